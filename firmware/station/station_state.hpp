// What a station does, and what may follow: the table that the loop keeps to.
#pragma once

#include <cstdint>
#include <span>

namespace traygauge {

enum class StationState : std::uint8_t {
  starting,  // opens what is not open; after a failure again and again
  waiting,   // for a press
  taking_first_view,
  awaiting_second_view,  // the arm moves, or the hand
  taking_second_view,
  measuring,  // and handing over; the lamp shows what became of it
  finished,
};
inline constexpr std::size_t kStationStateCount = static_cast<std::size_t>(StationState::finished) + 1;
const char* name(StationState state);

struct StationTransition {
  StationState from;
  StationState to;
  const char* when;  // for people
};

// Every transition that there is; a state may also follow itself where it says so.
std::span<const StationTransition> station_transitions();
bool may_follow(StationState from, StationState to);

}  // namespace traygauge
