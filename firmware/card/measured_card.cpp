#include "firmware/card/measured_card.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "firmware/base/exit_status.hpp"
#include "firmware/base/text.hpp"
#include "firmware/card/card_drawing.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

constexpr double kThinnestMm = 0.05;
constexpr double kThickestMm = 3.0;
constexpr double kPlasticMm = 0.8;
// A caliper and a cut by hand are good to 0.2 mm of 54.
constexpr double kMaxUnnoticedStretch = 0.004;
// Beyond, the two sides do not speak of one scale.
constexpr double kMaxFitStretch = 0.015;
constexpr double kLeastFit = 0.7;
constexpr double kMostFit = 1.3;
constexpr const char* kMeasureAgain =
    "measure between the outer edges of the black line, and where the size is right, print again at 100 %";

// Of the print over the drawing.
struct PrintScale {
  double across = 1.0;
  double down = 1.0;

  double mean() const { return 0.5 * (across + down); }
  double stretch() const { return std::abs(across / down - 1.0); }
  bool lies_within(double least, double most) const {
    return std::min(across, down) >= least && std::max(across, down) <= most;
  }
};

PrintScale scale_of(const MeasuredCard& card) {
  return {card.width_mm / kCardWidthMm, card.height_mm / kCardHeightMm};
}

std::string percent(double scale) {
  return fixed(100.0 * scale, 0) + " %";
}

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw UsageError("--measured " + printable(text) + ": " + why);
}

// What explains a size that the card cannot have.
std::string explain(const MeasuredCard& card) {
  constexpr double kNear = 0.9;
  const PrintScale scale = scale_of(card);
  const PrintScale swapped{card.height_mm / kCardWidthMm, card.width_mm / kCardHeightMm};
  const auto is_near = [&](const PrintScale& other, double unit_mm) {
    return other.lies_within(kNear / unit_mm, 1.0 / (kNear * unit_mm));
  };
  if (is_near(swapped, 1.0)) return "the width comes first, along the longer side of the pattern";
  if (is_near(scale, 10.0)) return "these are centimetres; type millimetres";
  if (is_near(scale, 25.4)) return "these are inches; type millimetres";
  if (!scale.lies_within(kLeastFit, kMostFit)) {
    return "expected about 85.60x53.98, the size of a credit card; " + std::string(kMeasureAgain);
  }
  if (scale.stretch() > kMaxFitStretch) {
    return percent(scale.across) + " across but " + percent(scale.down) +
           " down: the printer stretches, or the cut is not along the black line; " + kMeasureAgain;
  }
  if (scale.mean() < 1.0) {
    return percent(scale.mean()) +
           ": printed with 'fit to page', or on paper of another size than --paper; print again at 100 % "
           "('actual size')";
  }
  return percent(scale.mean()) +
         ": enlarged, as with 'fill page' or a scale of its own; print again at 100 % ('actual size')";
}

}  // namespace

MeasuredCard read_measured_card(const std::string& text) {
  const std::vector<double> numbers = read_sizes(text);
  const bool are_positive =
      std::all_of(numbers.begin(), numbers.end(), [](double number) { return number > 0.0; });
  if (numbers.size() < 2 || numbers.size() > 3 || !are_positive) {
    refuse(text, "expected WIDTHxHEIGHT or WIDTHxHEIGHTxTHICKNESS in mm, such as 85.4x53.9x1.0");
  }
  MeasuredCard card{numbers[0], numbers[1], {}};
  if (!scale_of(card).lies_within(1.0 - kMaxScaleOff, 1.0 + kMaxScaleOff)) refuse(text, explain(card));
  if (numbers.size() == 3) {
    if (numbers[2] < kThinnestMm || numbers[2] > kThickestMm) {
      refuse(text, "expected a thickness of 0.05 to 3 mm, about 1.0 for plastic with paper on both sides");
    }
    card.thickness_mm = numbers[2];
  }
  return card;
}

std::string describe_print(const MeasuredCard& card) {
  const PrintScale scale = scale_of(card);
  std::string text = "The print is " + fixed(100.0 * scale.across, 1) + " % as wide and " +
                     fixed(100.0 * scale.down, 1) + " % as high as it was drawn";
  if (scale.stretch() > kMaxUnnoticedStretch) {
    text +=
        ": the printer stretches one way, or the cut is not along the black line. The lines below take it "
        "into account where the whole print is stretched";
  }
  text += ".\n";
  if (!card.thickness_mm) {
    text +=
        "The thickness below is that of plain plastic. Measure it with the paper glued on, since a quarter "
        "of a millimetre is 1 % of the food in a dish 25 mm deep: --measured WIDTHxHEIGHTxTHICKNESS.\n";
  }
  return text;
}

std::string compose_card_table(const MeasuredCard& card) {
  return "[card]\npattern = \"card.png\"\nwidth_mm = " + fixed(card.width_mm, 2) +
         "\nheight_mm = " + fixed(card.height_mm, 2) +
         "\nthickness_mm = " + fixed(card.thickness_mm.value_or(kPlasticMm), 2) + "\n";
}

std::string compose_card_lines(const MeasuredCard& card) {
  return "For the station file:\n\n" + compose_card_table(card) +
         "\nFor capture.json:\n\n\"card\": {\"pattern\": \"card.png\", \"width_mm\": " +
         fixed(card.width_mm, 2) + ", \"height_mm\": " + fixed(card.height_mm, 2) +
         ", \"thickness_mm\": " + fixed(card.thickness_mm.value_or(kPlasticMm), 2) + "}\n";
}

}  // namespace traygauge
