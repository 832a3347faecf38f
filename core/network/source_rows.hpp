// Rows of what a convolution reads: its sources, enlarged where the layer says so, side by side.
#pragma once

#include <array>
#include <cstdint>

#include "core/network/network.hpp"
#include "core/network/rescaling.hpp"

namespace traygauge {

// A tensor in memory.
struct TensorView {
  const std::uint8_t* data = nullptr;
  TensorShape shape;
  bool is_signed = false;

  const std::uint8_t* row(int y) const { return data + static_cast<std::ptrdiff_t>(shape.row_bytes()) * y; }
  int at(int x, int y, int channel) const {
    const std::uint8_t value = row(y)[x * shape.channels + channel];
    return is_signed ? signed_value(value) : value;
  }
};

// Writes row `y` of the layer's input to `row`, from its second cell on; 0 beyond the input's ends on every
// side. `row` holds two cells more than the input is wide. `sources` are in the order of the layer's.
void gather_row(const NetworkLayer& layer, const std::array<TensorView, kMaxLayerSources>& sources, int y,
                std::int16_t* row);

}  // namespace traygauge
