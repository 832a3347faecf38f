#include "firmware/config/station_file.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/adjustment/bundle_problem.hpp"
#include "core/pipeline/measurement.hpp"
#include "drivers/v4l2/device_finder.hpp"
#include "drivers/v4l2/video_modes.hpp"
#include "firmware/base/text.hpp"
#include "firmware/config/lens_table.hpp"
#include "simulator/capture/json_node.hpp"
#include "simulator/capture/toml_file.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxLamps = 32;
constexpr int kMaxControl = 10'000'000;
constexpr double kLeastTurnDeg = 1.0;  // less is no second view

template <std::size_t N>
void expect(const JsonNode& table, const std::string_view (&keys)[N]) {
  expect_keys(table, keys);
}

Nanoseconds milliseconds(const JsonNode& node, double min_ms, double max_ms) {
  return std::chrono::round<Nanoseconds>(
      std::chrono::duration<double, std::milli>(node.number({min_ms, max_ms})));
}

Nanoseconds read_seconds(const JsonNode& node, double min_s, double max_s) {
  return std::chrono::round<Nanoseconds>(std::chrono::duration<double>(node.number({min_s, max_s})));
}

// `value` stays as it is where the key is not given.
void take(const JsonNode& table, const char* key, int min, int max, int& value) {
  if (const auto node = table.find(key)) value = node->integer(min, max);
}
void take(const JsonNode& table, const char* key, NumberRange range, double& value) {
  if (const auto node = table.find(key)) value = node->number(range);
}
void take(const JsonNode& table, const char* key, bool& value) {
  if (const auto node = table.find(key)) value = node->truth();
}
void take_ms(const JsonNode& table, const char* key, double min_ms, double max_ms, Nanoseconds& value) {
  if (const auto node = table.find(key)) value = milliseconds(*node, min_ms, max_ms);
}

std::string read_line_name(const JsonNode& node) {
  GpioPlace place;
  std::string line = node.text();
  if (!parse_gpio_place(line, place)) {
    node.fail("a line's name, or chip and number such as \"gpiochip0/17\"", "see gpioinfo");
  }
  return line;
}

GpioBias read_bias(const JsonNode& node) {
  const std::string bias = node.text();
  if (bias == "as-is") return GpioBias::as_is;
  if (bias == "pull-up") return GpioBias::pull_up;
  if (bias == "pull-down") return GpioBias::pull_down;
  node.fail(R"("pull-up", "pull-down" or "as-is")", "correct the value");
}

ControlWish read_control(const JsonNode& node) {
  if (!node.is_text()) return {ControlWish::Kind::value, node.integer(-kMaxControl, kMaxControl)};
  const std::string text = node.text();
  if (text == "hold") return {ControlWish::Kind::hold, 0};
  if (text == "leave") return {ControlWish::Kind::leave, 0};
  node.fail(R"(a whole number, "hold" or "leave")", "correct the value");
}

V4l2CameraParams read_camera(const JsonNode& table) {
  expect(table, {"device", "width", "height", "format", "frames_per_s", "exposure_us", "gain",
                 "white_balance_k", "focus", "settle_frames", "burst", "may_repeat", "lens_changed_on"});
  V4l2CameraParams camera;
  const JsonNode device = table.member("device");
  camera.device = device.text();
  if (!is_camera_name(camera.device)) {
    device.fail(R"("serial:…", "port:…", "name:…" or the path of a node)", "see traygauge check");
  }
  take(table, "width", kMinPictureSide, kMaxPictureSide, camera.mode.width);
  take(table, "height", kMinPictureSide, kMaxPictureSide, camera.mode.height);
  if (const auto format = table.find("format")) {
    camera.mode.format = format->text();
    if (!is_known_format(camera.mode.format))
      format->fail("one of " + list_known_formats(), "correct the value");
  }
  take(table, "frames_per_s", {0.1, 1000.0}, camera.mode.frames_per_s);
  for (std::size_t i = 0; i < kCameraControlCount; ++i) {
    if (const auto node = table.find(name(static_cast<CameraControl>(i)))) {
      camera.controls[i] = read_control(*node);
    }
  }
  take(table, "settle_frames", 0, 300, camera.settle_frames);
  take(table, "burst", 1, 8, camera.burst);
  take(table, "may_repeat", camera.may_repeat);
  return camera;
}

