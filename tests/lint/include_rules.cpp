#include "tests/lint/include_rules.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>

namespace traygauge {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kCommandLineParser = "firmware/command/program.cpp";
constexpr auto kFolders = std::to_array<std::string_view>({"core", "drivers", "simulator", "firmware"});

// Folders of core in the order in which the data flows: each knows itself and those before it.
constexpr auto kCoreOrder = std::to_array<std::string_view>(
    {"image_view", "base", "geometry", "image", "labels", "quality", "features", "card", "dish", "tracking",
     "adjustment", "stereo", "volume", "network", "segmentation", "pipeline", "enrolment", "paper"});

// The part of the standard library that neither allocates nor does input or output.
constexpr auto kCoreHeaders = std::to_array<std::string_view>(
    {"algorithm", "array",   "atomic",      "bit",     "cassert",          "cfloat",
     "charconv",  "chrono",  "climits",     "cmath",   "compare",          "concepts",
     "cstddef",   "cstdint", "cstring",     "ctime",   "initializer_list", "iterator",
     "limits",    "memory",  "new",         "numbers", "numeric",          "optional",
     "ranges",    "span",    "string_view", "tuple",   "type_traits",      "utility",
     "variant",   "version"});

bool begins(std::string_view text, std::string_view beginning) {
  return text.substr(0, beginning.size()) == beginning;
}

template <class List>
bool holds(const List& list, std::string_view text) {
  return std::find(list.begin(), list.end(), text) != list.end();
}

std::string_view folder_of(std::string_view path) {
  return path.substr(0, path.find('/'));
}

// The folders whose files this folder may include.
bool may_know(std::string_view folder, std::string_view included) {
  const std::string_view other = folder_of(included);
  if (other == folder) return true;
  if (begins(included, "core/image_view/")) return true;
  if (folder == "simulator") return other == "core" || other == "drivers";
  if (folder == "firmware") return holds(kFolders, other);
  return false;  // core and drivers
}

// Of "core/stereo/sgm.hpp": "stereo".
std::string_view subject_of(std::string_view path) {
  const std::string_view below = path.substr(path.find('/') + 1);
  return below.substr(0, below.find('/'));
}

// Where `included` comes later than `path` in the order of core.
std::optional<std::string> forbids_upward(std::string_view path, std::string_view included) {
  const std::string_view own = subject_of(path);
  const std::string_view other = subject_of(included);
  const auto* const own_at = std::find(kCoreOrder.begin(), kCoreOrder.end(), own);
  const auto* const other_at = std::find(kCoreOrder.begin(), kCoreOrder.end(), other);
  if (own_at == kCoreOrder.end())
    return "core has no folder " + std::string(own) + " in its order of folders";
  if (other_at <= own_at) return std::nullopt;
  return "core/" + std::string(own) + " comes before core/" + std::string(other) +
         " in the order of the data";
}

bool is_system_header(std::string_view path) {
  return path.find('/') == std::string_view::npos || begins(path, "linux/") || begins(path, "sys/");
}

std::optional<std::string> forbids_foreign(std::string_view folder, const std::string& path) {
  if (folder == "core") {
    if (holds(kCoreHeaders, path) || begins(path, "Eigen/") || begins(path, "hwy/")) return std::nullopt;
    return "core includes the non-allocating standard library, Eigen and Highway only, not <" + path + ">";
  }
  if (folder == "drivers" && !is_system_header(path)) {
    return "drivers include the standard library and the system's headers only, not <" + path + ">";
  }
  return std::nullopt;
}

// Headers that cost seconds of compiler wherever they are included.
std::optional<std::string> forbids_heavy(std::string_view path, const std::string& included) {
  if (begins(included, "CLI/") && path != kCommandLineParser)
    return std::string(kCommandLineParser) + " alone includes CLI11; others use its header";
  const bool is_heavy = included == "nlohmann/json.hpp" || begins(included, "toml++/");
  if (is_heavy && path.ends_with(".hpp"))
    return "<" + included + "> is included by the sources that need it, not by headers";
  return std::nullopt;
}

void scan_file(const fs::path& root, const std::string& path, ScanOfIncludes& scan) {
  std::ifstream file(root / path);
  std::string text;
  for (int line = 1; std::getline(file, text); ++line) {
    const auto included = parse_include(text);
    if (!included) continue;
    ++scan.includes;
    auto reason = forbids(path, *included);
    if (!reason && included->in_quotes && !fs::exists(root / included->path)) {
      reason = "\"" + included->path + "\" is no path from the root of the checkout";
    }
    if (reason) scan.breaches.push_back({path, line, *reason});
  }
  ++scan.files;
}

}  // namespace

std::optional<IncludedFile> parse_include(std::string_view line) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"].*)");
  std::match_results<std::string_view::const_iterator> match;
  if (!std::regex_match(line.begin(), line.end(), match, kInclude)) return std::nullopt;
  return IncludedFile{match[2].str(), match[1].str() == "\""};
}

std::optional<std::string> forbids(std::string_view path, const IncludedFile& included) {
  const std::string_view folder = folder_of(path);
  if (!included.in_quotes) {
    const auto reason = forbids_foreign(folder, included.path);
    return reason ? reason : forbids_heavy(path, included.path);
  }
  if (folder == "core" && begins(included.path, "core/")) return forbids_upward(path, included.path);
  if (may_know(folder, included.path)) return std::nullopt;
  return std::string(folder) + " does not know \"" + included.path + "\"";
}

ScanOfIncludes scan_includes(const fs::path& root) {
  ScanOfIncludes scan;
  for (const std::string_view folder : kFolders) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension();
      const bool is_source = extension == ".hpp" || extension == ".cpp" || extension == ".h";
      if (is_source) scan_file(root, fs::relative(entry.path(), root).generic_string(), scan);
    }
  }
  return scan;
}

}  // namespace traygauge
