#include "tests/support/reference_network.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

#include "core/base/crc32c.hpp"

namespace traygauge::test {
namespace {

ReferenceTensor enlarge(const ReferenceTensor& small, Enlargement enlargement) {
  if (enlargement == Enlargement::none) return small;
  ReferenceTensor large{2 * small.width, 2 * small.height, small.channels, {}};
  for (int y = 0; y < large.height; ++y) {
    for (int x = 0; x < large.width; ++x) {
      const int column = x / 2;
      const int row = y / 2;
      const int beside = std::clamp(x % 2 == 0 ? column - 1 : column + 1, 0, small.width - 1);
      const int above = std::clamp(y % 2 == 0 ? row - 1 : row + 1, 0, small.height - 1);
      for (int c = 0; c < small.channels; ++c) {
        const int sixteenths = 9 * small.at(column, row, c) + 3 * small.at(beside, row, c) +
                               3 * small.at(column, above, c) + small.at(beside, above, c);
        // Halves upward: the floor of the value and a half, also below 0.
        const int doubled = sixteenths + 8;
        const int rounded = doubled >= 0 ? doubled / 16 : -((15 - doubled) / 16);
        large.values.push_back(enlargement == Enlargement::nearest ? small.at(column, row, c) : rounded);
      }
    }
  }
  return large;
}

// The floor of sum · multiplier / 2^shift + 1 / 2.
int rescale_slowly(std::int64_t sum, std::int64_t multiplier, int shift, bool has_relu) {
  __extension__ using Wide = __int128;
  const Wide twice = Wide{2} * sum * multiplier + (Wide{1} << shift);
  const Wide divisor = Wide{1} << (shift + 1);
  Wide quotient = twice / divisor;
  if (twice % divisor < 0) --quotient;
  const Wide low = has_relu ? 0 : -128;
  return static_cast<int>(std::clamp(quotient, low, low + 255));
}

ReferenceTensor convolve_slowly(const ComposedLayer& layer, const std::vector<ReferenceTensor>& tensors) {
  std::vector<ReferenceTensor> sources;
  for (const ComposedSource& source : layer.sources) {
    sources.push_back(enlarge(tensors[static_cast<std::size_t>(source.tensor)], source.enlargement));
  }
  int width = sources[0].width;
  int height = sources[0].height;
  int inputs = 0;
  for (const ReferenceTensor& source : sources) {
    width = std::min(width, source.width);
    height = std::min(height, source.height);
    inputs += source.channels;
  }
  const auto value = [&](int x, int y, int channel) {
    if (x < 0 || y < 0 || x >= width || y >= height) return 0;
    std::size_t from = 0;
    while (channel >= sources[from].channels) channel -= sources[from++].channels;
    return sources[from].at(x, y, channel);
  };
  ReferenceTensor out{(width + layer.stride - 1) / layer.stride,
                      (height + layer.stride - 1) / layer.stride,
                      layer.channels,
                      {}};
  const int reach = layer.kernel / 2;
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      for (int c = 0; c < out.channels; ++c) {
        const auto channel = static_cast<std::size_t>(c);
        std::int64_t sum = layer.biases[channel];
        std::size_t at = channel * static_cast<std::size_t>(layer.kernel * layer.kernel * inputs);
        for (int j = 0; j < layer.kernel; ++j) {
          for (int i = 0; i < layer.kernel; ++i) {
            for (int k = 0; k < inputs; ++k) {
              sum += std::int64_t{layer.weights[at++]} *
                     value(x * layer.stride + i - reach, y * layer.stride + j - reach, k);
            }
          }
        }
        out.values.push_back(
            rescale_slowly(sum, layer.multipliers[channel], layer.shifts[channel], layer.has_relu));
      }
    }
  }
  return out;
}

}  // namespace

std::vector<ReferenceTensor> run_reference(const ComposedNetwork& network,
                                           const std::vector<std::uint8_t>& picture) {
  std::vector<ReferenceTensor> tensors;
  tensors.push_back(
      {network.width, network.height, kPictureChannels, std::vector<int>(picture.begin(), picture.end())});
  for (const ComposedLayer& layer : network.layers) tensors.push_back(convolve_slowly(layer, tensors));
  return tensors;
}

std::vector<std::uint8_t> bytes_of(const ReferenceTensor& tensor) {
  std::vector<std::uint8_t> bytes;
  for (const int value : tensor.values) bytes.push_back(static_cast<std::uint8_t>(value & 0xff));
  return bytes;
}

std::vector<std::uint8_t> reference_picture(const ComposedNetwork& network, std::uint32_t seed) {
  std::vector<std::uint8_t> picture;
  std::uint64_t state = seed;
  for (int i = 0; i < kPictureChannels * network.width * network.height; ++i) {
    state = (1664525 * state + 1013904223) % (std::uint64_t{1} << 32U);
    picture.push_back(
        static_cast<std::uint8_t>((state / (1U << 24U) + static_cast<unsigned>(i / 3 % 256)) / 2));
  }
  return picture;
}

NetworkTestVector reference_test_vector(const ComposedNetwork& network, std::uint32_t seed) {
  const std::vector<std::uint8_t> picture = reference_picture(network, seed);
  const std::vector<ReferenceTensor> tensors = run_reference(network, picture);
  std::vector<std::uint8_t> outputs;
  for (std::size_t i = 0; i < network.layers.size(); ++i) {
    if (network.layers[i].role == NetworkRole::none) continue;
    const std::vector<std::uint8_t> bytes = bytes_of(tensors[i + 1]);
    outputs.insert(outputs.end(), bytes.begin(), bytes.end());
  }
  return {seed, crc32c(std::as_bytes(std::span(picture))), crc32c(std::as_bytes(std::span(outputs)))};
}

}  // namespace traygauge::test
