// Profile `best`: pyramid, card, corners and tracks.
#include <cmath>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "core/tracking/pose_correction.hpp"
#include "tests/bench/comparisons.hpp"
#include "tests/bench/opencv_measurement.hpp"

namespace traygauge::bench {
namespace {

constexpr std::size_t kCornerLevel = 1;  // half size, as the tracker looks for them
constexpr int kRowSiftPoints = 4000;
constexpr double kSiftDishPixels = 400000.0;

Comparison compare_pyramid(const BestData& data) {
  const cv::Mat& gray = data.views[0].gray;
  const auto ours = [&gray,
                     workspace = std::make_shared<OwnedWorkspace<PyramidWorkspace>>(gray.cols, gray.rows)] {
    const GrayPyramid pyramid = build_pyramid(view_of(gray), **workspace);
    return static_cast<double>(pyramid.levels.back().width * pyramid.levels.back().height);
  };
  const auto resize = [&gray] {
    cv::Mat half;
    cv::Mat quarter;
    cv::resize(gray, half, {(gray.cols + 1) / 2, (gray.rows + 1) / 2}, 0.0, 0.0, cv::INTER_AREA);
    cv::resize(half, quarter, {(half.cols + 1) / 2, (half.rows + 1) / 2}, 0.0, 0.0, cv::INTER_AREA);
    return static_cast<double>(quarter.total());
  };
  const auto blur = [&gray] {
    cv::Mat half;
    cv::Mat quarter;
    cv::pyrDown(gray, half);
    cv::pyrDown(half, quarter);
    return static_cast<double>(quarter.total());
  };
  return {
      "pyramid",
      "pixels at last",
      {{"ours, two halvings", ours}, {"cv::resize, INTER_AREA, twice", resize}, {"cv::pyrDown twice", blur}}};
}

// Mean distance of the print's corners from where the finished measurement has them, which starts from our
// alignment, but rests on tracks and rims as well.
double card_error_px(const BestData& data, const Pose& camera_from_table) {
  const ReferenceCard& card = data.configuration.card;
  double sum_px = 0.0;
  for (const Vec2& corner : {Vec2(0.0, 0.0), Vec2(card.width_mm, 0.0), Vec2(card.width_mm, card.height_mm),
                             Vec2(0.0, card.height_mm)}) {
    const Vec3 point_mm = print_point_mm(corner, card.thickness_mm);
    sum_px +=
        data.scene.lens.pinhole.mean_focal_px() * ((camera_from_table * point_mm).hnormalized() -
                                                   (data.views[0].camera_from_table * point_mm).hnormalized())
                                                      .norm();
  }
  return sum_px / 4.0;
}

Comparison compare_card(const BestData& data) {
  const BestDataView& view = data.views[0];
  const CardAlignmentParams& params = data.configuration.card_alignment;
  const auto ours = [&data, &view, &params,
                     workspace = std::make_shared<OwnedWorkspace<CardAlignmentWorkspace>>(params)] {
    const Result<CardAlignment> alignment =
        align_card(view_of(view.gray), view_of(view.labels), view.regions.card, data.scene.lens,
                   *data.pattern, params, **workspace);
    return alignment.ok() ? card_error_px(data, alignment->camera_from_table) : std::nan("");
  };
  const auto peer = [&data, &view, lens = OpenCvLens(data.scene.lens),
                     pattern = prepare_pattern(data.scene)] {
    OpenCvCard card;
    if (!find_card(view.gray, as_rect(view.regions.card), pattern, lens, card)) return std::nan("");
    // Its frame lies on the print, y down and z into the table.
    const Mat3 axes = Vec3(1.0, -1.0, -1.0).asDiagonal();
    Pose camera_from_table;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) camera_from_table.rotation(r, c) = card.rotation(r, c);
      camera_from_table.translation[r] = card.origin_mm[r];
    }
    camera_from_table.rotation *= axes;
    camera_from_table.translation -=
        camera_from_table.rotation * Vec3(0.0, 0.0, data.configuration.card.thickness_mm);
    return card_error_px(data, camera_from_table);
  };
  return {"card", "px off", {{"ours, by grey values", ours}, {"cv::SIFT, homography, PnP", peer}}};
}

