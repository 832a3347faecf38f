#include <cmath>
#include <ostream>

#include "firmware/base/text.hpp"
#include "firmware/config/dish_choice.hpp"
#include "firmware/setup/setup_steps.hpp"
#include "firmware/station/estimator_measurer.hpp"
#include "firmware/station/hardware.hpp"
#include "firmware/station/scan_printer.hpp"
#include "firmware/station/site_scene.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

// What the tray says of the station: all its food, and how card and dish agree.
std::string grade_tray(const Measurement& measurement) {
  double sum_ml = 0.0;
  double sigma_ml = 0.0;  // errors of one tray's items go the same way, as that of its scale does
  for (const ItemResult& item : measurement.items) {
    if (item.status != StatusCode::ok) continue;
    sum_ml += item.volume_ml;
    sigma_ml += item.sigma_ml;
  }
  std::string text =
      "All food: " + fixed(sum_ml, 0) + " ml, standard deviation " + fixed(sigma_ml, 0) + " ml.";
  for (const Check& check : measurement.checks.items()) {
    if (check.kind != CheckKind::scale_percent) continue;
    text += " Card and dish " + std::to_string(check.label) + " agree about the scale to " +
            fixed(std::abs(check.value), 2) + " %; from " + fixed(check.limit, 0) + " % on it is told.";
  }
  return text;
}

class FirstTray final : public ResultSink {
 public:
  explicit FirstTray(std::ostream& out) : printer_(out, out, ScanPrinter::Format::text) {}

  Delivery deliver(const ScanResult& result) override {
    if (result.outcome == ScanOutcome::measured) grade_ = grade_tray(*result.measurement);
    return printer_.deliver(result);
  }
  void report_fault(const DeviceFailure& failure) override { printer_.report_fault(failure); }
  void report_restart() override { printer_.report_restart(); }
  void report_recovery(std::string_view what) override { printer_.report_recovery(what); }

  // Empty: it was not measured.
  const std::string& grade() const { return grade_; }

 private:
  ScanPrinter printer_;
  std::string grade_;
};

std::string grade_lens(const StationFile& station) {
  const auto facts = calibration_facts(station);
  if (!facts) return "The lens was described, not calibrated here: its grade is not known.";
  return "Grade of the lens: volumes right to " + fixed(facts->grade_percent, 2) +
         " % (two standard deviations).";
}

bool measure_tray(SetupSite& site) {
  const StationFile station = site.read();
  require_geometry(station);
  SiteScene scene(station, read_station_dishes(site.file));
  EstimatorMeasurer measurer(scene, scene.limits(), 0);
  FirstTray tray(site.dialogue.out());
  const std::unique_ptr<SetupDevices> opened = site.tools.open_devices(station);
  StationParams params = hardware_params(station);
  params.max_scans = 1;
  params.max_retries = kSetupRetries;
  site.dialogue.say("Lay a tray with dish, food and card under the camera, and press the button.");
  Station(opened->devices(), measurer, tray, site.stop, params).run();
  if (tray.grade().empty()) return false;
  site.dialogue.say(tray.grade());
  site.dialogue.say(grade_lens(station));
  return true;
}

}  // namespace

bool measure_first_tray(SetupSite& site) {
  return try_until_done(site, [&site] { return measure_tray(site); });
}

}  // namespace traygauge
