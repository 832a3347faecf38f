// Where a station's results go: to the terminal, and to a hub where one is configured.
#pragma once

#include <iosfwd>
#include <memory>
#include <optional>

#include "drivers/clock.hpp"
#include "firmware/config/hub_tables.hpp"
#include "firmware/handover/station_facts.hpp"
#include "firmware/station/scan_printer.hpp"

namespace traygauge {

// Within so long a press for an untouched tray is for the same meal.
Nanoseconds repeat_time(const HandoverConfig& config);

class ResultRoute {
 public:
  // Throws InputError where the folder of waiting results cannot be used.
  ResultRoute(const std::optional<HandoverConfig>& handover, StationFacts facts, ScanPrinter& printer,
              std::ostream& log);
  ResultRoute(const ResultRoute&) = delete;
  ResultRoute& operator=(const ResultRoute&) = delete;
  ~ResultRoute();

  ResultSink& sink() const;

 private:
  struct Handover;
  ScanPrinter& printer_;
  std::unique_ptr<Handover> handover_;  // none without a hub
};

}  // namespace traygauge