GpioTriggerParams read_button(const JsonNode& table) {
  expect(table,
         {"line", "active_low", "bias", "debounce_ms", "least_closed_ms", "stuck_after_s", "long_press_s"});
  GpioTriggerParams button;
  button.line.line = read_line_name(table.member("line"));
  take(table, "active_low", button.line.is_active_low);
  if (const auto bias = table.find("bias")) button.line.bias = read_bias(*bias);
  take_ms(table, "debounce_ms", 1.0, 500.0, button.debounce);
  take_ms(table, "least_closed_ms", 0.0, 30.0, button.least_closed);
  if (const auto node = table.find("stuck_after_s")) button.stuck_after = read_seconds(*node, 1.0, 3600.0);
  return button;
}

Nanoseconds read_long_press(const JsonNode& node) {
  const double seconds = node.number({0.0, 10.0});
  if (seconds > 0.0 && seconds < 0.5) node.fail("0, or 0.5 to 10", "a shorter press is an ordinary one");
  return std::chrono::round<Nanoseconds>(std::chrono::duration<double>(seconds));
}

std::uint32_t read_lit(const JsonNode& node, const std::vector<GpioLineParams>& lines) {
  std::uint32_t lit = 0;
  for (const JsonNode& entry : node.elements(0, kMaxLamps)) {
    const std::string line = entry.text();
    const auto found = std::find_if(lines.begin(), lines.end(),
                                    [&line](const GpioLineParams& params) { return params.line == line; });
    if (found == lines.end()) entry.fail("one of lamp.lines", "add it there, or correct its name");
    lit |= 1U << static_cast<unsigned>(found - lines.begin());
  }
  return lit;
}

LampConfig read_lamp(const JsonNode& table) {
  expect(table, {"lines", "active_low", "ready", "hold_still", "busy", "done", "try_again", "move_on",
                 "far_enough", "too_far", "fault"});
  LampConfig lamp;
  bool is_active_low = false;
  take(table, "active_low", is_active_low);
  for (const JsonNode& node : table.member("lines").elements(1, kMaxLamps)) {
    lamp.lines.push_back({read_line_name(node), is_active_low});
  }
  const auto lit = [&lamp](Signal signal) -> std::uint32_t& {
    return lamp.table[static_cast<std::size_t>(signal)];
  };
  for (const Signal signal :
       {Signal::ready, Signal::hold_still, Signal::busy, Signal::done, Signal::try_again, Signal::fault}) {
    lit(signal) = read_lit(table.member(name(signal)), lamp.lines);
  }
  // Where a hand moves the camera; where nothing is said, what tells a person about the same.
  constexpr std::array<std::array<Signal, 2>, 3> kGuidance = {{{Signal::move_on, Signal::hold_still},
                                                               {Signal::far_enough, Signal::ready},
                                                               {Signal::too_far, Signal::try_again}}};
  for (const auto& [signal, otherwise] : kGuidance) {
    const auto node = table.find(name(signal));
    lit(signal) = node ? read_lit(*node, lamp.lines) : lit(otherwise);
  }
  return lamp;
}

GpioLineParams read_output(const JsonNode& node, const std::vector<std::string>& inverted) {
  const std::string line = read_line_name(node);
  return {line, std::find(inverted.begin(), inverted.end(), line) != inverted.end()};
}

