#include "core/segmentation/glaze.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/median.hpp"
#include "core/base/units.hpp"

namespace traygauge {
namespace {

// Counts of bytes.
class ByteHistogram {
 public:
  void add(int value) {
    ++counts_[static_cast<std::size_t>(std::clamp(value, 0, 255))];
    ++total_;
  }
  int median() const {
    int below = 0;
    for (int value = 0; value < 256; ++value) {
      below += counts_[static_cast<std::size_t>(value)];
      if (2 * below >= total_) return value;
    }
    return 255;
  }
  int total() const { return total_; }

 private:
  std::array<int, kByteValues> counts_{};
  int total_ = 0;
};

template <class Take>
void for_each_cell(const DishRaster& raster, DishZone zone, Take&& take) {
  for (int y = 0; y < raster.height(); ++y) {
    for (int x = 0; x < raster.width(); ++x) {
      if (raster.zones.at(x, y) == zone) take(x, y);
    }
  }
}

// Mean bends over the squares about cells, row by row and from left to right. Of a row, the bends of each
// column are summed once.
class TextureReader {
 public:
  TextureReader(ImageView<const CellColour> colours, int radius) : colours_(colours), radius_(radius) {}

  // Doubled.
  int at(int x, int y) {
    if (y != row_) end_ = 0;
    row_ = y;
    const int top = std::max(0, y - radius_);
    const int bottom = std::min(colours_.height - 1, y + radius_);
    const int left = std::max(0, x - radius_);
    const int right = std::min(colours_.width - 1, x + radius_);
    for (int i = std::max(end_, left); i <= right; ++i) {
      int& column = column_at(i);
      column = 0;
      for (int j = top; j <= bottom; ++j) column += bend_at(colours_, i, j);
    }
    end_ = right + 1;
    int sum = 0;
    for (int i = left; i <= right; ++i) sum += column_at(i);
    return 2 * sum / ((bottom - top + 1) * (right - left + 1));
  }

 private:
  static constexpr std::size_t kColumns = 64;  // more than the largest square has

  int& column_at(int x) { return columns_[static_cast<std::size_t>(x) % kColumns]; }

  ImageView<const CellColour> colours_;
  int radius_;
  int row_ = -1;
  int end_ = 0;  // of the columns summed
  std::array<int, kColumns> columns_{};
};

}  // namespace

bool measure_glaze(const DishRaster& raster, const GlazeParams& params, GlazeColour& glaze) {
  ByteHistogram luma;
  ByteHistogram red;
  ByteHistogram green;
  ByteHistogram texture;
  TextureReader reader(raster.colours, params.texture_radius);
  for_each_cell(raster, DishZone::flange, [&](int x, int y) {
    const CellColour& colour = raster.colours.at(x, y);
    luma.add(colour.luma);
    red.add(colour.red);
    green.add(colour.green);
    texture.add(reader.at(x, y));
  });
  if (luma.total() < params.min_flange_cells) return false;
  glaze.median = {static_cast<std::uint8_t>(luma.median()), static_cast<std::uint8_t>(red.median()),
                  static_cast<std::uint8_t>(green.median())};
  ByteHistogram share_off;
  for_each_cell(raster, DishZone::flange, [&](int x, int y) {
    const CellColour& colour = raster.colours.at(x, y);
    share_off.add(std::abs(colour.red - glaze.median.red));
    share_off.add(std::abs(colour.green - glaze.median.green));
  });
  glaze.share_sigma = std::max(params.min_share_sigma, kMedianToSigma * share_off.median());
  glaze.texture = std::max(1.0, static_cast<double>(texture.median()));
  return true;
}

}  // namespace traygauge
