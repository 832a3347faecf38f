// What a station stands on in a guest: USB cameras that show a capture's pictures, a button and lamps on
// gpio-sim, an arm on a pseudo-terminal; and the station file that describes them.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "drivers/clock.hpp"
#include "simulator/capture/capture.hpp"
#include "tests/board/usb_camera.hpp"
#include "tests/drivers/gpio_bench.hpp"
#include "tests/drivers/serial/arm_controller.hpp"

namespace traygauge {

// How the second view is taken.
enum class StationMode : std::uint8_t {
  arm,        // by an arm that moves the camera
  by_hand,    // by a hand that does, and a second press
  by_second,  // by a second camera
};

// Where the station has card, dish and food from.
enum class Outlines : std::uint8_t {
  given,  // the capture's label pictures
  found,  // the station finds them
};

// Which lamps burn.
struct Lamps {
  bool green = false;
  bool yellow = false;
  bool red = false;
  bool blue = false;
};
inline constexpr Lamps kReady{.green = true};
inline constexpr Lamps kFault{.red = true};
inline constexpr Lamps kBusy{.green = true, .yellow = true};
inline constexpr Lamps kDone{.green = true, .red = true};
inline constexpr Lamps kMoveOn{.green = true, .yellow = true, .red = true};
inline constexpr Lamps kFarEnough{.green = true, .blue = true};
inline constexpr Lamps kTooFar{.blue = true};

// Where the hand may put the camera.
enum class Place : std::uint8_t { first_view, second_view, beyond };

class StationRig {
 public:
  StationRig(const std::filesystem::path& capture, StationMode mode);

  // The cameras; false when the kernel has no virtual host controller.
  bool plug_in();
  // Describes the rig, with a folder of dishes beside.
  void write_station(const std::filesystem::path& file, Outlines outlines) const;

  UsbCamera& camera() { return camera_; }
  UsbCamera& second_camera() { return *second_camera_; }
  ArmController& arm() { return *arm_; }
  Clock& clock() { return clock_; }

  void move_camera(Place place) { place_ = place; }
  void press(Nanoseconds held = std::chrono::milliseconds(60));
  bool shows(const Lamps& lamps);
  // False when it takes too long.
  bool wait_until_shows(const Lamps& lamps);

 private:
  UsbCamera::Picture picture(Place seen_from);
  Place seen_from();

  SystemClock clock_;
  Capture capture_;
  std::array<UsbCamera::Picture, 3> pictures_;  // by place
  double second_deg_;
  std::optional<ArmController> arm_;
  std::atomic<Place> place_ = Place::first_view;
  std::atomic<std::uint32_t> number_ = 0;
  std::unique_ptr<GpioBench> board_;
  UsbCamera camera_;
  std::optional<UsbCamera> second_camera_;
};

}  // namespace traygauge
