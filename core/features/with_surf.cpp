#include "core/features/has_surf.hpp"

namespace traygauge {

bool has_surf() {
  return true;
}

}  // namespace traygauge
