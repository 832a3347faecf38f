#include "firmware/config/config_folder.hpp"

#include <system_error>

#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

// Beside the program, in the checkout that it was built in, or where it was installed.
fs::path find_beside_program(const char* part, const char* expected) {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const char* place : {"config", "../config", "../../../share/traygauge/config"}) {
    fs::path folder = (program / place).lexically_normal();
    if (is_folder(folder / part)) return folder;
  }
  throw InputError({program / "config", ""}, expected, "none beside the program",
                   "pass --config DIR or set TRAYGAUGE_CONFIG");
}

}  // namespace

fs::path find_config_folder(const std::string& named) {
  if (named.empty())
    return find_beside_program("dishes", "the folder with dishes/, because the capture names no dish");
  if (is_folder(named)) return named;
  throw InputError({named, "--config"}, "a folder", "none", "name the folder that holds dishes/");
}

fs::path find_plots_folder(const std::string& named) {
  if (!named.empty() && is_folder(fs::path(named) / "plots")) return fs::path(named) / "plots";
  return find_beside_program("plots", "the folder with plots/, from which plots are drawn") / "plots";
}

}  // namespace traygauge
