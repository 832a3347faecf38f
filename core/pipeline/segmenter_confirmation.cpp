// Of a dish's items those that both views show.
#include <algorithm>

#include "core/labels/label_borders.hpp"
#include "core/labels/label_regions.hpp"
#include "core/pipeline/segmenter.hpp"

namespace traygauge {

// What only one view takes for an item is a shadow, a highlight, or a part of the item that it touches more
// than the dish. Labels stay in a row.
int Segmenter::keep_confirmed(std::uint8_t first, int items, std::uint8_t dish) const {
  const std::array<LabelRegions, 2> regions = {measure_regions(views_[0].labels),
                                               measure_regions(views_[1].labels)};
  const std::size_t end = first + static_cast<std::size_t>(items);
  std::array<std::uint8_t, kByteValues> confirmed{};
  int kept = 0;
  for (std::size_t label = first; label < end; ++label) {
    const bool is_in_both = std::min(regions[0].pixels[label], regions[1].pixels[label]) > 0;
    if (is_in_both) confirmed[label] = static_cast<std::uint8_t>(first + kept++);
  }
  if (kept == items) return kept;
  const std::array<ImageView<const std::uint8_t>, 2> labels = {views_[0].labels, views_[1].labels};
  LabelBorders& borders = memory_.food.borders;
  count_borders(labels, borders);
  std::array<std::uint8_t, kByteValues> renamed = confirmed;
  for (std::size_t label = first; label < end; ++label) {
    if (confirmed[label] != 0) continue;
    std::uint32_t most_px = borders.border_px(label, dish);
    renamed[label] = dish;
    for (std::size_t other = first; other < end; ++other) {
      if (confirmed[other] == 0 || borders.border_px(label, other) <= most_px) continue;
      most_px = borders.border_px(label, other);
      renamed[label] = confirmed[other];
    }
  }
  rename_items(first, items, renamed);
  return kept;
}

void Segmenter::rename_items(std::uint8_t first, int items,
                             const std::array<std::uint8_t, kByteValues>& renamed) const {
  for (const SegmentedView& view : views_) {
    for (int y = 0; y < view.labels.height; ++y) {
      for (int x = 0; x < view.labels.width; ++x) {
        std::uint8_t& label = view.labels.at(x, y);
        if (label >= first && label < first + items) label = renamed[label];
      }
    }
  }
}

}  // namespace traygauge
