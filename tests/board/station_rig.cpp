#include "tests/board/station_rig.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "simulator/capture/picture_file.hpp"
#include "simulator/render/jpeg_writer.hpp"
#include "tests/board/frames.hpp"

namespace traygauge {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

constexpr double kFrames_per_s = 4.0;
constexpr Nanoseconds kPatience = 120s;         // an emulated board is slow
constexpr Nanoseconds kBetweenPresses = 200ms;  // no hand is faster; what is, is a bounce

void write_camera(std::ostream& out, const char* table, const char* name, const PictureSize& size) {
  out << "[" << table << "]\ndevice = \"" << name << "\"\nwidth = " << size.width
      << "\nheight = " << size.height << "\nsettle_frames = 2\nburst = 1\n";
}

void write_lens(std::ostream& out, const char* table, const CameraDescription& camera) {
  out << "[" << table << "]\nfx = " << camera.fx_px << "\nfy = " << camera.fy_px << "\ncx = " << camera.cx_px
      << "\ncy = " << camera.cy_px << "\ndistortion = [";
  for (const double coefficient : camera.distortion) out << coefficient << ", ";
  out << "]\n";
}

void write_dish(const DishDescription& dish, const fs::path& file) {
  fs::create_directories(file.parent_path());
  std::ofstream out(file);
  out.precision(12);
  out << "style = \"dish\"\nouter_size_mm = [" << dish.outer_size_mm[0] << ", " << dish.outer_size_mm[1]
      << "]\nrim_height_mm = " << dish.rim_height_mm << "\nbottom_height_mm = " << dish.bottom_height_mm
      << "\nprofile = [";
  for (const ProfilePoint& point : dish.profile)
    out << "[" << point.inset_mm << ", " << point.height_mm << "], ";
  out << "]\n";
}

// Squeezed sideways: about what the camera would see of the card if it had gone on sideways by 30 degrees.
Picture turned_away(const Picture& seen) {
  constexpr double kSqueeze = 0.7;
  Picture turned(seen.size, seen.format);
  const int channels = bytes_per_pixel(seen.format);
  const double middle_px = (seen.size.width - 1) / 2.0;
  for (int x = 0; x < seen.size.width; ++x) {
    const auto from = static_cast<int>(std::lround(middle_px + (x - middle_px) / kSqueeze));
    if (from < 0 || from >= seen.size.width) continue;
    for (int y = 0; y < seen.size.height; ++y) {
      const std::ptrdiff_t row = y * seen.stride_bytes();
      std::copy_n(seen.pixels.begin() + row + from * channels, channels,
                  turned.pixels.begin() + row + x * channels);
    }
  }
  return turned;
}

UsbCamera::Picture from_beyond(const InputFile& second_view) {
  constexpr int kQuality = 90;
  const fs::path file = fs::temp_directory_path() / "beyond.jpg";
  write_jpeg(file, turned_away(read_picture(second_view)), kQuality);
  return read_frame(file);
}

}  // namespace

StationRig::StationRig(const fs::path& capture, StationMode mode)
    : capture_(read_capture(capture)),
      pictures_{read_frame(capture_.views[0].image.path), read_frame(capture_.views[1].image.path),
                from_beyond(capture_.views[1].image)},
      second_deg_(capture_.views[1].arm_angle_deg.value()),
      board_(make_gpio_sim_bench(std::getenv("TRAYGAUGE_BOARD_GPIO"),
                                 {"TRIGGER", "GREEN", "YELLOW", "RED", "BLUE"})),
      camera_(capture_.views[0].camera.size.width, capture_.views[0].camera.size.height, kFrames_per_s,
              [this] { return picture(seen_from()); }) {
  if (mode == StationMode::arm) arm_.emplace();
  if (mode != StationMode::by_second) return;
  const PictureSize& size = capture_.views[1].camera.size;
  second_camera_.emplace(
      size.width, size.height, kFrames_per_s, [this] { return picture(Place::second_view); }, 1);
}

bool StationRig::plug_in() {
  return camera_.plug_in() && (!second_camera_ || second_camera_->plug_in());
}

UsbCamera::Picture StationRig::picture(Place seen_from) {
  return numbered_frame(pictures_.at(static_cast<std::size_t>(seen_from)), ++number_);
}

Place StationRig::seen_from() {
  return arm_ && arm_->position_deg() > second_deg_ / 2.0 ? Place::second_view : place_.load();
}

void StationRig::press(Nanoseconds held) {
  board_->set_input("TRIGGER", true);
  clock_.sleep_for(held);
  board_->set_input("TRIGGER", false);
  clock_.sleep_for(kBetweenPresses);
}

bool StationRig::shows(const Lamps& lamps) {
  return board_->output("GREEN") == lamps.green && board_->output("YELLOW") == lamps.yellow &&
         board_->output("RED") == lamps.red && board_->output("BLUE") == lamps.blue;
}

bool StationRig::wait_until_shows(const Lamps& lamps) {
  const Instant deadline = clock_.now() + kPatience;
  while (!shows(lamps)) {
    if (clock_.now() > deadline) return false;
    clock_.sleep_for(20ms);
  }
  return true;
}

void StationRig::write_station(const fs::path& file, Outlines outlines) const {
  const auto& views = capture_.views;
  fs::create_directories(file.parent_path());
  std::ofstream out(file);
  out.precision(12);
  write_camera(out, "camera", "serial:T0001", views[0].camera.size);
  write_lens(out, "lens", views[0].camera);
  if (second_camera_) {
    write_camera(out, "second_camera", "serial:T0002", views[1].camera.size);
    write_lens(out, "second_lens", views[1].camera);
  }
  out << "[button]\nline = \"TRIGGER\"\nactive_low = false\nbias = \"as-is\"\n"
      << "[lamp]\nlines = [\"GREEN\", \"YELLOW\", \"RED\", \"BLUE\"]\nready = [\"GREEN\"]\nhold_still = "
         "[\"YELLOW\"]\n"
      << "busy = [\"GREEN\", \"YELLOW\"]\ndone = [\"GREEN\", \"RED\"]\ntry_again = [\"YELLOW\", \"RED\"]\n"
      << "fault = [\"RED\"]\nmove_on = [\"GREEN\", \"YELLOW\", \"RED\"]\nfar_enough = [\"GREEN\", \"BLUE\"]\n"
      << "too_far = [\"BLUE\"]\n";
  if (arm_) {
    out << "[arm]\nkind = \"serial\"\ndevice = \"" << arm_->path() << "\"\nsecond_view_deg = " << second_deg_
        << "\nsettling_ms = 100\n";
  }
  const CardDescription& card = capture_.card;
  out << "[card]\npattern = " << fs::absolute(card.pattern.path) << "\nwidth_mm = " << card.width_mm
      << "\nheight_mm = " << card.height_mm << "\nthickness_mm = " << card.thickness_mm << "\n";
  if (outlines == Outlines::given) {
    out << "[trays]\nlabels = [" << fs::absolute(views[0].labels->path) << ", "
        << fs::absolute(views[1].labels->path) << "]\n";
  }
  write_dish(capture_.dishes.at(0), file.parent_path() / "dishes" / "dish.toml");
}

}  // namespace traygauge
