#include "drivers/device_status.hpp"

#include <array>
#include <cerrno>
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
    {"invalid_argument", "The device cannot be used as it is asked for; correct the configuration."},
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
    {"stuck", "The button stays pressed; see that nothing lies on it."},
    {"unsupported", "The device cannot do what the configuration asks for."},
    {"no_permission",
     "This user may not open the device; add the user to its group and log in again: video for cameras, "
     "dialout "
     "for serial lines, gpio for lines of the board once config/60-traygauge-gpio.rules is installed."},
    {"in_use", "Another program uses the device; end that program."},
    {"device_gone",
     "The device has disappeared, or is not there under this name; plug it in, or correct its name."},
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

DeviceStatus status_of_errno(int error_number) {
  switch (error_number) {
    case 0:
      return DeviceCode::ok;
    case ENODEV:
    case ENXIO:
    case ENOENT:
    case ENOTCONN:
    case ESHUTDOWN:
      return {DeviceCode::device_gone, error_number};
    case EACCES:
    case EPERM:
      return {DeviceCode::no_permission, error_number};
    case EBUSY:
      return {DeviceCode::in_use, error_number};
    case ETIMEDOUT:
      return {DeviceCode::timed_out, error_number};
    default:
      return {DeviceCode::io_error, error_number};
  }
}

}  // namespace traygauge
