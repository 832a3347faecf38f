// The program `traygauge station` on the kernel's devices: USB cameras that show a capture's pictures through
// uvcvideo, a button and lamps on gpio-sim, an arm on a pseudo-terminal. What it reports is compared with
// what `traygauge measure` makes of the same pictures; then things go wrong. Usage: station_cycle PROGRAM
// CAPTURE arm|double|twin, in a guest; see station.sh.
#include <cstdio>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/board/child_program.hpp"
#include "tests/board/measured_volumes.hpp"
#include "tests/board/station_rig.hpp"

namespace {

using namespace traygauge;
using namespace std::chrono_literals;
using nlohmann::json;

constexpr double kMaxOff_ml = 0.01;
constexpr double kMaxResident_mib = 64.0;  // the station's budget

class Cycle {
 public:
  Cycle(StationRig& rig, ChildProgram& station, Volumes expected)
      : rig_(rig), station_(station), expected_(std::move(expected)) {}

  // Presses once the lamp says ready and expects this status; with the right volumes where it is ok.
  // `after_press` is done then.
  void scan(const char* what, const std::string& status, const std::function<void()>& after_press = {}) {
    if (!rig_.wait_until_shows(kReady)) return tell(what, false, "it was not ready");
    const Instant pressed_at = rig_.clock().now();
    rig_.press();
    if (after_press) after_press();
    expect_result(what, status, pressed_at);
  }
  // Of a scan that was pressed for at `pressed_at`.
  void expect_result(const char* what, const std::string& status, Instant pressed_at) {
    std::string line;
    if (!station_.read_line(line)) return tell(what, false, "it ended");
    const json document = json::parse(line);
    const Volumes found = volumes_ml(document);
    const double worst_ml = worst_difference_ml(found, expected_);
    bool is_right = document["status"] == status;
    if (status == "ok") is_right = is_right && found.size() == expected_.size();
    const double took_s = std::chrono::duration<double>(rig_.clock().now() - pressed_at).count();
    std::ostringstream text;
    text << document["status"] << " " << document["message"] << ", " << found.size() << " items, at most "
         << worst_ml << " ml from measure's, " << took_s << " s";
    tell(what, is_right && worst_ml <= kMaxOff_ml, text.str());
    remember(station_.memory());
  }
  // What the lamp says of the hand's way.
  void expect_lamps(const char* what, const Lamps& lamps) {
    const bool is_right = rig_.wait_until_shows(lamps);
    tell(what, is_right, is_right ? "the lamp says so" : "the lamp never says so");
  }
  void expect_little_memory() {
    const double peak_mib = static_cast<double>(memory_.peak_kib) / 1024.0;
    std::ostringstream text;
    text << peak_mib << " MiB resident at most, " << static_cast<double>(memory_.buffers_kib) / 1024.0
         << " of them the kernel's frame buffers";
    tell("the station's memory", peak_mib > 0.0 && peak_mib <= kMaxResident_mib, text.str());
  }
  bool is_good() const { return is_good_; }

 private:
  void tell(const char* what, bool is_right, const std::string& text) {
    std::printf("%s  %s: %s\n", is_right ? "ok  " : "FAIL", what, text.c_str());
    std::fflush(stdout);
    is_good_ = is_good_ && is_right;
  }
  // It may have ended meanwhile.
  void remember(const ChildProgram::Memory& memory) {
    memory_.peak_kib = std::max(memory_.peak_kib, memory.peak_kib);
    memory_.buffers_kib = std::max(memory_.buffers_kib, memory.buffers_kib);
  }

