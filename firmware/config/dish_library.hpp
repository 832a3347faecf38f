// The dishes that a site owns: one TOML file each, in config/dishes.
#pragma once

#include <filesystem>
#include <vector>

#include "simulator/capture/dish_description.hpp"

namespace traygauge {

// Every dishes/*.toml below `config_folder`, by file name. Unknown keys are errors: they are typing mistakes.
// Throws InputError; also when there is none.
std::vector<DishDescription> read_dish_library(const std::filesystem::path& config_folder);

}  // namespace traygauge
