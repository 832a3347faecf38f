#include "tests/evaluation/methods/pair_features.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/image/resample.hpp"
#include "core/labels/label_regions.hpp"
#include "tests/evaluation/methods/stopwatch.hpp"

namespace traygauge::tables {
namespace {

// OpenCV's SIFT doubles the picture so that all points come to lie a quarter of a pixel too far right and
// down (4.6, and later versions without enable_precise_upscale). Views that are turned against each other or
// differ in scale do not share that shift.
constexpr double kSiftOffsetPx = 0.25;
// Half of OpenCV's default, which leaves many foods without points: SIFT then finds about as many as SURF.
constexpr double kSiftContrast = 0.02;
constexpr int kSiftLayers = 3;
// For the same reason half of OpenCV's default of ORB's corners.
constexpr int kOrbFastThreshold = 10;
constexpr float kOrbScale = 1.2F;
constexpr int kOrbLevels = 8;
constexpr int kOrbPatchPx = 31;
// ORB leaves out what lies nearer to the border than its patch, in each level of its pyramid: on a card that
// fills its picture, most of the print.
const int kOrbBorderPx = cvCeil(kOrbPatchPx * std::pow(static_cast<double>(kOrbScale), kOrbLevels - 1));

struct SearchedPart {
  cv::Rect box;        // of the stored picture
  double scale = 1.0;  // wanted
  int cap = 0;         // points
};

cv::Ptr<cv::Feature2D> make_finder(Detector detector, int cap) {
  if (detector == Detector::sift) return cv::SIFT::create(cap, kSiftLayers, kSiftContrast);
  return cv::ORB::create(cap, kOrbScale, kOrbLevels, kOrbPatchPx, 0, 2, cv::ORB::HARRIS_SCORE, kOrbPatchPx,
                         kOrbFastThreshold);
}

PointFeatures detect(const cv::Mat& gray, const SearchedPart& part, Detector detector) {
  cv::Mat picture = gray(part.box);
  if (part.scale != 1.0)
    cv::resize(picture, picture, {}, part.scale, part.scale,
               part.scale < 1.0 ? cv::INTER_AREA : cv::INTER_CUBIC);
  const double scale_x = static_cast<double>(picture.cols) / part.box.width;
  const double scale_y = static_cast<double>(picture.rows) / part.box.height;
  const int border_px = detector == Detector::orb ? kOrbBorderPx : 0;
  const cv::Rect2d inside(border_px, border_px, picture.cols, picture.rows);
  if (border_px > 0)
    cv::copyMakeBorder(picture, picture, border_px, border_px, border_px, border_px,
                       cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
  make_finder(detector, part.cap)->detectAndCompute(picture, cv::noArray(), keypoints, descriptors);
  const double offset_px = detector == Detector::sift ? kSiftOffsetPx : border_px;
  PointFeatures features;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const cv::Point2d at = keypoints[i].pt;
    if (border_px > 0 && !inside.contains(at)) continue;
    features.pixels.emplace_back(part.box.x + scale_coordinate(at.x - offset_px, 1.0 / scale_x),
                                 part.box.y + scale_coordinate(at.y - offset_px, 1.0 / scale_y));
    features.descriptors.push_back(descriptors.row(static_cast<int>(i)));
  }
  return features;
}

// Appends those on the card, or those beside it.
void append(const PointFeatures& from, const cv::Mat& labels, bool on_card, PointFeatures& to) {
  for (std::size_t i = 0; i < from.pixels.size(); ++i) {
    const cv::Point place(std::clamp(cvRound(from.pixels[i].x()), 0, labels.cols - 1),
                          std::clamp(cvRound(from.pixels[i].y()), 0, labels.rows - 1));
    if ((labels.at<std::uint8_t>(place) == kCardLabel) != on_card) continue;
    to.pixels.push_back(from.pixels[i]);
    to.descriptors.push_back(from.descriptors.row(static_cast<int>(i)));
  }
}

struct Neighbour {
  int index = -1;
  bool is_distinct = false;
};

std::vector<Neighbour> nearest(const cv::Mat& from, const cv::Mat& to, int norm, double ratio) {
  std::vector<std::vector<cv::DMatch>> two;
  cv::BFMatcher(norm).knnMatch(from, to, two, 2);
  std::vector<Neighbour> neighbours(static_cast<std::size_t>(from.rows));
  for (std::size_t i = 0; i < two.size(); ++i) {
    if (two[i].size() < 2) continue;
    neighbours[i] = {two[i][0].trainIdx, static_cast<double>(two[i][1].distance) >=
                                             ratio * static_cast<double>(two[i][0].distance)};
  }
  return neighbours;
}

}  // namespace

cv::Mat gray_of(const CaptureSession& session, int view) {
  const Picture& picture = session.view(view).picture;
  const cv::Mat pixels(picture.size.height, picture.size.width,
                       picture.format == PixelFormat::gray8 ? CV_8UC1 : CV_8UC3,
                       const_cast<std::uint8_t*>(picture.pixels.data()));
  if (picture.format == PixelFormat::gray8) return pixels;
  cv::Mat gray;
  cv::cvtColor(pixels, gray, picture.format == PixelFormat::rgb8 ? cv::COLOR_RGB2GRAY : cv::COLOR_BGR2GRAY);
  return gray;
}

cv::Mat labels_of(const CaptureSession& session, int view) {
  const Picture& labels = session.view(view).labels;
  return {labels.size.height, labels.size.width, CV_8UC1, const_cast<std::uint8_t*>(labels.pixels.data())};
}

PointFeatures find_in_view(const CaptureSession& session, int view, Detector detector) {
  const paper::Configuration usual;
  const cv::Mat gray = gray_of(session, view);
  const cv::Mat labels = labels_of(session, view);
  const LabelRegions regions = measure_regions(session.view(view).labels.gray());
  PointFeatures features;
  const CardDescription& card = session.setup().card;
  const PixelBox& box = regions.card;
  if (!box.empty()) {
    const double seen_px_per_mm = std::sqrt(regions.pixels[kCardLabel] / (card.width_mm * card.height_mm));
    const double scale =
        std::clamp(usual.view.card_px_per_mm / seen_px_per_mm, 1.0, usual.view.max_card_enlargement);
    append(
        detect(gray, {{box.left, box.top, box.width(), box.height()}, scale, usual.caps.max_card_keypoints},
               detector),
        labels, true, features);
  }
  const double pixels = static_cast<double>(gray.cols) * gray.rows;
  const double scale = std::min({1.0, std::sqrt(usual.view.feature_dish_px / regions.dish_pixels),
                                 std::sqrt(usual.caps.max_feature_px / pixels)});
  const int room = usual.caps.max_keypoints - static_cast<int>(features.pixels.size());
  append(detect(gray, {{0, 0, gray.cols, gray.rows}, scale, room}, detector), labels, false, features);
  return features;
}

PointFeatures find_on_pattern(const CaptureSession& session, Detector detector) {
  const paper::Configuration usual;
  const Picture& pattern = session.setup().pattern;
  const double width_mm = session.setup().card.width_mm;
  const cv::Mat picture(pattern.size.height, pattern.size.width, CV_8UC1,
                        const_cast<std::uint8_t*>(pattern.pixels.data()));
  const double scale = std::min(1.0, usual.view.card_px_per_mm * width_mm / picture.cols);
  PointFeatures features = detect(
      picture, {{0, 0, picture.cols, picture.rows}, scale, usual.caps.max_pattern_keypoints}, detector);
  for (Vec2& pixel : features.pixels) pixel = pattern_mm(pixel, picture.cols, {width_mm});
  return features;
}

std::vector<IndexPair> match_points(const PointFeatures& first, const PointFeatures& second,
                                    Detector detector, double ratio) {
  std::vector<IndexPair> pairs;
  if (first.descriptors.rows < 2 || second.descriptors.rows < 2) return pairs;
  const int norm = detector == Detector::sift ? cv::NORM_L2 : cv::NORM_HAMMING;
  const auto forward = nearest(first.descriptors, second.descriptors, norm, ratio);
  const auto backward = nearest(second.descriptors, first.descriptors, norm, ratio);
  for (std::size_t i = 0; i < forward.size(); ++i) {
    if (forward[i].index < 0 || !forward[i].is_distinct) continue;
    const Neighbour& back = backward[static_cast<std::size_t>(forward[i].index)];
    if (back.index == static_cast<int>(i) && back.is_distinct)
      pairs.push_back({static_cast<int>(i), forward[i].index});
  }
  return pairs;
}

PairMatches match_pair(const CaptureSession& session, Detector detector) {
  const double ratio = static_cast<double>(paper::MatcherParams{}.distinctiveness_ratio);
  const PointFeatures pattern = find_on_pattern(session, detector);
  const Stopwatch watch;
  const std::array<PointFeatures, 2> views = {find_in_view(session, 0, detector),
                                              find_in_view(session, 1, detector)};
  std::array<std::vector<int>, 2> on_pattern;
  for (std::size_t v = 0; v < 2; ++v) {
    on_pattern[v].assign(views[v].pixels.size(), -1);
    for (const IndexPair& pair : match_points(views[v], pattern, detector, ratio))
      on_pattern[v][static_cast<std::size_t>(pair.first)] = pair.second;
  }
  PairMatches found;
  for (const IndexPair& pair : match_points(views[0], views[1], detector, ratio)) {
    const auto i = static_cast<std::size_t>(pair.first);
    const auto j = static_cast<std::size_t>(pair.second);
    found.matches.push_back({views[0].pixels[i], views[1].pixels[j]});
    const int point = on_pattern[0][i];
    if (point < 0 || on_pattern[1][j] != point) continue;
    found.card_matches.push_back(
        {pattern.pixels[static_cast<std::size_t>(point)], views[0].pixels[i], views[1].pixels[j]});
  }
  found.time_ms = watch.elapsed_ms();
  return found;
}

}  // namespace traygauge::tables
