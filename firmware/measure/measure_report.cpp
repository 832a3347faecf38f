#include "firmware/measure/measure_report.hpp"

#include <algorithm>

#include "firmware/base/text.hpp"

namespace traygauge {
namespace {

std::string list_failed_items(const Measurement& measurement) {
  std::string list;
  for (const ItemResult& item : measurement.items) {
    if (item.status == StatusCode::ok) continue;
    list += " Item " + std::to_string(item.label) + ": " + sentence(item.status);
  }
  return list;
}

// How far the measurement came.
std::string describe_progress(const MeasurementReport& report) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (report.keypoints[0] > 0 || report.keypoints[1] > 0) {
    add(std::to_string(report.keypoints[0]) + " and " + std::to_string(report.keypoints[1]) + " keypoints");
  }
  if (report.matches > 0) add(std::to_string(report.matches) + " matches");
  if (report.inliers > 0) {
    add(std::to_string(report.inliers) + " of them fit a motion within " +
        fixed(report.inlier_threshold_px, 2) + " px");
  }
  if (report.card_tracks > 0) add(std::to_string(report.card_tracks) + " points on the card");
  if (report.rim_points > 0) add(std::to_string(report.rim_points) + " points on the rim");
  if (report.matched_fraction > 0.0)
    add(fixed(100.0 * report.matched_fraction, 0) + "% of the dish matched densely");
  return text.empty() ? text : " (" + text + ")";
}

}  // namespace

std::string compose_message(const Measurement& measurement) {
  const StatusCode code = measurement.status.code();
  if (code == StatusCode::ok) return sentence(code);
  if (code != StatusCode::partial) {
    return sentence(code) + describe_progress(measurement.report) + list_failed_items(measurement);
  }
  const auto measured = std::count_if(measurement.items.begin(), measurement.items.end(),
                                      [](const ItemResult& item) { return item.status == StatusCode::ok; });
  return std::to_string(measured) + " of " + std::to_string(measurement.items.size()) +
         " items were measured." + list_failed_items(measurement);
}

std::vector<ReportedWarning> list_warnings(const Measurement& measurement,
                                           const std::vector<ReportedWarning>& input) {
  std::vector<ReportedWarning> warnings = input;
  measurement.warnings.for_each([&](Warning warning, std::uint8_t label) {
    warnings.push_back({name(warning), sentence(warning), label});
  });
  return warnings;
}

std::string describe(const ReportedWarning& warning) {
  if (warning.label == kBackgroundLabel) return warning.message;
  const char* kind = is_item(warning.label) ? "Item " : "Dish ";
  return kind + std::to_string(warning.label) + ": " + warning.message;
}

}  // namespace traygauge
