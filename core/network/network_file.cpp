#include "core/network/network_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/crc32c.hpp"
#include "core/base/little_endian.hpp"
#include "core/network/rescaling.hpp"

namespace traygauge {
namespace {

constexpr std::int32_t kMaxBias = std::int32_t{1} << 30U;  // half of what 32 bits hold
// A sum holds a bias and this many products of a byte and a weight.
constexpr auto kMaxTaps = std::int64_t{9} * kMaxLayerSources * kMaxNetworkChannels;
static_assert(kMaxBias + kMaxTaps * 255 * 128 < std::int64_t{1} << 31U);

// Takes one part after the other off the file; what the file lacks makes it fail, and reads as 0.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}

  std::span<const std::byte> take(std::size_t count) {
    if (count > rest_.size()) {
      failed_ = true;
      return {};
    }
    const std::span<const std::byte> taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  template <class T>
  T number() {
    const std::span<const std::byte> taken = take(sizeof(T));
    return failed_ ? T{0} : load_little_endian<T>(taken, 0);
  }
  bool failed() const { return failed_; }
  bool is_at_end() const { return rest_.empty(); }

 private:
  std::span<const std::byte> rest_;
  bool failed_ = false;
};

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

bool is_printable(char c) {
  return c >= ' ' && c <= '~';
}

// An enumerator of `count`, or failure.
template <class Enum>
bool read_choice(Reader& reader, std::uint8_t count, Enum& choice) {
  const auto value = reader.number<std::uint8_t>();
  choice = static_cast<Enum>(value);
  return value < count;
}

class Parser {
 public:
  Parser(std::span<const std::byte> bytes, Network& network)
      : reader_(bytes.subspan(kNetworkVersionAt + sizeof(std::uint16_t))), network_(network) {}

  NetworkFileStatus parse() {
    const NetworkFileStatus head = read_head();
    if (head != NetworkFileStatus::ok) return head;
    if (!read_names() || !read_provenance()) return NetworkFileStatus::contradictory;
    for (std::size_t i = 0; i < network_.layer_count; ++i) {
      const NetworkFileStatus status = read_layer(i);
      if (status != NetworkFileStatus::ok) return status;
    }
    if (reader_.failed() || !reader_.is_at_end() || !are_outputs_used()) {
      return NetworkFileStatus::contradictory;
    }
    return network_.multiply_adds() > kMaxMultiplyAdds ? NetworkFileStatus::too_large : NetworkFileStatus::ok;
  }

 private:
  NetworkFileStatus read_head() {
    network_.width = reader_.number<std::uint16_t>();
    network_.height = reader_.number<std::uint16_t>();
    network_.layer_count = reader_.number<std::uint16_t>();
    network_.class_count = reader_.number<std::uint16_t>();
    text_bytes_ = reader_.number<std::uint16_t>();
    network_.test.seed = reader_.number<std::uint32_t>();
    network_.test.input_crc = reader_.number<std::uint32_t>();
    network_.test.output_crc = reader_.number<std::uint32_t>();
    const auto [shorter, longer] = std::minmax(network_.width, network_.height);
    if (longer > kMaxNetworkSide || network_.layer_count > kMaxNetworkLayers ||
        network_.class_count > kMaxNetworkClasses) {
      return NetworkFileStatus::too_large;
    }
    const bool is_whole = !reader_.failed() && shorter >= kMinNetworkSide && network_.layer_count > 0 &&
                          network_.class_count > 1;
    return is_whole ? NetworkFileStatus::ok : NetworkFileStatus::contradictory;
  }

  // Each of one printable character at least, and one zero.
  bool read_names() {
    for (std::size_t i = 0; i < network_.class_count; ++i) {
      const std::string_view field = text_of(reader_.take(kNetworkNameBytes));
      const std::string_view name = field.substr(0, field.find('\0'));
      const std::string_view filling = field.substr(name.size());
      if (name.empty() || filling.empty() || !std::all_of(name.begin(), name.end(), is_printable) ||
          !std::all_of(filling.begin(), filling.end(), [](char c) { return c == '\0'; })) {
        return false;
      }
      network_.classes[i] = name;
    }
    return true;
  }

  bool read_provenance() {
    network_.provenance = text_of(reader_.take(text_bytes_));
    return std::all_of(network_.provenance.begin(), network_.provenance.end(),
                       [](char c) { return is_printable(c) || c == '\n'; });
  }

  NetworkFileStatus read_layer(std::size_t index) {
    NetworkLayer& layer = network_.layers[index];
    if (!read_choices(layer) || !read_sources(index, layer)) return NetworkFileStatus::contradictory;
    const auto channels = reader_.number<std::uint16_t>();
    const auto zero = reader_.number<std::uint16_t>();
    layer.step = std::bit_cast<float>(reader_.number<std::uint32_t>());
    if (reader_.failed() || channels == 0 || zero != 0 || !std::isfinite(layer.step) || layer.step <= 0.0F) {
      return NetworkFileStatus::contradictory;
    }
    if (channels > kMaxNetworkChannels) return NetworkFileStatus::too_large;
    const auto strided = [&](int side) { return (side + layer.stride - 1) / layer.stride; };
    layer.output = {strided(layer.input.width), strided(layer.input.height), channels};
    return read_numbers(layer) && suits_role(index, layer) ? NetworkFileStatus::ok
                                                           : NetworkFileStatus::contradictory;
  }

  bool read_choices(NetworkLayer& layer) {
    layer.kernel = reader_.number<std::uint8_t>();
    layer.stride = reader_.number<std::uint8_t>();
    const auto relu = reader_.number<std::uint8_t>();
    layer.has_relu = relu == 1;
    const bool has_role = read_choice(reader_, kNetworkRoles, layer.role);
    return (layer.kernel == 1 || layer.kernel == 3) && (layer.stride == 1 || layer.stride == 2) &&
           relu <= 1 && has_role;
  }

