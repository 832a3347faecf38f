#include "drivers/device_status.hpp"

#include <array>
#include <cstddef>

namespace traygauge {
namespace {

struct Text {
  const char* name;
  const char* sentence;
};

// In the order of DeviceCode.
constexpr auto kTexts = std::to_array<Text>({
    {"ok", "Works."},
    {"timed_out", "The device did not answer in time; check its cable and its power."},
    {"ended", "Nothing more will come from this device."},
    {"not_started", "The device has not been started."},
    {"invalid_argument", "The device was asked for something that makes no sense, such as no time to wait."},
    {"buffer_too_small", "The memory for the picture is smaller than the camera's pictures."},
    {"out_of_range", "The angle lies outside the arm's limits."},
    {"not_homed", "The arm does not know where it stands; it has to go home first."},
    {"busy", "The device is still carrying out the last request."},
    {"torn_frame", "The picture arrived damaged; if this comes back, check the camera's cable."},
    {"stale_frame", "The camera delivered an old picture; it may hang."},
    {"unsteady",
     "Pictures in a row differ: the tray moved, or they arrive damaged; hold still, then check the camera's "
     "cable."},
    {"unreadable", "The recorded picture could not be read."},
    {"stalled", "The arm did not reach its place; check that nothing blocks it."},
    {"device_gone", "The device has disappeared; plug it in again."},
    {"io_error", "The device reported an error."},
});

static_assert(kTexts.size() == kDeviceCodeCount);

}  // namespace

const char* name(DeviceCode code) {
  return kTexts[static_cast<std::size_t>(code)].name;
}

const char* sentence(DeviceCode code) {
  return kTexts[static_cast<std::size_t>(code)].sentence;
}

}  // namespace traygauge
