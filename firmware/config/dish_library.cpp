#include "firmware/config/dish_library.hpp"

#include <algorithm>
#include <system_error>

#include "firmware/config/dish_file.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {

std::vector<DishDescription> read_dish_library(const std::filesystem::path& config_folder) {
  const std::filesystem::path folder = config_folder / "dishes";
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().extension() == ".toml") files.push_back(entry->path());
  }
  if (error) throw InputError({folder, ""}, "a folder with dishes", error.message(), "check the path");
  if (files.empty())
    throw InputError({folder, ""}, "a *.toml for every dish", "none", "describe at least one");
  std::sort(files.begin(), files.end());
  std::vector<DishDescription> dishes;
  dishes.reserve(files.size());
  for (const std::filesystem::path& file : files) dishes.push_back(read_dish_file(file));
  return dishes;
}

}  // namespace traygauge
