// A board that systemd booted with no camera, under the units that are shipped: then a camera is plugged in,
// a tray is measured, and its result is in the hub. Usage: boot_unplugged CAPTURE STATION_FILE, in a guest as
// a service that the units wait for; see systemd.sh.
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "firmware/command/service_manager.hpp"
#include "tests/board/child_program.hpp"
#include "tests/board/measured_volumes.hpp"
#include "tests/board/service_unit.hpp"
#include "tests/board/station_rig.hpp"

namespace {

using namespace traygauge;
using namespace std::chrono_literals;
using nlohmann::json;

constexpr Nanoseconds kPatience = 60s;  // an emulated board is slow
constexpr double kMaxOff_ml = 0.01;
constexpr int kHubPort = 8080;
constexpr const char* kProgram = "/usr/bin/traygauge";

// The hub on this board, where the units expect it.
void write_hub(const std::string& station_file) {
  std::ofstream out(station_file, std::ios::app);
  out << "[station]\nname = \"kitchen\"\nsocket = \"/run/traygauge/hub\"\n"
      << "folder = \"/var/lib/traygauge/station\"\nrepeat_within_s = 0\n"
      << "[hub]\nstore = \"/var/lib/traygauge/hub/results.db\"\nkeep_free_mib = 0\nlisten = [\"127.0.0.1:"
      << kHubPort << "\"]\n";
}

// Discarded where the hub has no answer.
json ask_hub(const std::string& path) {
  ChildProgram ask("wget -q -O - http://127.0.0.1:" + std::to_string(kHubPort) + "/api/v1/scans/" + path +
                   " 2>/dev/null");
  std::string text;
  ask.read_line(text);
  return json::parse(text, nullptr, false);
}

// A file for the first device of a kind, outside of /dev, of which the hub has one of its own; empty when the
// kernel does not know the kind.
std::string make_device(const std::string& kind, int minor) {
  std::ifstream kinds("/proc/devices");
  for (std::string line; std::getline(kinds, line);) {
    std::istringstream words(line);
    unsigned major = 0;
    std::string name;
    if (!(words >> major >> name) || name != kind) continue;
    const std::string file = std::filesystem::current_path() / ("device-" + kind);
    const bool is_made =
        ::mknod(file.c_str(), S_IFCHR | 0600, makedev(major, static_cast<unsigned>(minor))) == 0;
    return is_made || errno == EEXIST ? file : "";
  }
  return "";
}

std::string outcome(int error) {
  return error < 0 ? "not tried" : error == 0 ? "works" : std::strerror(error);
}

class UnpluggedBoot {
 public:
  UnpluggedBoot(StationRig& rig, Volumes expected) : rig_(rig), expected_(std::move(expected)) {}

  void expect_units_without_camera() {
    const bool has_camera = std::filesystem::exists("/dev/video0");
    tell("nothing is plugged in", !has_camera, has_camera ? "there is a camera" : "no /dev/video0");
    for (const ServiceUnit* const unit : {&hub_, &station_}) {
      wait_until([unit] { return unit->property("ActiveState") == "active"; });
      const std::string state = unit->property("ActiveState");
      tell("a unit runs", state == "active", unit->property("Id") + " is " + state);
    }
    const bool has_said = wait_until([this] { return station_.has_logged("serial:T0001: "); });
    tell("the station says that the camera is absent", has_said && rig_.wait_until_shows(kFault),
         has_said ? "and the lamp says fault" : "not in its log");
    const std::string fed_at = fed_us();
    const bool is_fed = wait_until([&] { return fed_us() != fed_at; });
    tell("the station feeds the watchdog", is_fed, "at " + fed_at + ", then at " + fed_us() + " us");
  }

  // False when the station does not get the camera.
  bool plug_in(const char* what) {
    const Instant plugged_at = rig_.clock().now();
    if (!rig_.plug_in()) return tell(what, false, "no virtual host controller");
    const bool is_ready = wait_until([this] { return rig_.shows(kReady); });
    std::ostringstream text;
    text << (is_ready ? "ready after " : "not ready after ") << seconds_since(plugged_at) << " s";
    return tell(what, is_ready, text.str());
  }

