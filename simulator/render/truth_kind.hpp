// What a pixel shows, for those who learn from pictures: finer than labels, which name dishes and items.
#pragma once

#include <cstdint>

namespace traygauge {

enum class TruthKind : std::uint8_t {
  none,   // nothing of the scene
  table,  // or the tray
  food,
  glaze,  // of a dish, its rim excepted
  rim,    // of a dish: its edge and its outer wall
  card,
  cutlery,
  napkin,
  cup,    // or a glass, with what is in it
  hand,   // with its arm and sleeve
  other,  // a phone, keys, a packet
};

}  // namespace traygauge
