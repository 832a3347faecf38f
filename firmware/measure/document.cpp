#include <nlohmann/json.hpp>
#include <optional>

#include "firmware/base/json_number.hpp"
#include "firmware/measure/json_parts.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

Json items_of(const Measurement& measurement) {
  Json items = Json::array();
  for (const ItemResult& item : measurement.items) items.push_back(item_document(item));
  return items;
}

Json pose_of(const Measurement& measurement) {
  if (!measurement.has_pose) return nullptr;
  const Pose& pose = measurement.second_from_first;
  Json rotation = Json::array();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rotation.push_back(pose.rotation(row, column));
  }
  const Vec3& t = pose.translation;
  return {{"rotation", rotation}, {"translation_mm", {t.x(), t.y(), t.z()}}};
}

Json timing_of(const MeasureReport& report) {
  const Measurement& measurement = *report.measurement;
  Json timing = Json::object();
  for (std::size_t i = 0; i < kStageCount; ++i) {
    // A stage that was not reached took no time.
    const double ms = measurement.stage_ms[i];
    timing[name(static_cast<Stage>(i))] = number_or_null(ms, is_measured(measurement) || ms > 0.0);
  }
  if (report.segmentation_ms) timing["segmentation"] = *report.segmentation_ms;
  timing["total"] = measurement.total_ms;
  timing["setup"] = report.setup_ms;
  return timing;
}

}  // namespace

std::string compose_document(const MeasureReport& report) {
  const Measurement& measurement = *report.measurement;
  Json document;
  document["version"] = kMeasureVersion;
  document["capture"] = report.capture;
  document["pair"] = report.pair;
  document["profile"] = report.profile;
  document["seed"] = report.seed;
  document["status"] = name(measurement.status.code());
  document["message"] = report.message;
  document["items"] = items_of(measurement);
  document["relative_angle_deg"] = number_or_null(measurement.relative_angle_deg, measurement.has_pose);
  document["pose"] = pose_of(measurement);
  document["timing_ms"] = timing_of(report);
  document["memory_bytes"] = {{"reserved", report.reserved_bytes}, {"used", report.used_bytes}};
  document["checks"] = check_documents(measurement.checks);
  document["warnings"] = warning_documents(report.warnings);
  // A path may hold bytes that are not UTF-8.
  return document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace traygauge
