#include <array>
#include <string>

#include "firmware/base/text.hpp"
#include "firmware/config/profile.hpp"
#include "firmware/measure/measure_report.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kLabelWidth = 6;
constexpr std::size_t kNumberWidth = 11;
constexpr double kMm2PerCm2 = 100.0;
constexpr const char* kNothing = "-";

std::string row(const std::string& label, const std::array<std::string, 4>& numbers,
                const std::string& status) {
  std::string line = pad_left(label, kLabelWidth);
  for (const std::string& number : numbers) line += pad_left(number, kNumberWidth);
  return line + "  " + status + "\n";
}

std::string item_row(const ItemResult& item) {
  const std::string label = std::to_string(item.label);
  if (item.status != StatusCode::ok)
    return row(label, {kNothing, kNothing, kNothing, kNothing}, name(item.status));
  return row(label,
             {fixed(item.volume_ml, 1), fixed(item.area_mm2 / kMm2PerCm2, 1), fixed(item.mean_height_mm, 1),
              fixed(item.max_height_mm, 1)},
             name(item.status));
}

std::string item_rows(const Measurement& measurement) {
  if (measurement.items.empty()) return "";
  std::string text = row("item", {"volume ml", "area cm²", "mean mm", "max mm"}, "status");
  double volume_ml = 0.0;
  for (const ItemResult& item : measurement.items) {
    text += item_row(item);
    if (item.status == StatusCode::ok) volume_ml += item.volume_ml;
  }
  if (is_measured(measurement) && measurement.items.size() > 1) {
    text += row("all", {fixed(volume_ml, 1), "", "", ""}, "");
  }
  while (text.size() > 1 && text[text.size() - 2] == ' ') text.erase(text.size() - 2, 1);
  return text + "\n";
}

std::string times(const MeasureReport& report) {
  const Measurement& measurement = *report.measurement;
  std::string text = fixed(measurement.total_ms, 1) + " ms (";
  bool first = !report.segmentation_ms.has_value();
  if (report.segmentation_ms) text += "segmentation " + fixed(*report.segmentation_ms, 1);
  for (std::size_t i = 0; i < kStageCount; ++i) {
    if (measurement.stage_ms[i] <= 0.0) continue;
    text += (first ? "" : ", ") + std::string(name(static_cast<Stage>(i))) + " " +
            fixed(measurement.stage_ms[i], 1);
    first = false;
  }
  return text + (first ? "" : "; ") + "setup before it " + fixed(report.setup_ms, 1) + ")";
}

}  // namespace

std::string compose_table(const MeasureReport& report) {
  const Measurement& measurement = *report.measurement;
  const auto line = [](const char* title, const std::string& text) {
    return pad_right(title, 9) + text + "\n";
  };
  std::string text = line("capture", printable(report.capture) + ", views " + std::to_string(report.pair[0]) +
                                         " and " + std::to_string(report.pair[1]) + ", profile " +
                                         report.profile + ", seed " + std::to_string(report.seed));
  text += line("status", std::string(name(measurement.status.code())) + ": " + report.message) + "\n";
  text += item_rows(measurement);
  if (measurement.has_pose) {
    text += line("views", fixed(measurement.relative_angle_deg, 1) + "° apart, the camera moved by " +
                              fixed(measurement.second_from_first.translation.norm(), 0) + " mm");
  }
  const MeasurementReport& counts = measurement.report;
  const auto kept = [&](std::size_t i) {
    return std::to_string(counts.keypoints[i]) + " of " + std::to_string(counts.keypoints_found[i]);
  };
  if (report.profile == name(Profile::best)) {
    text += line("points", std::to_string(counts.matches) + " of " + std::to_string(counts.corners) +
                               " corners found in both views, " + std::to_string(counts.inliers) +
                               " fit the motion");
  } else {
    text +=
        line("points", kept(0) + " and " + kept(1) + " salient points, " + std::to_string(counts.matches) +
                           " matches, " + std::to_string(counts.inliers) + " fit the motion, " +
                           std::to_string(counts.card_tracks) + " lie on the card");
  }
  text += line("time", times(report));
  text +=
      line("memory", mebibytes(report.used_bytes) + " of " + mebibytes(report.reserved_bytes) + " MiB used");
  for (const ReportedWarning& warning : report.warnings) text += line("warning", describe(warning));
  return text;
}

}  // namespace traygauge
