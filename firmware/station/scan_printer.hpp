// Results for people, or as one JSON document a line.
#pragma once

#include <iosfwd>
#include <string>

#include "firmware/station/scan_result.hpp"

namespace traygauge {

// "Scan 1 (soup): rice 120 ml …" in lines of text; ends with a line feed.
std::string scan_text(const ScanResult& result);
// The same as JSON in one line, without a line feed. What was not measured is null. With an identity, it is
// the document that is stored.
std::string scan_json(const ScanResult& result, const ScanIdentity* identity = nullptr);

// "button: The device reported an error. (detail)"
std::string failure_text(const DeviceFailure& failure);

// Where the dirt is and what to do, for people.
std::string lens_sentence(const LensSpot& spot);

// Results go to `out`, what is wrong with devices to `log`; neither is buffered.
class ScanPrinter final : public ResultSink {
 public:
  enum class Format : std::uint8_t { text, json };
  ScanPrinter(std::ostream& out, std::ostream& log, Format format) : out_(out), log_(log), format_(format) {}

  Delivery deliver(const ScanResult& result) override;
  void report_fault(const DeviceFailure& failure) override;
  void report_restart() override;
  void report_recovery(std::string_view what) override;

 private:
  std::ostream& out_;
  std::ostream& log_;
  Format format_;
};

}  // namespace traygauge
