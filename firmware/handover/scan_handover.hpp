// Hands every result to the hub; what the hub does not take waits on the station's disk.
#pragma once

#include <chrono>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/base/board_state.hpp"
#include "firmware/base/scan_id.hpp"
#include "firmware/base/wall_clock.hpp"
#include "firmware/config/hub_tables.hpp"
#include "firmware/handover/hub_link.hpp"
#include "firmware/handover/kept_results.hpp"
#include "firmware/handover/next_tray.hpp"
#include "firmware/handover/station_facts.hpp"
#include "firmware/station/scan_result.hpp"

namespace traygauge {

struct ScanHandoverParams {
  StationFacts facts;
  PicturePolicy pictures = PicturePolicy::hide;
  // Presses wait while kept results are handed over.
  Milliseconds longest_attention{300};
  // A hub that refuses or hangs is asked again so much later.
  Milliseconds retry_after{2000};
  // A shape has some 200 kB, of which a socket holds half.
  Milliseconds longest_shape{100};
  // The hub calls a station silent that says nothing for longer: see its health.
  Milliseconds heartbeat{2000};
  // The board's temperature changes over minutes.
  Milliseconds board_looked_at_every{10'000};
  std::filesystem::path board_classes = "/sys/class";  // where the kernel tells it
};

// Prints what it hands over. Used by one thread.
class ScanHandover final : public ResultSink {
 public:
  ScanHandover(ResultSink& printer, HubLink& link, KeptResults& kept, std::ostream& log,
               ScanHandoverParams params = {});

  Delivery deliver(const ScanResult& result) override;
  TrayHint next_tray() override { return next_tray_.use(SteadyClock::now()); }
  bool has_room() override;
  void attend() override;
  void report_state(std::string_view state) override;
  void report_fault(const DeviceFailure& failure) override;
  void report_restart() override;
  void report_recovery(std::string_view what) override;

 private:
  using SteadyClock = std::chrono::steady_clock;

  Delivery keep(const std::string& id, const std::string& document);
  bool hand_over(const std::string& id, const std::string& document);
  bool hand_over_kept();
  void hear_next_tray();
  void tell_appearance();
  void look_at_board();
  double queue_stands_s() const;
  void tell_state();
  void log_notices();
  void note_hub(const HubReply& reply);
  void note_disk(const std::string& problem);

  ResultSink& printer_;
  HubLink& link_;
  KeptResults& kept_;
  std::ostream& log_;
  ScanHandoverParams params_;

  NextTray next_tray_;
  std::string state_ = "starting";
  WallTime pressed_at_;
  std::optional<ScanId> last_id_;  // of the last result with a measurement
  std::string picture_;            // of that result, where it may be shown
  std::string shape_;              // of that result; empty once the hub was told
  struct Fault {
    std::string status;   // its DeviceCode's name
    std::string message;  // for people
  };
  std::map<std::string, Fault, std::less<>> faults_;  // by device
  std::string lens_problem_;                          // dirt that the last trays showed; may be empty
  std::string hub_problem_;                           // empty while the hub takes what it is given
  std::string disk_problem_;                          // empty while results can be kept
  bool is_full_ = false;                              // which is what disk_problem_ tells
  SteadyClock::time_point asked_at_;                  // of the last attempt that failed
  bool was_refused_ = false;
  std::optional<SteadyClock::time_point> queue_stands_since_;  // none: nothing waits, or it is being taken
  SteadyClock::time_point told_at_;
  BoardState board_;
  std::optional<SteadyClock::time_point> board_looked_at_;
};

}  // namespace traygauge
