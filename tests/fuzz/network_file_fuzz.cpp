// A file of a network, from its version on; its signature, length and checksum are made right, because no
// fuzzer finds a checksum. What is accepted fits into the memory that it asks for, and runs twice alike.
#include <memory>
#include <new>
#include <vector>

#include "core/base/crc32c.hpp"
#include "core/base/little_endian.hpp"
#include "core/network/network_file.hpp"
#include "core/network/network_runner.hpp"
#include "core/network/test_vector.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace traygauge {
namespace {

constexpr std::int64_t kMaxWork = 2'000'000;  // multiply-adds of an input that is run

struct Free {
  void operator()(std::byte* block) const {
    ::operator delete (block, std::align_val_t{kArenaAlignmentBytes});
  }
};

std::vector<std::byte> seal(const std::uint8_t* data, std::size_t size) {
  std::vector<std::byte> file(kNetworkVersionAt + size);
  for (std::size_t i = 0; i < kNetworkSignature.size(); ++i) {
    file[i] = static_cast<std::byte>(kNetworkSignature[i]);
  }
  for (std::size_t i = 0; i < size; ++i) file[kNetworkVersionAt + i] = static_cast<std::byte>(data[i]);
  const std::span<std::byte> bytes(file);
  store_little_endian(bytes, kNetworkCheckedAt, static_cast<std::uint32_t>(file.size()));
  store_little_endian(bytes, kNetworkCrcAt, crc32c(bytes.subspan(kNetworkCheckedAt)));
  return file;
}

void run(const Network& network) {
  const std::size_t bytes = required_bytes(network);
  if (bytes > kMaxNetworkBytes || network.multiply_adds() > kMaxWork) return;
  const std::unique_ptr<std::byte, Free> block(
      static_cast<std::byte*>(::operator new (bytes, std::align_val_t{kArenaAlignmentBytes})));
  NetworkRunner runner(network, {block.get(), bytes});
  const TestVectorOutcome first = check_test_vector(network, runner);
  const TestVectorOutcome second = check_test_vector(network, runner);
  demand(first.has_same_picture == second.has_same_picture, "the same picture each time");
  demand(first.has_same_outputs == second.has_same_outputs, "the same outputs each time");
  demand(runner.output(NetworkRole::classes).shape.channels == static_cast<int>(network.class_count),
         "a channel a class");
}

}  // namespace
}  // namespace traygauge

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace traygauge;
  const std::vector<std::byte> file = seal(data, size);
  Network network;
  const NetworkFileStatus status = parse_network(file, network);
  demand(status != NetworkFileStatus::foreign, "the signature is right");
  if (status == NetworkFileStatus::ok) run(network);
  return 0;
}
