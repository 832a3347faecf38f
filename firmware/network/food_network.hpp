// The network for food that the product finds food with.
#pragma once

#include "core/network/network.hpp"

namespace traygauge {

// Read once a process, and kept: from the folder that TRAYGAUGE_CONFIG names, if it has one, else that
// which came with the program. Throws InputError as LoadedNetwork does, and where it tells no food.
const Network& food_network();

}  // namespace traygauge
