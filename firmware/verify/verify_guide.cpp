#include "firmware/verify/verify_guide.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>

#include "firmware/base/text.hpp"
#include "firmware/base/wall_clock.hpp"
#include "firmware/measure/measure_report.hpp"
#include "firmware/verify/verify_figures.hpp"

namespace traygauge {
namespace {

// "30 mm to the left, 20 mm away from you", or "in the middle".
std::string describe_shift(const VerifyPlace& place) {
  std::string text;
  const auto add = [&](double shift_mm, const char* positive, const char* negative) {
    if (shift_mm == 0.0) return;
    text += (text.empty() ? "" : ", ") + fixed(std::abs(shift_mm), 0) + " mm " +
            (shift_mm > 0.0 ? positive : negative);
  };
  add(place.shift_mm[0], "to the right", "to the left");
  add(place.shift_mm[1], "away from you", "towards you");
  return text.empty() ? "in the middle of the tray" : text + " of the middle of the tray";
}

std::string describe_turn(double angle_deg) {
  if (angle_deg == 0.0) return "its length from left to right";
  return "turned by " + fixed(angle_deg, 0) + " degrees counter-clockwise from there, seen from above";
}

}  // namespace

VerifyScan scan_of(const Measurement& measurement) {
  VerifyScan scan;
  scan.status = name(measurement.status.code());
  for (const ReportedWarning& warning : list_warnings(measurement, {})) scan.warnings.push_back(warning.code);
  if (measurement.status.code() == StatusCode::ok && measurement.items.size() == 1) {
    scan.is_measured = true;
    scan.volume_ml = measurement.items[0].volume_ml;
    scan.sigma_ml = measurement.items[0].sigma_ml;
    return scan;
  }
  scan.message = compose_message(measurement);
  if (!is_measured(measurement)) return scan;
  scan.status = "not_one_item";
  scan.message = std::to_string(measurement.items.size()) + " items were found where one body lies.";
  return scan;
}

void VerifyGuide::prompt() {
  const VerifyStep* const step = next();
  if (step == nullptr) return;
  const auto& steps = plan().steps;
  const VerifyBody& body = plan().bodies[step->body];
  out_ << "Step " << step - steps.data() + 1 << " of " << steps.size() << ", " << step->id << ": "
       << (step->is_repeat ? "lift body " : "lay body ") << body.id << " (" << fixed(body.volume_ml, 1)
       << " ml) " << (step->is_repeat ? "and lay it again " : "") << "on the flat of the dish \""
       << plan().dish << "\", " << describe_turn(step->angle_deg) << "; the dish "
       << describe_shift(plan().places[step->place]) << ", the card beside it. Then press the button."
       << std::endl;
}

void VerifyGuide::take(VerifyScan scan) {
  const VerifyStep* const step = next();
  const VerifyBody& body = plan().bodies[step->body];
  scan.step = step->id;
  scan.attempt = log_.record().attempts_at(step->id) + 1;
  scan.time = utc_text(read_wall_clock().unix_ms);
  log_.append(scan);
  out_ << scan.step << ": ";
  if (scan.is_measured) {
    const double error = verify_error(scan, body);
    out_ << fixed(scan.volume_ml, 1) << " ± " << fixed(scan.sigma_ml, 1) << " ml, "
         << (error < 0.0 ? "" : "+") << fixed(error, 1) << " %";
    for (const std::string& warning : scan.warnings) out_ << ", warning " << warning;
    out_ << std::endl;
    return;
  }
  out_ << "refused (" << scan.status << "). " << scan.message;
  if (!scan.is_last && scan.attempt < plan().attempts) {
    out_ << " It is recorded; the step is repeated." << std::endl;
  } else {
    out_ << " It is recorded; that was the last attempt at this step." << std::endl;
  }
}

std::string describe_progress(const VerifyRecord& record) {
  const auto& steps = record.header.plan.steps;
  const auto done =
      std::ranges::count_if(steps, [&](const VerifyStep& step) { return record.is_done(step); });
  const auto refused = std::ranges::count_if(steps, [&](const VerifyStep& step) {
    return record.is_done(step) && record.measured(step.id) == nullptr;
  });
  std::string text = std::to_string(done) + " of " + std::to_string(steps.size()) + " steps are done";
  if (refused > 0) text += ", " + std::to_string(refused) + " of them refused for good";
  return text + ".";
}

}  // namespace traygauge
