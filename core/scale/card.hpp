// The reference card: found in both views by its pattern, it gives scale and table (paper III-A-3).
#pragma once

#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/geometry.hpp"
#include "core/base/random.hpp"
#include "core/base/status.hpp"

namespace traygauge {

// A point of the card seen in both views: where on the pattern (mm, origin at its top left corner, y down),
// and along which ray of each view.
struct CardTrack {
  Vec2 pattern_mm = Vec2::Zero();
  Vec2 first = Vec2::Zero();
  Vec2 second = Vec2::Zero();
  Vec3 point_in_first = Vec3::Zero();  // of the sparse cloud, in baselines
};

}  // namespace traygauge
