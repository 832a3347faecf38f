#include "firmware/record/capture_recording.hpp"

#include <ostream>

#include "firmware/record/capture_recorder.hpp"
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

bool record_captures(const StationFile& station, const StationDevices& devices,
                     const CaptureRecording& recording, const std::atomic<bool>& stop, std::ostream& out,
                     std::ostream& log) {
  const LensConfig& second = station.second_lens ? *station.second_lens : *station.lens;
  CaptureRecorder recorder(recording.out, {station.lens->camera, second.camera}, *station.card);
  RecordPrinter printer(recorder, recording.out, out, log);
  StationParams params = hardware_params(station);
  params.max_scans = recording.count;
  params.max_retries = recording.max_retries;
  params.seen_per_commanded = 1.0;  // captures have the commanded angle
  return Station(devices, recorder, printer, stop, params).run().all_worked();
}

}  // namespace traygauge
