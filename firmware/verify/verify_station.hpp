// An acceptance test on a station: a person lays the bodies and presses the button.
#pragma once

#include <atomic>
#include <iosfwd>
#include <string>

#include "firmware/station/scan_result.hpp"
#include "firmware/verify/verify_guide.hpp"

namespace traygauge {

struct VerifyRunOptions;

// Takes the station's results as attempts at the guide's steps, and says what to lay next.
class VerifySink final : public ResultSink {
 public:
  // `stop` is somebody else's wish; `ended` is set where the station is to end: by that wish, or because all
  // is done or nothing can be kept. All outlive the sink.
  VerifySink(VerifyGuide& guide, std::string dish, ResultSink& printer, const std::atomic<bool>& stop,
             std::atomic<bool>& ended)
      : guide_(guide), dish_(std::move(dish)), printer_(printer), stop_(stop), ended_(ended) {}

  // A cancelled scan and one that a device spoilt are told, and are no attempts.
  Delivery deliver(const ScanResult& result) override;
  TrayHint next_tray() override;
  void attend() override;
  void report_fault(const DeviceFailure& failure) override { printer_.report_fault(failure); }
  void report_restart() override { printer_.report_restart(); }
  void report_recovery(std::string_view what) override { printer_.report_recovery(what); }

  // Why nothing could be kept; empty: all was.
  const std::string& problem() const { return problem_; }

 private:
  VerifyGuide& guide_;
  std::string dish_;
  ResultSink& printer_;
  const std::atomic<bool>& stop_;
  std::atomic<bool>& ended_;
  std::string problem_;
};

// On the devices of options.station. Throws InputError, UsageError, OutputError.
VerifyRecord run_verify_station(const VerifyRunOptions& options, const VerifyPlan& plan,
                                const std::atomic<bool>& stop, std::ostream& out, std::ostream& log);

}  // namespace traygauge
