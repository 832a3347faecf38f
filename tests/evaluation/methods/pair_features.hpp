// Salient points of OpenCV's detectors in both views and on the card's pattern, and their matches.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/paper/pipeline/estimator.hpp"
#include "firmware/measure/capture_session.hpp"

namespace traygauge::tables {

enum class Detector : std::uint8_t { sift, orb };

struct PointFeatures {
  std::vector<Vec2> pixels;  // of the stored picture
  cv::Mat descriptors;       // a row a point
};

// Pictures of a session as OpenCV takes them; they share its pixels where they can.
cv::Mat gray_of(const CaptureSession& session, int view);
cv::Mat labels_of(const CaptureSession& session, int view);

// Looks where profile paper looks for SURF, at the same scales: the frame with the dish reduced to a fixed
// area, and the card apart, enlarged to the scale of its pattern.
PointFeatures find_in_view(const CaptureSession& session, int view, Detector detector);
// The same on the pattern; pixels are mm on the printed side.
PointFeatures find_on_pattern(const CaptureSession& session, Detector detector);

struct IndexPair {
  int first = 0;
  int second = 0;
};
// Table I's best rule: each is the other's nearest, and the next one lies at least `ratio` times farther,
// seen from either side.
std::vector<IndexPair> match_points(const PointFeatures& first, const PointFeatures& second,
                                    Detector detector, double ratio);

struct PairMatches {
  std::vector<paper::GivenMatch> matches;
  std::vector<paper::GivenCardMatch> card_matches;  // whose three matches agree
  double time_ms = 0.0;  // the pattern's features apart, which a program finds once
};
PairMatches match_pair(const CaptureSession& session, Detector detector);

}  // namespace traygauge::tables
