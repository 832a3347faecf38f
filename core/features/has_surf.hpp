// Whether this library was built with SURF (CMake option TRAYGAUGE_SURF), on which US patents may run until
// 2027.
#pragma once

namespace traygauge {

bool has_surf();

}  // namespace traygauge
