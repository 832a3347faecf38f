// What became of a press of the button, and who wants to know.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/image_view/image_view.hpp"
#include "drivers/clock.hpp"
#include "drivers/device_status.hpp"
#include "firmware/base/board_state.hpp"
#include "firmware/base/scan_id.hpp"
#include "firmware/base/wall_clock.hpp"
#include "firmware/station/lens_watch.hpp"
#include "firmware/station/tray_hint.hpp"

namespace traygauge {

struct Measurement;

enum class ScanOutcome : std::uint8_t {
  measured,        // all items, or some of them
  not_measurable,  // the measurement's status says why
  device_failed,   // a device's status says why
  cancelled,       // the second press did not come, or the button was held
};

// A device that did not do what it was asked for. The texts are valid during the call they are passed to.
struct DeviceFailure {
  std::string_view device;
  DeviceStatus status;
  std::string_view detail;
};

struct ScanResult {
  std::uint64_t scan = 0;  // counts presses since the start, from 1
  std::string_view tray;
  ScanOutcome outcome = ScanOutcome::measured;
  const Measurement* measurement = nullptr;  // set when measured or not_measurable
  FrameView picture;                         // the first view, with a measurement; valid during the call
  std::optional<LensSpot> lens_spot;         // dirt that the last trays showed
  DeviceFailure failure;                     // set when device_failed
  bool was_held = false;                     // the button, which cancelled the scan
  bool repeats_last = false;                 // pressed again soon after the last result, for the same tray
  Nanoseconds duration{0};                   // from the press to this result, by the station's clock
};

// What a result is called where it is stored.
struct ScanIdentity {
  ScanId id;
  WallTime taken_at;
  std::optional<ScanId> supersedes;  // the same tray's result, which is not booked any more
  BoardState board;                  // of the board that measured it
};

// Where a result got.
enum class Delivery : std::uint8_t {
  done,    // where it belongs
  kept,    // safe here, on its way there
  failed,  // nowhere: the lamp then asks for somebody
};

// Takes results. Used by one thread.
class ResultSink {
 public:
  ResultSink() = default;
  ResultSink(const ResultSink&) = delete;
  ResultSink& operator=(const ResultSink&) = delete;
  virtual ~ResultSink() = default;

  // Only what is done may be shown as done.
  [[nodiscard]] virtual Delivery deliver(const ScanResult& result) = 0;
  // What is known of the tray for which the button was pressed; holds until its result was measured.
  virtual TrayHint next_tray() { return {}; }
  // False when no further result could be kept: then nothing is measured. The sink tells why, once.
  [[nodiscard]] virtual bool has_room() { return true; }
  // Between two looks at the button, every half second at least: may take some tens of milliseconds.
  virtual void attend() {}
  // The station's state has changed; its name.
  virtual void report_state(std::string_view /*state*/) {}
  // A device failed outside a scan; told once, until it works again.
  virtual void report_fault(const DeviceFailure& failure) = 0;
  // The button was held: the devices are opened anew.
  virtual void report_restart() = 0;
  // `what` failed and works again.
  virtual void report_recovery(std::string_view what) = 0;
};

}  // namespace traygauge
