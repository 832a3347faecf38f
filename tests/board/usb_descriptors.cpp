#include "tests/board/usb_descriptors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace traygauge {

void add(UsbBytes& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

namespace {

void append(UsbBytes& bytes, const UsbBytes& more) {
  for (const std::uint8_t byte : more) bytes.push_back(byte);
}

// A descriptor: its length comes first.
void add_descriptor(UsbBytes& all, const UsbBytes& body) {
  all.push_back(static_cast<std::uint8_t>(body.size() + 1));
  append(all, body);
}

// Camera terminal 1 (exposure), processing unit 2 (gain), output terminal 3.
UsbBytes describe_units() {
  UsbBytes units;
  add_descriptor(units, {0x24, 2, 1, 0x01, 0x02, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0x0A, 0, 0});
  add_descriptor(units, {0x24, 5, 2, 1, 0, 0, 2, 0x00, 0x02, 0});
  add_descriptor(units, {0x24, 3, 3, 0x01, 0x01, 0, 2, 0});
  UsbBytes header = {0x24, 1, 0x00, 0x01};
  add(header, static_cast<std::uint32_t>(13 + units.size()), 2);
  add(header, 48'000'000, 4);
  append(header, UsbBytes{1, 1});
  UsbBytes all;
  add_descriptor(all, header);
  append(all, units);
  return all;
}

}  // namespace

UsbBytes describe_device() {
  UsbBytes bytes;
  add_descriptor(bytes, {1, 0x00, 0x02, 0xEF, 2, 1, 64, 0x6B, 0x1D, 0x02, 0x01, 0x00, 0x01, 1, 2, 3, 1});
  return bytes;
}

UsbBytes describe_text(int index, int port) {
  if (index == 0) return {4, 3, 0x09, 0x04};
  const std::array<std::string, 3> texts = {"Traygauge tests", "Test camera",
                                            "T000" + std::to_string(port + 1)};
  const std::string& text = texts.at(static_cast<std::size_t>(std::min(index, 3) - 1));
  UsbBytes bytes = {static_cast<std::uint8_t>(2 + 2 * text.size()), 3};
  for (const char letter : text) add(bytes, static_cast<std::uint8_t>(letter), 2);
  return bytes;
}

UsbBytes describe_configuration(int width, int height, double frame_s) {
  UsbBytes interfaces;
  add_descriptor(interfaces, {11, 0, 2, 14, 3, 0, 2});
  add_descriptor(interfaces, {4, 0, 0, 0, 14, 1, 0, 2});
  const UsbBytes units = describe_units();
  append(interfaces, units);
  add_descriptor(interfaces, {4, 1, 0, 1, 14, 2, 0, 0});
  const auto interval = static_cast<std::uint32_t>(std::lround(frame_s * 1e7));
  const auto frame_bytes = static_cast<std::uint32_t>(2 * width * height);
  UsbBytes stream;
  add_descriptor(stream, {0x24, 6, 1, 1, 1, 1, 0, 0, 0, 0});  // Motion JPEG, one size
  UsbBytes frame = {0x24, 7, 1, 0};
  add(frame, static_cast<std::uint32_t>(width), 2);
  add(frame, static_cast<std::uint32_t>(height), 2);
  for (int i = 0; i < 2; ++i) add(frame, frame_bytes * 8, 4);
  add(frame, frame_bytes, 4);
  add(frame, interval, 4);
  frame.push_back(1);
  add(frame, interval, 4);
  add_descriptor(stream, frame);
  add_descriptor(stream, {0x24, 13, 1, 1, 4});
  UsbBytes header = {0x24, 1, 1};
  add(header, static_cast<std::uint32_t>(14 + stream.size()), 2);
  append(header, UsbBytes{0x81, 0, 3, 0, 0, 0, 1, 0});
  add_descriptor(interfaces, header);
  append(interfaces, stream);
  add_descriptor(interfaces, {5, 0x81, 2, 0x00, 0x02, 0});

  UsbBytes head = {2};
  add(head, static_cast<std::uint32_t>(9 + interfaces.size()), 2);
  append(head, UsbBytes{2, 1, 0, 0x80, 250});
  UsbBytes all;
  add_descriptor(all, head);
  append(all, interfaces);
  return all;
}

}  // namespace traygauge
