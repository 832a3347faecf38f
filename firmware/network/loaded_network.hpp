// A network from a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/network/network.hpp"

namespace traygauge {

class LoadedNetwork {
 public:
  // Throws InputError where the file is absent, damaged, foreign, newer or too large, and where the network
  // does not compute what its test vector says.
  explicit LoadedNetwork(const std::filesystem::path& path);
  LoadedNetwork(const LoadedNetwork&) = delete;
  LoadedNetwork& operator=(const LoadedNetwork&) = delete;

  const Network& network() const { return network_; }
  std::size_t file_bytes() const { return bytes_.size(); }

 private:
  std::vector<std::uint8_t> bytes_;
  Network network_;  // refers to them
};

}  // namespace traygauge
