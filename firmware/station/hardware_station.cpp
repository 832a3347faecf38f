#include "firmware/station/hardware_station.hpp"

#include "firmware/base/exit_status.hpp"
#include "firmware/command/service_manager.hpp"
#include "firmware/config/config_folder.hpp"
#include "firmware/config/dish_library.hpp"
#include "firmware/handover/result_route.hpp"
#include "firmware/station/hardware.hpp"
#include "firmware/station/scan_printer.hpp"
#include "firmware/station/site_scene.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

// Those beside the station file, or where it has none, the usual ones.
std::vector<DishDescription> read_dishes(const std::filesystem::path& file) {
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  const bool has_own = std::filesystem::is_directory(folder / "dishes");
  return read_dish_library(find_config_folder(has_own ? folder.string() : ""));
}

}  // namespace

int run_hardware_station(const StationCommand& command, const std::filesystem::path& file,
                         const std::atomic<bool>& stop, std::ostream& out, std::ostream& log) {
  if (!command.faults.empty()) throw UsageError("--faults: only simulated devices fail as a script says");
  if (command.repeat || command.real_time)
    throw UsageError("--repeat, --real-time: for played captures; real devices take their own time");
  if (!command.hub.socket.empty()) {
    throw UsageError("--hub: for played captures; a station's hub is in " + file.string() +
                     ", under [station]");
  }
  if (!command.labels.source.empty() || command.labels.items > 0) {
    throw UsageError("--labels, --items: for played captures; a station's are in " + file.string() +
                     ", under [trays]");
  }
  const StationFile station_file = read_station_file(file);
  if (command.by_hand && station_file.arm) {
    throw UsageError("--by-hand: " + station_file.file.string() + " has an [arm]; remove one of the two");
  }
  require_geometry(station_file);
  SiteScene scene(station_file, read_dishes(file));
  EstimatorMeasurer measurer(scene, scene.limits(), command.seed);
  ScanPrinter printer(out, log, command.json ? ScanPrinter::Format::json : ScanPrinter::Format::text);
  const ResultRoute route(station_file.handover, scene.dish_styles(), printer, log);
  Hardware hardware(station_file);
  warn_of_changed_lenses(station_file, hardware, log);
  StationParams params = hardware_params(station_file);
  params.max_scans = command.scans;
  if (station_file.handover) params.repeat_within = repeat_time(*station_file.handover);
  Station station(hardware.devices(), measurer, route.sink(), stop, params);
  ServiceManager manager;
  const bool all_worked = station.run([&manager] { manager.note_progress(); }).all_worked();
  manager.note_stopping();
  return all_worked ? kExitMeasured : kExitNotMeasurable;
}

}  // namespace traygauge
