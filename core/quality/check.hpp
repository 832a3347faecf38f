// What was compared with what else is known, and how it came out: numbers beside the warnings and refusals
// that follow from them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/labels/label_set.hpp"

namespace traygauge {

// As the JSON contract spells them, with units.
enum class CheckKind : std::uint8_t {
  dish_slip_mm,     // how far dish and card moved against each other between the pictures
  scale_percent,    // by how much the card's size would have to be wrong for the dish's to be right
  dish_height_mm,   // how far the dish's edge lies over where card and description put it
  dish_lean_deg,    // between the planes of the dish's edge and of the card
  glaze_height_mm,  // how far a dish's bare glaze lies over where its description puts it
  table_height_mm,  // how far the table around the card lies over where the card puts it; of the card's label
  own_motion_mm,    // how far dishes slid over the table, which were measured all the same
  item_slip_mm,     // how far an item moved between the pictures, across the line between the cameras
  item_foot_mm,     // how high an item's edge came out over the dish; it does not lie below it
  item_unlike_percent,  // share of an item that looks different in the two pictures
  object_height_mm,     // of what stands beside the dishes and is none of them, 0 without any; of the
                        // background's label
  focal_percent,        // how much longer or shorter a focal length makes card and dishes agree, where one
                        // does; of the background's label
};
inline constexpr auto kCheckNames =
    std::to_array<const char*>({"dish_slip_mm", "scale_percent", "dish_height_mm", "dish_lean_deg",
                                "glaze_height_mm", "table_height_mm", "own_motion_mm", "item_slip_mm",
                                "item_foot_mm", "item_unlike_percent", "object_height_mm", "focal_percent"});
inline const char* name(CheckKind kind) {
  return kCheckNames[static_cast<std::size_t>(kind)];
}

enum class Verdict : std::uint8_t { passed, warned, refused };
inline constexpr auto kVerdictNames = std::to_array<const char*>({"passed", "warned", "refused"});
inline const char* name(Verdict verdict) {
  return kVerdictNames[static_cast<std::size_t>(verdict)];
}

struct Check {
  CheckKind kind = CheckKind::dish_slip_mm;
  std::uint8_t label = kBackgroundLabel;  // of the dish or item that it is about
  double value = 0.0;
  double sigma = 0.0;
  double limit = 0.0;  // of the magnitude; beyond it the check does not pass
  Verdict verdict = Verdict::passed;
};

// `value` is significant, or has no sigma: is it too much?
constexpr Verdict judge(double value, double warning, double most) {
  const double magnitude = value < 0.0 ? -value : value;
  if (magnitude > most) return Verdict::refused;
  return magnitude > warning ? Verdict::warned : Verdict::passed;
}

class CheckList {
 public:
  // Eight dishes with six each, sixteen items with three, the table, what stands on it, and the lens.
  static constexpr std::size_t kCapacity = 99;

  // What does not fit is left out.
  void add(const Check& check) {
    if (size_ < kCapacity) checks_[size_++] = check;
  }
  std::span<const Check> items() const { return std::span(checks_).first(size_); }

 private:
  std::array<Check, kCapacity> checks_{};
  std::size_t size_ = 0;
};

}  // namespace traygauge
