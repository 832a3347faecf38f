#include "core/quality/region_colours.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "core/base/median.hpp"
#include "core/base/units.hpp"
#include "core/labels/label_regions.hpp"

namespace traygauge {
namespace {

using LightTable = std::array<std::uint32_t, kByteValues>;

constexpr double kFullLight = std::numeric_limits<std::uint16_t>::max();

// sRGB to linear light by a cubic without its power function; within 0.2 % of full light.
constexpr LightTable make_light_table() {
  LightTable table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double v = static_cast<double>(i) / 255.0;
    const double light = v * (v * (v * 0.305306011 + 0.682171111) + 0.012522878);
    table[i] = static_cast<std::uint32_t>(kFullLight * light + 0.5);
  }
  return table;
}

constexpr LightTable kLight = make_light_table();

struct Sum {
  std::uint64_t red = 0;
  std::uint64_t green = 0;
  std::uint64_t blue = 0;
};

void add_pixel(const std::uint8_t* pixel, PixelFormat format, Sum& sum) {
  const bool is_gray = format == PixelFormat::gray8;
  const std::uint32_t left = kLight[pixel[0]];
  const std::uint32_t middle = is_gray ? left : kLight[pixel[1]];
  const std::uint32_t right = is_gray ? left : kLight[pixel[2]];
  sum.red += format == PixelFormat::rgb8 ? left : right;
  sum.green += middle;
  sum.blue += format == PixelFormat::rgb8 ? right : left;
}

double at_least_one(double ratio) {
  return ratio < 1.0 ? 1.0 / ratio : ratio;
}

// The median over the common regions of what `ratio` gives for both colours.
template <class Ratio>
double median_ratio(const RegionColours& first, const RegionColours& second, int min_samples, Ratio ratio) {
  std::array<double, kByteValues> ratios{};
  std::size_t count = 0;
  const auto enough = static_cast<std::uint32_t>(std::max(min_samples, 1));
  for (std::size_t label = kBackgroundLabel + 1; label < first.size(); ++label) {
    const RegionColour& a = first[label];
    const RegionColour& b = second[label];
    if (a.samples < enough || b.samples < enough) continue;
    ratios[count++] = ratio(a, b);
  }
  return count == 0 ? 1.0 : at_least_one(median(std::span(ratios).first(count)));
}

}  // namespace

void measure_region_colours(const FrameView& frame, ImageView<const std::uint8_t> labels,
                            const RegionColourParams& params, RegionColours& colours) {
  colours.fill({});
  std::array<Sum, kByteValues> sums{};
  const int step = std::max(params.step_px, 1);
  const int bytes = bytes_per_pixel(frame.format);
  for (int y = 0; y < frame.height; y += step) {
    const std::uint8_t* row = frame.data + y * frame.stride_bytes;
    const std::uint8_t* label_row = labels.row(y);
    for (int x = 0; x < frame.width; x += step) {
      const std::uint8_t label = label_row[x];
      if (label == kBackgroundLabel) continue;
      add_pixel(row + static_cast<std::ptrdiff_t>(x) * bytes, frame.format, sums[label]);
      ++colours[label].samples;
    }
  }
  for (std::size_t label = 0; label < colours.size(); ++label) {
    RegionColour& colour = colours[label];
    if (colour.samples == 0) continue;
    const double scale = 1.0 / (kFullLight * colour.samples);
    // One part in 65535 keeps ratios of black finite.
    colour.red = static_cast<float>(scale * static_cast<double>(sums[label].red + colour.samples));
    colour.green = static_cast<float>(scale * static_cast<double>(sums[label].green + colour.samples));
    colour.blue = static_cast<float>(scale * static_cast<double>(sums[label].blue + colour.samples));
  }
}

ColourDifference compare_colours(const RegionColours& first, const RegionColours& second,
                                 const RegionColourParams& params) {
  const auto light = [](const RegionColour& c) { return static_cast<double>(c.red + c.green + c.blue); };
  const auto red = [](const RegionColour& c) { return static_cast<double>(c.red) / c.green; };
  const auto blue = [](const RegionColour& c) { return static_cast<double>(c.blue) / c.green; };
  const auto compare = [&](auto value) {
    return median_ratio(first, second, params.min_samples,
                        [&](const RegionColour& a, const RegionColour& b) { return value(b) / value(a); });
  };
  return {compare(light), std::max(compare(red), compare(blue))};
}

}  // namespace traygauge
