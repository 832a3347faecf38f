// The program `traygauge station` on the kernel's devices: a USB camera that shows a capture's pictures
// through uvcvideo, a button and lamps on gpio-sim, an arm on a pseudo-terminal. What it reports is compared
// with what `traygauge measure` makes of the same pictures; then things go wrong. Usage: station_cycle
// PROGRAM CAPTURE, in a guest; see station.sh.
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "drivers/clock.hpp"
#include "simulator/capture/capture.hpp"
#include "tests/board/frames.hpp"
#include "tests/board/usb_camera.hpp"
#include "tests/drivers/gpio_bench.hpp"
#include "tests/drivers/serial/arm_controller.hpp"

namespace {

using namespace traygauge;
using namespace std::chrono_literals;
using nlohmann::json;
namespace fs = std::filesystem;

constexpr double kFrames_per_s = 4.0;
constexpr Nanoseconds kPatience = 120s;  // an emulated board is slow

// A program whose lines are read.
class Program {
 public:
  explicit Program(const std::string& command) : stream_(::popen(command.c_str(), "r")) {}
  ~Program() { finish(); }
  bool read_line(std::string& line) {
    line.clear();
    for (int letter = std::fgetc(stream_); letter != EOF; letter = std::fgetc(stream_)) {
      if (letter == '\n') return true;
      line += static_cast<char>(letter);
    }
    return false;
  }
  int finish() {
    if (stream_ == nullptr) return status_;
    status_ = WEXITSTATUS(::pclose(stream_));
    stream_ = nullptr;
    return status_;
  }

 private:
  std::FILE* stream_;
  int status_ = 0;
};

struct Rig {
  explicit Rig(const fs::path& folder)
      : capture(read_capture(folder)),
        pictures{read_frame(capture.views[0].image.path), read_frame(capture.views[1].image.path)},
        second_deg(capture.views[1].arm_angle_deg.value()) {}

  std::vector<std::uint8_t> next_frame() {
    const bool is_second = arm.position_deg() > second_deg / 2.0;
    return numbered_frame(pictures[is_second ? 1 : 0], ++number);
  }
  bool shows(bool green, bool yellow, bool red) {
    return board->output("GREEN") == green && board->output("YELLOW") == yellow &&
           board->output("RED") == red;
  }
  bool wait_until_ready() {
    const Instant deadline = clock.now() + kPatience;
    while (!shows(true, false, false)) {
      if (clock.now() > deadline) return false;
      clock.sleep_for(50ms);
    }
    return true;
  }
  void press() {
    board->set_input("TRIGGER", true);
    clock.sleep_for(60ms);
    board->set_input("TRIGGER", false);
  }

  SystemClock clock;
  Capture capture;
  std::array<std::vector<std::uint8_t>, 2> pictures;
  double second_deg;
  std::uint32_t number = 0;
  ArmController arm;
  std::unique_ptr<GpioBench> board =
      make_gpio_sim_bench(std::getenv("TRAYGAUGE_BOARD_GPIO"), {"TRIGGER", "GREEN", "YELLOW", "RED"});
  UsbCamera camera{capture.views[0].camera.size.width, capture.views[0].camera.size.height, kFrames_per_s,
                   [this] { return next_frame(); }};
};

void write_station(Rig& rig, const fs::path& file) {
  const CameraDescription& camera = rig.capture.views[0].camera;
  const CardDescription& card = rig.capture.card;
  std::ofstream out(file);
  out.precision(12);
  out << "[camera]\ndevice = \"serial:T0001\"\nwidth = " << camera.size.width
      << "\nheight = " << camera.size.height << "\nsettle_frames = 2\nburst = 1\n"
      << "[button]\nline = \"TRIGGER\"\nactive_low = false\nbias = \"as-is\"\n"
      << "[lamp]\nlines = [\"GREEN\", \"YELLOW\", \"RED\"]\nready = [\"GREEN\"]\nhold_still = [\"YELLOW\"]\n"
      << "busy = [\"GREEN\", \"YELLOW\"]\ndone = [\"GREEN\", \"RED\"]\ntry_again = [\"YELLOW\", \"RED\"]\n"
      << "fault = [\"RED\"]\n"
      << "[arm]\nkind = \"serial\"\ndevice = \"" << rig.arm.path()
      << "\"\nsecond_view_deg = " << rig.second_deg << "\nsettling_ms = 100\n[lens]\nfx = " << camera.fx_px
      << "\nfy = " << camera.fy_px << "\ncx = " << camera.cx_px << "\ncy = " << camera.cy_px
      << "\ndistortion = [";
  for (const double coefficient : camera.distortion) out << coefficient << ", ";
  out << "]\n[card]\npattern = " << fs::absolute(card.pattern.path) << "\nwidth_mm = " << card.width_mm
      << "\nheight_mm = " << card.height_mm << "\nthickness_mm = " << card.thickness_mm
      << "\n[trays]\nlabels = [" << fs::absolute(rig.capture.views[0].labels->path) << ", "
      << fs::absolute(rig.capture.views[1].labels->path) << "]\n";
  const DishDescription& dish = rig.capture.dishes.at(0);
  fs::create_directories(file.parent_path() / "dishes");
  std::ofstream dishes(file.parent_path() / "dishes" / "dish.toml");
  dishes.precision(12);
  dishes << "style = \"dish\"\nouter_size_mm = [" << dish.outer_size_mm[0] << ", " << dish.outer_size_mm[1]
         << "]\nrim_height_mm = " << dish.rim_height_mm << "\nbottom_height_mm = " << dish.bottom_height_mm
         << "\nprofile = [";
  for (const ProfilePoint& point : dish.profile)
    dishes << "[" << point.inset_mm << ", " << point.height_mm << "], ";
  dishes << "]\n";
}

// Label to volume.
std::map<int, double> volumes(const json& document) {
  std::map<int, double> volumes;
  for (const json& item : document["items"]) {
    if (!item["volume_ml"].is_null()) volumes[item["label"]] = item["volume_ml"];
  }
  return volumes;
}

class Cycle {
 public:
  Cycle(Rig& rig, Program& station, std::map<int, double> expected)
      : rig_(rig), station_(station), expected_(std::move(expected)) {}

