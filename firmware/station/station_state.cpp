#include "firmware/station/station_state.hpp"

#include <algorithm>
#include <array>

namespace traygauge {
namespace {

using enum StationState;

constexpr auto kTransitions = std::to_array<StationTransition>({
    {starting, waiting, "All devices are open, and the arm stands at home."},
    {starting, starting, "A device does not open: it is told once, and tried again ever later, up to 5 s."},
    {starting, finished, "Somebody ends the program, or a simulated device does not come back."},
    {waiting, waiting,
     "No press within half a second; a contact that bounces; a press while no further result can be kept."},
    {waiting, taking_first_view, "A press."},
    {waiting, starting, "The button was held, or fails."},
    {waiting, finished, "Somebody ends the program, or all scans are done."},
    {taking_first_view, awaiting_second_view, "The picture is good; the arm begins to move."},
    {taking_first_view, measuring, "The picture cannot be measured: the result says why."},
    {taking_first_view, waiting, "Six pictures in a row are damaged or unsteady: the result says so."},
    {taking_first_view, starting, "Camera or arm fails: the result says so."},
    {awaiting_second_view, taking_second_view, "The arm stands still, or the button was pressed again."},
    {awaiting_second_view, waiting, "No second press within a minute, or the button was held: cancelled."},
    {awaiting_second_view, starting, "Arm, button or camera fails: the result says so."},
    {taking_second_view, measuring, "The picture was taken."},
    {taking_second_view, waiting, "Six pictures in a row are damaged or unsteady: the result says so."},
    {taking_second_view, starting, "Camera or arm fails: the result says so."},
    {measuring, waiting,
     "The result is handed over, or kept; the lamp shows it. Presses meanwhile for the same tray start "
     "nothing."},
    {measuring, taking_first_view,
     "The button was pressed meanwhile for another tray; or the pictures contradict the arm's angle, and the "
     "scan is taken again, once."},
    {measuring, starting, "The arm fails on its way home; the result stands."},
});

}  // namespace

const char* name(StationState state) {
  static constexpr auto kNames =
      std::to_array<const char*>({"starting", "waiting", "taking_first_view", "awaiting_second_view",
                                  "taking_second_view", "measuring", "finished"});
  static_assert(kNames.size() == kStationStateCount);
  return kNames[static_cast<std::size_t>(state)];
}

std::span<const StationTransition> station_transitions() {
  return kTransitions;
}

bool may_follow(StationState from, StationState to) {
  return std::any_of(kTransitions.begin(), kTransitions.end(), [=](const StationTransition& transition) {
    return transition.from == from && transition.to == to;
  });
}

}  // namespace traygauge
