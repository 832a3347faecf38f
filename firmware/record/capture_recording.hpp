// Captures recorded at the button.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <iosfwd>

#include "firmware/config/station_file.hpp"
#include "firmware/station/station.hpp"

namespace traygauge {

struct CaptureRecording {
  std::filesystem::path out;  // a folder below for each capture; made where it is not there
  std::uint64_t count = 0;    // then it ends; 0: until `stop`
  int max_retries = 0;        // of a device that fails, then it ends; 0: never
};

// A capture for each press, with a line to `out`. True when all were saved; else `log` says what failed. The
// station has lens and card. Throws InputError, OutputError.
bool record_captures(const StationFile& station, const StationDevices& devices,
                     const CaptureRecording& recording, const std::atomic<bool>& stop, std::ostream& out,
                     std::ostream& log);

}  // namespace traygauge
