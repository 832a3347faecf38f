// The size of a finished card, as a caliper says it.
#pragma once

#include <optional>
#include <string>

namespace traygauge {

struct MeasuredCard {
  double width_mm = 0.0;  // between the outer edges of the black line
  double height_mm = 0.0;
  std::optional<double> thickness_mm;  // plastic and paper together
};

// No sheet that was printed at 100 % is off by more.
inline constexpr double kMaxScaleOff = 0.015;

// "84.9x53.6" or "84.9x53.6x1.0", in mm, also with decimal commas. Throws UsageError where that is no size,
// or none that the card can have; it says which mistake of printing or measuring makes such a size.
MeasuredCard read_measured_card(const std::string& text);

// How the print differs from what was drawn, a sentence or two.
std::string describe_print(const MeasuredCard& card);

// The table [card] of a station file; the print's picture is card.png beside it.
std::string compose_card_table(const MeasuredCard& card);

// The same, and its like for capture.json, with what they are for.
std::string compose_card_lines(const MeasuredCard& card);

}  // namespace traygauge
