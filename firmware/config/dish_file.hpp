// The file of a dish (see read_dish_file), written.
#pragma once

#include <filesystem>
#include <string>

#include "simulator/capture/dish_toml.hpp"

namespace traygauge {

// What read_dish_file reads back as the same dish; the label is no part of it.
std::string compose_dish_file(const DishDescription& dish);

// Replaces the file as a whole or not at all. Throws OutputError.
void write_dish_file(const std::filesystem::path& file, const DishDescription& dish);

}  // namespace traygauge
