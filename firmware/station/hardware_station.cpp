#include "firmware/station/hardware_station.hpp"

#include <memory>
#include <utility>

#include "firmware/base/exit_status.hpp"
#include "firmware/command/service_manager.hpp"
#include "firmware/config/dish_choice.hpp"
#include "firmware/config/last_good.hpp"
#include "firmware/handover/result_route.hpp"
#include "firmware/station/background_measurer.hpp"
#include "firmware/station/hardware.hpp"
#include "firmware/station/scan_printer.hpp"
#include "firmware/station/site_scene.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
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
  // What a station file names, such as the card's print, may be as bad as the file.
  const auto chosen = read_or_last_good(
      file, command.last_good,
      [&file](const std::filesystem::path& content) {
        StationFile station = read_station_file(file, content);
        require_geometry(station);
        auto scene = std::make_unique<SiteScene>(station, read_station_dishes(file));
        return std::pair(std::move(station), std::move(scene));
      },
      [](const auto& config) { return config.first.on_bad_config; });
  const auto& [station_file, scene] = chosen.config;
  if (!chosen.problem.empty()) log << chosen.problem << std::endl;
  if (command.by_hand && station_file.arm) {
    throw UsageError("--by-hand: " + station_file.file.string() + " has an [arm]; remove one of the two");
  }
  EstimatorMeasurer estimator(*scene, scene->limits(), command.seed);
  BackgroundMeasurer measurer(estimator);
  ScanPrinter printer(out, log, command.json ? ScanPrinter::Format::json : ScanPrinter::Format::text);
  Hardware hardware(station_file);
  const ResultRoute route(station_file.handover,
                          {scene->dish_styles(), chosen.problem, device_names(hardware.devices()),
                           calibration_facts(station_file)},
                          printer, log);
  warn_of_changed_lenses(station_file, hardware, log);
  StationParams params = hardware_params(station_file);
  params.max_scans = command.scans;
  // Beside the buffers of two cameras there is no room for a third picture.
  params.takes_next_tray_early = hardware.devices().second_camera == nullptr;
  if (station_file.handover) params.repeat_within = repeat_time(*station_file.handover);
  Station station(hardware.devices(), measurer, route.sink(), stop, params);
  ServiceManager manager;
  const bool all_worked = station.run([&manager] { manager.note_progress(); }).all_worked();
  manager.note_stopping();
  return all_worked ? kExitMeasured : kExitNotMeasurable;
}

}  // namespace traygauge
