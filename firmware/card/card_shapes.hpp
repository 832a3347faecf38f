// Quadrangles painted on a grid of samples, in integers.
#pragma once

#include <cstdint>
#include <vector>

#include "firmware/card/card_drawing.hpp"

namespace traygauge {

// Where samples may lie.
inline constexpr std::int32_t kPlacesPerUnit = 16;

// The samples of one axis, evenly spread over its extent.
std::vector<std::int32_t> card_sample_places(int samples, int extent_units);

// From which place on a shape is met, and before which.
struct CardRows {
  std::int32_t top = 0;
  std::int32_t bottom = 0;

  bool hold(std::int32_t place) const { return place >= top && place < bottom; }
};
CardRows rows_of(const CardShape& shape);

// Sets the samples of a row that lie in the shape: 1 where it is ink, else 0; as many samples as `places`.
// One on a left or upper side is inside, one on a right or lower side is not.
void fill_card_row(const CardShape& shape, std::int32_t row_place, const std::vector<std::int32_t>& places,
                   std::uint8_t* row);

}  // namespace traygauge
