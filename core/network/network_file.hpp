// The file of a network (.tgn), version 1. Numbers begin with their lowest byte.
//
//   at  bytes
//    0   8  89 54 47 4e 0d 0a 1a 0a: its signature
//    8   4  CRC-32C of all that follows
//   12   4  bytes of the whole file
//   16   2  version
//   18   4  width and height of the picture, 2 each
//   22   2  layers
//   24   2  classes
//   26   2  bytes of the text
//   28  12  test vector: seed, CRC-32C of the picture, CRC-32C of the outputs
//   40      names of the classes, 24 bytes each, filled up with zeros
//           the text: how the network was trained; ASCII with line ends
//           the layers
//
// A layer:
//    0   4  kernel (3, 1), stride (1, 2), ReLU (1, 0), role
//    4   4  number of sources (1, 2), enlargement of each, 0
//    8   4  tensors of the sources, 2 bytes each; 0 where there is no second
//   12   4  output channels, 0, 2 bytes each
//   16   4  step, as a float of IEEE 754
//   20      biases, multipliers (4 bytes a channel each), shifts (1), weights (1 each)
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/network/network.hpp"

namespace traygauge {

inline constexpr std::uint16_t kNetworkFileVersion = 1;
// Layers take no less memory than bytes in the file: a larger one does not fit into kMaxNetworkBytes.
inline constexpr std::size_t kMaxNetworkFileBytes = std::size_t{1} << 20U;

// Where the layout above has it; for those who write such files.
inline constexpr std::size_t kNetworkCrcAt = 8;
inline constexpr std::size_t kNetworkCheckedAt = 12;
inline constexpr std::size_t kNetworkVersionAt = 16;
inline constexpr std::size_t kNetworkHeaderBytes = 40;
inline constexpr std::size_t kNetworkNameBytes = 24;
inline constexpr auto kNetworkSignature =
    std::to_array<std::uint8_t>({0x89, 'T', 'G', 'N', '\r', '\n', 0x1a, '\n'});

enum class NetworkFileStatus : std::uint8_t {
  ok,
  foreign,        // no such file
  damaged,        // cut off, longer than it says, or another checksum
  newer,          // whole, of a version that this program does not know
  contradictory,  // whole, but what it states cannot be
  too_large,      // of more layers, channels or work than a station has room for
};

// `network` refers to `bytes`, and means something only where this returns ok. Reads nothing outside of
// `bytes`, whatever they hold. O(bytes).
[[nodiscard]] NetworkFileStatus parse_network(std::span<const std::byte> bytes, Network& network);

}  // namespace traygauge
