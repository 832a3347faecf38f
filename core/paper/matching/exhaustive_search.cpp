#include "core/paper/matching/exhaustive_search.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "core/base/lanes.hpp"

namespace traygauge::paper {

namespace {

constexpr int kTileRows = 4;         // with eight columns: eight SSE accumulators, half of the registers
constexpr int kBlocksPerChunk = 12;  // 24 KiB of columns stay in the first-level cache while all rows pass

using TileRows = std::array<const float*, kTileRows>;
struct alignas(32) Tile {
  float square[kTileRows][kBlockSize];
};

// In registers: arrays of plain floats would stay in memory.
constexpr std::size_t kRegisters = kBlockSize / kFloatLanes;

// The sums run over the dimensions in their order, as in block_squares: the same bits.
void compute_tile(const TileRows& rows, const float* block, Tile& tile) {
  FloatLanes sums[kTileRows][kRegisters] = {};
  for (std::size_t d = 0; d < kDescriptorLength; ++d) {
#pragma GCC unroll 2
    for (std::size_t v = 0; v < kRegisters; ++v) {
      const FloatLanes columns = load_floats(block + d * kBlockSize + v * kFloatLanes);
#pragma GCC unroll 4
      for (std::size_t r = 0; r < kTileRows; ++r) {
        const FloatLanes difference = rows[r][d] - columns;
        sums[r][v] += difference * difference;
      }
    }
  }
  std::memcpy(tile.square, sums, sizeof sums);
}

// Whether any of the eight can enter the row's or its column's list. Rare after the first columns.
bool has_candidate(const float* squares, float row_limit, const float* column_limits) {
  int found = 0;
  for (std::size_t j = 0; j < kBlockSize; ++j) {
    found |= static_cast<int>(squares[j] <= row_limit) | static_cast<int>(squares[j] <= column_limits[j]);
  }
  return found != 0;
}

struct Lists {
  std::span<const std::int32_t> slots;
  std::span<float> column_limits;
  std::span<Neighbours> of_first;
  std::span<Neighbours> of_second;
  int count;
};

void insert_candidates(const float* squares, std::int32_t row, std::size_t first_slot, Lists& lists) {
  Neighbours& of_row = lists.of_first[static_cast<std::size_t>(row)];
  for (std::size_t j = 0; j < kBlockSize; ++j) {
    const std::int32_t column = lists.slots[first_slot + j];
    if (column < 0) continue;
    of_row.insert(squares[j], column, lists.count);
    Neighbours& of_column = lists.of_second[static_cast<std::size_t>(column)];
    of_column.insert(squares[j], row, lists.count);
    lists.column_limits[first_slot + j] = of_column.limit(lists.count);
  }
}

void compare_rows(const FeatureSet& first, std::span<const std::int32_t> rows,
                  const PackedDescriptors& packed, BlockRange chunk, Lists& lists) {
  Tile tile;
  for (std::size_t begin = 0; begin < rows.size(); begin += kTileRows) {
    const std::size_t height = std::min<std::size_t>(kTileRows, rows.size() - begin);
    TileRows pointers;
    for (std::size_t r = 0; r < kTileRows; ++r) {  // a short last tile computes its last row again
      const auto row = static_cast<std::size_t>(rows[begin + std::min(r, height - 1)]);
      pointers[r] = first.descriptors[row].data();
    }
    for (int b = chunk.begin; b < chunk.end; ++b) {
      compute_tile(pointers, packed.block(b), tile);
      const auto slot = static_cast<std::size_t>(b) * kBlockSize;
      for (std::size_t r = 0; r < height; ++r) {
        const std::int32_t row = rows[begin + r];
        const float row_limit = lists.of_first[static_cast<std::size_t>(row)].limit(lists.count);
        if (has_candidate(tile.square[r], row_limit, lists.column_limits.data() + slot)) {
          insert_candidates(tile.square[r], row, slot, lists);
        }
      }
    }
  }
}

}  // namespace

void search_exhaustively(const FeatureSet& first, const PackedDescriptors& packed, int count,
                         std::span<std::int32_t> rows, std::span<float> column_limits,
                         std::span<Neighbours> of_first, std::span<Neighbours> of_second) {
  for (Neighbours& list : of_first) list.clear();
  for (Neighbours& list : of_second) list.clear();
  std::fill(column_limits.begin(), column_limits.end(), std::numeric_limits<float>::infinity());
  Lists lists{packed.slots, column_limits, of_first, of_second, count};
  for (int sign = 0; sign < kSignGroups; ++sign) {
    std::size_t height = 0;
    for (std::size_t i = 0; i < first.keypoints.size(); ++i) {
      if (sign_group(first.keypoints[i].laplacian) == sign) rows[height++] = static_cast<std::int32_t>(i);
    }
    const BlockRange columns = packed.comparable(sign);
    for (int b = columns.begin; b < columns.end; b += kBlocksPerChunk) {
      compare_rows(first, rows.first(height), packed, {b, std::min(b + kBlocksPerChunk, columns.end)}, lists);
    }
  }
}

}  // namespace traygauge::paper
