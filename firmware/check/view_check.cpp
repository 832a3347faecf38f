#include "firmware/check/view_check.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "firmware/base/text.hpp"
#include "firmware/card/card_finder.hpp"
#include "firmware/card/known_cards.hpp"

namespace traygauge {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;

}  // namespace

CheckResult check_card(const FrameView& picture, const LensModel& lens, const ReferenceCard& card,
                       std::optional<Pose>& camera_from_table) {
  camera_from_table.reset();
  CardFinder finder(lens.width, lens.height);
  CardAlignment found;
  if (!finder.learn(card).ok()) {
    return {"card", false,
            "The picture [card] pattern shows too little to recognise a card by; use another."};
  }
  if (!finder.find(picture, lens, found).ok()) {
    const std::array<CardSight, 1> sights{{{picture, lens}}};
    if (const auto other = find_other_card(sights, card))
      return {"card", false, tell_other_card(*other, card, "[card] pattern")};
    return {
        "card", false,
        "The card is not in view, or not to be recognised; lay it flat beside the dish, printed side up, all "
        "of it in the picture and in focus."};
  }
  camera_from_table = found.camera_from_table;
  const double distance_mm = (found.camera_from_table * finder.card_centre_mm()).norm();
  return {"card", true,
          "seen at " + fixed(distance_mm, 0) + " mm, " +
              fixed(lens.pinhole.mean_focal_px() / distance_mm, 1) + " px a mm; " +
              fixed(100.0 * found.visible_fraction, 0) + " % of it in view, its print agrees to " +
              fixed(100.0 * found.correlation, 0) + " %"};
}

CheckResult check_move(const Pose& second_from_first, double commanded_deg,
                       const std::optional<ArmGeometry>& geometry, const MoveCheckParams& params) {
  CheckResult result{"arm and card", true, ""};
  const double seen_deg = rotation_angle_deg(second_from_first.rotation);
  result.text = "the camera turned by " + fixed(seen_deg, 2) + " degrees where " +
                fixed(std::abs(commanded_deg), 2) + " were commanded";
  if (!geometry) {
    result.is_good = std::abs(seen_deg - std::abs(commanded_deg)) <= params.max_angle_off_deg;
    if (!result.is_good) {
      result.text +=
          "; correct arm.steps_per_deg or the arm's own scale, or calibrate the arm (traygauge "
          "calibrate arm).";
    }
    return result;
  }
  if (std::abs(commanded_deg - geometry->commanded_deg) > params.max_angle_off_deg) {
    result.is_good = false;
    result.text += "; the arm was calibrated at " + fixed(geometry->commanded_deg, 2) +
                   " degrees: set arm.second_view_deg to that, or calibrate the arm again.";
    return result;
  }
  const Vec3 turn(geometry->turn_deg[0], geometry->turn_deg[1], geometry->turn_deg[2]);
  const Vec3 shift(geometry->shift_mm[0], geometry->shift_mm[1], geometry->shift_mm[2]);
  const double off_deg =
      rotation_angle_deg(rotation_about(kRadians * turn).transpose() * second_from_first.rotation);
  const double off_mm = (shift - second_from_first.translation).norm();
  result.text += "; " + fixed(off_deg, 2) + " degrees and " + fixed(off_mm, 1) +
                 " mm from where it was when the arm was calibrated";
  result.is_good = off_deg <= params.max_angle_off_deg && off_mm <= params.max_shift_off_mm;
  if (!result.is_good) {
    result.text += ": the camera or the arm sits otherwise now; tighten it and calibrate the arm again.";
  }
  return result;
}

}  // namespace traygauge
