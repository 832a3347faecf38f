#include "firmware/hub/page_files.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

namespace traygauge {
namespace {

namespace fs = std::filesystem;

constexpr const char* kThreeFolder = "/usr/share/javascript";
constexpr const char* kThreeModule = "three/three.module.js";

}  // namespace

std::optional<fs::path> find_page_folder() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const char* place : {"page", "../firmware/page", "../../../share/traygauge/page"}) {
    fs::path folder = (program / place).lexically_normal();
    if (fs::is_regular_file(folder / "index.html", ignored)) return folder;
  }
  return std::nullopt;
}

Expected<void> read_page(const fs::path& folder, StaticFiles& files) {
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    std::string name = entry.path().filename().string();
    if (entry.is_regular_file(error) && StaticFiles::may_hold(name)) names.push_back(std::move(name));
  }
  if (error) return Failure{folder.string() + ": " + error.message()};
  std::sort(names.begin(), names.end());
  if (Expected<void> read = files.read(folder, names); !read.ok()) return read;
  if (!fs::is_regular_file(fs::path(kThreeFolder) / kThreeModule, error)) return {};
  return files.read(kThreeFolder, {kThreeModule});
}

}  // namespace traygauge
