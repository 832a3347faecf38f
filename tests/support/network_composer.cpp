#include "tests/support/network_composer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <stdexcept>

#include "core/base/crc32c.hpp"
#include "core/base/little_endian.hpp"
#include "tests/support/reference_network.hpp"

namespace traygauge::test {
namespace {

class Bytes {
 public:
  template <class T>
  void add(T number) {
    const auto raw = static_cast<std::make_unsigned_t<T>>(number);
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes_.push_back(static_cast<std::byte>((std::uint64_t{raw} >> (8 * i)) & 0xffU));
    }
  }
  void add_text(const std::string& text, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) add(static_cast<std::uint8_t>(i < text.size() ? text[i] : 0));
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

void add_layer(const ComposedLayer& layer, Bytes& bytes) {
  bytes.add(static_cast<std::uint8_t>(layer.kernel));
  bytes.add(static_cast<std::uint8_t>(layer.stride));
  bytes.add(static_cast<std::uint8_t>(layer.has_relu));
  bytes.add(static_cast<std::uint8_t>(layer.role));
  bytes.add(static_cast<std::uint8_t>(layer.sources.size()));
  const auto source = [&](std::size_t i) {
    return i < layer.sources.size() ? layer.sources[i] : ComposedSource{};
  };
  for (std::size_t i = 0; i < kMaxLayerSources; ++i) {
    bytes.add(static_cast<std::uint8_t>(source(i).enlargement));
  }
  bytes.add(std::uint8_t{0});
  for (std::size_t i = 0; i < kMaxLayerSources; ++i) bytes.add(static_cast<std::uint16_t>(source(i).tensor));
  bytes.add(static_cast<std::uint16_t>(layer.channels));
  bytes.add(std::uint16_t{0});
  bytes.add(std::bit_cast<std::uint32_t>(layer.step));
  for (const std::int32_t bias : layer.biases) bytes.add(bias);
  for (const std::int32_t multiplier : layer.multipliers) bytes.add(multiplier);
  for (const std::uint8_t shift : layer.shifts) bytes.add(shift);
  for (const std::int8_t weight : layer.weights) bytes.add(weight);
}

// Down to half the size in two layers.
void add_scale(ComposedNetwork& network, int channels) {
  const int from = static_cast<int>(network.layers.size());
  network.layers.push_back({3, 2, true, NetworkRole::none, {{from}}, channels});
  network.layers.push_back({3, 1, true, NetworkRole::none, {{from + 1}}, channels});
}

}  // namespace

std::vector<std::byte> compose_network(const ComposedNetwork& network) {
  Bytes bytes;
  for (const std::uint8_t byte : kNetworkSignature) bytes.add(byte);
  bytes.add(std::uint32_t{0});
  bytes.add(std::uint32_t{0});
  for (const std::size_t number :
       {static_cast<std::size_t>(network.version), static_cast<std::size_t>(network.width),
        static_cast<std::size_t>(network.height), network.layers.size(), network.classes.size(),
        network.provenance.size()}) {
    bytes.add(static_cast<std::uint16_t>(number));
  }
  bytes.add(network.vector.seed);
  bytes.add(network.vector.input_crc);
  bytes.add(network.vector.output_crc);
  for (const std::string& name : network.classes) bytes.add_text(name, kNetworkNameBytes);
  bytes.add_text(network.provenance, network.provenance.size());
  for (const ComposedLayer& layer : network.layers) add_layer(layer, bytes);
  std::vector<std::byte> file = bytes.take();
  store_little_endian(std::span(file), kNetworkCheckedAt, static_cast<std::uint32_t>(file.size()));
  mend_checksum(file);
  return file;
}

void mend_checksum(std::vector<std::byte>& file) {
  const std::span<std::byte> bytes(file);
  store_little_endian(bytes, kNetworkCrcAt, crc32c(bytes.subspan(kNetworkCheckedAt)));
}

std::vector<int> tensor_channels(const ComposedNetwork& network) {
  std::vector<int> channels{kPictureChannels};
  for (const ComposedLayer& layer : network.layers) channels.push_back(layer.channels);
  return channels;
}

void draw_numbers(std::uint32_t seed, ComposedNetwork& network) {
  std::mt19937 engine(seed);
  const std::vector<int> channels = tensor_channels(network);
  for (ComposedLayer& layer : network.layers) {
    std::size_t taps = 0;
    for (const ComposedSource& source : layer.sources) {
      taps += static_cast<std::size_t>(channels[static_cast<std::size_t>(source.tensor)] * layer.kernel *
                                       layer.kernel);
    }
    std::uniform_int_distribution<int> weight(-128, 127);
    const auto count = static_cast<std::size_t>(layer.channels);
    layer.weights.resize(count * taps);
    for (std::int8_t& number : layer.weights) number = static_cast<std::int8_t>(weight(engine));
    // The sum of so many products of a weight and a value near 64 spreads about so far.
    const double spread = 64.0 * 74.0 * std::sqrt(static_cast<double>(taps));
    for (std::size_t c = 0; c < count; ++c) {
      const int shift = std::uniform_int_distribution<int>(30, 50)(engine);
      const double scale = std::uniform_real_distribution<double>(30.0, 120.0)(engine) / spread;
      const double multiplier = std::clamp(std::ldexp(scale, shift), 1.0, 2147483647.0);
      layer.multipliers.push_back(static_cast<std::int32_t>(multiplier));
      layer.shifts.push_back(static_cast<std::uint8_t>(shift));
      layer.biases.push_back(
          static_cast<std::int32_t>(std::uniform_real_distribution<double>(-spread, 2.0 * spread)(engine)));
    }
  }
}

ComposedNetwork food_layers(int width, int height) {
  ComposedNetwork network;
  network.width = width;
  network.height = height;
  network.classes = {"background", "food",   "glaze", "rim",  "table", "card",
                     "cutlery",    "napkin", "cup",   "hand", "other"};
  std::vector<ComposedLayer>& layers = network.layers;
  layers.push_back({3, 2, true, NetworkRole::none, {{0}}, 12});
  for (const int channels : {20, 32, 48, 48}) add_scale(network, channels);
  constexpr auto kUp = Enlargement::bilinear;
  layers.push_back({3, 1, true, NetworkRole::none, {{9, kUp}, {7}}, 32});   // tensor 10
  layers.push_back({3, 1, true, NetworkRole::none, {{10, kUp}, {5}}, 24});  // 11
  layers.push_back({3, 1, true, NetworkRole::none, {{11, kUp}, {3}}, 16});  // 12
  layers.push_back({3, 1, false, NetworkRole::embedding, {{12}}, 12});
  layers.push_back({3, 1, true, NetworkRole::none, {{12, kUp}, {1}}, 12});  // 14
  layers.push_back({1, 1, false, NetworkRole::border, {{14}}, 1});
  layers.push_back({1, 1, false, NetworkRole::classes, {{14}}, static_cast<int>(network.classes.size())});
  return network;
}

ComposedNetwork draw_network(std::uint32_t seed) {
  std::mt19937 engine(seed);
  const auto draw = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine); };
  ComposedNetwork network;
  network.width = draw(kMinNetworkSide, 45);
  network.height = draw(kMinNetworkSide, 40);
  std::vector<std::array<int, 2>> sizes{{network.width, network.height}};
  const auto enlarged = [&](const ComposedSource& source) {
    const std::array<int, 2> size = sizes[static_cast<std::size_t>(source.tensor)];
    const int times = source.enlargement == Enlargement::none ? 1 : 2;
    return std::array<int, 2>{times * size[0], times * size[1]};
  };
  const auto draw_source = [&] {
    const int newest = static_cast<int>(sizes.size()) - 1;
    const int tensor = draw(0, 2) == 0 ? draw(0, newest) : newest;
    const bool may_grow = sizes[static_cast<std::size_t>(tensor)][0] <= 48;
    return ComposedSource{tensor, may_grow ? static_cast<Enlargement>(draw(0, 2)) : Enlargement::none};
  };
  const int count = draw(3, 10);
  for (int i = 0; i < count; ++i) {
    ComposedLayer layer{draw(0, 2) == 0 ? 1 : 3, draw(1, 2), draw(0, 3) > 0,
                        NetworkRole::none,       {},         draw(1, 19)};
    if (i == 0) {
      layer.sources = {{0}};
    } else {
      layer.sources = {draw_source()};
      std::array<int, 2> size = enlarged(layer.sources[0]);
      for (int tries = 0; tries < 40 && layer.sources.size() == 1; ++tries) {
        const ComposedSource other = draw_source();
        const std::array<int, 2> further = enlarged(other);
        const bool first_is_exact = layer.sources[0].enlargement == Enlargement::none;
        const bool is_exact = other.enlargement == Enlargement::none;
        const auto exceeds = [](std::array<int, 2> large, std::array<int, 2> small) {
          return large[0] - small[0] >= 0 && large[0] - small[0] <= 1 && large[1] - small[1] >= 0 &&
                 large[1] - small[1] <= 1;
        };
        if (further == size || (first_is_exact && !is_exact && exceeds(further, size)) ||
            (!first_is_exact && is_exact && exceeds(size, further))) {
          layer.sources.push_back(other);
          if (is_exact) size = further;
        }
      }
    }
    std::array<int, 2> size = enlarged(layer.sources[0]);
    if (layer.sources.size() == 2 && layer.sources[1].enlargement == Enlargement::none) {
      size = enlarged(layer.sources[1]);
    }
    sizes.push_back(
        {(size[0] + layer.stride - 1) / layer.stride, (size[1] + layer.stride - 1) / layer.stride});
    network.layers.push_back(layer);
  }
  // What nobody reads becomes a source of the heads, or a head.
  network.layers.push_back({1, 1, false, NetworkRole::classes, {{count}}, 2});
  std::vector<bool> is_read(network.layers.size() + 1, false);
  for (const ComposedLayer& layer : network.layers) {
    for (const ComposedSource& source : layer.sources)
      is_read[static_cast<std::size_t>(source.tensor)] = true;
  }
  bool has_embedding = false;
  for (int tensor = count - 1; tensor >= 1; --tensor) {
    if (is_read[static_cast<std::size_t>(tensor)]) continue;
    ComposedLayer& layer = network.layers[static_cast<std::size_t>(tensor) - 1];
    if (has_embedding) return draw_network(seed + 0x9e3779b9U);
    layer.role = NetworkRole::embedding;
    has_embedding = true;
  }
  // An output may be read by other layers, too.
  if (!has_embedding && draw(0, 1) == 0) {
    network.layers[static_cast<std::size_t>(draw(1, count)) - 1].role = NetworkRole::embedding;
  }
  draw_numbers(seed, network);
  return network;
}

void add_test_vector(ComposedNetwork& network) {
  network.vector = reference_test_vector(network, network.vector.seed);
}

}  // namespace traygauge::test
