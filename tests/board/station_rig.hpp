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

// Which lamps burn.
struct Lamps {
  bool green = false;
  bool yellow = false;
  bool red = false;
};
inline constexpr Lamps kReady{true, false, false};
inline constexpr Lamps kFarEnough = kReady;
inline constexpr Lamps kFault{false, false, true};
inline constexpr Lamps kMoveOn{true, true, true};

class StationRig {
 public:
  StationRig(const std::filesystem::path& capture, StationMode mode);

  // The cameras; false when the kernel has no virtual host controller.
  bool plug_in();
  // Describes the rig, with a folder of dishes beside.
  void write_station(const std::filesystem::path& file) const;

  UsbCamera& camera() { return camera_; }
  UsbCamera& second_camera() { return *second_camera_; }
  ArmController& arm() { return *arm_; }
  Clock& clock() { return clock_; }

  // The hand, to the second view or back.
  void move_camera(bool to_second) { is_moved_ = to_second; }
  void press(Nanoseconds held = std::chrono::milliseconds(60));
  bool shows(const Lamps& lamps);
  // False when it takes too long.
  bool wait_until_shows(const Lamps& lamps);

 private:
  UsbCamera::Picture picture(bool of_second_view);
  bool sees_second_view();

  SystemClock clock_;
  Capture capture_;
  std::array<UsbCamera::Picture, 2> pictures_;
  double second_deg_;
  std::optional<ArmController> arm_;
  std::atomic<bool> is_moved_ = false;
  std::atomic<std::uint32_t> number_ = 0;
  std::unique_ptr<GpioBench> board_;
  UsbCamera camera_;
  std::optional<UsbCamera> second_camera_;
};

}  // namespace traygauge
