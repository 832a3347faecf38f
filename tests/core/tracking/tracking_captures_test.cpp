// Tracks on rendered captures against their true poses and depth, from poses as wrong as a card may leave
// them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "core/tracking/point_tracking.hpp"
#include "tests/support/allocated.hpp"
#include "tests/support/cameras.hpp"
#include "tests/support/capture_bundle.hpp"
#include "tests/support/pictures.hpp"

namespace traygauge {
namespace {

using test::view_of;

struct CaptureCase {
  const char* folder = nullptr;
  std::size_t min_tracks = 0;  // dark wood carries hardly any texture that both views agree on
  double min_inliers = 0.0;
  double max_rms_px = 0.0;

  friend std::ostream& operator<<(std::ostream& stream, const CaptureCase& c) { return stream << c.folder; }
};

class TracksOnCaptures : public ::testing::TestWithParam<CaptureCase> {
 protected:
  TracksOnCaptures() : memory_(1600, 1200, params_) {}
  void SetUp() override {
    if (test::captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES is not set";
    capture_ = test::read_capture_truth(test::captures_folder() / GetParam().folder);
    thickness_mm_ = capture_.description.at("card").at("thickness_mm");
    table_ = test::table_frame_of(capture_, thickness_mm_).inverse();
  }
  void load(int first, int second) {
    const std::array<int, 2> indices = {first, second};
    for (std::size_t i = 0; i < 2; ++i) {
      const test::TrueView& view = capture_.views.at(static_cast<std::size_t>(indices[i]));
      gray_[i] = view.read_gray();
      labels_[i] = view.read_labels();
      truth_[i] = view.camera_from_world * table_;
      lenses_[i] = view.lens;
    }
  }
  Status run(const TableCameras& cameras) {
    std::array<TrackedView, 2> views;
    for (std::size_t i = 0; i < 2; ++i)
      views[i] = {build_pyramid(view_of(gray_[i]), *pyramids_[i]), view_of(labels_[i]), lenses_[i]};
    Random random(1);
    return track_points(views[0], views[1], cameras, thickness_mm_, params_, random, *memory_, tracks_,
                        report_);
  }

  PointTrackingParams params_;
  test::Allocated<PointTrackingWorkspace> memory_;
  test::Allocated<PyramidWorkspace> first_pyramid_{1600, 1200};
  test::Allocated<PyramidWorkspace> second_pyramid_{1600, 1200};
  const std::array<const PyramidWorkspace*, 2> pyramids_ = {&*first_pyramid_, &*second_pyramid_};
  test::CaptureTruth capture_;
  double thickness_mm_ = 0.0;
  Pose table_;
  std::array<cv::Mat, 2> gray_;
  std::array<cv::Mat, 2> labels_;
  std::array<LensModel, 2> lenses_;
  TableCameras truth_;
  std::span<const PointTrack> tracks_;
  PointTrackingReport report_;
};

TEST_P(TracksOnCaptures, LieOnTheTrueEpipolarLines) {
  for (const auto& [a, b] : capture_.pairs) {
    SCOPED_TRACE(::testing::Message() << "pair " << a << "-" << b);
    load(a, b);
    ASSERT_TRUE(
        run({truth_[0], test::perturbed(truth_[1], 0.3, 2.0, static_cast<std::uint64_t>(10 * a + b))}).ok());
    const EpipolarDistance distance(second_from_first(truth_), lenses_[1].pinhole.mean_focal_px());
    std::size_t inliers = 0;
    double squares = 0.0;
    double signed_sum = 0.0;
    double normalised = 0.0;
    std::array<int, kGrounds> count{};
    for (const PointTrack& track : tracks_) {
      ++count[static_cast<std::size_t>(ground_of(track.label))];
      const double error_px = distance(track.first, track.second);
      if (!(std::abs(error_px) < 0.5)) continue;
      ++inliers;
      squares += error_px * error_px;
      signed_sum += error_px;
      const auto sigma = static_cast<double>(track.sigma_px);
      normalised += error_px * error_px / (sigma * sigma);
    }
    const auto n = static_cast<double>(inliers);
    EXPECT_GE(tracks_.size(), GetParam().min_tracks);
    EXPECT_GE(n, GetParam().min_inliers * static_cast<double>(tracks_.size()));
    EXPECT_LE(std::sqrt(squares / n), GetParam().max_rms_px);
    EXPECT_LE(std::abs(signed_sum / n), 3.5 * std::sqrt(squares) / n + 0.01);
    EXPECT_GT(std::sqrt(normalised / n), 0.6);
    EXPECT_LT(std::sqrt(normalised / n), 1.4);
    EXPECT_GE(count[static_cast<std::size_t>(Ground::card)], 10);
    EXPECT_GE(count[static_cast<std::size_t>(Ground::food)], 15);
  }
}

TEST_P(TracksOnCaptures, EndWhereTheTrueDepthHasThem) {
  load(0, 1);
  ASSERT_TRUE(run({truth_[0], test::perturbed(truth_[1], 0.3, 2.0, 77)}).ok());
  const cv::Mat1f depth = capture_.read_depth_mm();
  const Pose motion = second_from_first(truth_);
  std::vector<double> errors_px;
  for (const PointTrack& track : tracks_) {
    const Vec2 pixel = lenses_[0].pixel(track.first);
    const cv::Rect around(static_cast<int>(pixel.x()) - 2, static_cast<int>(pixel.y()) - 2, 6, 6);
    if ((around & cv::Rect(0, 0, depth.cols, depth.rows)) != around) continue;
    double low = 0.0;
    double high = 0.0;
    cv::minMaxLoc(depth(around), &low, &high);
    if (low <= 0.0 || high - low > 3.0) continue;  // an edge
    cv::Mat1f there;
    cv::getRectSubPix(depth, {1, 1},
                      cv::Point2f(static_cast<float>(pixel.x()), static_cast<float>(pixel.y())), there);
    const double depth_mm = static_cast<double>(there(0, 0));
    const Vec3 point = motion * (depth_mm * Vec3(track.first.x(), track.first.y(), 1.0));
    errors_px.push_back(lenses_[1].pinhole.mean_focal_px() *
                        (point.head<2>() / point.z() - track.second).norm());
  }
  ASSERT_GT(errors_px.size(), tracks_.size() / 2);
  std::sort(errors_px.begin(), errors_px.end());
  EXPECT_LT(errors_px[errors_px.size() / 2], 0.25);
  EXPECT_LT(errors_px[errors_px.size() * 9 / 10], 1.0);
}

// The camera stands still and the tray is moved: what lies around it stays where it was in the picture, and
// does not follow the card.
TEST_P(TracksOnCaptures, SurroundingsThatStayAreDropped) {
  const auto [a, b] = capture_.pairs.back();
  load(a, b);
  std::vector<cv::Point> tray;
  cv::Mat covered = (labels_[1] != 0);
  cv::findNonZero(covered, tray);
  cv::Mat1b kept(covered.size(), std::uint8_t{0});
  std::vector<cv::Point> hull;
  cv::convexHull(tray, hull);
  cv::fillConvexPoly(kept, hull, 255);
  cv::dilate(kept, kept, cv::Mat(), {-1, -1}, 20);
  gray_[0].copyTo(gray_[1], kept == 0);
  ASSERT_TRUE(run({truth_[0], test::perturbed(truth_[1], 0.3, 2.0, 5)}).ok());
  std::size_t standing = 0;
  for (const PointTrack& track : tracks_) {
    const Vec2 second = lenses_[1].pixel(track.second);
    if (kept(static_cast<int>(second.y()), static_cast<int>(second.x())) == 0) ++standing;
  }
  EXPECT_LE(standing, tracks_.size() / 20);
  const EpipolarDistance distance(second_from_first(truth_), lenses_[1].pinhole.mean_focal_px());
  std::size_t inliers = 0;
  for (const PointTrack& track : tracks_)
    inliers += std::abs(distance(track.first, track.second)) < 0.5 ? 1U : 0U;
  EXPECT_GE(static_cast<double>(inliers), 0.9 * static_cast<double>(tracks_.size()));
}

INSTANTIATE_TEST_SUITE_P(
    Captures, TracksOnCaptures,
    ::testing::Values(CaptureCase{"meals/m01", 200, 0.95, 0.15}, CaptureCase{"meals/m04", 450, 0.98, 0.13},
                      CaptureCase{"meals/m06", 600, 0.98, 0.13}, CaptureCase{"meals/m08", 700, 0.98, 0.11},
                      CaptureCase{"angles/a01", 700, 0.98, 0.08},
                      CaptureCase{"plates/c1_oval", 600, 0.98, 0.14},
                      CaptureCase{"trays/t04", 600, 0.98, 0.11}, CaptureCase{"trays/t05", 180, 0.92, 0.17}),
    [](const auto& test) {
      std::string name = test.param.folder;
      std::replace(name.begin(), name.end(), '/', '_');
      return name;
    });

}  // namespace
}  // namespace traygauge