  StationRig& rig_;
  ChildProgram& station_;
  Volumes expected_;
  ChildProgram::Memory memory_;
  bool is_good_ = true;
};

void pull_out(StationRig& rig, UsbCamera& camera) {
  camera.unplug();
  rig.clock().sleep_for(1s);
  camera.plug_in();
}

struct Course {
  StationMode mode;
  Outlines outlines;
  int scans;  // pressed for, of them:
  int unmeasured;
  void (*play)(StationRig& rig, Cycle& cycle);
};

void play_arm(StationRig& rig, Cycle& cycle) {
  cycle.scan("a tray", "ok");
  cycle.scan("half a picture arrives", "ok", [&] { rig.camera().spoil_next(UsbFrameFault::half); });
  cycle.scan("noise arrives", "ok", [&] { rig.camera().spoil_next(UsbFrameFault::junk); });
  cycle.scan("the camera is pulled out", "device_gone", [&] { pull_out(rig, rig.camera()); });
  cycle.scan("the arm stalls", "stalled", [&] {
    rig.clock().sleep_for(100ms);
    rig.arm().stalls = true;
    rig.wait_until_shows(kFault);
    rig.arm().stalls = false;
  });
  cycle.scan("a tray after all that", "ok");
}

void play_hand(StationRig& rig, Cycle& cycle) {
  const auto move_and_press = [&] {
    cycle.expect_lamps("not moved yet", kMoveOn);
    rig.move_camera(Place::beyond);
    cycle.expect_lamps("moved too far", kTooFar);
    rig.move_camera(Place::second_view);
    cycle.expect_lamps("moved far enough", kFarEnough);
    rig.press();
  };
  cycle.scan("a tray", "ok", move_and_press);
  rig.move_camera(Place::first_view);
  cycle.scan("the button is held", "cancelled", [&] {
    cycle.expect_lamps("not moved yet", kMoveOn);
    rig.press(3s);
  });
  cycle.scan("the camera is pulled out on its way", "device_gone", [&] {
    cycle.expect_lamps("not moved yet", kMoveOn);
    pull_out(rig, rig.camera());
  });
  cycle.scan("a tray after all that", "ok", move_and_press);
  rig.move_camera(Place::first_view);
  Instant pressed_at;
  cycle.scan("another tray lies there while this one is measured", "ok", [&] {
    move_and_press();
    cycle.expect_lamps("both views taken", kBusy);
    rig.move_camera(Place::beyond);
    pressed_at = rig.clock().now();
    rig.press();
  });
  cycle.expect_lamps("the other tray's first view taken", kMoveOn);
  rig.press(3s);
  cycle.expect_result("the other tray's scan", "cancelled", pressed_at);
}

void play_two_cameras(StationRig& rig, Cycle& cycle) {
  cycle.scan("a tray", "ok");
  cycle.scan("noise arrives from the second camera", "ok",
             [&] { rig.second_camera().spoil_next(UsbFrameFault::junk); });
  cycle.scan("the second camera is pulled out", "device_gone", [&] { pull_out(rig, rig.second_camera()); });
  cycle.scan("a tray after all that", "ok");
}

const std::map<std::string, Course> kCourses = {
    {"arm", {StationMode::arm, Outlines::given, 6, 2, play_arm}},
    {"double", {StationMode::by_hand, Outlines::found, 6, 3, play_hand}},
    {"twin", {StationMode::by_second, Outlines::found, 4, 1, play_two_cameras}},
};

int run(const std::string& program, const std::string& folder, const Course& course) {
  StationRig rig(folder, course.mode);
  if (!rig.plug_in()) return 2;
  const std::string file = "/tmp/site/station.toml";
  rig.write_station(file, course.outlines);
  const Volumes expected = measure_ml(program, folder, course.outlines);
  std::printf("measure: %zu items\n", expected.size());
  ChildProgram check(program + " check " + file);
  for (std::string line; check.read_line(line);) std::printf("check: %s\n", line.c_str());
  const bool check_is_good = check.finish() == 0 && !expected.empty();

  ChildProgram station(program + " station --seed 0 --json --scans " + std::to_string(course.scans) +
                       " --devices hardware:" + file);
  Cycle cycle(rig, station, expected);
  course.play(rig, cycle);
  cycle.expect_little_memory();
  const bool ended = station.finish() == (course.unmeasured > 0 ? 1 : 0);
  std::printf("%s  the station ended as it should\n", ended ? "ok  " : "FAIL");
  return cycle.is_good() && check_is_good && ended ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  const auto course = count == 4 ? kCourses.find(arguments[3]) : kCourses.end();
  if (course == kCourses.end()) {
    std::fprintf(stderr, "usage: station_cycle PROGRAM CAPTURE arm|double|twin\n");
    return 2;
  }
  try {
    return run(arguments[1], arguments[2], course->second);
  } catch (const std::exception& error) {
    std::printf("FAIL  %s\n", error.what());
    return 1;
  }
}
