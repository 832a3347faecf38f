// The folder `config`, which comes with the program: dishes, and how plots are drawn.
#pragma once

#include <filesystem>
#include <string>

namespace traygauge {

// The folder with dishes/: `named` when it is not empty, else that which came with the program. Throws
// InputError.
std::filesystem::path find_config_folder(const std::string& named);

// The folder plots/ below `named` where it has one, because a site may change its plots, else that which came
// with the program. Throws InputError.
std::filesystem::path find_plots_folder(const std::string& named);

}  // namespace traygauge