  // A hand moves the camera between two presses; the result is what the hub has stored.
  bool scan(const char* what) {
    const std::string last_id = latest_id();
    rig_.press();
    if (!rig_.wait_until_shows(kMoveOn)) return tell(what, false, "the first view was not taken");
    rig_.move_camera(Place::second_view);
    if (!rig_.wait_until_shows(kFarEnough)) return tell(what, false, "the hand was not led");
    rig_.press();
    const Instant pressed_at = rig_.clock().now();
    const bool is_done = rig_.wait_until_shows(kDone);
    const double took_s = seconds_since(pressed_at);
    rig_.move_camera(Place::first_view);
    if (!is_done) return tell(what, false, "the lamp never says done");
    if (!wait_until([&] { return latest_id() != last_id; }))
      return tell(what, false, "the hub has no result");
    const json document = ask_hub(latest_id() + "/document");
    const Volumes found = volumes_ml(document);
    const double worst_ml = worst_difference_ml(found, expected_);
    std::ostringstream text;
    text << "the hub has " << document["id"] << ": " << document["status"] << ", " << found.size()
         << " items, at most " << worst_ml << " ml from measure's, " << took_s << " s after the second press";
    return tell(what,
                document["status"] == "ok" && found.size() == expected_.size() && worst_ml <= kMaxOff_ml,
                text.str());
  }

  void pull_out() {
    rig_.wait_until_shows(kReady);
    rig_.camera().unplug();
    rig_.press();
    const bool is_told = rig_.wait_until_shows(kFault);
    tell("the camera is pulled out", is_told,
         is_told ? "a press, and the lamp says fault" : "the lamp never says so");
  }

  void expect_confined() {
    struct Kind {
      const char* name;
      int minor;
      bool is_stations;
    };
    constexpr auto kKinds = std::to_array<Kind>({{"video4linux", 0, true},
                                                 {"media", 0, true},
                                                 {"gpiochip", 0, true},
                                                 {"ttyUSB", 0, true},
                                                 {"ttyACM", 0, true},
                                                 {"ttyS", 64, true},
                                                 {"usb_device", 0, false},
                                                 {"mem", 11, false}});
    for (const Kind& kind : kKinds) {
      const std::string file = make_device(kind.name, kind.minor);
      const int station = file.empty() ? -1 : station_.open_device(file);
      const int hub = file.empty() ? -1 : hub_.open_device(file);
      const bool is_let_through = station >= 0 && station != EPERM;
      tell("devices", is_let_through == kind.is_stations && hub == EPERM,
           std::string(kind.name) + ": station: " + outcome(station) + "; hub: " + outcome(hub));
    }
    const int seen = hub_.open_device("/dev/gpiochip0");
    tell("the hub sees no device", seen == ENOENT, "/dev/gpiochip0: " + outcome(seen));
    const int station = station_.connect_here(kHubPort);
    const int hub = hub_.connect_here(kHubPort);
    tell("network", station > 0 && hub == 0, "station: " + outcome(station) + "; hub: " + outcome(hub));
  }

  void expect_no_restart() {
    for (const ServiceUnit* const unit : {&hub_, &station_}) {
      const std::string restarts = unit->property("NRestarts");
      tell("a unit ran on", restarts == "0", unit->property("Id") + " was restarted " + restarts + " times");
    }
  }
  bool is_good() const { return is_good_; }

 private:
  bool tell(const char* what, bool is_right, const std::string& text) {
    std::printf("%s  %s: %s\n", is_right ? "ok  " : "FAIL", what, text.c_str());
    std::fflush(stdout);
    is_good_ = is_good_ && is_right;
    return is_right;
  }
  bool wait_until(const std::function<bool()>& is_so) {
    const Instant deadline = rig_.clock().now() + kPatience;
    while (!is_so()) {
      if (rig_.clock().now() > deadline) return false;
      rig_.clock().sleep_for(200ms);
    }
    return true;
  }
  double seconds_since(Instant then) {
    return std::chrono::duration<double>(rig_.clock().now() - then).count();
  }
  std::string fed_us() const { return station_.property("WatchdogTimestampMonotonic"); }
  // Empty where nothing is stored yet.
  static std::string latest_id() {
    const json scan = ask_hub("latest");
    return scan.is_object() ? scan.value("id", "") : "";
  }

  StationRig& rig_;
  Volumes expected_;
  ServiceUnit station_{"traygauge-station.service"};
  ServiceUnit hub_{"traygauge-hub.service"};
  bool is_good_ = true;
};

int run(const std::string& capture, const std::string& station_file) {
  StationRig rig(capture, StationMode::by_hand);
  rig.write_station(station_file, Outlines::given);
  write_hub(station_file);
  UnpluggedBoot boot(rig, measure_ml(kProgram, capture, Outlines::given));
  ServiceManager().note_progress();
  boot.expect_units_without_camera();
  if (boot.plug_in("a camera is plugged in")) {
    boot.scan("a tray");
    boot.pull_out();
    boot.plug_in("the camera is plugged in again");
    boot.scan("a tray after that");
  }
  boot.expect_confined();
  boot.expect_no_restart();
  return boot.is_good() ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) {
    std::fprintf(stderr, "usage: boot_unplugged CAPTURE STATION_FILE\n");
    return 2;
  }
  try {
    return run(arguments[1], arguments[2]);
  } catch (const std::exception& error) {
    std::printf("FAIL  %s\n", error.what());
    return 1;
  }
}
