// One layer of a network.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/network/network_plan.hpp"
#include "core/network/source_rows.hpp"

namespace traygauge {

// A layer's numbers as the kernel reads them.
struct PackedLayer {
  std::span<const std::int16_t> weights;  // see NetworkWorkspace
  std::span<const std::int32_t> biases;
  std::span<const std::int32_t> multipliers;
  std::span<const std::uint8_t> shifts;
};

// Writes the layer's whole output. The output may lie where a source does as NetworkPlan has it. Products are
// of 16 bits and sums of 32, both exact, so that the order in which they are added does not matter.
void convolve(const NetworkLayer& layer, const PackedLayer& packed,
              const std::array<TensorView, kMaxLayerSources>& sources, NetworkWorkspace& workspace,
              std::uint8_t* output);

}  // namespace traygauge
