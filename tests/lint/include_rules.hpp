// Who may include whom, and what is too heavy for most.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace traygauge {

// What a line `#include <x>` or `#include "x"` names.
struct IncludedFile {
  std::string path;
  bool in_quotes = false;
};
std::optional<IncludedFile> parse_include(std::string_view line);

// Why the file at `path` (from the root of the checkout) may not include this; nothing when it may.
std::optional<std::string> forbids(std::string_view path, const IncludedFile& included);

struct Breach {
  std::string path;
  int line = 0;
  std::string reason;
};
struct ScanOfIncludes {
  int files = 0;
  int includes = 0;
  std::vector<Breach> breaches;
};
// Every source and header below core, drivers, simulator and firmware. Quoted files must exist below `root`.
ScanOfIncludes scan_includes(const std::filesystem::path& root);

}  // namespace traygauge
