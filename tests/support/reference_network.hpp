// Networks computed slowly, one value after the other, straight from what network.hpp says of them. Shares
// none of core's arithmetic.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/support/network_composer.hpp"

namespace traygauge::test {

struct ReferenceTensor {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<int> values;  // row by row, the channels of a cell side by side

  int at(int x, int y, int channel) const {
    return values[static_cast<std::size_t>((y * width + x) * channels + channel)];
  }
};

// All tensors of the network, the picture's first.
std::vector<ReferenceTensor> run_reference(const ComposedNetwork& network,
                                           const std::vector<std::uint8_t>& picture);

// As bytes, those of negative values by two's complement.
std::vector<std::uint8_t> bytes_of(const ReferenceTensor& tensor);

// The test picture of this seed, and the vector that a file with it has to hold.
std::vector<std::uint8_t> reference_picture(const ComposedNetwork& network, std::uint32_t seed);
NetworkTestVector reference_test_vector(const ComposedNetwork& network, std::uint32_t seed);

}  // namespace traygauge::test
