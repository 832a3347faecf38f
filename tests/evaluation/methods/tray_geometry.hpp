// What the compared methods share: the dish's plane from the card, and a run's record.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/evaluate/protocol.hpp"
#include "firmware/measure/capture_session.hpp"
#include "tests/evaluation/methods/pair_features.hpp"

namespace traygauge::tables {

// Both cameras in mm and the table by the card alone. Valid until the session's next measurement, on which
// its pictures depend.
struct CalibratedPair {
  Pose second_from_first;
  Plane dish_bottom;  // in the first camera
  paper::WorkingPictures pictures;
  std::vector<RayMatch> inliers;
  double relative_angle_deg = 0.0;
  double time_ms = 0.0;  // from matches to scale
};

// The motion by profile paper from these matches, and the dish's bottom by the points of the card in the
// sparse cloud. `refusal` says why there is none.
std::optional<CalibratedPair> calibrate_pair(CaptureSession& session, const PairMatches& matches,
                                             std::uint64_t seed, StatusCode& refusal);

// The printed side of the card in one view by the pattern's points (Zhang's homography, then least squares),
// with an inlier distance of 3 % of its length as in the paper; mm, in the camera.
std::optional<Plane> find_card_plane(const CaptureSession& session, int view, const PointFeatures& points,
                                     const PointFeatures& pattern);

// The only dish's bottom over the card's print; nothing when the tray's dish is not known.
std::optional<Plane> bottom_under_print(const CaptureSession& session, const Plane& print);

// camera_from_dish: the dish frame on `bottom`, z up, its origin where the middle of the picture looks.
Pose frame_on(const Plane& bottom, const PinholeCamera& camera, ImageView<const std::uint8_t> picture);

// The same pixels for OpenCV.
cv::Mat as_cv(ImageView<const std::uint8_t> picture);

// Labels of the items that a picture of labels shows.
std::vector<std::uint8_t> items_in(ImageView<const std::uint8_t> labels);

// Sets the run's status by that of its items.
void conclude(Run& run);

}  // namespace traygauge::tables
