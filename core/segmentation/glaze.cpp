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
void for_each_flange_cell(const DishRaster& raster, Take&& take) {
  for (int y = 0; y < raster.height(); ++y) {
    for (int x = 0; x < raster.width(); ++x) {
      if (raster.zones.at(x, y) == DishZone::flange) take(raster.colours.at(x, y));
    }
  }
}

}  // namespace

bool measure_glaze(const DishRaster& raster, const GlazeParams& params, GlazeColour& glaze) {
  ByteHistogram red;
  ByteHistogram green;
  for_each_flange_cell(raster, [&](const CellColour& colour) {
    red.add(colour.red);
    green.add(colour.green);
  });
  if (red.total() < params.min_flange_cells) return false;
  glaze.red = red.median();
  glaze.green = green.median();
  ByteHistogram share_off;
  for_each_flange_cell(raster, [&](const CellColour& colour) {
    share_off.add(std::abs(colour.red - glaze.red));
    share_off.add(std::abs(colour.green - glaze.green));
  });
  glaze.share_sigma = std::max(params.min_share_sigma, kMedianToSigma * share_off.median());
  return true;
}

}  // namespace traygauge
