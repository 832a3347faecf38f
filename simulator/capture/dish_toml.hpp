// One dish of a site: a TOML file in config/dishes.
#pragma once

#include <filesystem>

#include "simulator/capture/dish_description.hpp"

namespace traygauge {

// Unknown keys are errors: they are typing mistakes. Throws InputError.
DishDescription read_dish_file(const std::filesystem::path& file);

}  // namespace traygauge
