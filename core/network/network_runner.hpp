// A network that runs in fixed memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/image_view/image_view.hpp"
#include "core/network/convolution.hpp"
#include "core/network/network.hpp"
#include "core/network/network_plan.hpp"
#include "core/network/source_rows.hpp"

namespace traygauge {

inline constexpr std::size_t kMaxNetworkBytes =
    std::size_t{1} << 20U;  // what a station has room for; the network for food takes 0.8

// Bytes that a runner of this network takes: weights of 16 bits, tensors, rows of a convolution.
std::size_t required_bytes(const Network& network);

class NetworkRunner {
 public:
  // Refers to both; `block` has required_bytes(network), aligned for an arena. The file that the network was
  // parsed from is not needed afterwards, but for names and text.
  NetworkRunner(const Network& network, std::span<std::byte> block);

  // To be filled before each run: three bytes a pixel, red, green, blue; so the view's width is three times
  // the network's. Contents are undefined after a run.
  ImageView<std::uint8_t> input() const;
  void run();
  // Of the last run, up to the next filling of the input. Empty where the network has no such output.
  TensorView output(NetworkRole role) const;
  // The real value of one unit of that output; 0 where the network has none.
  float step(NetworkRole role) const;

 private:
  void pack(std::size_t layer);
  PackedLayer packed(std::size_t layer) const;
  TensorView tensor(std::size_t index) const;

  const Network& network_;
  NetworkPlan plan_;
  NetworkWorkspace workspace_;
};

}  // namespace traygauge
