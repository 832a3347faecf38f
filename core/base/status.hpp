// Every way in which a measurement can end, with the sentence that a person reads.
#pragma once

#include <cstdint>

namespace traygauge {

enum class StatusCode : std::uint8_t {
  ok,
  partial,
  invalid_configuration,
  out_of_memory,
  frame_missing,
  frame_size_mismatch,
  labels_size_mismatch,
  frame_too_dark,
  frame_too_bright,
  no_dish_label,
  no_food_label,
  too_many_dishes,
  dish_cut_off,
  too_blurred,
  card_hidden,
  exposure_differs,
  white_balance_differs,
  too_few_features,
  too_few_matches,
  views_identical,
  views_too_close,
  views_too_far_apart,
  pose_not_found,
  pose_contradicts_card,
  card_not_found,
  scale_not_found,
  labels_inconsistent,
  rectification_failed,
  disparity_range_too_large,
  rim_not_found,
  table_not_found,
  dish_unknown,
  too_little_depth,
  item_too_small,
  item_hidden,
  item_below_dish,
  item_clipped,
  item_textureless,
};

// The code as the JSON contract spells it, e.g. "card_not_found".
const char* name(StatusCode code);

// One sentence: what happened and what to do.
const char* sentence(StatusCode code);

// The outcome of a function that can fail.
class [[nodiscard]] Status {
 public:
  constexpr Status() = default;
  constexpr Status(StatusCode code) : code_(code) {}  // NOLINT(google-explicit-constructor): reads as a value
  constexpr bool ok() const { return code_ == StatusCode::ok; }
  constexpr StatusCode code() const { return code_; }

 private:
  StatusCode code_ = StatusCode::ok;
};

}  // namespace traygauge
