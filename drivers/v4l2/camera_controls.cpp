#include "drivers/v4l2/camera_controls.hpp"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>

namespace traygauge {
namespace {

// How the kernel names a control. `unit`: how much of the configuration's number is a step of the kernel's.
struct Value {
  std::uint32_t id;
  double unit;
};
constexpr double kLines = 0.0;  // the sensor's lines, whose time depends on its mode
struct Automatic {
  std::uint32_t id;
  int off;
  std::array<int, 2> on;  // what the camera knows of them, the better one first
};
struct Description {
  const char* name;
  Automatic automatic;
  std::array<Value, 2> values;  // USB cameras have the first, sensors on the board the second
};

constexpr std::array<Description, kCameraControlCount> kDescriptions = {{
    {"exposure_us",
     {V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL, {V4L2_EXPOSURE_AUTO, V4L2_EXPOSURE_APERTURE_PRIORITY}},
     {{{V4L2_CID_EXPOSURE_ABSOLUTE, 100}, {V4L2_CID_EXPOSURE, kLines}}}},
    {"gain", {V4L2_CID_AUTOGAIN, 0, {1, 1}}, {{{V4L2_CID_GAIN, 1}, {V4L2_CID_ANALOGUE_GAIN, 1}}}},
    {"white_balance_k",
     {V4L2_CID_AUTO_WHITE_BALANCE, 0, {1, 1}},
     {{{V4L2_CID_WHITE_BALANCE_TEMPERATURE, 1}, {V4L2_CID_WHITE_BALANCE_TEMPERATURE, 1}}}},
    {"focus",
     {V4L2_CID_FOCUS_AUTO, 0, {1, 1}},
     {{{V4L2_CID_FOCUS_ABSOLUTE, 1}, {V4L2_CID_FOCUS_ABSOLUTE, 1}}}},
}};

const Description& description(CameraControl control) {
  return kDescriptions[static_cast<std::size_t>(control)];
}

std::optional<v4l2_queryctrl> find_control(VideoDevice& device, std::uint32_t id) {
  v4l2_queryctrl query{};
  query.id = id;
  if (device.request(VIDIOC_QUERYCTRL, &query) != 0) return std::nullopt;
  if ((query.flags & V4L2_CTRL_FLAG_DISABLED) != 0) return std::nullopt;
  return query;
}

bool has_value(VideoDevice& device, CameraControl control) {
  const auto& values = description(control).values;
  return std::any_of(values.begin(), values.end(),
                     [&device](const Value& value) { return find_control(device, value.id).has_value(); });
}

int times_unit(int value, double unit) {
  return static_cast<int>(std::lround(value * unit));
}

std::string in_unit(int value, double unit) {
  return unit == 0.0 ? std::to_string(value) + " of its own" : std::to_string(times_unit(value, unit));
}

int read_control(VideoDevice& device, std::uint32_t id, int& value) {
  v4l2_control control{id, 0};
  const int error = device.request(VIDIOC_G_CTRL, &control);
  value = control.value;
  return error;
}

// Nothing where the camera has none of this name.
std::optional<std::int64_t> read_long_control(VideoDevice& device, std::uint32_t id) {
  v4l2_ext_control control{};
  control.id = id;
  v4l2_ext_controls controls{};
  controls.which = V4L2_CTRL_WHICH_CUR_VAL;
  controls.count = 1;
  controls.controls = &control;
  if (device.request(VIDIOC_G_EXT_CTRLS, &controls) != 0) return std::nullopt;
  return static_cast<std::int64_t>(control.value64);
}

// How long the sensor takes for a line: its pixels and the pause behind them. 0 where the camera does not
// say.
double line_us(VideoDevice& device, int width_px) {
  const auto rate_per_s = read_long_control(device, V4L2_CID_PIXEL_RATE);
  int pause_px = 0;
  if (!rate_per_s || *rate_per_s <= 0 || read_control(device, V4L2_CID_HBLANK, pause_px) != 0) return 0.0;
  return 1e6 * (width_px + pause_px) / static_cast<double>(*rate_per_s);
}

int write_control(VideoDevice& device, std::uint32_t id, int value) {
  v4l2_control control{id, value};
  return device.request(VIDIOC_S_CTRL, &control);
}

}  // namespace

const char* name(CameraControl control) {
  return description(control).name;
}

DeviceStatus CameraControls::fail(CameraControl control, DeviceStatus status, const std::string& what) {
  problem_ = std::string(name(control)) + ": " + what;
  return status;
}

DeviceStatus CameraControls::switch_automatic(CameraControl control, bool on) {
  const Automatic& automatic = description(control).automatic;
  const auto query = find_control(device_, automatic.id);
  if (!query) return DeviceCode::ok;
  const std::span<const int> choices = on ? std::span<const int>(automatic.on) : std::span(&automatic.off, 1);
  int error = EINVAL;
  for (const int choice : choices) {
    error = write_control(device_, automatic.id, choice);
    int found = 0;
    if (error == 0) error = read_control(device_, automatic.id, found);
    if (error == 0 && found == choice) {
      is_automatic_ = is_automatic_ || on;
      return DeviceCode::ok;
    }
    if (error != 0 && status_of_errno(error).code() == DeviceCode::device_gone) break;
  }
  if (on && error == EINVAL) return DeviceCode::ok;  // it has only the manual setting
  const DeviceStatus status = error == 0 || error == EINVAL || error == ERANGE
                                  ? DeviceStatus(DeviceCode::unsupported)
                                  : status_of_errno(error);
  return fail(control, status,
              "the camera does not let its automatic be switched " + std::string(on ? "on" : "off") +
                  "; set it to \"leave\" if it may vary between the views");
}

DeviceStatus CameraControls::set_value(CameraControl control, int value) {
  for (const Value& known : description(control).values) {
    const auto query = find_control(device_, known.id);
    if (!query) continue;
    const double unit = known.unit == kLines ? line_us_ : known.unit;
    if (unit == 0.0) {
      return fail(control, DeviceCode::unsupported,
                  "the camera counts lines and does not say how long one takes; set it with v4l2-ctl before "
                  "the station starts, and write \"hold\" here");
    }
    const int steps = static_cast<int>(value / unit);
    if (steps < query->minimum || steps > query->maximum) {
      return fail(control, DeviceCode::unsupported,
                  std::to_string(value) + " is asked for; the camera has " + in_unit(query->minimum, unit) +
                      " to " + in_unit(query->maximum, unit));
    }
    if (const int error = write_control(device_, known.id, steps); error != 0) {
      return fail(control, status_of_errno(error), std::to_string(value) + " could not be set");
    }
    int found = 0;
    if (const int error = read_control(device_, known.id, found); error != 0) {
      return fail(control, status_of_errno(error), "it cannot be read back");
    }
    if (std::abs(found - steps) > std::max(0, query->step - 1)) {
      return fail(control, DeviceCode::unsupported,
                  std::to_string(value) + " was set, the camera says " + in_unit(found, unit));
    }
    held_[static_cast<std::size_t>(control)] = {known.id, found, unit};
    return DeviceCode::ok;
  }
  return fail(control, DeviceCode::unsupported,
              "the camera has no such control; remove the key from the configuration");
}

// Automatics first: while one is on, its value cannot be set.
DeviceStatus CameraControls::prepare(const ControlWishes& wishes, int width_px) {
  held_ = {};
  line_us_ = line_us(device_, width_px);
  is_automatic_ = false;
  for (std::size_t i = 0; i < kCameraControlCount; ++i) {
    const auto control = static_cast<CameraControl>(i);
    if (wishes[i].kind == ControlWish::Kind::leave) continue;
    const bool holds = wishes[i].kind == ControlWish::Kind::hold;
    // What every camera has; where this node cannot hold it, something else moves it.
    if (holds && control == CameraControl::exposure && !has_value(device_, control)) {
      return fail(control, DeviceCode::unsupported,
                  "the camera's node has no control that could hold it. A sensor on the board has its own on "
                  "another node: set exposure and gain there (v4l2-ctl --list-devices), and write \"leave\" "
                  "here");
    }
    DeviceStatus status = switch_automatic(control, holds);
    if (status.ok() && !holds) status = set_value(control, wishes[i].value);
    if (!status.ok()) return status;
  }
  return DeviceCode::ok;
}

DeviceStatus CameraControls::release(const ControlWishes& wishes) {
  is_automatic_ = false;
  DeviceStatus status;
  for (std::size_t i = 0; status.ok() && i < kCameraControlCount; ++i) {
    const auto control = static_cast<CameraControl>(i);
    const bool is_held = wishes[i].kind == ControlWish::Kind::hold && control != CameraControl::focus;
    if (is_held) status = switch_automatic(control, true);
  }
  return status;
}

// Read while the automatics are on, all before the first is switched off: exposure's takes gain along. Some
// cameras go back to the last value that was set by hand, so what was found is written.
DeviceStatus CameraControls::lock(const ControlWishes& wishes) {
  DeviceStatus status = find_settled(wishes);
  for (std::size_t i = 0; status.ok() && i < kCameraControlCount; ++i) {
    if (wishes[i].kind == ControlWish::Kind::hold)
      status = switch_automatic(static_cast<CameraControl>(i), false);
  }
  for (std::size_t i = 0; status.ok() && i < kCameraControlCount; ++i) {
    if (wishes[i].kind == ControlWish::Kind::hold && held_[i].id != 0)
      status = hold(static_cast<CameraControl>(i));
  }
  is_automatic_ = is_automatic_ && !status.ok();
  return status.ok() ? verify() : status;
}

DeviceStatus CameraControls::find_settled(const ControlWishes& wishes) {
  for (std::size_t i = 0; i < kCameraControlCount; ++i) {
    if (wishes[i].kind != ControlWish::Kind::hold) continue;
    const auto control = static_cast<CameraControl>(i);
    for (const Value& known : description(control).values) {
      if (!find_control(device_, known.id)) continue;
      int found = 0;
      if (const int error = read_control(device_, known.id, found); error != 0) {
        return fail(control, status_of_errno(error), "it cannot be read");
      }
      held_[i] = {known.id, found, known.unit == kLines ? line_us_ : known.unit};
      break;
    }
  }
  return DeviceCode::ok;
}

DeviceStatus CameraControls::hold(CameraControl control) {
  Held& held = held_[static_cast<std::size_t>(control)];
  const auto query = find_control(device_, held.id);
  if (!query || (query->flags & V4L2_CTRL_FLAG_READ_ONLY) != 0) return DeviceCode::ok;
  const int settled = std::clamp(held.value, query->minimum, query->maximum);
  if (const int error = write_control(device_, held.id, settled); error != 0) {
    return fail(control, status_of_errno(error),
                "it settled at " + in_unit(settled, held.unit) + " and cannot be held there");
  }
  if (const int error = read_control(device_, held.id, held.value); error != 0) {
    return fail(control, status_of_errno(error), "it cannot be read back");
  }
  if (std::abs(held.value - settled) <= std::max(0, query->step - 1)) return DeviceCode::ok;
  return fail(control, DeviceCode::unsupported,
              "it settled at " + in_unit(settled, held.unit) + ", held the camera says " +
                  in_unit(held.value, held.unit));
}

DeviceStatus CameraControls::verify() {
  for (std::size_t i = 0; i < kCameraControlCount; ++i) {
    const Held& held = held_[i];
    int found = 0;
    if (held.id == 0) continue;
    if (const int error = read_control(device_, held.id, found); error != 0) {
      return fail(static_cast<CameraControl>(i), status_of_errno(error), "it cannot be read");
    }
    if (found != held.value) {
      return fail(static_cast<CameraControl>(i), DeviceCode::unsupported,
                  "it stood at " + in_unit(held.value, held.unit) + " and went to " +
                      in_unit(found, held.unit) + " by itself");
    }
  }
  return DeviceCode::ok;
}

std::optional<int> CameraControls::held(CameraControl control) const {
  const Held& held = held_[static_cast<std::size_t>(control)];
  return held.id != 0 && held.unit != 0.0 ? std::optional(times_unit(held.value, held.unit)) : std::nullopt;
}

std::string CameraControls::describe() const {
  std::string text;
  for (std::size_t i = 0; i < kCameraControlCount; ++i) {
    if (held_[i].id == 0) continue;
    text += (text.empty() ? "" : ", ") + std::string(kDescriptions[i].name) + " " +
            in_unit(held_[i].value, held_[i].unit);
  }
  return text.empty() ? "the camera has nothing to hold" : text;
}

}  // namespace traygauge
