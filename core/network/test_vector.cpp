#include "core/network/test_vector.hpp"

#include <cstddef>
#include <span>

#include "core/base/crc32c.hpp"

namespace traygauge {
namespace {

std::span<const std::byte> bytes_of(const std::uint8_t* data, std::size_t count) {
  return std::as_bytes(std::span(data, count));
}

}  // namespace

void draw_test_picture(std::uint32_t seed, ImageView<std::uint8_t> picture) {
  std::uint32_t state = seed;
  const int count = picture.width * picture.height;
  for (int i = 0; i < count; ++i) {
    state = 1664525U * state + 1013904223U;
    picture.data[i] =
        static_cast<std::uint8_t>(((state >> 24U) + static_cast<std::uint32_t>(i / 3 % 256)) / 2);
  }
}

TestVectorOutcome check_test_vector(const Network& network, NetworkRunner& runner) {
  const ImageView<std::uint8_t> input = runner.input();
  draw_test_picture(network.test.seed, input);
  const auto pixels = static_cast<std::size_t>(input.width) * static_cast<std::size_t>(input.height);
  TestVectorOutcome outcome;
  outcome.has_same_picture = crc32c(bytes_of(input.data, pixels)) == network.test.input_crc;
  runner.run();
  Crc32c outputs;
  for (const NetworkLayer& layer : network.used_layers()) {
    if (layer.role == NetworkRole::none) continue;
    const TensorView output = runner.output(layer.role);
    outputs.add(bytes_of(output.data, output.shape.bytes()));
  }
  outcome.has_same_outputs = outputs.value() == network.test.output_crc;
  return outcome;
}

}  // namespace traygauge
