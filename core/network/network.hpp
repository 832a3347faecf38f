// A convolutional network in integers: what its file states, as views into the file's bytes.
//
// Every layer is a convolution, 3×3 or 1×1. It reads one or two tensors, each of them enlarged twofold where
// the layer says so, with their channels side by side: enlargement and concatenation exist nowhere else, so
// no memory is needed for what they make. Tensors hold 8 bits a value, row by row, the channels of a cell
// side by side: 0 to 255 after a ReLU, -128 to 127 without one. Tensor 0 is the picture, red, green and blue;
// tensor i is what layer i - 1 makes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace traygauge {

inline constexpr int kMinNetworkSide = 16;  // no food shows in less; no code depends on it
// Up to these a tensor has 2^28 bytes, so that places in it fit an int, and a sum of products, of two sources
// and 3×3, leaves half of 32 bits to the bias (network_file.cpp asserts it).
inline constexpr int kMaxNetworkSide = 1024;
inline constexpr int kMaxNetworkChannels = 256;  // of a tensor
// Room in a Network, of which a station has one; the network for food has 16 layers.
inline constexpr int kMaxNetworkClasses = 32;
inline constexpr std::size_t kMaxNetworkLayers = 32;
inline constexpr std::size_t kMaxNetworkTensors = kMaxNetworkLayers + 1;
inline constexpr std::size_t kMaxLayerSources = 2;  // of a U-Net: what comes up, and what is handed across
inline constexpr int kPictureChannels = 3;
inline constexpr std::int64_t kMaxMultiplyAdds = 1'000'000'000;  // half a second on a small board

// What a layer's output means to those who run the network.
enum class NetworkRole : std::uint8_t {
  none,       // read by other layers alone
  classes,    // a channel a class; the largest counts
  border,     // one channel, positive on the border between two items
  embedding,  // alike within portions of one food
};
inline constexpr std::size_t kNetworkRoles = 4;

enum class Enlargement : std::uint8_t {
  none,
  nearest,   // twofold
  bilinear,  // twofold: 9, 3, 3 and 1 sixteenths of the four nearest cells, rounded
};
inline constexpr std::size_t kEnlargements = 3;

struct TensorShape {
  int width = 0;
  int height = 0;
  int channels = 0;

  constexpr std::size_t row_bytes() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
  }
  constexpr std::size_t bytes() const { return row_bytes() * static_cast<std::size_t>(height); }
  constexpr bool operator==(const TensorShape&) const = default;
};

struct LayerSource {
  int tensor = 0;
  Enlargement enlargement = Enlargement::none;
};

// Multipliers, biases and shifts are per channel of the output. The numbers stay in the file, unaligned.
struct NetworkLayer {
  int kernel = 3;  // or 1
  int stride = 1;  // or 2
  bool has_relu = true;
  NetworkRole role = NetworkRole::none;
  float step = 1.0F;  // of the output: the real value of one unit
  int source_count = 1;
  std::array<LayerSource, kMaxLayerSources> sources{};
  TensorShape input;  // of the convolution: its sources, enlarged, side by side
  TensorShape output;
  std::span<const std::byte> biases;       // int32
  std::span<const std::byte> multipliers;  // int32, positive
  std::span<const std::byte> shifts;       // uint8, 1 to 62
  std::span<const std::byte> weights;  // int8: output channel, row and column of the kernel, input channel

  std::span<const LayerSource> used_sources() const {
    return std::span(sources).first(static_cast<std::size_t>(source_count));
  }
  // Weights of one output channel.
  constexpr std::size_t taps() const {
    return static_cast<std::size_t>(kernel) * static_cast<std::size_t>(kernel) *
           static_cast<std::size_t>(input.channels);
  }
  constexpr std::int64_t multiply_adds() const {
    return static_cast<std::int64_t>(output.bytes()) * static_cast<std::int64_t>(taps());
  }
};

// A picture that everybody can make, and the outputs that whoever wrote the file got for it.
struct NetworkTestVector {
  std::uint32_t seed = 0;        // of draw_test_picture()
  std::uint32_t input_crc = 0;   // CRC-32C of that picture
  std::uint32_t output_crc = 0;  // CRC-32C of all outputs with a role, in the order of the layers
};

struct Network {
  int width = 0;
  int height = 0;
  std::size_t layer_count = 0;
  std::array<NetworkLayer, kMaxNetworkLayers> layers{};
  std::size_t class_count = 0;
  std::array<std::string_view, kMaxNetworkClasses> classes{};  // their names
  std::string_view provenance;                                 // how it was trained: lines of ASCII
  NetworkTestVector test;

  std::span<const NetworkLayer> used_layers() const { return std::span(layers).first(layer_count); }
  // The output of this role; null where the network has none, and for no role.
  const NetworkLayer* find(NetworkRole role) const {
    if (role == NetworkRole::none) return nullptr;
    for (const NetworkLayer& layer : used_layers()) {
      if (layer.role == role) return &layer;
    }
    return nullptr;
  }
  TensorShape tensor_shape(std::size_t tensor) const {
    return tensor == 0 ? TensorShape{width, height, kPictureChannels} : layers[tensor - 1].output;
  }
  bool is_signed(std::size_t tensor) const { return tensor != 0 && !layers[tensor - 1].has_relu; }
  std::int64_t multiply_adds() const {
    std::int64_t sum = 0;
    for (const NetworkLayer& layer : used_layers()) sum += layer.multiply_adds();
    return sum;
  }
};

}  // namespace traygauge
