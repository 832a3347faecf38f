// Where the paper's sets lie.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "tests/evaluation/tables/paper_tables.hpp"

namespace traygauge::tables {

// As typed; empty where an option was left out.
struct SetOptions {
  std::string meals;
  std::string angles;
  std::string plates;
  std::string meals14;
  std::string sets;  // a folder that holds them as meals-45, … or as meals, angles, plates, meals14
};

using SetFolders = std::map<PaperSet, std::filesystem::path>;

// The folders of the sets that were named or lie in `sets`. Throws UsageError where a named one is absent.
SetFolders find_sets(const SetOptions& options);

}  // namespace traygauge::tables
