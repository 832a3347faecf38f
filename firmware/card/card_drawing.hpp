// The patterns of the reference cards that Traygauge prints, each drawn from its number alone.
//
// A pattern is black and white, so that no printer has to raster a grey, and no shape of it comes twice. Per
// size, from 16 mm down to 1 mm, quadrangles are strewn, each turned another way and in the colour that its
// middle does not have yet. So there are corners for every distance from which a camera may look. All is
// integer arithmetic on core's generator: a number gives the same shapes on every machine, for ever, since
// cards outlive programs (tests/firmware/card/card_drawing_test.cpp holds their hashes).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "simulator/capture/picture.hpp"

namespace traygauge {

// They are numbered from 1.
inline constexpr int kCardPatterns = 12;

// A 50th of a millimetre.
inline constexpr int kCardUnitsPerMm = 50;
inline constexpr int kCardWidthUnits = 4280;   // 85.60 mm, ISO/IEC 7810 ID-1
inline constexpr int kCardHeightUnits = 2699;  // 53.98 mm
inline constexpr double kCardWidthMm = static_cast<double>(kCardWidthUnits) / kCardUnitsPerMm;
inline constexpr double kCardHeightMm = static_cast<double>(kCardHeightUnits) / kCardUnitsPerMm;

// Units from the card's top left corner, x to the right, y down.
struct CardPoint {
  std::int32_t x = 0;
  std::int32_t y = 0;
};

// A quadrangle without crossing sides; it may reach beyond the card.
struct CardShape {
  std::array<CardPoint, 4> corners{};
  bool is_ink = true;  // else paper
};

// What people call the card, such as "TG-03".
std::string card_id(int number);

// In the order in which they are painted on white paper. The card's id stands in its bottom left corner, and
// a black line of 0.4 mm runs along its edge, to measure the print from.
std::vector<CardShape> draw_card(int number);

// Grey values that ink and paper have in photographs: their light is as 1 to 20. No paper reaches 255, where
// the search of corners takes it for a highlight.
inline constexpr std::uint8_t kInkGray = 52;
inline constexpr std::uint8_t kPaperGray = 232;

// The drawing as a picture of this size, which the card fills; each pixel has the mean light of `fineness`²
// samples.
Picture picture_of(std::span<const CardShape> drawing, PictureSize size, int fineness);

// The picture that a station searches for, 10 px/mm.
inline constexpr PictureSize kCardPictureSize{856, 540};
Picture card_picture(int number);

}  // namespace traygauge