StepperConfig read_stepper(const JsonNode& table) {
  std::vector<std::string> inverted;
  if (const auto list = table.find("inverted")) {
    for (const JsonNode& node : list->elements(1, 4)) inverted.push_back(read_line_name(node));
  }
  StepperConfig stepper;
  stepper.step = read_output(table.member("step"), inverted);
  stepper.direction = read_output(table.member("direction"), inverted);
  if (const auto enable = table.find("enable")) stepper.enable = read_output(*enable, inverted);
  stepper.home = read_output(table.member("home"), inverted);
  if (const auto bias = table.find("home_bias")) stepper.home.bias = read_bias(*bias);
  StepperArmParams& motion = stepper.motion;
  motion.steps_per_deg = table.member("steps_per_deg").number({0.1, 10'000.0});
  take(table, "max_deg", {1.0, 360.0}, motion.limits.max_deg);
  take(table, "speed_deg_per_s", {0.1, 1000.0}, motion.speed_deg_per_s);
  take(table, "acceleration_deg_per_s2", {0.1, 10'000.0}, motion.acceleration_deg_per_s2);
  take(table, "homing_speed_deg_per_s", {0.1, 1000.0}, motion.homing_speed_deg_per_s);
  take(table, "home_overlap_deg", {0.1, 20.0}, motion.home_overlap_deg);
  take(table, "home_tolerance_deg", {0.1, 5.0}, motion.home_tolerance_deg);
  take_ms(table, "settling_ms", 0.0, 10'000.0, motion.settling_time);
  return stepper;
}

SerialArmParams read_serial(const JsonNode& table) {
  SerialArmParams serial;
  serial.device = table.member("device").text();
  take(table, "baud", 1, 10'000'000, serial.baud);
  if (!is_serial_speed(serial.baud)) {
    table.member("baud").fail("9600, 19200, 38400, 57600, 115200 or 230400",
                              "set the arm's controller to one of these");
  }
  take_ms(table, "settling_ms", 0.0, 10'000.0, serial.settling_time);
  if (const auto longest = table.find("longest_move_s"))
    serial.longest_move = read_seconds(*longest, 1.0, 600.0);
  return serial;
}

ArmConfig read_arm(const JsonNode& table) {
  const JsonNode kind = table.member("kind");
  const std::string text = kind.text();
  ArmConfig arm;
  if (text == "stepper") {
    expect(table, {"kind", "second_view_deg", "step", "direction", "enable", "home", "home_bias", "inverted",
                   "steps_per_deg", "max_deg", "speed_deg_per_s", "acceleration_deg_per_s2",
                   "homing_speed_deg_per_s", "home_overlap_deg", "home_tolerance_deg", "settling_ms"});
    arm.kind = read_stepper(table);
  } else if (text == "serial") {
    expect(table, {"kind", "second_view_deg", "device", "baud", "settling_ms", "longest_move_s"});
    arm.kind = read_serial(table);
  } else {
    kind.fail(R"("stepper" or "serial")", "leave [arm] out where a hand moves the camera");
  }
  take(table, "second_view_deg", {-90.0, 90.0}, arm.second_view_deg);
  if (const auto* stepper = std::get_if<StepperConfig>(&arm.kind);
      stepper != nullptr && !stepper->motion.limits.contains(arm.second_view_deg)) {
    table.member("second_view_deg").fail("an angle from 0 to max_deg", "correct one of the two");
  }
  return arm;
}

ArmGeometry read_arm_geometry(const JsonNode& table) {
  expect(table, {"commanded_deg", "turn_deg", "shift_mm"});
  ArmGeometry geometry;
  geometry.commanded_deg = table.member("commanded_deg").number({-90.0, 90.0});
  const auto turn = table.member("turn_deg").numbers(3, {-180.0, 180.0});
  const auto shift = table.member("shift_mm").numbers(3, {-5000.0, 5000.0});
  std::copy(turn.begin(), turn.end(), geometry.turn_deg.begin());
  std::copy(shift.begin(), shift.end(), geometry.shift_mm.begin());
  if (geometry.angle_deg() < kLeastTurnDeg) {
    table.member("turn_deg")
        .fail("a turn of " + fixed(kLeastTurnDeg, 0) + " degrees at least",
              "run traygauge calibrate arm again");
  }
  return geometry;
}

CardDescription read_card(const JsonNode& table, const fs::path& folder) {
  expect(table, {"pattern", "width_mm", "height_mm", "thickness_mm"});
  CardDescription card;
  const JsonNode pattern = table.member("pattern");
  card.pattern = {folder / pattern.text(), pattern.key()};
  card.width_mm = table.member("width_mm").number({10.0, 500.0});
  card.height_mm = table.member("height_mm").number({10.0, 500.0});
  card.thickness_mm = table.member("thickness_mm").number({0.0, 10.0});
  return card;
}

void read_trays(const JsonNode& table, const fs::path& folder, StationFile& station) {
  expect(table, {"labels", "dishes", "items"});
  const auto labels = table.find("labels");
  if (labels && labels->is_text()) {
    if (labels->text() != "automatic")
      labels->fail("\"automatic\", or two label pictures, one for each view", "correct the value");
  } else if (labels) {
    const auto list = labels->elements(2, 2);
    station.labels = {InputFile{folder / list[0].text(), list[0].key()},
                      InputFile{folder / list[1].text(), list[1].key()}};
  }
  if (const auto dishes = table.find("dishes")) {
    for (const JsonNode& dish : dishes->elements(1, kMaxPlacedDishes)) station.dishes.push_back(dish.text());
  }
  const auto items = table.find("items");
  if (!items) return;
  station.items = items->integer(1, static_cast<int>(kMaxItems));
  if (station.labels) items->fail("no number beside label pictures, which say it", "remove one of the two");
}

}  // namespace

StationFile read_station_file(const fs::path& file, const fs::path& content) {
  const JsonDocument document = read_toml(content, kMaxStationFileBytes, "a station in TOML");
  const JsonNode root = document.root();
  check_station_version(root);
  expect(root, {"version", "camera", "second_camera", "button", "lamp", "arm", "arm_geometry", "lens",
                "second_lens", "card", "trays", "station", "hub", "fleet", "on_bad_config"});
  const fs::path folder = file.parent_path();
  StationFile station;
  station.file = file;
  station.on_bad_config = read_on_bad_config(root);
  station.camera = read_camera(root.member("camera"));
  station.button = read_button(root.member("button"));
  if (const auto node = root.member("button").find("long_press_s"))
    station.long_press = read_long_press(*node);
  if (const auto lamp = root.find("lamp")) station.lamp = read_lamp(*lamp);
  if (const auto arm = root.find("arm")) station.arm = read_arm(*arm);
  if (const auto geometry = root.find("arm_geometry")) station.arm_geometry = read_arm_geometry(*geometry);
  if (const auto lens = root.find("lens"))
    station.lens = read_lens_table(*lens, root.member("camera"), station.camera, folder);
  if (const auto second = root.find("second_camera")) {
    station.second_camera = read_camera(*second);
    if (station.arm) second->fail("either an arm or a second camera", "remove one of the two");
    if (station.second_camera->device == station.camera.device) {
      second->member("device").fail("another camera than the first", "correct one of the two");
    }
    if (const auto lens = root.find("second_lens"))
      station.second_lens = read_lens_table(*lens, *second, *station.second_camera, folder);
  }
  if (const auto card = root.find("card")) station.card = read_card(*card, folder);
  if (const auto trays = root.find("trays")) read_trays(*trays, folder, station);
  if (const auto handover = root.find("station")) station.handover = read_handover_table(*handover, folder);
  if (const auto hub = root.find("hub")) {
    read_hub_table(*hub, folder);
    station.has_hub = true;
  }
  if (const auto fleet = root.find("fleet")) {
    if (!station.has_hub) fleet->fail("the table [hub] beside this one", "add it, or remove this one");
    read_fleet_table(*fleet, station.handover ? station.handover->name : std::string(), folder);
  }
  return station;
}

}  // namespace traygauge
