#include "firmware/config/dish_choice.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "core/labels/label_regions.hpp"
#include "firmware/config/config_folder.hpp"
#include "firmware/config/dish_library.hpp"
#include "firmware/config/station_file.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {

bool has_one_dish(const Capture& capture) {
  return capture.dishes.empty() || (capture.dishes.size() == 1 && capture.dishes.front().label == 1);
}

void require_one_dish(const Capture& capture) {
  if (has_one_dish(capture)) return;
  const std::size_t count = capture.dishes.size();
  throw InputError({capture.file, "dishes"}, "one dish, of label 1",
                   count == 1 ? "label " + std::to_string(capture.dishes.front().label)
                              : std::to_string(count) + " dishes",
                   "profile paper measures one dish");
}

std::vector<DishDescription> choose_dishes(const Capture& capture, const std::string& config) {
  return capture.dishes.empty() ? read_dish_library(find_config_folder(config)) : capture.dishes;
}

std::vector<DishDescription> read_station_dishes(const std::filesystem::path& station_file) {
  const std::filesystem::path folder = std::filesystem::absolute(station_file).parent_path();
  std::error_code ignored;
  const bool has_own = std::filesystem::is_directory(folder / "dishes", ignored);
  return read_dish_library(find_config_folder(has_own ? folder.string() : ""));
}

Expected<std::vector<DishDescription>> find_dishes(const std::vector<std::string>& styles,
                                                   const std::vector<DishDescription>& library) {
  std::vector<DishDescription> dishes;
  for (const std::string& style : styles) {
    const auto found = std::find_if(library.begin(), library.end(),
                                    [&style](const DishDescription& dish) { return dish.style == style; });
    if (found == library.end()) return Failure{style};
    dishes.push_back(*found);
    const std::size_t place = dishes.size() - 1;
    dishes.back().label = place == 0 ? kDishLabel : kFirstFurtherDishLabel - 1 + static_cast<int>(place);
  }
  return dishes;
}

std::vector<DishDescription> choose_tray_dishes(const StationFile& station,
                                                const std::vector<DishDescription>& library) {
  if (station.dishes.empty()) return library;
  Expected<std::vector<DishDescription>> dishes = find_dishes(station.dishes, library);
  if (dishes.ok()) return std::move(*dishes);
  std::string styles;
  for (const DishDescription& dish : library) styles += (styles.empty() ? "" : ", ") + dish.style;
  const auto unknown = std::find(station.dishes.begin(), station.dishes.end(), dishes.failure());
  throw InputError({station.file, "trays.dishes[" + std::to_string(unknown - station.dishes.begin()) + "]"},
                   "one of " + styles, printable(dishes.failure()),
                   "correct it, or describe the dish in dishes/");
}

}  // namespace traygauge
