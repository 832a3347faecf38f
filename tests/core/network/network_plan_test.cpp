// Where tensors lie: none over another that is still needed, but for the one that its layer writes over.
#include "core/network/network_plan.hpp"

#include <gtest/gtest.h>

#include "core/network/network_runner.hpp"
#include "tests/core/network/running_network.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge::test {
namespace {

// The last layer that needs the tensor; outputs are needed after the last.
std::size_t needed_until(const Network& network, std::size_t tensor) {
  if (tensor > 0 && network.layers[tensor - 1].role != NetworkRole::none) return network.layer_count;
  std::size_t last = 0;
  for (std::size_t i = 0; i < network.layer_count; ++i) {
    for (const LayerSource& source : network.layers[i].used_sources()) {
      if (static_cast<std::size_t>(source.tensor) == tensor) last = i;
    }
  }
  return last;
}

// The tensor exists from layer tensor - 1 on; one that ends there may be written over by it.
void expect_no_overlap(const Network& network) {
  const NetworkPlan plan = plan_network(network);
  for (std::size_t later = 1; later <= network.layer_count; ++later) {
    const std::size_t begin = plan.tensor_at[later];
    const std::size_t bytes = network.tensor_shape(later).bytes();
    EXPECT_LE(begin + bytes, plan.tensor_bytes);
    for (std::size_t earlier = 0; earlier < later; ++earlier) {
      const std::size_t other = plan.tensor_at[earlier];
      const bool overlaps = begin < other + network.tensor_shape(earlier).bytes() && other < begin + bytes;
      const std::size_t until = needed_until(network, earlier);
      if (until < later - 1 || !overlaps) continue;
      EXPECT_EQ(until, later - 1) << "tensor " << later << " lies over tensor " << earlier;
      EXPECT_EQ(begin, other) << "tensor " << later << " lies over a part of tensor " << earlier;
    }
  }
}

TEST(NetworkPlan, LaysNoTensorOverOneThatIsNeeded) {
  const std::uint32_t seed = random_seed();
  for (std::uint32_t i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const RunningNetwork running(draw_network(seed + i));
    expect_no_overlap(running.network());
  }
}

TEST(NetworkPlan, FitsTheNetworkOfFoodIntoAMebibyte) {
  ComposedNetwork composed = food_layers();
  draw_numbers(1, composed);
  const RunningNetwork running(composed);
  expect_no_overlap(running.network());
  EXPECT_LT(required_bytes(running.network()), kMaxNetworkBytes);
  // All tensors beside each other would take more than this.
  std::size_t sum = 0;
  for (std::size_t i = 0; i <= running.network().layer_count; ++i) {
    sum += running.network().tensor_shape(i).bytes();
  }
  EXPECT_LT(plan_network(running.network()).tensor_bytes, sum / 2);
  RecordProperty("bytes", static_cast<int>(required_bytes(running.network())));
}

// A layer of as many channels as its source, which nobody needs afterwards, takes no memory of its own.
TEST(NetworkPlan, LetsALayerWriteOverItsSource) {
  ComposedNetwork composed;
  composed.layers.push_back({3, 1, true, NetworkRole::none, {{0}}, 3});
  composed.layers.push_back({3, 1, true, NetworkRole::none, {{1}}, 3});
  composed.layers.push_back({1, 1, false, NetworkRole::classes, {{2}}, 2});
  draw_numbers(1, composed);
  const RunningNetwork running(composed);
  EXPECT_EQ(plan_network(running.network()).tensor_bytes, aligned_bytes(32 * 24 * 3));
}

}  // namespace
}  // namespace traygauge::test
