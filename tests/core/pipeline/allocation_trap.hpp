// Counts every allocation and release of this program while armed.
#pragma once

namespace traygauge {

void arm_allocation_trap();
// Disarms; returns how many calls were caught.
int disarm_allocation_trap();

}  // namespace traygauge
