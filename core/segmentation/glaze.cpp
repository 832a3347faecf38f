#include "core/segmentation/glaze.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/segmentation/geodesic.hpp"

namespace traygauge {
namespace {

constexpr double kMedianToSigma = 1.4826;

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
  std::array<int, 256> counts_{};
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

}  // namespace

void measure_texture(const DishRaster& raster, int radius, std::span<std::int32_t> column_sums,
                     ImageView<std::uint16_t> texture) {
  const int width = raster.width();
  const int height = raster.height();
  const std::span<std::int32_t> columns = column_sums.first(static_cast<std::size_t>(width));
  std::fill(columns.begin(), columns.end(), 0);
  // The outermost cells have no bend.
  const auto add_row = [&](int y, int sign) {
    if (y < 1 || y > height - 2) return;
    const CellColour* above = raster.colours.row(y - 1);
    const CellColour* row = raster.colours.row(y);
    const CellColour* below = raster.colours.row(y + 1);
    for (int x = 1; x + 1 < width; ++x) {
      columns[static_cast<std::size_t>(x)] +=
          sign * (std::abs(2 * row[x].luma - row[x - 1].luma - row[x + 1].luma) +
                  std::abs(2 * row[x].luma - above[x].luma - below[x].luma));
    }
  };
  for (int y = 0; y < radius; ++y) add_row(y, 1);
  for (int y = 0; y < height; ++y) {
    add_row(y + radius, 1);
    add_row(y - radius - 1, -1);
    const int rows = std::min(height - 2, y + radius) - std::max(1, y - radius) + 1;
    std::uint16_t* out = texture.row(y);
    int sum = 0;
    for (int x = 1; x < std::min(radius, width); ++x) sum += columns[static_cast<std::size_t>(x)];
    for (int x = 0; x < width; ++x) {
      if (x + radius < width) sum += columns[static_cast<std::size_t>(x + radius)];
      if (x > radius) sum -= columns[static_cast<std::size_t>(x - radius - 1)];
      const int count = rows * (std::min(width - 2, x + radius) - std::max(1, x - radius) + 1);
      out[x] = static_cast<std::uint16_t>(count <= 0 ? 0 : 2 * sum / count);
    }
  }
}

bool measure_glaze(const DishRaster& raster, ImageView<const std::uint16_t> texture_map,
                   const GlazeParams& params, GlazeColour& glaze) {
  ByteHistogram luma;
  ByteHistogram red;
  ByteHistogram green;
  ByteHistogram texture;
  for_each_cell(raster, DishZone::flange, [&](int x, int y) {
    const CellColour& colour = raster.colours.at(x, y);
    luma.add(colour.luma);
    red.add(colour.red);
    green.add(colour.green);
    texture.add(texture_map.at(x, y));
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

void seed_food(const DishRaster& raster, ImageView<const std::uint16_t> texture_map, const GlazeColour& glaze,
               const GlazeParams& params, ImageView<std::uint8_t> seeds) {
  for (int y = 0; y < raster.height(); ++y) {
    for (int x = 0; x < raster.width(); ++x) {
      std::uint8_t& seed = seeds.at(x, y);
      const DishZone zone = raster.zones.at(x, y);
      if (zone == DishZone::outside) {
        seed = kBarred;
        continue;
      }
      if (zone == DishZone::edge) {
        seed = kGlazeSeed;
        continue;
      }
      seed = kNoOwner;
      const CellColour& colour = raster.colours.at(x, y);
      const int red = colour.red - glaze.median.red;
      const int green = colour.green - glaze.median.green;
      const double off = std::sqrt(static_cast<double>(red * red + green * green)) / glaze.share_sigma;
      const double light = static_cast<double>(colour.luma) / std::max<int>(1, glaze.median.luma);
      const double texture = texture_map.at(x, y) / glaze.texture;
      const bool is_textured = texture >= params.food_texture_ratio;
      if (off >= params.food_deviations || light < params.food_darkest ||
          (is_textured && off >= params.textured_food_deviations)) {
        seed = kFoodSeed;
      } else if (off < params.glaze_deviations && light > params.darkest && light < params.brightest &&
                 texture < params.texture_ratio) {
        seed = kGlazeSeed;
      }
    }
  }
}

}  // namespace traygauge
