// Hosts that are this machine.
#pragma once

#include <string_view>

namespace traygauge {

// By the name, or the literal address without brackets, alone: nothing is looked up.
bool is_this_machine(std::string_view host);

}  // namespace traygauge
