#include "firmware/record/record_command.hpp"

#include <ostream>

#include "firmware/base/exit_status.hpp"
#include "firmware/command/program.hpp"
#include "firmware/record/capture_recorder.hpp"
#include "firmware/record/picture_recorder.hpp"
#include "firmware/station/hardware.hpp"
#include "firmware/station/scan_printer.hpp"

namespace traygauge {
namespace {

// A line for each press.
class RecordPrinter final : public ResultSink {
 public:
  RecordPrinter(const CaptureRecorder& recorder, std::filesystem::path out_folder, std::ostream& out,
                std::ostream& log)
      : recorder_(recorder),
        out_folder_(std::move(out_folder)),
        out_(out),
        printer_(out, log, ScanPrinter::Format::text) {}

  Delivery deliver(const ScanResult& result) override {
    if (result.outcome == ScanOutcome::measured) {
      out_ << "Saved " << (out_folder_ / result.tray).string() << std::endl;
      return out_.good() ? Delivery::done : Delivery::failed;
    }
    if (!recorder_.problem().empty()) {
      out_ << "Not saved: " << recorder_.problem() << std::endl;
      return Delivery::failed;
    }
    return printer_.deliver(result);
  }
  void report_fault(const DeviceFailure& failure) override { printer_.report_fault(failure); }
  void report_restart() override { printer_.report_restart(); }
  void report_recovery(std::string_view what) override { printer_.report_recovery(what); }

 private:
  const CaptureRecorder& recorder_;
  std::filesystem::path out_folder_;
  std::ostream& out_;
  ScanPrinter printer_;
};

}  // namespace

void add_record_command(Program& program, RecordOptions& options) {
  Command command = program.add_command("record", "Save captures: press the button for each tray");
  command.add_option("STATION", options.station, "The station file, see config/station.toml").required();
  command.add_option("--out", options.out, "Folder for the captures").required();
  command.add_flag(
      "--pictures", options.pictures,
      "Single pictures, such as of a chessboard for traygauge calibrate; neither lens nor card need "
      "be known");
  command.add_option("--count", options.count, "End after so many").positive();
}

int run_record(const RecordOptions& options, const std::atomic<bool>& stop, std::ostream& out,
               std::ostream& log) {
  const StationFile station_file = read_station_file(options.station);
  if (options.pictures) {
    Hardware hardware(station_file);
    const bool ended = record_pictures(hardware.camera(), hardware.trigger(), hardware.lamp(),
                                       {options.out, options.count}, stop, out, log);
    return ended ? kExitMeasured : kExitNotMeasurable;
  }
  require_geometry(station_file);
  const LensConfig& second = station_file.second_lens ? *station_file.second_lens : *station_file.lens;
  CaptureRecorder recorder(options.out, {station_file.lens->camera, second.camera}, *station_file.card);
  RecordPrinter printer(recorder, options.out, out, log);
  Hardware hardware(station_file);
  warn_of_changed_lenses(station_file, hardware, log);
  StationParams params = hardware_params(station_file);
  params.max_scans = options.count;
  params.seen_per_commanded = 1.0;  // captures have the commanded angle
  Station station(hardware.devices(), recorder, printer, stop, params);
  return station.run().all_worked() ? kExitMeasured : kExitNotMeasurable;
}

}  // namespace traygauge
