// Files of networks, composed byte by byte as core/network/network_file.hpp describes them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/network/network_file.hpp"

namespace traygauge::test {

struct ComposedSource {
  int tensor = 0;
  Enlargement enlargement = Enlargement::none;
};

struct ComposedLayer {
  int kernel = 3;
  int stride = 1;
  bool has_relu = true;
  NetworkRole role = NetworkRole::none;
  std::vector<ComposedSource> sources;
  int channels = 1;
  float step = 1.0F;
  std::vector<std::int32_t> biases{};
  std::vector<std::int32_t> multipliers{};
  std::vector<std::uint8_t> shifts{};
  std::vector<std::int8_t> weights{};
};

struct ComposedNetwork {
  int version = kNetworkFileVersion;
  int width = 32;
  int height = 24;
  std::vector<std::string> classes{"other", "food"};
  std::string provenance = "made by a test";
  NetworkTestVector vector;
  std::vector<ComposedLayer> layers;
};

std::vector<std::byte> compose_network(const ComposedNetwork& network);

// Writes the checksum of the rest into the file's head.
void mend_checksum(std::vector<std::byte>& file);

// Gives every layer weights, biases and multipliers by chance, such that sums rarely saturate and seldom
// vanish.
void draw_numbers(std::uint32_t seed, ComposedNetwork& network);

// The layers of the network for food: five scales, 12 to 48 channels down, 32 to 12 up; heads for eleven
// classes, borders and an embedding. 320 × 240: 190 million multiply-adds.
ComposedNetwork food_layers(int width = 320, int height = 240);

// A network of 3 to 10 layers of every kind by chance.
ComposedNetwork draw_network(std::uint32_t seed);

// With the test vector that this program computes for it.
void add_test_vector(ComposedNetwork& network);

}  // namespace traygauge::test
