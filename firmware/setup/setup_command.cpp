#include "firmware/setup/setup_command.hpp"

#include <algorithm>
#include <array>
#include <ostream>
#include <string_view>

#include "firmware/base/exit_status.hpp"
#include "firmware/command/program.hpp"
#include "firmware/setup/setup_steps.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

constexpr const char* kInstalledFile = "/etc/traygauge/station.toml";

struct SetupStep {
  std::string_view name;
  std::string_view title;
  bool (*run)(SetupSite& site);
};

constexpr std::array<SetupStep, 9> kSteps = {{
    {"camera", "The camera", set_up_camera},
    {"button", "Button and lamp", set_up_button},
    {"card", "The reference card", set_up_card},
    {"lens", "The lens", set_up_lens},
    {"view", "The card in view", set_up_view},
    {"arm", "The second view", set_up_arm},
    {"dishes", "The dishes", set_up_dishes},
    {"hub", "Where results go", set_up_hub},
    {"tray", "The first tray", measure_first_tray},
}};

std::string step_names() {
  std::string names;
  for (const SetupStep& step : kSteps) names.append(names.empty() ? "" : ", ").append(step.name);
  return names;
}

std::string how_to_start(const std::string& station) {
  const std::string file = printable(station);
  const std::string start =
      station == kInstalledFile
          ? "`systemctl enable --now traygauge-hub traygauge-station` starts it, now and at every boot."
          : "`traygauge hub --config " + file + "` and `traygauge station --devices hardware:" + file +
                "` start it.";
  return start + " `traygauge verify plan` begins the acceptance test.";
}

bool is_step(const std::string& name) {
  return std::ranges::any_of(kSteps, [&name](const SetupStep& step) { return step.name == name; });
}

}  // namespace

void add_setup_command(Program& program, SetupOptions& options) {
  Command command = program.add_command(
      "setup", "Set up a station step by step: camera, card, lens, arm, dishes, hub, first tray");
  command.add_option("STATION", options.station, "The station file, see config/station.toml; it is written")
      .required();
  command.add_option("--step", options.step, "One step alone: " + step_names());
}

int run_setup(const SetupOptions& options, const SetupTools& tools, std::istream& in, std::ostream& out) {
  if (!options.step.empty() && !is_step(options.step))
    throw UsageError("--step: expected one of " + step_names() + ", found " + printable(options.step));
  const std::atomic<bool> never_stops = false;
  Dialogue dialogue(in, out);
  SetupSite site{dialogue, options.station, tools, never_stops};
  static_cast<void>(site.read());
  dialogue.say(
      "What is asked in [] is taken at Enter. Ctrl-C ends; what was set up until then stays, and this "
      "command goes on from there.\nA station that runs has its devices to itself: end it first (systemctl "
      "stop "
      "traygauge-station).");
  std::string left_out;
  std::size_t number = 0;
  for (const SetupStep& step : kSteps) {
    ++number;
    if (!options.step.empty() && step.name != options.step) continue;
    dialogue.say("\n" + std::to_string(number) + " of " + std::to_string(kSteps.size()) + ": " +
                 std::string(step.title));
    try {
      if (!step.run(site)) left_out.append(left_out.empty() ? "" : ", ").append(step.name);
    } catch (const DialogueEnded&) {
      dialogue.say("Ended at step " + std::string(step.name) + ".");
      return kExitNotMeasurable;
    }
  }
  if (!left_out.empty()) {
    dialogue.say("\nLeft out: " + left_out + ". `traygauge setup " + printable(options.station) +
                 "` goes on with them.");
    return kExitNotMeasurable;
  }
  if (options.step.empty()) dialogue.say("\nThe station is set up. " + how_to_start(options.station));
  return kExitMeasured;
}

}  // namespace traygauge
