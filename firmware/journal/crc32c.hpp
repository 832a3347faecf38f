// The checksum CRC-32C (Castagnoli), as iSCSI (RFC 3720) and ext4 use it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace traygauge {

// Finds every change of up to 32 neighbouring bits, others but for one in 2^32.
std::uint32_t crc32c(std::span<const std::byte> bytes);

}  // namespace traygauge
