#include "firmware/config/dish_choice.hpp"

#include "firmware/config/dish_library.hpp"
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

}  // namespace traygauge
