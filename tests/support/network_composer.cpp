#include "tests/support/network_composer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <random>

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

using Size = std::array<int, 2>;  // width, height

// One after the other, layers whose sources fit each other.
class NetworkDraw {
 public:
  explicit NetworkDraw(std::uint32_t seed) : engine_(seed) {}

  std::optional<ComposedNetwork> draw() {
    network_.width = between(kMinNetworkSide, 45);
    network_.height = between(kMinNetworkSide, 40);
    sizes_ = {{network_.width, network_.height}};
    const int count = between(3, 10);
    for (int i = 0; i < count; ++i) add_layer();
    network_.layers.push_back({1, 1, false, NetworkRole::classes, {{count}}, 2});
    if (!give_role(count)) return std::nullopt;
    return network_;
  }

 private:
  int between(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }

  Size size_of(const ComposedSource& source) const {
    const Size size = sizes_[static_cast<std::size_t>(source.tensor)];
    const int times = source.enlargement == Enlargement::none ? 1 : 2;
    return {times * size[0], times * size[1]};
  }

  // Mostly the newest tensor; not enlarged beyond what is computed quickly.
  ComposedSource draw_source() {
    const int newest = static_cast<int>(sizes_.size()) - 1;
    const int tensor = between(0, 2) == 0 ? between(0, newest) : newest;
    const bool may_grow = sizes_[static_cast<std::size_t>(tensor)][0] <= 48;
    return {tensor, may_grow ? static_cast<Enlargement>(between(0, 2)) : Enlargement::none};
  }

  // Of one size; or the one that is enlarged exceeds the other by one at most.
  bool may_join(const ComposedSource& first, const ComposedSource& second) const {
    const auto exceeds = [&](const ComposedSource& large, const ComposedSource& small) {
      if (large.enlargement == Enlargement::none || small.enlargement != Enlargement::none) return false;
      const Size a = size_of(large);
      const Size b = size_of(small);
      return a[0] - b[0] >= 0 && a[0] - b[0] <= 1 && a[1] - b[1] >= 0 && a[1] - b[1] <= 1;
    };
    return size_of(first) == size_of(second) || exceeds(first, second) || exceeds(second, first);
  }

  void add_layer() {
    ComposedLayer layer{between(0, 2) == 0 ? 1 : 3, between(1, 2),   between(0, 3) > 0,
                        NetworkRole::none,          {draw_source()}, between(1, 19)};
    for (int tries = 0; tries < 40 && layer.sources.size() == 1; ++tries) {
      const ComposedSource other = draw_source();
      if (may_join(layer.sources[0], other)) layer.sources.push_back(other);
    }
    Size size = size_of(layer.sources[0]);
    if (layer.sources.back().enlargement == Enlargement::none) size = size_of(layer.sources.back());
    const auto strided = [&](int side) { return (side + layer.stride - 1) / layer.stride; };
    sizes_.push_back({strided(size[0]), strided(size[1])});
    network_.layers.push_back(layer);
  }

  // What nobody reads is the embedding. Without such a layer, on some draws one that others read as well is:
  // of the layers before the head, which are `count`. False where there are several that nobody reads.
  bool give_role(int count) {
    std::vector<bool> is_read(network_.layers.size() + 1, false);
    for (const ComposedLayer& layer : network_.layers) {
      for (const ComposedSource& source : layer.sources)
        is_read[static_cast<std::size_t>(source.tensor)] = true;
    }
    int embedding = 0;
    for (int tensor = 1; tensor < count; ++tensor) {
      if (is_read[static_cast<std::size_t>(tensor)]) continue;
      if (embedding != 0) return false;
      embedding = tensor;
    }
    if (embedding == 0 && between(0, 1) == 0) embedding = between(1, count);
    if (embedding != 0)
      network_.layers[static_cast<std::size_t>(embedding) - 1].role = NetworkRole::embedding;
    return true;
  }

  std::mt19937 engine_;
  ComposedNetwork network_;
  std::vector<Size> sizes_;
};

// Of every tensor, the picture's first.
std::vector<int> tensor_channels(const ComposedNetwork& network) {
  std::vector<int> channels{kPictureChannels};
  for (const ComposedLayer& layer : network.layers) channels.push_back(layer.channels);
  return channels;
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
  for (;; seed += 0x9e3779b9U) {
    std::optional<ComposedNetwork> network = NetworkDraw(seed).draw();
    if (!network) continue;  // more than one layer that nobody reads
    draw_numbers(seed, *network);
    return *network;
  }
}

void add_test_vector(ComposedNetwork& network) {
  network.vector = reference_test_vector(network, network.vector.seed);
}

}  // namespace traygauge::test
