// Short names for contents: where a result is stored, and what it was computed from.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "firmware/evaluate/pair_tasks.hpp"
#include "tests/evaluation/tables/variant.hpp"

namespace traygauge::tables {

// FNV-1a of 64 bits as 16 hexadecimal digits.
std::string fingerprint(std::span<const std::uint8_t> bytes);
std::string fingerprint(const std::string& text);

// What results are computed with: hashes of the libraries and of this program's methods, OpenCV's version.
std::string describe_program();

// Names of measurements. Files are read once.
class PairKeys {
 public:
  // Everything that the volumes of `task` by `variant` depend on, as text: the program, the variant, and the
  // capture's files. `config`: folder with dishes/, for captures that name none. Throws InputError.
  std::string key_of(const PairTask& task, const Variant& variant, const std::string& config);

 private:
  const std::string& of_file(const std::filesystem::path& file);
  const std::string& of_pair(const PairTask& task, const std::string& config);

  std::map<std::filesystem::path, std::string> files_;
  std::map<std::pair<std::filesystem::path, std::array<int, 2>>, std::string> pairs_;
};

}  // namespace traygauge::tables
