#include "core/labels/label_regions.hpp"

#include <algorithm>
#include <cstring>

namespace traygauge {
namespace {

// End of the run of equal labels that starts at `begin`. Runs are long, so eight pixels are compared at once.
int find_run_end(const std::uint8_t* labels, int begin, int width) {
  const std::uint8_t label = labels[begin];
  const std::uint64_t eight_equal = 0x0101010101010101U * label;
  int end = begin + 1;
  for (std::uint64_t eight = 0; end + 8 <= width; end += 8) {
    std::memcpy(&eight, labels + end, sizeof(eight));
    if (eight != eight_equal) break;
  }
  while (end < width && labels[end] == label) ++end;
  return end;
}

void extend_box(PixelBox& box, int left, int right, int y) {
  if (box.empty()) {
    box = {left, y, right, y + 1};
    return;
  }
  box.left = std::min(box.left, left);
  box.right = std::max(box.right, right);
  box.bottom = y + 1;
}

}  // namespace

LabelRegions measure_regions(ImageView<const std::uint8_t> labels) {
  LabelRegions regions;
  regions.width = labels.width;
  regions.height = labels.height;
  for (int y = 0; y < labels.height; ++y) {
    const std::uint8_t* row = labels.row(y);
    for (int begin = 0; begin < labels.width;) {
      const int end = find_run_end(row, begin, labels.width);
      const auto length = static_cast<std::uint32_t>(end - begin);
      regions.pixels[row[begin]] += length;
      extend_box(regions.boxes[row[begin]], begin, end, y);
      begin = end;
    }
  }
  for (int value = kDishLabel; value <= kLastItemLabel; ++value) {
    const auto label = static_cast<std::size_t>(value);
    regions.dish_pixels += regions.pixels[label];
    regions.dish = united(regions.dish, regions.boxes[label]);
  }
  regions.card = regions.boxes[kCardLabel];
  return regions;
}

}  // namespace traygauge
