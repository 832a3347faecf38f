// `traygauge station`: the loop from the button to the result.
#pragma once

#include <atomic>
#include <cstdint>
#include <iosfwd>
#include <string>

#include "firmware/config/hub_tables.hpp"
#include "firmware/station/open_captures.hpp"
#include "firmware/station/station.hpp"

namespace traygauge {

class Program;

struct StationCommand {
  std::string devices;      // "hardware:FILE" or "simulator:FOLDER"
  std::string faults;       // a fault script; empty: nothing goes wrong
  std::uint64_t scans = 0;  // 0: every capture once; on hardware without end
  bool repeat = false;      // plays the captures again and again
  bool real_time = false;   // simulated devices take the time that real ones take
  bool json = false;
  bool by_hand = false;  // no arm: a second press takes the second view
  double second_view_deg = StationParams{}.second_view_deg;
  std::uint64_t seed = 0;
  LabelChoice labels;     // of captures
  std::string last_good;  // where the last good station file is kept; empty: nowhere
  HandoverConfig hub;     // of played captures; without a socket there is none
};

// Adds the command; when it is given, parsing fills `command`.
void add_station_command(Program& program, StationCommand& command);

// Runs the loop until its end or until `stop`. Exit status: all scans measured, or some not.
// Throws UsageError, InputError and what `open_captures` throws, before anything is printed.
int run_station(const StationCommand& command, OpenCaptures& open_captures, const std::atomic<bool>& stop,
                std::ostream& out, std::ostream& log);

}  // namespace traygauge
