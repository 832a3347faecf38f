#include "simulator/bodies/body_texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace traygauge {
namespace {

// Neither ink nor paper alone: the darkest grey still shows its corners to a camera, and no light one is
// taken for a highlight.
constexpr std::array<std::uint8_t, 5> kGrays = {40, 90, 140, 190, 235};
constexpr int kCellsPerBlock = 4;  // whose squares are darker or lighter together, for distant cameras

// SplitMix64's finaliser (Steele, Lea and Flood 2014): neighbouring inputs give unrelated outputs.
std::uint64_t mixed(std::uint64_t value) {
  value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  value = (value ^ (value >> 27U)) * 0x94D049BB133111EBULL;
  return value ^ (value >> 31U);
}

int below(int bound, std::uint64_t seed, int column, int row) {
  const auto place = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(column)) << 32U) |
                     static_cast<std::uint32_t>(row);
  return static_cast<int>(mixed(seed + mixed(place + 0x9E3779B97F4A7C15ULL)) %
                          static_cast<std::uint64_t>(bound));
}

int block_of(int cell) {
  return cell >= 0 ? cell / kCellsPerBlock : (cell + 1) / kCellsPerBlock - 1;
}

}  // namespace

std::uint8_t body_cell_gray(std::string_view body_id, int piece, int column, int row) {
  auto seed = static_cast<std::uint64_t>(piece);
  for (const char letter : body_id) seed = mixed(seed + static_cast<unsigned char>(letter));
  const int level = below(5, seed, column, row) + below(3, mixed(seed), block_of(column), block_of(row)) - 1;
  return kGrays.at(static_cast<std::size_t>(std::clamp(level, 0, 4)));
}

}  // namespace traygauge
