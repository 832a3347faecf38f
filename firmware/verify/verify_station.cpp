#include "firmware/verify/verify_station.hpp"

#include <ostream>
#include <string>
#include <vector>

#include "firmware/base/exit_status.hpp"
#include "firmware/config/dish_choice.hpp"
#include "firmware/station/hardware.hpp"
#include "firmware/station/scan_printer.hpp"
#include "firmware/station/site_scene.hpp"
#include "firmware/verify/verify_command.hpp"
#include "firmware/verify/verify_conditions.hpp"
#include "simulator/capture/output_file.hpp"

namespace traygauge {
namespace {

DishDescription find_station_dish(const std::vector<DishDescription>& library, const std::string& style) {
  const auto found = find_dishes({style}, library);
  if (found.ok()) return found->front();
  std::string list;
  for (const DishDescription& dish : library) list += (list.empty() ? "" : ", ") + dish.style;
  throw UsageError("the plan's dish: the station has no dish " + printable(style) + "; it knows " + list);
}

}  // namespace

Delivery VerifySink::deliver(const ScanResult& result) {
  if (result.measurement == nullptr) {
    const Delivery told = printer_.deliver(result);
    guide_.prompt();
    return told;
  }
  try {
    guide_.take(scan_of(*result.measurement));
  } catch (const OutputError& error) {
    problem_ = error.what();
    ended_ = true;
    return Delivery::failed;
  }
  guide_.prompt();
  if (guide_.next() == nullptr) ended_ = true;
  return Delivery::done;
}

TrayHint VerifySink::next_tray() {
  const VerifyStep* const step = guide_.next();
  return {step == nullptr ? "" : step->id, 1, {dish_}};
}

void VerifySink::attend() {
  if (stop_) ended_ = true;
}

VerifyRecord run_verify_station(const VerifyRunOptions& options, const VerifyPlan& plan,
                                const std::atomic<bool>& stop, std::ostream& out, std::ostream& log) {
  const StationFile station_file = read_station_file(options.station);
  require_geometry(station_file);
  const std::vector<DishDescription> library = read_station_dishes(station_file.file);
  VerifyHeader header = begin_verify_header(options, plan);
  add_station_conditions(station_file, find_station_dish(library, plan.dish), header);
  SiteScene scene(station_file, library);
  VerifyLog record(options.out, header);
  VerifyGuide guide(record, out);
  if (guide.next() == nullptr) return record.record();

  EstimatorMeasurer measurer(scene, scene.limits(), 0);
  ScanPrinter printer(out, log, ScanPrinter::Format::text);
  std::atomic<bool> ended = false;
  VerifySink sink(guide, plan.dish, printer, stop, ended);
  Hardware hardware(station_file);
  warn_of_changed_lenses(station_file, hardware, log);
  StationParams params = hardware_params(station_file);
  params.repeat_within = {};  // a press for an untouched tray is one more attempt at it
  Station station(hardware.devices(), measurer, sink, ended, params);
  guide.prompt();
  station.run();
  if (!sink.problem().empty()) throw UsageError(sink.problem());
  return record.record();
}

}  // namespace traygauge
