#include "core/segmentation/dish_raster.hpp"

#include <algorithm>
#include <cmath>

#include "core/image/gray_weights.hpp"
#include "core/labels/convex_fill.hpp"

namespace traygauge {
namespace {

PixelBox box_around(std::span<const Vec2> outline_px, int width, int height) {
  Vec2 low = Vec2::Constant(1e9);
  Vec2 high = Vec2::Constant(-1e9);
  for (const Vec2& corner : outline_px) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const auto inside = [](double x, int size) {
    return static_cast<int>(std::floor(std::clamp(x, 0.0, static_cast<double>(size))));
  };
  return {inside(low.x(), width), inside(low.y(), height), inside(high.x() + 1.0, width),
          inside(high.y() + 1.0, height)};
}

struct Rgb {
  int red = 0;
  int green = 0;
  int blue = 0;
};

// Sum over a square of the frame.
Rgb sum_square(const FrameView& frame, int left, int top, int step) {
  Rgb sum;
  const int bytes = bytes_per_pixel(frame.format);
  const bool is_bgr = frame.format == PixelFormat::bgr8;
  for (int y = top; y < top + step; ++y) {
    const std::uint8_t* pixel = frame.data + y * frame.stride_bytes + std::ptrdiff_t{left} * bytes;
    for (int x = 0; x < step; ++x, pixel += bytes) {
      sum.red += pixel[bytes == 1 ? 0 : (is_bgr ? 2 : 0)];
      sum.green += pixel[bytes == 1 ? 0 : 1];
      sum.blue += pixel[bytes == 1 ? 0 : (is_bgr ? 0 : 2)];
    }
  }
  return sum;
}

CellColour colour_of(const Rgb& sum, int pixels, double dark_level) {
  const double scale = 1.0 / pixels;
  const double red = sum.red * scale;
  const double green = sum.green * scale;
  const double blue = sum.blue * scale;
  const double dark = dark_level * dark_level;
  const double light = red * red + green * green + blue * blue + 3.0 * dark;
  const auto share = [&](double value) {
    return static_cast<std::uint8_t>(std::min(255.0, 510.0 * (value * value + dark) / light + 0.5));
  };
  const GrayWeights weights = gray_weights(PixelFormat::rgb8);
  const double luma =
      (weights.first * red + weights.second * green + weights.third * blue) / static_cast<double>(kGrayOne);
  return {static_cast<std::uint8_t>(luma + 0.5), share(red), share(green)};
}

}  // namespace

bool load_dish_raster(const FrameView& frame, std::span<const Vec2> outline_px, double px_per_mm,
                      const DishRasterParams& params, DishRasterWorkspace& workspace, DishRaster& raster) {
  const PixelBox box = box_around(outline_px, frame.width, frame.height);
  if (box.empty()) return false;
  const double area_px = static_cast<double>(box.width()) * box.height();
  const int by_size = static_cast<int>(std::lround(px_per_mm * params.cell_mm));
  const int by_memory = static_cast<int>(std::ceil(std::sqrt(area_px / params.max_cells)));
  raster.step_px = std::max({by_size, by_memory, 1});
  raster.cell_mm = raster.step_px / px_per_mm;
  raster.left_px = box.left;
  raster.top_px = box.top;
  const int width = box.width() / raster.step_px;
  const int height = box.height() / raster.step_px;
  if (width < 3 || height < 3) return false;
  raster.colours = {workspace.colours.data(), width, height};
  raster.zones = {workspace.zones.data(), width, height};
  const int pixels = raster.step_px * raster.step_px;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Rgb sum =
          sum_square(frame, box.left + x * raster.step_px, box.top + y * raster.step_px, raster.step_px);
      raster.colours.at(x, y) = colour_of(sum, pixels, params.dark_level);
    }
    std::fill_n(raster.zones.row(y), width, DishZone::outside);
  }
  return true;
}

void mark_zone(DishRaster& raster, std::span<Vec2> outline_px, DishZone zone) {
  for (Vec2& corner : outline_px) corner = raster.cell_of(corner);
  for_each_covered_row(raster.width(), raster.height(), outline_px, [&](int y, int left, int right) {
    std::fill(raster.zones.row(y) + left, raster.zones.row(y) + right, zone);
  });
}

}  // namespace traygauge
