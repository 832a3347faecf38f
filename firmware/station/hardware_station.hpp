// `traygauge station` on the devices of a station file.
#pragma once

#include <atomic>
#include <filesystem>
#include <iosfwd>

#include "firmware/station/station_command.hpp"

namespace traygauge {

// Runs until `stop`, or until so many scans as the command says. Throws UsageError and InputError before any
// device is opened.
int run_hardware_station(const StationCommand& command, const std::filesystem::path& file,
                         const std::atomic<bool>& stop, std::ostream& out, std::ostream& log);

}  // namespace traygauge