  bool read_sources(std::size_t index, NetworkLayer& layer) {
    layer.source_count = reader_.number<std::uint8_t>();
    for (LayerSource& source : layer.sources) {
      if (!read_choice(reader_, kEnlargements, source.enlargement)) return false;
    }
    if (reader_.number<std::uint8_t>() != 0) return false;
    for (LayerSource& source : layer.sources) source.tensor = reader_.number<std::uint16_t>();
    if (reader_.failed() || layer.source_count < 1 ||
        layer.source_count > static_cast<int>(kMaxLayerSources)) {
      return false;
    }
    const LayerSource& second = layer.sources[1];
    if (layer.source_count == 1 && (second.tensor != 0 || second.enlargement != Enlargement::none)) {
      return false;
    }
    return join_sources(index, layer);
  }

  // A source that is not enlarged says how large the convolution's input is. One that is may be a row and a
  // column larger, which are then cut off: an odd side was halved upward.
  bool join_sources(std::size_t index, NetworkLayer& layer) {
    const LayerSource* exact = layer.sources.data();
    int channels = 0;
    for (const LayerSource& source : layer.used_sources()) {
      if (static_cast<std::size_t>(source.tensor) > index) return false;
      channels += enlarged_shape(source).channels;
      if (exact->enlargement != Enlargement::none) exact = &source;
    }
    const bool may_exceed = exact->enlargement == Enlargement::none;
    if (!may_exceed) exact = layer.sources.data();
    layer.input = enlarged_shape(*exact);
    for (const LayerSource& source : layer.used_sources()) {
      const TensorShape shape = enlarged_shape(source);
      const int excess = may_exceed && source.enlargement != Enlargement::none ? 1 : 0;
      const auto fits = [&](int side, int wanted) { return side >= wanted && side <= wanted + excess; };
      if (!fits(shape.width, layer.input.width) || !fits(shape.height, layer.input.height)) return false;
    }
    layer.input.channels = channels;
    return layer.input.width <= kMaxNetworkSide && layer.input.height <= kMaxNetworkSide;
  }

  TensorShape enlarged_shape(const LayerSource& source) const {
    const TensorShape shape = network_.tensor_shape(static_cast<std::size_t>(source.tensor));
    if (source.enlargement == Enlargement::none) return shape;
    return {2 * shape.width, 2 * shape.height, shape.channels};
  }

  bool read_numbers(NetworkLayer& layer) {
    const auto channels = static_cast<std::size_t>(layer.output.channels);
    layer.biases = reader_.take(channels * sizeof(std::int32_t));
    layer.multipliers = reader_.take(channels * sizeof(std::int32_t));
    layer.shifts = reader_.take(channels);
    layer.weights = reader_.take(channels * layer.taps());
    if (reader_.failed()) return false;
    for (std::size_t c = 0; c < channels; ++c) {
      const auto bias = load_little_endian<std::int32_t>(layer.biases, c * sizeof(std::int32_t));
      const auto multiplier = load_little_endian<std::int32_t>(layer.multipliers, c * sizeof(std::int32_t));
      const auto shift = std::to_integer<int>(layer.shifts[c]);
      if (bias < -kMaxBias || bias > kMaxBias || multiplier < 1 || shift < kMinRescalingShift ||
          shift > kMaxRescalingShift) {
        return false;
      }
    }
    return true;
  }

  // Each role once; as many channels as it takes.
  bool suits_role(std::size_t index, const NetworkLayer& layer) const {
    if (layer.role == NetworkRole::none) return true;
    if (network_.find(layer.role) != &network_.layers[index]) return false;
    if (layer.role == NetworkRole::classes) {
      return static_cast<std::size_t>(layer.output.channels) == network_.class_count;
    }
    return layer.role != NetworkRole::border || layer.output.channels == 1;
  }

  // Every layer's output is read by another or has a role, and there are classes.
  bool are_outputs_used() const {
    std::array<bool, kMaxNetworkTensors> is_used{};
    for (const NetworkLayer& layer : network_.used_layers()) {
      for (const LayerSource& source : layer.used_sources()) {
        is_used[static_cast<std::size_t>(source.tensor)] = true;
      }
    }
    for (std::size_t i = 0; i < network_.layer_count; ++i) {
      if (!is_used[i + 1] && network_.layers[i].role == NetworkRole::none) return false;
    }
    return network_.find(NetworkRole::classes) != nullptr;
  }

  Reader reader_;
  Network& network_;
  std::size_t text_bytes_ = 0;
};

}  // namespace

NetworkFileStatus parse_network(std::span<const std::byte> bytes, Network& network) {
  const std::span signature = std::as_bytes(std::span(kNetworkSignature));
  if (bytes.size() < signature.size() || !std::ranges::equal(signature, bytes.first(signature.size()))) {
    return NetworkFileStatus::foreign;
  }
  if (bytes.size() < kNetworkHeaderBytes ||
      load_little_endian<std::uint32_t>(bytes, kNetworkCheckedAt) != bytes.size() ||
      load_little_endian<std::uint32_t>(bytes, kNetworkCrcAt) != crc32c(bytes.subspan(kNetworkCheckedAt))) {
    return NetworkFileStatus::damaged;
  }
  const auto version = load_little_endian<std::uint16_t>(bytes, kNetworkVersionAt);
  if (version > kNetworkFileVersion) return NetworkFileStatus::newer;
  if (version == 0) return NetworkFileStatus::contradictory;
  network = Network{};
  return Parser(bytes, network).parse();
}

}  // namespace traygauge
