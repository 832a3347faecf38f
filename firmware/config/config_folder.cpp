#include "firmware/config/config_folder.hpp"

#include <system_error>

#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNameTheFolder = "pass --config DIR or set TRAYGAUGE_CONFIG";

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

fs::path find_beside_program(const char* part, const char* expected, const char* advice) {
  std::error_code ignored;
  return find_config_above(fs::read_symlink("/proc/self/exe", ignored).parent_path(), part, expected, advice);
}

}  // namespace

fs::path find_config_above(const fs::path& start, const char* part, const char* expected,
                           const char* advice) {
  for (fs::path above = start; above.has_relative_path(); above = above.parent_path()) {
    for (const char* place : {"config", "share/traygauge/config"}) {
      fs::path folder = above / place;
      if (is_folder(folder / part)) return folder;
    }
  }
  throw InputError({start / "config", ""}, expected, "none beside the program", advice);
}

fs::path find_config_folder(const std::string& named) {
  if (named.empty())
    return find_beside_program("dishes", "the folder with dishes/, because the capture names no dish",
                               kNameTheFolder);
  if (is_folder(named)) return named;
  throw InputError({named, "--config"}, "a folder", "none", "name the folder that holds dishes/");
}

fs::path find_network_file(const std::string& named) {
  fs::path folder = fs::path(named) / "network";
  if (named.empty() || !is_folder(folder))
    folder =
        find_beside_program("network", "the folder with network/, which holds the network for food",
                            "install the program anew, or set TRAYGAUGE_CONFIG to a folder that has it") /
        "network";
  return folder / "food.tgn";
}

fs::path find_plots_folder(const std::string& named) {
  if (!named.empty() && is_folder(fs::path(named) / "plots")) return fs::path(named) / "plots";
  return find_beside_program("plots", "the folder with plots/, from which plots are drawn", kNameTheFolder) /
         "plots";
}

}  // namespace traygauge
