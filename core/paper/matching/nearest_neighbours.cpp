#include "core/paper/matching/nearest_neighbours.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "core/base/lanes.hpp"

namespace traygauge::paper {

namespace {

constexpr int kBlockSize = NeighbourWorkspace::kBlockSize;
constexpr int kSignGroups = NeighbourWorkspace::kSignGroups;
constexpr int kBlockFloats = kBlockSize * kDescriptorLength;
constexpr float kPadValue = 1e3F;    // farther from every unit vector than any of them is from another
constexpr int kTileRows = 4;         // with eight columns: eight SSE accumulators, half of the registers
constexpr int kBlocksPerChunk = 12;  // 24 KiB of columns stay in the first-level cache while all rows pass

// The group of a Laplacian sign: 0, 1 or 2.
constexpr int sign_group(int laplacian) {
  return laplacian < 0 ? 0 : laplacian > 0 ? 2 : 1;
}

// Assigns the keypoints to slots, group by group, by index within a group.
void assign_slots(std::span<const Keypoint> keypoints, NeighbourWorkspace& workspace) {
  std::size_t slot = 0;
  for (int group = 0; group < kSignGroups; ++group) {
    workspace.group_begin[static_cast<std::size_t>(group)] = static_cast<int>(slot / kBlockSize);
    for (std::size_t i = 0; i < keypoints.size(); ++i) {
      if (sign_group(keypoints[i].laplacian) == group) {
        workspace.slots[slot++] = static_cast<std::int32_t>(i);
      }
    }
    while (slot % kBlockSize != 0) workspace.slots[slot++] = -1;
  }
  workspace.group_begin[kSignGroups] = static_cast<int>(slot / kBlockSize);
}

// Copies the descriptors to the places that `slots` states.
void fill_blocks(std::span<const Descriptor> descriptors, NeighbourWorkspace& workspace) {
  const auto slots = static_cast<std::size_t>(workspace.group_begin[kSignGroups]) * kBlockSize;
  for (std::size_t slot = 0; slot < slots; ++slot) {
    float* place = workspace.values.data() + slot / kBlockSize * kBlockFloats + slot % kBlockSize;
    const std::int32_t feature = workspace.slots[slot];
    for (std::size_t d = 0; d < kDescriptorLength; ++d) {
      place[d * kBlockSize] = feature < 0 ? kPadValue : descriptors[static_cast<std::size_t>(feature)][d];
    }
  }
}

// A run of blocks.
struct BlockRange {
  int begin = 0;
  int end = 0;
};

// The blocks that features of this group are compared with: their own and those of unknown sign.
BlockRange comparable_blocks(const NeighbourWorkspace& workspace, int sign) {
  const auto& begin = workspace.group_begin;
  return {sign == 2 ? begin[1] : begin[0], sign == 0 ? begin[2] : begin[3]};
}

using TileRows = std::array<const float*, kTileRows>;
struct alignas(32) Tile {
  float square[kTileRows][kBlockSize];
};

// In registers: arrays of plain floats would stay in memory.
constexpr std::size_t kRegisters = kBlockSize / kFloatLanes;

// The sums run over the dimensions in their order: all processors see the same bits.
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
  NeighbourWorkspace& workspace;
  std::span<Neighbours> of_first;
  std::span<Neighbours> of_second;
  int count;
};

void insert_candidates(const float* squares, std::int32_t row, std::size_t first_slot, Lists& lists) {
  Neighbours& of_row = lists.of_first[static_cast<std::size_t>(row)];
  for (std::size_t j = 0; j < kBlockSize; ++j) {
    const std::int32_t column = lists.workspace.slots[first_slot + j];
    if (column < 0) continue;
    of_row.insert(squares[j], column, lists.count);
    Neighbours& of_column = lists.of_second[static_cast<std::size_t>(column)];
    of_column.insert(squares[j], row, lists.count);
    lists.workspace.column_limits[first_slot + j] = of_column.limit(lists.count);
  }
}

void compare_rows(const FeatureSet& first, std::span<const std::int32_t> rows, BlockRange chunk,
                  Lists& lists) {
  Tile tile;
  for (std::size_t begin = 0; begin < rows.size(); begin += kTileRows) {
    const std::size_t height = std::min<std::size_t>(kTileRows, rows.size() - begin);
    TileRows pointers;
    for (std::size_t r = 0; r < kTileRows; ++r) {  // a short last tile computes its last row again
      const auto row = static_cast<std::size_t>(rows[begin + std::min(r, height - 1)]);
      pointers[r] = first.descriptors[row].data();
    }
    for (int b = chunk.begin; b < chunk.end; ++b) {
      compute_tile(pointers, lists.workspace.values.data() + std::ptrdiff_t{b} * kBlockFloats, tile);
      const auto slot = static_cast<std::size_t>(b) * kBlockSize;
      for (std::size_t r = 0; r < height; ++r) {
        const std::int32_t row = rows[begin + r];
        const float row_limit = lists.of_first[static_cast<std::size_t>(row)].limit(lists.count);
        if (has_candidate(tile.square[r], row_limit, lists.workspace.column_limits.data() + slot)) {
          insert_candidates(tile.square[r], row, slot, lists);
        }
      }
    }
  }
}

}  // namespace

void find_nearest_neighbours(const FeatureSet& first, const FeatureSet& second, int count,
                             NeighbourWorkspace& workspace, std::span<Neighbours> of_first,
                             std::span<Neighbours> of_second) {
  assign_slots(second.keypoints, workspace);
  fill_blocks(second.descriptors, workspace);
  for (Neighbours& list : of_first) list.clear();
  for (Neighbours& list : of_second) list.clear();
  std::fill(workspace.column_limits.begin(), workspace.column_limits.end(),
            std::numeric_limits<float>::infinity());
  Lists lists{workspace, of_first, of_second, count};
  for (int sign = 0; sign < kSignGroups; ++sign) {
    std::size_t height = 0;
    for (std::size_t i = 0; i < first.keypoints.size(); ++i) {
      if (sign_group(first.keypoints[i].laplacian) == sign) {
        workspace.rows[height++] = static_cast<std::int32_t>(i);
      }
    }
    const BlockRange columns = comparable_blocks(workspace, sign);
    for (int b = columns.begin; b < columns.end; b += kBlocksPerChunk) {
      compare_rows(first, workspace.rows.first(height), {b, std::min(b + kBlocksPerChunk, columns.end)},
                   lists);
    }
  }
}

}  // namespace traygauge::paper
