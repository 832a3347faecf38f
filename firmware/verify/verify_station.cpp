#include "firmware/verify/verify_station.hpp"

#include <algorithm>
#include <ostream>

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

void require_dish(const SiteScene& scene, const std::string& dish) {
  const std::vector<std::string> styles = scene.dish_styles();
  if (std::ranges::find(styles, dish) != styles.end()) return;
  std::string list;
  for (const std::string& style : styles) list += (list.empty() ? "" : ", ") + style;
  throw UsageError("the plan's dish: the station has no dish " + printable(dish) + "; it knows " + list);
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
  SiteScene scene(station_file, read_station_dishes(station_file.file));
  require_dish(scene, plan.dish);
  VerifyHeader header = begin_verify_header(options, plan);
  add_station_conditions(station_file, header);
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
