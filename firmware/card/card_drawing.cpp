#include "firmware/card/card_drawing.hpp"

#include <algorithm>
#include <cstddef>

#include "core/base/random.hpp"
#include "firmware/card/card_shapes.hpp"

namespace traygauge {
namespace {

// Changing any of these makes other cards.
constexpr std::uint64_t kFirstSeed = 0x7472617967617567ULL;
// Of the first 26, the twelve that core finds best: in each of 200 rendered pictures from 350 and 500 mm.
constexpr std::array<std::uint64_t, kCardPatterns> kSeeds{1, 5, 7, 9, 11, 12, 14, 15, 17, 18, 21, 26};
constexpr int kFrameUnits = 20;
struct Layer {
  int reach_units;  // of a corner from the middle, at most
  int shapes;
};
constexpr std::array<Layer, 5> kLayers{{{400, 10}, {200, 30}, {100, 80}, {50, 200}, {25, 500}}};

// Cosine and sine as fractions.
struct Turn {
  int cosine;
  int sine;
  int divisor;
};
constexpr std::array<Turn, 8> kTurns{
    {{3, 4, 5}, {4, 3, 5}, {5, 12, 13}, {12, 5, 13}, {24, 7, 25}, {7, 24, 25}, {21, 20, 29}, {1, 0, 1}}};

CardPoint turned(CardPoint point, const Turn& turn, CardPoint middle) {
  return {middle.x + (point.x * turn.cosine - point.y * turn.sine) / turn.divisor,
          middle.y + (point.x * turn.sine + point.y * turn.cosine) / turn.divisor};
}

// A corner in each quadrant about the middle.
CardShape draw_shape(Random& random, int reach) {
  const CardPoint middle{static_cast<std::int32_t>(random.below(kCardWidthUnits)),
                         static_cast<std::int32_t>(random.below(kCardHeightUnits))};
  const Turn& turn = kTurns[random.below(kTurns.size())];
  const auto span = static_cast<std::uint32_t>(reach);
  // Every third is a bar.
  const int narrow = random.below(3) == 0 ? 3 : 1;
  constexpr std::array<CardPoint, 4> kQuadrants{{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
  CardShape shape;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto x = static_cast<std::int32_t>(span / 5 + random.below(span - span / 5));
    const auto y = static_cast<std::int32_t>(span / 5 + random.below(span - span / 5));
    shape.corners[i] = turned({kQuadrants[i].x * x, kQuadrants[i].y * y / narrow}, turn, middle);
  }
  return shape;
}

CardShape rectangle(CardPoint corner, CardPoint size, bool is_ink) {
  const CardPoint far{corner.x + size.x, corner.y + size.y};
  return {{{corner, {far.x, corner.y}, far, {corner.x, far.y}}}, is_ink};
}

// What has been painted, 10 samples a millimetre.
class Canvas {
 public:
  Canvas()
      : across_(card_sample_places(kCardPictureSize.width, kCardWidthUnits)),
        down_(card_sample_places(kCardPictureSize.height, kCardHeightUnits)),
        ink_(Picture::area(kCardPictureSize)) {}

  bool is_ink_in_the_middle_of(const CardShape& shape) const {
    std::int32_t x = 0;
    std::int32_t y = 0;
    for (const CardPoint& corner : shape.corners) {
      x += corner.x;
      y += corner.y;
    }
    return ink_[index(across_, x / 4) + across_.size() * index(down_, y / 4)] != 0;
  }

  void paint(const CardShape& shape) {
    const CardRows rows = rows_of(shape);
    for (std::size_t y = 0; y < down_.size(); ++y) {
      if (rows.hold(down_[y])) fill_card_row(shape, down_[y], across_, &ink_[across_.size() * y]);
    }
  }

 private:
  static std::size_t index(const std::vector<std::int32_t>& places, std::int32_t unit) {
    const auto at = std::lower_bound(places.begin(), places.end(), kPlacesPerUnit * unit);
    return std::min(places.size() - 1, static_cast<std::size_t>(at - places.begin()));
  }

  std::vector<std::int32_t> across_;
  std::vector<std::int32_t> down_;
  std::vector<std::uint8_t> ink_;
};

// Five columns and seven rows; the highest of a row's five bits is its left one.
struct Glyph {
  char letter;
  std::array<std::uint8_t, 7> rows;
};
constexpr std::array<Glyph, 13> kGlyphs{{{'T', {31, 4, 4, 4, 4, 4, 4}},
                                         {'G', {14, 17, 16, 23, 17, 17, 14}},
                                         {'-', {0, 0, 0, 14, 0, 0, 0}},
                                         {'0', {14, 17, 19, 21, 25, 17, 14}},
                                         {'1', {4, 12, 4, 4, 4, 4, 14}},
                                         {'2', {14, 17, 1, 6, 8, 16, 31}},
                                         {'3', {14, 17, 1, 6, 1, 17, 14}},
                                         {'4', {2, 6, 10, 18, 31, 2, 2}},
                                         {'5', {31, 16, 30, 1, 1, 17, 14}},
                                         {'6', {6, 8, 16, 30, 17, 17, 14}},
                                         {'7', {31, 1, 2, 4, 8, 8, 8}},
                                         {'8', {14, 17, 17, 14, 17, 17, 14}},
                                         {'9', {14, 17, 17, 15, 1, 2, 12}}}};
constexpr int kDotUnits = 18;  // 2.5 mm high

void write_id(const std::string& id, std::vector<CardShape>& shapes) {
  const int width = static_cast<int>(id.size()) * 6 * kDotUnits + kDotUnits;
  const int top = kCardHeightUnits - kFrameUnits - 9 * kDotUnits;
  shapes.push_back(rectangle({kFrameUnits, top}, {width, 9 * kDotUnits}, false));
  for (std::size_t i = 0; i < id.size(); ++i) {
    const auto* const glyph = std::find_if(kGlyphs.begin(), kGlyphs.end(),
                                           [&](const Glyph& candidate) { return candidate.letter == id[i]; });
    const int left = kFrameUnits + kDotUnits + static_cast<int>(i) * 6 * kDotUnits;
    for (int row = 0; row < 7; ++row) {
      const unsigned bits = glyph->rows.at(static_cast<std::size_t>(row));
      const int y = top + (row + 1) * kDotUnits;
      for (int column = 0; column < 5; ++column) {
        if ((bits >> static_cast<unsigned>(4 - column) & 1U) == 0) continue;
        const int x = left + column * kDotUnits;
        shapes.push_back(rectangle({x, y}, {kDotUnits, kDotUnits}, true));
      }
    }
  }
}

void draw_frame(std::vector<CardShape>& shapes) {
  constexpr CardPoint kAcross{kCardWidthUnits, kFrameUnits};
  constexpr CardPoint kDown{kFrameUnits, kCardHeightUnits};
  shapes.push_back(rectangle({0, 0}, kAcross, true));
  shapes.push_back(rectangle({0, kCardHeightUnits - kFrameUnits}, kAcross, true));
  shapes.push_back(rectangle({0, 0}, kDown, true));
  shapes.push_back(rectangle({kCardWidthUnits - kFrameUnits, 0}, kDown, true));
}

}  // namespace

std::string card_id(int number) {
  return number < 10 ? "TG-0" + std::to_string(number) : "TG-" + std::to_string(number);
}

std::vector<CardShape> draw_card(int number) {
  Random random(kFirstSeed + kSeeds.at(static_cast<std::size_t>(number) - 1));
  std::vector<CardShape> shapes;
  Canvas canvas;
  for (const Layer& layer : kLayers) {
    for (int i = 0; i < layer.shapes; ++i) {
      CardShape shape = draw_shape(random, layer.reach_units);
      shape.is_ink = !canvas.is_ink_in_the_middle_of(shape);
      canvas.paint(shape);
      shapes.push_back(shape);
    }
  }
  write_id(card_id(number), shapes);
  draw_frame(shapes);
  return shapes;
}

}  // namespace traygauge
