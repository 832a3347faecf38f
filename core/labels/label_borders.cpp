#include "core/labels/label_borders.hpp"

#include <algorithm>
#include <cstring>

namespace traygauge {
namespace {

// Counts the pairs (a[i], b[i]) of different labels. Most are equal, so eight are compared at once.
void add_borders(const std::uint8_t* a, const std::uint8_t* b, int count,
                 std::span<std::uint32_t> borders_px) {
  const auto add = [&](int i) {
    if (a[i] == b[i]) return;
    if (is_item(a[i])) ++borders_px[kByteValues * a[i] + b[i]];
    if (is_item(b[i])) ++borders_px[kByteValues * b[i] + a[i]];
  };
  int i = 0;
  for (; i + 8 <= count; i += 8) {
    std::uint64_t eight_a = 0;
    std::uint64_t eight_b = 0;
    std::memcpy(&eight_a, a + i, sizeof(eight_a));
    std::memcpy(&eight_b, b + i, sizeof(eight_b));
    if (eight_a == eight_b) continue;
    for (int k = i; k < i + 8; ++k) add(k);
  }
  for (; i < count; ++i) add(i);
}

}  // namespace

void count_borders(std::span<const ImageView<const std::uint8_t>> views, LabelBorders& borders) {
  std::fill(borders.borders_px.begin(), borders.borders_px.end(), 0U);
  for (const ImageView<const std::uint8_t>& labels : views) {
    for (int y = 0; y < labels.height; ++y) {
      add_borders(labels.row(y), labels.row(y) + 1, labels.width - 1, borders.borders_px);
      if (y + 1 < labels.height)
        add_borders(labels.row(y), labels.row(y + 1), labels.width, borders.borders_px);
    }
  }
}

}  // namespace traygauge