  // Presses once the lamp says ready and expects this status; with the right volumes where it is ok.
  // `after_press` is done then.
  void scan(const char* what, const std::string& status, const std::function<void()>& after_press = {}) {
    std::string line;
    const bool is_ready = rig_.wait_until_ready();
    const Instant pressed_at = rig_.clock.now();
    if (is_ready) rig_.press();
    if (after_press) after_press();
    if (!is_ready || !station_.read_line(line)) return tell(what, false, "it was not ready, or ended");
    const json document = json::parse(line);
    const auto found = volumes(document);
    double worst_ml = 0.0;
    bool is_right = document["status"] == status;
    if (status == "ok") is_right = is_right && found.size() == expected_.size();
    for (const auto& [label, volume_ml] : found) {
      const auto known = expected_.find(label);
      worst_ml = std::max(worst_ml, known == expected_.end() ? 1e9 : std::abs(known->second - volume_ml));
    }
    const double took_s = std::chrono::duration<double>(rig_.clock.now() - pressed_at).count();
    std::ostringstream text;
    text << document["status"] << " " << document["message"] << ", " << found.size() << " items, at most "
         << worst_ml << " ml from measure's, " << took_s << " s";
    tell(what, is_right && worst_ml <= 0.01, text.str());
  }
  bool is_good() const { return is_good_; }

 private:
  void tell(const char* what, bool is_right, const std::string& text) {
    std::printf("%s  %s: %s\n", is_right ? "ok  " : "FAIL", what, text.c_str());
    std::fflush(stdout);
    is_good_ = is_good_ && is_right;
  }
  Rig& rig_;
  Program& station_;
  std::map<int, double> expected_;
  bool is_good_ = true;
};

json measure(const std::string& program, const std::string& capture) {
  Program run(program + " measure " + capture + " --labels given --seed 0 --json");
  std::string text;
  run.read_line(text);
  return json::parse(text);
}

int run(const std::string& program, const std::string& folder) {
  Rig rig(folder);
  if (!rig.camera.plug_in()) return 2;
  const fs::path file = "/tmp/site/station.toml";
  fs::create_directories(file.parent_path());
  write_station(rig, file);
  const auto expected = volumes(measure(program, folder));
  std::printf("measure: %zu items\n", expected.size());
  Program check(program + " check " + file.string());
  for (std::string line; check.read_line(line);) std::printf("check: %s\n", line.c_str());
  const bool check_is_good = check.finish() == 0 && !expected.empty();

  Program station(program + " station --seed 0 --json --scans 6 --devices hardware:" + file.string());
  Cycle cycle(rig, station, expected);
  cycle.scan("a tray", "ok");
  cycle.scan("half a picture arrives", "ok", [&] { rig.camera.spoil_next(UsbFrameFault::half); });
  cycle.scan("noise arrives", "ok", [&] { rig.camera.spoil_next(UsbFrameFault::junk); });
  cycle.scan("the camera is pulled out", "device_gone", [&] {
    rig.camera.unplug();
    rig.clock.sleep_for(1s);
    rig.camera.plug_in();
  });
  cycle.scan("the arm stalls", "stalled", [&] {
    rig.clock.sleep_for(300ms);
    rig.arm.stalls = true;
    while (!rig.shows(false, false, true)) rig.clock.sleep_for(20ms);
    rig.arm.stalls = false;
  });
  cycle.scan("a tray after all that", "ok");
  const bool ended = station.finish() == 1;  // two of the six were not measured
  std::printf("%s  the station ended as it should\n", ended ? "ok  " : "FAIL");
  return cycle.is_good() && check_is_good && ended ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return 2;
  try {
    return run(arguments[1], arguments[2]);
  } catch (const std::exception& error) {
    std::printf("FAIL  %s\n", error.what());
    return 1;
  }
}
