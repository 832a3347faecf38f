// One dish of a site: a TOML file in config/dishes.
#pragma once

#include <filesystem>
#include <string>

#include "simulator/capture/dish_description.hpp"

namespace traygauge {

// Unknown keys are errors: they are typing mistakes. Throws InputError.
DishDescription read_dish_file(const std::filesystem::path& file);

// What read_dish_file reads back as the same dish; the label is no part of it.
std::string compose_dish_file(const DishDescription& dish);

// Replaces the file as a whole or not at all. Throws OutputError.
void write_dish_file(const std::filesystem::path& file, const DishDescription& dish);

}  // namespace traygauge
