#include "firmware/network/loaded_network.hpp"

#include <span>
#include <string>

#include "core/base/little_endian.hpp"
#include "core/network/network_file.hpp"
#include "core/network/network_runner.hpp"
#include "core/network/test_vector.hpp"
#include "firmware/base/aligned_block.hpp"
#include "firmware/base/text.hpp"
#include "simulator/capture/input_bytes.hpp"

namespace traygauge {
namespace {

const char* const kExpected = "a network for food (.tgn)";
const char* const kCopyAgain = "copy it from the release again, or train it anew";

[[noreturn]] void refuse(const InputFile& file, NetworkFileStatus status, std::span<const std::byte> bytes) {
  switch (status) {
    case NetworkFileStatus::foreign:
      throw InputError(file, kExpected, "a file of another kind", "name a file that the training wrote");
    case NetworkFileStatus::newer: {
      const auto version = load_little_endian<std::uint16_t>(bytes, kNetworkVersionAt);
      throw InputError(file, "version " + std::to_string(kNetworkFileVersion) + " of the format",
                       "version " + std::to_string(version), "update traygauge");
    }
    case NetworkFileStatus::contradictory:
      throw InputError(file, kExpected, "layers or sizes that contradict each other", kCopyAgain);
    case NetworkFileStatus::too_large:
      throw InputError(file, "a network that a station has room and time for",
                       "more layers, channels or work than that", "train a smaller one");
    default:
      throw InputError(file, kExpected, "a damaged one: its length or its checksum is not what it states",
                       kCopyAgain);
  }
}

}  // namespace

LoadedNetwork::LoadedNetwork(const std::filesystem::path& path)
    : bytes_(read_bytes({path, ""}, kMaxNetworkFileBytes, kExpected)) {
  const InputFile file{path, ""};
  const std::span<const std::byte> bytes = std::as_bytes(std::span(bytes_));
  const NetworkFileStatus status = parse_network(bytes, network_);
  if (status != NetworkFileStatus::ok) refuse(file, status, bytes);
  const std::size_t required = required_bytes(network_);
  if (required > kMaxNetworkBytes) {
    throw InputError(file, "a network that takes at most " + mebibytes(kMaxNetworkBytes) + " MiB of memory",
                     "one that takes " + mebibytes(required) + " MiB", "train a smaller one");
  }
  const AlignedBlock block(required);
  NetworkRunner runner(network_, block.bytes());
  const TestVectorOutcome outcome = check_test_vector(network_, runner);
  if (outcome.has_same_picture && outcome.has_same_outputs) return;
  throw InputError(
      file, "the outputs that its test vector states", "others",
      "the program that wrote it computes otherwise: write it with the training of this release");
}

}  // namespace traygauge
