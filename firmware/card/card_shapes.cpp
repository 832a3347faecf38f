#include "firmware/card/card_shapes.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace traygauge {
namespace {

// Lenses and pixels average light, of which grey values are about the root; rounded.
std::vector<std::uint8_t> grays_by_ink(int samples) {
  std::vector<std::uint8_t> grays;
  for (int ink = 0; ink <= samples; ++ink) {
    const int light = kPaperGray * kPaperGray * (samples - ink) + kInkGray * kInkGray * ink;
    int gray = 0;
    while ((2 * gray + 1) * (2 * gray + 1) * samples <= 4 * light) ++gray;
    grays.push_back(static_cast<std::uint8_t>(gray));
  }
  return grays;
}

}  // namespace

std::vector<std::int32_t> card_sample_places(int samples, int extent_units) {
  std::vector<std::int32_t> places(static_cast<std::size_t>(samples));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::int64_t doubled = (2 * static_cast<std::int64_t>(i) + 1) * extent_units * kPlacesPerUnit;
    places[i] = static_cast<std::int32_t>(doubled / (2 * static_cast<std::int64_t>(samples)));
  }
  return places;
}

CardRows rows_of(const CardShape& shape) {
  const auto [top, bottom] =
      std::minmax_element(shape.corners.begin(), shape.corners.end(),
                          [](const CardPoint& a, const CardPoint& b) { return a.y < b.y; });
  return {kPlacesPerUnit * top->y, kPlacesPerUnit * bottom->y};
}

void fill_card_row(const CardShape& shape, std::int32_t row_place, const std::vector<std::int32_t>& places,
                   std::uint8_t* row) {
  std::array<std::int64_t, 4> crossings{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    CardPoint a = shape.corners[i];
    CardPoint b = shape.corners[(i + 1) % 4];
    if (a.y > b.y) std::swap(a, b);
    if (row_place < kPlacesPerUnit * a.y || row_place >= kPlacesPerUnit * b.y) continue;
    const std::int64_t product = (row_place - kPlacesPerUnit * static_cast<std::int64_t>(a.y)) * (b.x - a.x);
    const std::int64_t height = b.y - a.y;
    const std::int64_t quotient = product / height - (product % height < 0 ? 1 : 0);  // rounded down
    std::int64_t crossing = kPlacesPerUnit * static_cast<std::int64_t>(a.x) + quotient;
    for (std::size_t k = 0; k < count; ++k) {
      if (crossing < crossings[k]) std::swap(crossing, crossings[k]);
    }
    crossings[count++] = crossing;
  }
  for (std::size_t i = 0; i + 1 < count; i += 2) {
    const auto begin = std::lower_bound(places.begin(), places.end(), crossings[i]);
    const auto end = std::lower_bound(begin, places.end(), crossings[i + 1]);
    std::fill(row + (begin - places.begin()), row + (end - places.begin()),
              static_cast<std::uint8_t>(shape.is_ink));
  }
}

Picture picture_of(std::span<const CardShape> drawing, PictureSize size, int fineness) {
  const std::vector<std::int32_t> across = card_sample_places(size.width * fineness, kCardWidthUnits);
  const std::vector<std::int32_t> down = card_sample_places(size.height * fineness, kCardHeightUnits);
  const std::vector<std::uint8_t> gray_by_ink = grays_by_ink(fineness * fineness);
  std::vector<CardRows> extents;
  for (const CardShape& shape : drawing) extents.push_back(rows_of(shape));
  Picture picture(size, PixelFormat::gray8);
  std::vector<std::uint8_t> row(across.size());
  std::vector<int> ink(static_cast<std::size_t>(size.width));
  const auto fine = static_cast<std::size_t>(fineness);
  for (std::size_t y = 0; y < static_cast<std::size_t>(size.height); ++y) {
    std::fill(ink.begin(), ink.end(), 0);
    for (std::size_t k = 0; k < fine; ++k) {
      const std::int32_t place = down[fine * y + k];
      std::fill(row.begin(), row.end(), std::uint8_t{0});
      for (std::size_t i = 0; i < drawing.size(); ++i) {
        if (extents[i].hold(place)) fill_card_row(drawing[i], place, across, row.data());
      }
      for (std::size_t x = 0; x < row.size(); ++x) ink[x / fine] += row[x];
    }
    for (std::size_t x = 0; x < ink.size(); ++x)
      picture.pixels[y * ink.size() + x] = gray_by_ink[static_cast<std::size_t>(ink[x])];
  }
  return picture;
}

Picture card_picture(int number) {
  constexpr int kFineness = 5;  // a sample a unit
  return picture_of(draw_card(number), kCardPictureSize, kFineness);
}

}  // namespace traygauge
