#include "core/network/network_runner.hpp"

#include <cassert>

#include "core/base/little_endian.hpp"
#include "core/network/rescaling.hpp"

namespace traygauge {

std::size_t required_bytes(const Network& network) {
  ArenaPlan arena;
  NetworkWorkspace().allocate(arena, plan_network(network));
  return arena.high_water_bytes();
}

NetworkRunner::NetworkRunner(const Network& network, std::span<std::byte> block)
    : network_(network), plan_(plan_network(network)) {
  Arena arena(block);
  workspace_.allocate(arena, plan_);
  assert(!arena.exhausted());
  for (std::size_t i = 0; i < network.layer_count; ++i) pack(i);
}

// Channels and taps beyond the layer's own stay zero, as the arena made them.
void NetworkRunner::pack(std::size_t layer) {
  const NetworkLayer& from = network_.layers[layer];
  const auto channels = static_cast<std::size_t>(from.output.channels);
  const std::size_t padded = NetworkPlan::padded_taps(from);
  for (std::size_t c = 0; c < channels; ++c) {
    const std::size_t at = plan_.channels_at[layer] + c;
    workspace_.biases[at] = load_little_endian<std::int32_t>(from.biases, c * sizeof(std::int32_t));
    workspace_.multipliers[at] = load_little_endian<std::int32_t>(from.multipliers, c * sizeof(std::int32_t));
    workspace_.shifts[at] = std::to_integer<std::uint8_t>(from.shifts[c]);
    const std::span<std::int16_t> weights = workspace_.weights.subspan(plan_.weights_at[layer] + c * padded);
    for (std::size_t k = 0; k < from.taps(); ++k) {
      weights[k] = signed_value(std::to_integer<std::uint8_t>(from.weights[c * from.taps() + k]));
    }
  }
}

PackedLayer NetworkRunner::packed(std::size_t layer) const {
  const std::size_t at = plan_.channels_at[layer];
  return {workspace_.weights.subspan(plan_.weights_at[layer]), workspace_.biases.subspan(at),
          workspace_.multipliers.subspan(at), workspace_.shifts.subspan(at)};
}

TensorView NetworkRunner::tensor(std::size_t index) const {
  return {workspace_.tensors.data() + plan_.tensor_at[index], network_.tensor_shape(index),
          network_.is_signed(index)};
}

ImageView<std::uint8_t> NetworkRunner::input() const {
  return {workspace_.tensors.data() + plan_.tensor_at[0], kPictureChannels * network_.width, network_.height};
}

void NetworkRunner::run() {
  for (std::size_t i = 0; i < network_.layer_count; ++i) {
    const NetworkLayer& layer = network_.layers[i];
    std::array<TensorView, kMaxLayerSources> sources;
    for (std::size_t k = 0; k < layer.used_sources().size(); ++k) {
      sources[k] = tensor(static_cast<std::size_t>(layer.sources[k].tensor));
    }
    convolve(layer, packed(i), sources, workspace_, workspace_.tensors.data() + plan_.tensor_at[i + 1]);
  }
}

TensorView NetworkRunner::output(NetworkRole role) const {
  const NetworkLayer* layer = network_.find(role);
  if (layer == nullptr) return {};
  return tensor(static_cast<std::size_t>(layer - network_.layers.data()) + 1);
}

float NetworkRunner::step(NetworkRole role) const {
  const NetworkLayer* layer = network_.find(role);
  return layer == nullptr ? 0.0F : layer->step;
}

}  // namespace traygauge
