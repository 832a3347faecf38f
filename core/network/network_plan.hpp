// Where everything of a network lies in its memory. A tensor is kept from the layer that makes it to the last
// that reads it, outputs with a role to the end; tensors that are never needed at the same time share memory,
// and a layer writes over what it reads where nothing is lost by it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/network/network.hpp"

namespace traygauge {

// Taps are filled up to a multiple: eight numbers of 16 bits fill a register of SSE2 and of NEON.
inline constexpr std::size_t kTapBlock = 8;
inline constexpr std::size_t kOutputBlock = 4;  // output channels computed side by side
inline constexpr std::size_t kTileCells = 16;   // cells of a row computed side by side, in pairs

constexpr std::size_t round_up(std::size_t count, std::size_t block) {
  return (count + block - 1) / block * block;
}

// Counts of elements, not bytes, but for the tensors.
struct NetworkPlan {
  std::array<std::size_t, kMaxNetworkTensors> tensor_at{};  // bytes into the memory of the tensors
  std::size_t tensor_bytes = 0;
  std::array<std::size_t, kMaxNetworkLayers> weights_at{};
  std::size_t weights = 0;
  std::array<std::size_t, kMaxNetworkLayers> channels_at{};
  std::size_t channels = 0;
  std::size_t row = 0;    // of the widest convolution's input, with a cell beside either end
  std::size_t patch = 0;  // of the cells that a tile of the largest convolution reads
  std::size_t sums = 0;

  // The same for one layer.
  static std::size_t padded_taps(const NetworkLayer& layer) { return round_up(layer.taps(), kTapBlock); }
  static std::size_t padded_channels(const NetworkLayer& layer) {
    return round_up(static_cast<std::size_t>(layer.output.channels), kOutputBlock);
  }
};

NetworkPlan plan_network(const Network& network);

inline constexpr std::size_t kRingRows = 3;  // that a kernel reads

struct NetworkWorkspace {
  std::span<std::uint8_t> tensors;
  std::span<std::int16_t> weights;  // of each layer: output channels, of each its taps, filled up with zeros
  std::span<std::int32_t> biases;
  std::span<std::int32_t> multipliers;
  std::span<std::uint8_t> shifts;
  std::array<std::span<std::int16_t>, kRingRows> rows;
  std::span<std::int16_t> patch;
  std::span<std::int32_t> sums;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const NetworkPlan& plan) {
    tensors = arena.template take<std::uint8_t>(plan.tensor_bytes);
    weights = arena.template take<std::int16_t>(plan.weights);
    biases = arena.template take<std::int32_t>(plan.channels);
    multipliers = arena.template take<std::int32_t>(plan.channels);
    shifts = arena.template take<std::uint8_t>(plan.channels);
    for (std::span<std::int16_t>& row : rows) row = arena.template take<std::int16_t>(plan.row);
    patch = arena.template take<std::int16_t>(plan.patch);
    sums = arena.template take<std::int32_t>(plan.sums);
  }
};

}  // namespace traygauge
