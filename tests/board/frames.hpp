// JPEG frames for the USB camera.
#pragma once

#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace traygauge {

inline std::vector<std::uint8_t> read_frame(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(stream)), {});
  if (bytes.size() < 4) throw std::runtime_error(file + " is no picture");
  return bytes;
}

// The same picture with a number in a comment, as no two frames of a real sensor are the same bytes.
inline std::vector<std::uint8_t> numbered_frame(const std::vector<std::uint8_t>& frame,
                                                std::uint32_t number) {
  constexpr std::uint8_t kMarker = 0xFF;
  constexpr std::uint8_t kComment = 0xFE;
  std::vector<std::uint8_t> numbered = {frame[0], frame[1], kMarker, kComment, 0, 6};
  for (int i = 0; i < 4; ++i) numbered.push_back(static_cast<std::uint8_t>(number >> (8 * i)));
  numbered.insert(numbered.end(), frame.begin() + 2, frame.end());
  return numbered;
}

}  // namespace traygauge
