#include "tests/evaluation/methods/dense_views.hpp"

#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <vector>

#include "tests/evaluation/methods/stopwatch.hpp"

namespace traygauge::tables {
namespace {

constexpr int kCorners = 2000;
constexpr double kQuality = 0.001;  // of the strongest corner's response: food is far weaker than print
constexpr double kCornerDistance_px = 6.0;
constexpr int kCornerBlock_px = 3;
constexpr double kHarris = 0.04;
constexpr int kWindow_px = 21;
constexpr int kLevels = 5;          // the rest of the motion: up to 100 px for food 50 mm high
constexpr double kReturn_px = 0.5;  // of a track followed back to its corner
constexpr double kHomographyInlier_px = 3.0;
constexpr std::size_t kMinCardMatches = 8;

cv::Point2f as_point(const Vec2& pixel) {
  return {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
}

// From pixels of the first picture to those of the second, by the card.
cv::Mat card_homography(const PairMatches& by_sift) {
  std::vector<cv::Point2f> first;
  std::vector<cv::Point2f> second;
  for (const paper::GivenCardMatch& match : by_sift.card_matches) {
    first.push_back(as_point(match.first));
    second.push_back(as_point(match.second));
  }
  if (first.size() < kMinCardMatches) return {};
  return cv::findHomography(first, second, cv::RANSAC, kHomographyInlier_px);
}

}  // namespace

PairMatches track_corners(const CaptureSession& session, const PairMatches& by_sift) {
  const Stopwatch watch;
  PairMatches tracks;
  tracks.card_matches = by_sift.card_matches;
  tracks.time_ms = by_sift.time_ms;
  const cv::Mat homography = card_homography(by_sift);
  if (homography.empty()) return tracks;
  const cv::Mat first = gray_of(session, 0);
  const cv::Mat second = gray_of(session, 1);
  cv::Mat warped;
  cv::warpPerspective(second, warped, homography, first.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(first, corners, kCorners, kQuality, kCornerDistance_px, cv::noArray(),
                          kCornerBlock_px, true, kHarris);
  if (corners.empty()) return tracks;
  std::vector<cv::Point2f> followed;
  std::vector<cv::Point2f> returned;
  std::vector<std::uint8_t> found;
  std::vector<std::uint8_t> found_back;
  const cv::Size window(kWindow_px, kWindow_px);
  cv::calcOpticalFlowPyrLK(first, warped, corners, followed, found, cv::noArray(), window, kLevels);
  cv::calcOpticalFlowPyrLK(warped, first, followed, returned, found_back, cv::noArray(), window, kLevels);
  std::vector<cv::Point2f> in_second;
  cv::perspectiveTransform(followed, in_second, homography);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (found[i] == 0 || found_back[i] == 0 || cv::norm(returned[i] - corners[i]) > kReturn_px) continue;
    tracks.matches.push_back({Vec2(corners[i].x, corners[i].y), Vec2(in_second[i].x, in_second[i].y)});
  }
  tracks.time_ms += watch.elapsed_ms();
  return tracks;
}

Run measure_dense_views(CaptureSession& session, const PairMatches& tracks, std::uint64_t seed,
                        const SweepParams& params) {
  Run run;
  run.seed = seed;
  const auto pair = calibrate_pair(session, tracks, seed, run.status);
  if (!pair) return run;
  const Stopwatch watch;
  run.relative_angle_deg = pair->relative_angle_deg;
  const ImageView<const std::uint8_t> labels = pair->pictures.labels[0];
  const Pose first_from_dish = frame_on(pair->dish_bottom, pair->pictures.cameras[0], labels);
  const SweepView first{pair->pictures.cameras[0], first_from_dish, as_cv(pair->pictures.gray[0])};
  const SweepView second{pair->pictures.cameras[1], pair->second_from_first * first_from_dish,
                         as_cv(pair->pictures.gray[1])};
  const cv::Mat heights = filter_heights(sweep_heights(first, second, params), first,
                                         sweep_heights(second, first, params), second, params);
  const cv::Mat picture = as_cv(labels);
  for (const std::uint8_t label : items_in(labels)) {
    const double ml = volume_under_ml(heights, picture == label, first);
    if (std::isnan(ml)) {
      run.items.push_back({label, StatusCode::item_hidden});
    } else if (ml <= 0.0) {
      run.items.push_back({label, StatusCode::item_below_dish});
    } else {
      run.items.push_back({label, StatusCode::ok, ml});
    }
  }
  conclude(run);
  run.total_ms = pair->time_ms + watch.elapsed_ms();
  return run;
}

}  // namespace traygauge::tables
