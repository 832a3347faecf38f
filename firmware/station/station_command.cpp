#include "firmware/station/station_command.hpp"

#include <limits>
#include <ostream>
#include <string_view>

#include "firmware/base/exit_status.hpp"
#include "firmware/base/scan_id.hpp"
#include "firmware/command/program.hpp"
#include "firmware/command/service_manager.hpp"
#include "firmware/handover/result_route.hpp"
#include "firmware/measure/measure_choices.hpp"
#include "firmware/station/hardware_station.hpp"
#include "firmware/station/played_scene.hpp"
#include "firmware/station/scan_printer.hpp"
#include "simulator/capture/input_error.hpp"
#include "simulator/devices/capture_folders.hpp"
#include "simulator/devices/fault_file.hpp"
#include "simulator/devices/simulated_arm.hpp"
#include "simulator/devices/simulated_camera.hpp"
#include "simulator/devices/simulated_clock.hpp"
#include "simulator/devices/simulated_indicator.hpp"
#include "simulator/devices/simulated_trigger.hpp"

namespace traygauge {
namespace {

constexpr std::string_view kSimulatorPrefix = "simulator:";
constexpr std::string_view kHardwarePrefix = "hardware:";
// Retries of a device that does not come back, about ten minutes: a script may switch it off for ever.
constexpr int kMaxRetries = 120;

std::uint64_t scan_count(const StationCommand& command, const CaptureSource& captures) {
  // By hand each scan has two presses, whose count has to fit.
  if (command.repeat) return std::numeric_limits<std::uint64_t>::max() / 2;
  return command.scans > 0 ? command.scans : captures.capture_count();
}

std::optional<HandoverConfig> handover_of(const StationCommand& command) {
  const HandoverConfig& hub = command.hub;
  if (hub.socket.empty() && hub.folder.empty()) return std::nullopt;
  if (hub.socket.empty() || hub.folder.empty())
    throw UsageError(
        "--hub, --keep: expected both: the hub's socket, and a folder where results wait for it");
  if (!is_station_name(hub.name))
    throw UsageError("--name: expected 1 to 32 of a-z, 0-9 and '-', found " + printable(hub.name));
  return hub;
}

int play(const StationCommand& command, const FaultPlan& faults, MeasurableCaptures& captures,
         const std::atomic<bool>& stop, std::ostream& out, std::ostream& log) {
  SimulatedClock clock;
  if (command.real_time) clock.run_in_real_time();
  TrayPlayer player(captures, command.by_hand ? CameraMover::hand : CameraMover::arm);
  SimulatedArm arm(clock, &player);
  SimulatedCamera camera(clock, player, command.by_hand ? nullptr : &arm);
  SimulatedIndicator lamp(clock);
  const std::uint64_t scans = scan_count(command, captures);
  SimulatedTrigger trigger(clock, lamp, command.by_hand ? 2 * scans : scans);
  trigger.before_press([&player] { player.handle_press(); });
  lamp.on_signal([&player](Signal signal) { player.handle_signal(signal); });
  faults.apply(SimulatedDevice::camera, camera.faults());
  faults.apply(SimulatedDevice::button, trigger.faults());
  faults.apply(SimulatedDevice::arm, arm.faults());
  faults.apply(SimulatedDevice::lamp, lamp.faults());
  faults.apply(SimulatedDevice::clock, clock.faults());

  PlayedScene scene(captures, player);
  EstimatorMeasurer measurer(scene, captures.limits(), command.seed);
  ScanPrinter printer(out, log, command.json ? ScanPrinter::Format::json : ScanPrinter::Format::text);
  const StationDevices devices{camera, trigger, command.by_hand ? nullptr : &arm, lamp, clock};
  const ResultRoute route(handover_of(command), {{}, {}, device_names(devices), {}}, printer, log);
  StationParams params;
  if (!command.hub.socket.empty()) params.repeat_within = repeat_time(command.hub);
  params.second_view_deg = command.second_view_deg;
  params.max_scans = scans;
  params.max_retries = kMaxRetries;
  if (!command.by_hand && !arm.limits().contains(params.second_view_deg)) {
    throw UsageError("--second-view: expected " + std::to_string(arm.limits().min_deg) + " to " +
                     std::to_string(arm.limits().max_deg) + " degrees, where the arm can go");
  }
  Station station(devices, measurer, route.sink(), stop, params);
  ServiceManager manager;
  const StationTotals& totals = station.run([&manager] { manager.note_progress(); });
  const bool is_complete = totals.scans >= scans || stop;
  if (!is_complete) {
    log << "Ended after " << totals.scans << " of " << scans
        << " scans: " << (totals.gave_up ? "a device did not come back." : "no press came through any more.")
        << std::endl;
  }
  return totals.all_worked() && is_complete ? kExitMeasured : kExitNotMeasurable;
}

}  // namespace

void add_station_command(Program& program, StationCommand& command) {
  Command station = program.add_command("station", "Wait for the button, measure the tray, report; again");
  station
      .add_option(
          "--devices", command.devices,
          "hardware:FILE opens the devices of a station file (config/station.toml); simulator:FOLDER plays "
          "a capture, or a folder of captures by name")
      .required();
  station.add_option("--faults", command.faults,
                     "A script of what goes wrong with the simulated devices; see simulator/README.md");
  const CommandOption scans =
      station.add_option("--scans", command.scans, "End after so many scans").positive();
  station
      .add_action(
          "--once", [&command] { command.scans = 1; }, "The same as --scans 1")
      .excludes(scans);
  station
      .add_action(
          "--repeat", [&command] { command.repeat = true; },
          "Play the captures again and again, until Ctrl-C")
      .excludes(scans);
  station.add_flag("--real-time", command.real_time,
                   "Simulated devices take the time that real ones take, and do not jump ahead");
  station.add_flag("--json", command.json, "One JSON document a line for each scan");
  station.add_flag("--by-hand", command.by_hand,
                   "Without an arm: move the camera and press again for the second view");
  station
      .add_option("--second-view", command.second_view_deg,
                  "Where the simulated arm goes, degrees from home; a real one's is in its station file")
      .show_default();
  station.add_option(
      "--labels", command.labels.source,
      "Where played captures are outlined: given (label pictures) or auto (found in the pictures); default: "
      "given where a capture has label pictures. A real station's are in its station file");
  add_items_option(station, command.labels.items);
  station.add_option("--hub", command.hub.socket,
                     "Hand results to the hub that listens at this socket; a real station's is in its file");
  station.add_option("--keep", command.hub.folder, "The folder where results wait for the hub");
  station.add_action(
      "--show-pictures", [&command] { command.hub.pictures = PicturePolicy::show; },
      "Let the hub show the trays' photographs, from its memory; a real station's are in its file");
  station.add_option("--name", command.hub.name, "What the station is called in the hub").show_default();
  station.add_option("--last-good", command.last_good,
                     "Where a copy of the station file is kept, which counts where a later one is bad "
                     "(on_bad_config in the file)");
  station.add_option("--seed", command.seed, "Seed of the random samples").show_default();
}

int run_station(const StationCommand& command, OpenCaptures& open_captures, const std::atomic<bool>& stop,
                std::ostream& out, std::ostream& log) {
  if (command.devices.starts_with(kHardwarePrefix)) {
    return run_hardware_station(command, command.devices.substr(kHardwarePrefix.size()), stop, out, log);
  }
  if (!command.devices.starts_with(kSimulatorPrefix)) {
    throw UsageError("--devices: expected hardware:FILE or simulator:FOLDER, found " +
                     printable(command.devices));
  }
  const std::filesystem::path folder = command.devices.substr(kSimulatorPrefix.size());
  const auto folders = find_capture_folders(folder);
  if (folders.empty()) {
    throw InputError({folder, ""}, "capture.json here, or captures in the folders below", "neither",
                     "name a capture, or a folder of captures");
  }
  if (!command.last_good.empty())
    throw UsageError("--last-good: for a station file; played captures have none");
  const FaultPlan faults = command.faults.empty() ? FaultPlan() : read_fault_file(command.faults);
  if (command.by_hand && !faults.of(SimulatedDevice::arm).empty()) {
    throw UsageError("--faults: the script has faults of the arm, and --by-hand plays none; remove one");
  }
  const auto captures = open_captures(folders, command.labels);
  return play(command, faults, *captures, stop, out, log);
}

}  // namespace traygauge
