// What there is under the paths that a station file names: names, sizes, owners, modes and times, never
// contents.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/support/station_values.hpp"

namespace traygauge {

// Where stations and hubs that run by our units keep the last good configuration: beside what they store.
std::vector<std::filesystem::path> last_good_files(const StationValues& station);

// Folders whose disks matter: those of the file, of results that wait and of results that are stored.
std::vector<std::filesystem::path> station_folders(const StationValues& station);

std::string describe_paths(const StationValues& station);

}  // namespace traygauge
