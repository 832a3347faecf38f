// What the USB camera made of software says of itself: a UVC 1.0 camera with one Motion JPEG mode.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace traygauge {

using UsbBytes = std::vector<std::uint8_t>;

// The lowest `count` bytes, the lowest first, as USB has them.
void add(UsbBytes& bytes, std::uint32_t value, int count);

UsbBytes describe_device();
// The serial number differs with the port.
UsbBytes describe_text(int index, int port);
// Interfaces: control (camera terminal 1 with exposure, processing unit 2 with gain), stream.
UsbBytes describe_configuration(int width, int height, double frame_s);

}  // namespace traygauge
