#include "core/network/network_plan.hpp"

#include <algorithm>

namespace traygauge {
namespace {

class TensorPlacer {
 public:
  TensorPlacer(const Network& network, NetworkPlan& plan) : network_(network), plan_(plan) {
    for (std::size_t i = 0; i < network.layer_count; ++i) {
      for (const LayerSource& source : network.layers[i].used_sources()) {
        last_use_[static_cast<std::size_t>(source.tensor)] = i;
      }
      if (network.layers[i].role != NetworkRole::none) is_output_[i + 1] = true;
    }
  }

  void place_all() {
    place(0, 0);
    for (std::size_t i = 0; i < network_.layer_count; ++i) {
      const std::size_t tensor = i + 1;
      if (!place_over_source(i)) place(tensor, i);
    }
  }

 private:
  std::size_t bytes(std::size_t tensor) const { return aligned_bytes(network_.tensor_shape(tensor).bytes()); }
  bool is_needed(std::size_t tensor, std::size_t layer) const {
    return is_output_[tensor] || last_use_[tensor] >= layer;
  }

  // At the lowest place that no tensor takes which is needed at this layer: 0, or the end of one of them.
  void place(std::size_t tensor, std::size_t layer) {
    std::size_t lowest = 0;
    bool is_found = fits(0, tensor, layer);
    for (std::size_t other = 0; other < tensor; ++other) {
      const std::size_t end = plan_.tensor_at[other] + bytes(other);
      if (!is_needed(other, layer) || (is_found && end >= lowest) || !fits(end, tensor, layer)) continue;
      lowest = end;
      is_found = true;
    }
    settle(tensor, lowest);
  }

  bool fits(std::size_t at, std::size_t tensor, std::size_t layer) const {
    for (std::size_t other = 0; other < tensor; ++other) {
      if (!is_needed(other, layer)) continue;
      const std::size_t begin = plan_.tensor_at[other];
      if (at < begin + bytes(other) && begin < at + bytes(tensor)) return false;
    }
    return true;
  }

  // A convolution reads each row of its input once, in order, and before it writes the output's row of that
  // number. So it may write over a source that nobody needs afterwards, unless the source is enlarged or has
  // shorter rows than the output.
  bool place_over_source(std::size_t layer) {
    const NetworkLayer& reading = network_.layers[layer];
    const std::span<const LayerSource> sources = reading.used_sources();
    const auto* const source =
        std::find_if(sources.data(), sources.data() + sources.size(), [&](const LayerSource& one) {
          const auto tensor = static_cast<std::size_t>(one.tensor);
          const bool is_last = !is_output_[tensor] && last_use_[tensor] == layer;
          return is_last && one.enlargement == Enlargement::none &&
                 reading.output.row_bytes() <= network_.tensor_shape(tensor).row_bytes();
        });
    if (source == sources.data() + sources.size()) return false;
    settle(layer + 1, plan_.tensor_at[static_cast<std::size_t>(source->tensor)]);
    return true;
  }

  void settle(std::size_t tensor, std::size_t at) {
    plan_.tensor_at[tensor] = at;
    plan_.tensor_bytes = std::max(plan_.tensor_bytes, at + bytes(tensor));
  }

  const Network& network_;
  NetworkPlan& plan_;
  std::array<std::size_t, kMaxNetworkTensors> last_use_{};
  std::array<bool, kMaxNetworkTensors> is_output_{};
};

}  // namespace

NetworkPlan plan_network(const Network& network) {
  NetworkPlan plan;
  TensorPlacer(network, plan).place_all();
  for (std::size_t i = 0; i < network.layer_count; ++i) {
    const NetworkLayer& layer = network.layers[i];
    const std::size_t taps = NetworkPlan::padded_taps(layer);
    const std::size_t channels = NetworkPlan::padded_channels(layer);
    plan.weights_at[i] = plan.weights;
    plan.weights += channels * taps;
    plan.channels_at[i] = plan.channels;
    plan.channels += channels;
    const auto columns = static_cast<std::size_t>(layer.input.width) + 2;
    plan.row = std::max(plan.row, columns * static_cast<std::size_t>(layer.input.channels));
    plan.patch = std::max(plan.patch, kTileCells * taps);
    plan.sums = std::max(plan.sums, kTileCells * channels);
  }
  return plan;
}

}  // namespace traygauge
