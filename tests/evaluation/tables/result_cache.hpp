// Measurements that were made before, one small JSON file for each pair and variant.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/evaluate/protocol.hpp"

namespace traygauge::tables {

class ResultCache {
 public:
  // Creates the folder; throws OutputError.
  explicit ResultCache(std::filesystem::path folder);

  // The runs of seeds 1, 2, … that are stored under `key`; none when there are none or they cannot be read.
  std::vector<Run> read(const std::string& key) const;
  // Replaces what is stored under `key`: a reader finds either all or nothing of it. Throws OutputError.
  void write(const std::string& key, const std::vector<Run>& runs) const;

  std::filesystem::path file_of(const std::string& key) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace traygauge::tables
