// A picture for each press, for calibrating: neither lens nor card need be known.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <iosfwd>

#include "drivers/camera.hpp"
#include "drivers/clock.hpp"
#include "drivers/indicator.hpp"
#include "drivers/trigger.hpp"

namespace traygauge {

struct PictureRecording {
  std::filesystem::path out;  // made where it is not there; pictures are 0001.png, 0002.png, …
  std::uint64_t count = 0;    // then it ends; 0: until `stop`
};

// True when it ended as asked; else `log` says which device failed. Throws OutputError.
bool record_pictures(Camera& camera, Trigger& trigger, Indicator& lamp, const PictureRecording& recording,
                     const std::atomic<bool>& stop, std::ostream& out, std::ostream& log);

}  // namespace traygauge
