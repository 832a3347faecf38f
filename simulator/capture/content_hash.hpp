// Short names for contents.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace traygauge {

// FNV-1a of 64 bits as 16 hexadecimal digits: tells contents apart that nobody made alike on purpose.
std::string content_hash(std::span<const std::uint8_t> bytes);
std::string content_hash(const std::string& text);

}  // namespace traygauge
