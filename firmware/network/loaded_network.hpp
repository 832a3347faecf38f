// A network from a file, in memory of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/network/network.hpp"
#include "core/network/network_runner.hpp"
#include "firmware/base/aligned_block.hpp"

namespace traygauge {

class LoadedNetwork {
 public:
  // Throws InputError where the file is absent, damaged, foreign, newer or too large, and where the network
  // does not compute what its test vector says.
  explicit LoadedNetwork(const std::filesystem::path& path);
  LoadedNetwork(const LoadedNetwork&) = delete;
  LoadedNetwork& operator=(const LoadedNetwork&) = delete;

  const Network& network() const { return network_; }
  NetworkRunner& runner() { return *runner_; }
  std::size_t file_bytes() const { return bytes_.size(); }
  std::size_t memory_bytes() const { return block_->bytes().size(); }

 private:
  std::vector<std::uint8_t> bytes_;
  Network network_;
  std::unique_ptr<AlignedBlock> block_;
  std::unique_ptr<NetworkRunner> runner_;
};

}  // namespace traygauge
