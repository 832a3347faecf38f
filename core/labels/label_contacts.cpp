#include "core/labels/label_contacts.hpp"

namespace traygauge {

void count_contacts(ImageView<const std::uint8_t> labels, std::uint8_t label,
                    std::span<std::uint32_t, kByteValues> contacts) {
  const auto add_side = [&](std::uint8_t a, std::uint8_t b) {
    if (a == b) return;
    if (a == label) ++contacts[b];
    if (b == label) ++contacts[a];
  };
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      if (x > 0) add_side(labels.at(x - 1, y), labels.at(x, y));
      if (y > 0) add_side(labels.at(x, y - 1), labels.at(x, y));
    }
  }
}

}  // namespace traygauge
