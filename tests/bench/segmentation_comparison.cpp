// Card, dishes and food found in two views, beside the same put together from OpenCV's parts.
#include <algorithm>
#include <memory>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "firmware/segment/label_scores.hpp"
#include "tests/bench/comparisons.hpp"

namespace traygauge::bench {
namespace {

constexpr double kHalf = 0.5;

cv::Mat picture_of(const Scene& scene, std::size_t view) {
  const Picture& frame = scene.frames[view];
  return {frame.size.height, frame.size.width, CV_8UC3, const_cast<std::uint8_t*>(frame.pixels.data())};
}

cv::ColorConversionCodes either(const Scene& scene, cv::ColorConversionCodes from_rgb,
                                cv::ColorConversionCodes from_bgr) {
  return scene.frames[0].format == PixelFormat::rgb8 ? from_rgb : from_bgr;
}

// How much of what is food both say is, in %, over both views.
double food_percent(const Scene& scene, const std::array<Picture, 2>& labels) {
  double sum = 0.0;
  for (std::size_t v = 0; v < 2; ++v) sum += 50.0 * score_labels(labels[v], scene.labels[v]).food_iou;
  return sum;
}

// Finds the labels of a scene, which outlives it.
struct Drawing {
  explicit Drawing(const Scene& scene_) : scene(scene_), session(scene_) {}

  std::array<Picture, 2> draw() {
    session.estimator.reset();
    std::array<Picture, 2> drawn;
    for (std::size_t v = 0; v < 2; ++v) {
      ViewInput view = scene.view(v);
      view.labels = {};
      static_cast<void>(session.estimator.add_view(view));
    }
    for (std::size_t v = 0; v < 2; ++v) {
      const ImageView<const std::uint8_t> labels = session.estimator.labels(v);
      drawn[v] = Picture({labels.width, labels.height}, PixelFormat::gray8);
      std::copy_n(labels.data, drawn[v].pixels.size(), drawn[v].pixels.begin());
    }
    return drawn;
  }

  const Scene& scene;
  Session session;
};

struct PrintFeatures {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
};

// The print at about the scale at which half a picture shows it.
PrintFeatures describe_print(const Scene& scene, cv::ORB& orb) {
  const cv::Mat print(scene.pattern.size.height, scene.pattern.size.width, CV_8U,
                      const_cast<std::uint8_t*>(scene.pattern.pixels.data()));
  cv::Mat reduced;
  const double scale = 200.0 / print.cols;
  cv::resize(print, reduced, {}, scale, scale, cv::INTER_AREA);
  PrintFeatures features;
  orb.detectAndCompute(reduced, cv::noArray(), features.points, features.descriptors);
  return features;
}

// The card by ORB features and a homography.
void find_card_by_opencv(const cv::Mat& gray, const PrintFeatures& print, cv::ORB& orb) {
  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
  orb.detectAndCompute(gray, cv::noArray(), points, descriptors);
  std::vector<std::vector<cv::DMatch>> matches;
  cv::BFMatcher(cv::NORM_HAMMING).knnMatch(descriptors, print.descriptors, matches, 2);
  std::vector<cv::Point2f> from;
  std::vector<cv::Point2f> to;
  for (const auto& pair : matches) {
    if (pair.size() < 2 || pair[0].distance > 0.9F * pair[1].distance) continue;
    from.push_back(print.points[static_cast<std::size_t>(pair[0].trainIdx)].pt);
    to.push_back(points[static_cast<std::size_t>(pair[0].queryIdx)].pt);
  }
  if (from.size() >= 4) cv::findHomography(from, to, cv::RANSAC, 3.0);
}

// The ellipse around the largest contour of edges.
cv::RotatedRect find_dish_by_opencv(const cv::Mat& gray) {
  cv::Mat edges;
  cv::Canny(gray, edges, 40.0, 100.0);
  cv::dilate(edges, edges, cv::Mat());
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(edges, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::RotatedRect dish;
  for (const auto& contour : contours) {
    if (contour.size() < 5) continue;
    std::vector<cv::Point> hull;
    cv::convexHull(contour, hull);
    if (hull.size() < 5) continue;
    const cv::RotatedRect box = cv::fitEllipse(hull);
    if (box.size.area() > dish.size.area()) dish = box;
  }
  return dish;
}

// Colours by mean shift; what is coloured or dark on the dish is food.
cv::Mat find_food_by_opencv(const cv::Mat& picture, const cv::RotatedRect& dish,
                            cv::ColorConversionCodes to_lab) {
  cv::Mat smooth;
  cv::pyrMeanShiftFiltering(picture, smooth, 8.0, 16.0, 1);
  cv::Mat lab;
  cv::cvtColor(smooth, lab, to_lab);
  std::array<cv::Mat, 3> planes;
  cv::split(lab, planes.data());
  cv::Mat labels(picture.size(), CV_8U, cv::Scalar(0));
  cv::ellipse(labels, dish, cv::Scalar(kDishLabel), cv::FILLED);
  const cv::Mat coloured = (cv::abs(planes[1] - 128) > 10) | (cv::abs(planes[2] - 128) > 14);
  labels.setTo(kFirstItemLabel, coloured & (labels == kDishLabel));
  return labels;
}

std::array<Picture, 2> draw_by_opencv(const Scene& scene, const PrintFeatures& print, cv::ORB& orb) {
  std::array<Picture, 2> drawn;
  for (std::size_t v = 0; v < 2; ++v) {
    cv::Mat half;
    cv::Mat gray;
    cv::resize(picture_of(scene, v), half, {}, kHalf, kHalf, cv::INTER_AREA);
    cv::cvtColor(half, gray, either(scene, cv::COLOR_RGB2GRAY, cv::COLOR_BGR2GRAY));
    find_card_by_opencv(gray, print, orb);
    const cv::Mat labels = find_food_by_opencv(half, find_dish_by_opencv(gray),
                                               either(scene, cv::COLOR_RGB2Lab, cv::COLOR_BGR2Lab));
    drawn[v] = Picture(scene.frames[v].size, PixelFormat::gray8);
    cv::Mat full(drawn[v].size.height, drawn[v].size.width, CV_8U, drawn[v].pixels.data());
    cv::resize(labels, full, full.size(), 0.0, 0.0, cv::INTER_NEAREST);
  }
  return drawn;
}

}  // namespace

Comparison compare_segmentation(const Scene& scene) {
  const auto drawing = std::make_shared<Drawing>(scene);
  const auto ours = [&scene, drawing] { return food_percent(scene, drawing->draw()); };
  const cv::Ptr<cv::ORB> orb = cv::ORB::create(2000);
  const auto peer = [&scene, orb, print = describe_print(scene, *orb)] {
    return food_percent(scene, draw_by_opencv(scene, print, *orb));
  };
  return {scene.name + ", card, dish and food found",
          "% of the food",
          {{"ours", ours}, {"ORB, Canny, mean shift at half size", peer}}};
}

}  // namespace traygauge::bench
