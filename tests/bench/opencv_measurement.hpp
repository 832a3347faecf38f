// The whole measurement from OpenCV's parts: what a good engineer would assemble. SIFT on dish and card,
// exhaustive ratio matching, essential matrix by USAC, scale and plane from the card's pose, planar
// rectification with the dish's bottom at zero disparity, semi-global matching with both views as the
// reference in turn, prisms over the dish's bottom.
#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <vector>

#include "tests/bench/opencv_stereo.hpp"
#include "tests/bench/scene.hpp"

namespace traygauge::bench {

struct SparsePoints {
  std::vector<cv::Point2d> pixels;  // of the frame
  cv::Mat descriptors;
};

// RootSIFT, at most `count` points of `box`, searched for with the picture scaled by `scale` (at most 1).
SparsePoints find_sift(const cv::Mat& gray, const cv::Rect& box, double scale, int count);

// Index pairs: mutual nearest neighbours whose distance is below `ratio` times the next one's.
std::vector<cv::Point> match_symmetric(cv::DescriptorMatcher& matcher, const cv::Mat& first,
                                       const cv::Mat& second, float ratio);

struct OpenCvPattern {
  SparsePoints points;
  double px_per_mm = 0.0;
};
// Once per card, as ours does at construction.
OpenCvPattern prepare_pattern(const Scene& scene);

// The card as one view shows it.
struct OpenCvCard {
  std::map<int, cv::Point2d> rays;  // of each point of the pattern that was found
  cv::Matx33d rotation;             // camera from card
  cv::Vec3d origin_mm;
};
// By its own points: homography to the pattern, then its pose.
bool find_card(const cv::Mat& gray, const cv::Rect& box, const OpenCvPattern& pattern, const OpenCvLens& lens,
               OpenCvCard& card);

// Volumes by label; empty when the motion, the card or the dish was not found.
std::map<int, double> measure_by_opencv(const Scene& scene, const OpenCvPattern& pattern);

}  // namespace traygauge::bench
