// The names of the devices that are connected. Takes no picture and no line.
#pragma once

#include <string>

namespace traygauge {

// Cameras, chips with lines, serial ports.
std::string describe_devices();

}  // namespace traygauge