Comparison compare_corners(const BestData& data) {
  const ImageView<const std::uint8_t> picture = data.views[0].pyramid.levels[kCornerLevel];
  const PointTrackingParams& params = data.configuration.tracking;
  const auto ours = [&data, picture, &params,
                     workspace = std::make_shared<OwnedWorkspace<CornerWorkspace>>(
                         picture.width, picture.height, params.corners),
                     storage = std::vector<Corner>(static_cast<std::size_t>(params.max_corners))]() mutable {
    Random random(1);
    BoundedList<Corner> corners(storage);
    find_corners({picture, view_of(data.views[0].labels), 1 << kCornerLevel, {}}, params.corners, random,
                 **workspace, corners);
    return static_cast<double>(corners.size());
  };
  const auto peer = [&params, half = cv::Mat(picture.height, picture.width, CV_8U,
                                             const_cast<std::uint8_t*>(picture.data))] {
    std::vector<cv::Point2f> corners;
    cv::goodFeaturesToTrack(half, corners, params.max_corners, 0.01, 3.0);
    return static_cast<double>(corners.size());
  };
  return {"corners", "corners", {{"ours, spread over the scene", ours}, {"cv::goodFeaturesToTrack", peer}}};
}

// Points that lie within a pixel of the epipolar line that was measured.
class TrueTracks {
 public:
  explicit TrueTracks(const BestData& data)
      : lens_(data.scene.lens),
        distance_(second_from_first({data.views[0].camera_from_table, data.views[1].camera_from_table}),
                  data.scene.lens.pinhole.mean_focal_px()) {}
  bool holds(const Vec2& first_ray, const Vec2& second_ray) const {
    return std::abs(distance_(first_ray, second_ray)) < 1.0;
  }
  bool holds_pixels(const Vec2& first, const Vec2& second) const {
    Vec2 first_ray;
    Vec2 second_ray;
    return lens_.undistort_pixel(first, first_ray) && lens_.undistort_pixel(second, second_ray) &&
           holds(first_ray, second_ray);
  }

 private:
  LensModel lens_;
  EpipolarDistance distance_;
};

Method opencv_flow(const BestData& data) {
  return {
      "cv::calcOpticalFlowPyrLK", [&data, truth = TrueTracks(data)] {
        const int count = data.configuration.tracking.max_corners;
        std::vector<cv::Point2f> first;
        std::vector<cv::Point2f> second;
        std::vector<std::uint8_t> found;
        cv::goodFeaturesToTrack(data.views[0].gray, first, count, 0.01, 6.0);
        cv::calcOpticalFlowPyrLK(data.views[0].gray, data.views[1].gray, first, second, found, cv::noArray(),
                                 {21, 21}, 5);
        double good = 0.0;
        for (std::size_t i = 0; i < first.size(); ++i) {
          good += found[i] != 0 && truth.holds_pixels({first[i].x, first[i].y}, {second[i].x, second[i].y});
        }
        return good;
      }};
}

Method opencv_sift(const BestData& data) {
  return {"cv::SIFT, cv::BFMatcher", [&data, truth = TrueTracks(data)] {
            std::array<SparsePoints, 2> points;
            for (std::size_t i = 0; i < 2; ++i) {
              const BestDataView& view = data.views[i];
              const cv::Rect box = as_rect(view.regions.dish) | as_rect(view.regions.card);
              points[i] = find_sift(view.gray, box, std::sqrt(kSiftDishPixels / view.regions.dish_pixels),
                                    kRowSiftPoints);
            }
            cv::BFMatcher matcher(cv::NORM_L2);
            double good = 0.0;
            for (const cv::Point& pair :
                 match_symmetric(matcher, points[0].descriptors, points[1].descriptors, 0.8F)) {
              const cv::Point2d& a = points[0].pixels[static_cast<std::size_t>(pair.x)];
              const cv::Point2d& b = points[1].pixels[static_cast<std::size_t>(pair.y)];
              good += truth.holds_pixels({a.x, a.y}, {b.x, b.y});
            }
            return good;
          }};
}

// From pyramids and the card's poses, which ours needs, and from whole pictures, which the peers need.
Comparison compare_tracks(const BestData& data) {
  const PointTrackingParams& params = data.configuration.tracking;
  const auto ours = [&data, &params, truth = TrueTracks(data),
                     workspace = std::make_shared<OwnedWorkspace<PointTrackingWorkspace>>(
                         data.scene.lens.width, data.scene.lens.height, params)] {
    Random random(1);
    std::span<const PointTrack> tracks;
    PointTrackingReport report;
    const Status status =
        track_points(data.tracked(0), data.tracked(1), {data.views[0].from_card, data.views[1].from_card},
                     data.configuration.card.thickness_mm, params, random, **workspace, tracks, report);
    double good = 0.0;
    if (!status.ok()) return good;
    for (const PointTrack& track : tracks) good += truth.holds(track.first, track.second);
    return good;
  };
  return {"tracks", "on their lines", {{"ours, from corners", ours}, opencv_sift(data), opencv_flow(data)}};
}

}  // namespace

std::vector<Comparison> compare_best_sparse_stages(const BestData& data) {
  return {compare_pyramid(data), compare_card(data), compare_corners(data), compare_tracks(data)};
}

}  // namespace traygauge::bench
