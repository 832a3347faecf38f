// The folder `config`, which comes with the program: dishes, the network for food, and how plots are drawn.
#pragma once

#include <filesystem>
#include <string>

namespace traygauge {

// The folder with dishes/: `named` when it is not empty, else that which came with the program. Throws
// InputError.
std::filesystem::path find_config_folder(const std::string& named);

// Of `start` and the folders above it, but not the root, the nearest beside which `config` or
// `share/traygauge/config` has the folder `part`: the checkout in which a program was built, or where it was
// installed. Throws InputError, which says what was `expected`, and the advice.
std::filesystem::path find_config_above(const std::filesystem::path& start, const char* part,
                                        const char* expected, const char* advice);

// The file of the network for food: below `named` where it has a folder network/, else that which came with
// the program. Throws InputError.
std::filesystem::path find_network_file(const std::string& named);

// The folder plots/ below `named` where it has one, because a site may change its plots, else that which came
// with the program. Throws InputError.
std::filesystem::path find_plots_folder(const std::string& named);

}  // namespace traygauge
