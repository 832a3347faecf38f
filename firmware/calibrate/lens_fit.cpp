#include "firmware/calibrate/lens_fit.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

namespace traygauge {
namespace {

std::vector<cv::Point3f> points_on(const Chessboard& board) {
  std::vector<cv::Point3f> points;
  for (std::size_t i = 0; i < board.corner_count(); ++i) {
    const Vec2 corner = board.corner_place(i);
    points.emplace_back(static_cast<float>(corner.x()), static_cast<float>(corner.y()), 0.0F);
  }
  return points;
}

std::vector<cv::Point2f> pixels_of(const BoardSighting& sighting) {
  std::vector<cv::Point2f> pixels;
  for (const Vec2& corner : sighting.corners_px)
    pixels.emplace_back(static_cast<float>(corner.x()), static_cast<float>(corner.y()));
  return pixels;
}

int flags_for(LensTerms terms) {
  const int without_k3 = terms == LensTerms::all ? 0 : cv::CALIB_FIX_K3;
  return terms == LensTerms::radial ? without_k3 | cv::CALIB_ZERO_TANGENT_DIST : without_k3;
}

CameraDescription describe(const cv::Mat& matrix, const cv::Mat& distortion, PictureSize size) {
  CameraDescription camera;
  camera.size = size;
  camera.fx_px = matrix.at<double>(0, 0);
  camera.fy_px = matrix.at<double>(1, 1);
  camera.cx_px = matrix.at<double>(0, 2);
  camera.cy_px = matrix.at<double>(1, 2);
  for (int i = 0; i < 5; ++i) camera.distortion[static_cast<std::size_t>(i)] = distortion.at<double>(i);
  return camera;
}

bool is_plausible(const CameraDescription& camera) {
  const auto is_finite = [](double number) { return std::isfinite(number); };
  return std::all_of(camera.distortion.begin(), camera.distortion.end(), is_finite) && camera.fx_px > 0.0 &&
         camera.fy_px > 0.0 && std::isfinite(camera.fx_px) && std::isfinite(camera.fy_px) &&
         camera.cx_px >= 0.0 && camera.cx_px < camera.size.width && camera.cy_px >= 0.0 &&
         camera.cy_px < camera.size.height;
}

}  // namespace

double LensFit::rms_px() const {
  double sum = 0.0;
  for (const double rms_px : picture_rms_px) sum += rms_px * rms_px;
  return std::sqrt(sum / static_cast<double>(picture_rms_px.size()));
}

std::optional<LensFit> fit_lens(std::span<const BoardSighting* const> sightings, const Chessboard& board,
                                PictureSize size, LensTerms terms) {
  const std::vector<std::vector<cv::Point3f>> points(sightings.size(), points_on(board));
  std::vector<std::vector<cv::Point2f>> pixels;
  for (const BoardSighting* sighting : sightings) pixels.push_back(pixels_of(*sighting));
  cv::Mat matrix;
  cv::Mat distortion;
  std::vector<cv::Mat> turns;
  std::vector<cv::Mat> shifts;
  cv::Mat errors;
  try {
    cv::calibrateCamera(points, pixels, cv::Size(size.width, size.height), matrix, distortion, turns, shifts,
                        cv::noArray(), cv::noArray(), errors, flags_for(terms));
  } catch (const cv::Exception&) {  // boards that all face one way leave it nothing to begin with
    return std::nullopt;
  }
  LensFit fit;
  fit.camera = describe(matrix, distortion, size);
  if (!is_plausible(fit.camera)) return std::nullopt;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    fit.picture_rms_px.push_back(errors.at<double>(static_cast<int>(i)));
    cv::Mat rotation;
    cv::Rodrigues(turns[i], rotation);
    fit.board_normals.emplace_back(rotation.at<double>(0, 2), rotation.at<double>(1, 2),
                                   rotation.at<double>(2, 2));
  }
  return fit;
}

double reprojection_rms_px(const BoardSighting& sighting, const Chessboard& board,
                           const CameraDescription& camera) {
  const cv::Matx33d matrix(camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1);
  const cv::Mat distortion(1, 5, CV_64F, const_cast<double*>(camera.distortion.data()));
  const std::vector<cv::Point3f> points = points_on(board);
  const std::vector<cv::Point2f> pixels = pixels_of(sighting);
  cv::Vec3d turn;
  cv::Vec3d shift;
  cv::solvePnP(points, pixels, matrix, distortion, turn, shift);
  std::vector<cv::Point2f> seen;
  cv::projectPoints(points, turn, shift, matrix, distortion, seen);
  double sum = 0.0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const cv::Point2f off = seen[i] - pixels[i];
    sum += static_cast<double>(off.dot(off));
  }
  return std::sqrt(sum / static_cast<double>(seen.size()));
}

}  // namespace traygauge
