// What can be said of this machine without opening a device: texts for people.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace traygauge {

// This program, the kernel, the distribution, the machine, the libraries that are loaded.
std::string describe_versions();

// Temperature, under-voltage, memory, how long it has run, and the space of the disks that hold `folders`.
std::string describe_state(const std::vector<std::filesystem::path>& folders);

}  // namespace traygauge
