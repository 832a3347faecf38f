// Whole networks, bit by bit as the slow reference has them.
#include "core/network/network_runner.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/network/test_vector.hpp"
#include "tests/core/network/running_network.hpp"
#include "tests/support/random_seed.hpp"
#include "tests/support/reference_network.hpp"

namespace traygauge::test {
namespace {

constexpr NetworkRole kRoles[] = {NetworkRole::classes, NetworkRole::border, NetworkRole::embedding};

void expect_same_outputs(const ComposedNetwork& network, const std::vector<std::uint8_t>& picture,
                         RunningNetwork& running) {
  running.run(picture);
  const std::vector<ReferenceTensor> tensors = run_reference(network, picture);
  for (const NetworkRole role : kRoles) {
    const auto made = std::find_if(network.layers.begin(), network.layers.end(),
                                   [&](const ComposedLayer& layer) { return layer.role == role; });
    if (made == network.layers.end()) {
      EXPECT_TRUE(running.output(role).empty());
      continue;
    }
    const auto at = static_cast<std::size_t>(made - network.layers.begin()) + 1;
    EXPECT_EQ(running.output(role), bytes_of(tensors[at])) << static_cast<int>(role);
  }
}

TEST(NetworkRunner, GivesTheBitsOfTheReference) {
  const std::uint32_t seed = random_seed();
  for (std::uint32_t i = 0; i < 25; ++i) {
    SCOPED_TRACE(i);
    const ComposedNetwork network = draw_network(seed + i);
    RunningNetwork running(network);
    // Twice: nothing of the first picture may be left.
    for (std::uint32_t picture = 0; picture < 2; ++picture) {
      expect_same_outputs(network, reference_picture(network, seed + picture), running);
    }
    if (HasFailure()) return;
  }
}

TEST(NetworkRunner, GivesTheBitsOfTheReferenceForTheNetworkOfFood) {
  ComposedNetwork network = food_layers(64, 48);
  const std::uint32_t seed = random_seed();
  draw_numbers(seed, network);
  RunningNetwork running(network);
  expect_same_outputs(network, reference_picture(network, seed), running);
}

// The largest weights on the largest values: sums of 36 million, and outputs at both ends.
TEST(NetworkRunner, SaturatesWhereEverythingIsLargest) {
  ComposedNetwork network;
  network.width = network.height = 16;
  network.layers.push_back({1, 1, true, NetworkRole::none, {{0}}, 128});
  network.layers.push_back({3, 1, false, NetworkRole::classes, {{1}}, 2});
  ComposedLayer& wide = network.layers[0];
  wide.biases.assign(128, 1 << 30);
  wide.multipliers.assign(128, 2147483647);
  wide.shifts.assign(128, 1);
  wide.weights.assign(128 * 3, 127);
  ComposedLayer& last = network.layers[1];
  last.biases = {0, 0};
  last.multipliers = {1, 1};
  last.shifts = {18, 19};
  last.weights.assign(2 * 9 * 128, -128);
  std::fill_n(last.weights.begin(), 9 * 128, std::int8_t{127});
  RunningNetwork running(network);
  const std::vector<std::uint8_t> picture(16 * 16 * 3, 255);
  expect_same_outputs(network, picture, running);
  const TensorView output = running.runner().output(NetworkRole::classes);
  EXPECT_EQ(output.at(8, 8, 0), 127);
  EXPECT_EQ(output.at(8, 8, 1), -72);  // -128 * 255 * 1152 / 2^19 = -71.7
}

TEST(NetworkRunner, ChecksTheTestVectorOfTheFile) {
  ComposedNetwork network = food_layers(32, 32);  // with all roles
  draw_numbers(random_seed(), network);
  network.vector.seed = 7;
  add_test_vector(network);
  RunningNetwork running(network);
  const TestVectorOutcome same = check_test_vector(running.network(), running.runner());
  EXPECT_TRUE(same.has_same_picture);
  EXPECT_TRUE(same.has_same_outputs);

  ++network.vector.output_crc;
  RunningNetwork other(network);
  EXPECT_TRUE(check_test_vector(other.network(), other.runner()).has_same_picture);
  EXPECT_FALSE(check_test_vector(other.network(), other.runner()).has_same_outputs);
  ++network.vector.input_crc;
  RunningNetwork third(network);
  EXPECT_FALSE(check_test_vector(third.network(), third.runner()).has_same_picture);
}

}  // namespace
}  // namespace traygauge::test
