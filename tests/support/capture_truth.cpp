#include "tests/support/capture_truth.hpp"

#include <cstdlib>
#include <fstream>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

namespace traygauge::test {
namespace {

constexpr double kDepthUnitMm = 0.02;  // of depth_0.png
constexpr int kLastDishLabel = 199;

void set_distortion(LensModel& lens, const std::vector<double>& k) {
  lens.k1 = k.at(0);
  lens.k2 = k.at(1);
  lens.p1 = k.at(2);
  lens.p2 = k.at(3);
  lens.k3 = k.at(4);
}

LensModel lens_from_json(const nlohmann::json& camera) {
  LensModel lens;
  lens.width = camera.at("width");
  lens.height = camera.at("height");
  lens.pinhole = {camera.at("fx"), camera.at("fy"), camera.at("cx"), camera.at("cy")};
  set_distortion(lens, camera.at("distortion"));
  return lens;
}

}  // namespace

std::filesystem::path captures_folder() {
  const char* folder = std::getenv("TRAYGAUGE_CAPTURES");
  return folder == nullptr ? "" : folder;
}

nlohmann::json read_json(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return nlohmann::json::parse(stream);
}

Vec3 vec3_from_json(const nlohmann::json& values) {
  return {values.at(0).get<double>(), values.at(1).get<double>(), values.at(2).get<double>()};
}

Pose pose_from_json(const nlohmann::json& rows) {
  Pose pose;
  for (int r = 0; r < 3; ++r) {
    const nlohmann::json& row = rows.at(static_cast<std::size_t>(r));
    pose.rotation.row(r) = vec3_from_json(row).transpose();
    pose.translation[r] = row.at(3).get<double>();
  }
  return pose;
}

cv::Mat1b TrueView::read_gray() const {
  return cv::imread(image.string(), cv::IMREAD_GRAYSCALE);
}

cv::Mat1b TrueView::read_labels() const {
  return cv::imread(labels.string(), cv::IMREAD_UNCHANGED);
}

std::vector<cv::Point2d> TrueView::rays(const std::vector<cv::Point2d>& pixels) const {
  std::vector<cv::Point2d> rays;
  cv::undistortPoints(pixels, rays, camera_matrix(lens.pinhole), distortion_of(lens));
  return rays;
}

cv::Mat1f CaptureTruth::read_depth_mm() const {
  cv::Mat1f depth_mm;
  cv::imread((folder / "depth_0.png").string(), cv::IMREAD_UNCHANGED)
      .convertTo(depth_mm, CV_32F, kDepthUnitMm);
  return depth_mm;
}

CaptureTruth read_capture_truth(const std::filesystem::path& folder) {
  CaptureTruth capture;
  capture.folder = folder;
  capture.description = read_json(folder / "capture.json");
  capture.truth = read_json(folder / "truth.json");
  for (const nlohmann::json& entry : capture.description.at("views")) {
    TrueView view;
    view.image = folder / entry.at("image").get<std::string>();
    if (entry.contains("labels")) view.labels = folder / entry.at("labels").get<std::string>();
    view.lens =
        lens_from_json(entry.contains("camera") ? entry.at("camera") : capture.description.at("camera"));
    view.camera_from_world = pose_from_json(capture.truth.at("poses").at(capture.views.size()));
    capture.views.push_back(view);
  }
  capture.pairs = capture.description.at("pairs");
  for (const nlohmann::json& corner : capture.truth.at("card_corners_mm")) {
    capture.card_corners_mm.push_back(vec3_from_json(corner));
  }
  return capture;
}

std::vector<TrueView> read_real_views(const std::filesystem::path& folder) {
  std::vector<TrueView> views;
  const nlohmann::json cameras = read_json(folder / "cameras.json");
  for (const nlohmann::json& entry : cameras.at("views")) {
    TrueView view;
    view.image = folder / entry.at("image").get<std::string>();
    const auto matrix = entry.at("K").get<std::vector<double>>();
    const auto rotation = entry.at("R").get<std::vector<double>>();
    view.lens.pinhole = {matrix.at(0), matrix.at(4), matrix.at(2), matrix.at(5)};
    set_distortion(view.lens, entry.value("dist_k1k2p1p2k3", std::vector<double>(5, 0.0)));
    view.camera_from_world.rotation =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation.data());
    view.camera_from_world.translation = vec3_from_json(entry.at("t"));
    views.push_back(view);
  }
  return views;
}

Pose motion_between(const Pose& first_from_world, const Pose& second_from_world) {
  return second_from_world * first_from_world.inverse();
}

Plane plane_in_camera(const Plane& world, const Pose& camera_from_world) {
  const Vec3 normal = camera_from_world.rotation * world.normal;
  return {normal, world.offset + normal.dot(camera_from_world.translation)};
}

PinholeCamera enlarge(const PinholeCamera& camera, double scale) {
  return {scale * camera.fx_px, scale * camera.fy_px, scale * (camera.cx_px + 0.5) - 0.5,
          scale * (camera.cy_px + 0.5) - 0.5};
}

cv::Mat1b dish_mask(const cv::Mat1b& labels) {
  cv::Mat1b mask;
  cv::inRange(labels, 1, kLastDishLabel, mask);
  return mask;
}

Undistortion::Undistortion(const LensModel& lens, const PinholeCamera& target, cv::Size size) {
  cv::initUndistortRectifyMap(camera_matrix(lens.pinhole), distortion_of(lens), cv::noArray(),
                              camera_matrix(target), size, CV_32FC1, map_x_, map_y_);
}

cv::Mat Undistortion::apply(const cv::Mat& stored, int interpolation) const {
  cv::Mat target;
  cv::remap(stored, target, map_x_, map_y_, interpolation);
  return target;
}

}  // namespace traygauge::test
