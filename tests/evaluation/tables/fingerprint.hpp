// What a result was computed from.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "firmware/evaluate/pair_tasks.hpp"
#include "tests/evaluation/tables/variant.hpp"

namespace traygauge::tables {

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
