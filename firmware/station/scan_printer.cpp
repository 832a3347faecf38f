#include "firmware/station/scan_printer.hpp"

#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <ostream>

#include "firmware/base/json_number.hpp"
#include "firmware/measure/json_parts.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

std::string_view status_name(const ScanResult& result) {
  if (result.outcome == ScanOutcome::cancelled) return "cancelled";
  if (result.outcome == ScanOutcome::device_failed) return name(result.failure.status.code());
  return name(result.measurement->status.code());
}

std::string message(const ScanResult& result) {
  switch (result.outcome) {
    case ScanOutcome::cancelled:
      return result.was_held ? "The button was held, which cancels the scan."
                             : "The button was not pressed a second time.";
    case ScanOutcome::device_failed:
      return failure_text(result.failure);
    case ScanOutcome::measured:
    case ScanOutcome::not_measurable:
      break;
  }
  return compose_message(*result.measurement);
}

std::string item_text(const ItemResult& item) {
  std::array<char, 64> text{};
  if (item.status != StatusCode::ok) return "item " + std::to_string(item.label) + " " + name(item.status);
  std::snprintf(text.data(), text.size(), "item %d %.1f ml", item.label, item.volume_ml);
  return text.data();
}

void add_identity(const ScanIdentity& identity, Json& json) {
  json["id"] = scan_id_text(identity.id);
  json["station"] = identity.id.station;
  json["number"] = identity.id.number;
  json["taken_at"] = utc_text(identity.taken_at.unix_ms);
  json["clock_synchronised"] = identity.taken_at.synchronised;
  json["supersedes"] = identity.supersedes ? Json(scan_id_text(*identity.supersedes)) : Json();
  const BoardState& board = identity.board;
  json["board"] = {{"temperature_c", value_or_null(board.temperature_c)},
                   {"under_voltage", value_or_null(board.under_voltage)}};
}

std::vector<ReportedWarning> warnings_of(const ScanResult& result) {
  std::vector<ReportedWarning> warnings = list_warnings(*result.measurement, {});
  if (result.lens_spot) warnings.push_back({"lens_spot", lens_sentence(*result.lens_spot)});
  return warnings;
}

Json lens_document(const std::optional<LensSpot>& spot) {
  if (!spot) return nullptr;
  return {{"x_px", spot->x_px}, {"y_px", spot->y_px}, {"width_px", spot->width_px}};
}

void add_measurement(const ScanResult& result, Json& json) {
  const Measurement& measurement = *result.measurement;
  for (const ItemResult& item : measurement.items) json["items"].push_back(item_document(item));
  if (measurement.has_pose) json["relative_angle_deg"] = measurement.relative_angle_deg;
  Json timing = Json::object();
  for (std::size_t i = 0; i < kStageCount; ++i) {
    timing[name(static_cast<Stage>(i))] = measurement.stage_ms[i];
  }
  if (measurement.segmentation_ms > 0.0) timing["segmentation"] = measurement.segmentation_ms;
  timing["total"] = measurement.total_ms;
  json["timing_ms"] = timing;
  json["checks"] = check_documents(measurement.checks);
  json["blur_px"] = blur_document(measurement.report.pictures);
  json["lens_spot"] = lens_document(result.lens_spot);
  json["warnings"] = warning_documents(warnings_of(result));
}

}  // namespace

std::string lens_sentence(const LensSpot& spot) {
  std::array<char, 200> text{};
  std::snprintf(
      text.data(), text.size(),
      "On all of the last trays both pictures were dark at x = %.0f, y = %.0f, some %.0f pixels wide, "
      "as behind dirt on the lens; clean it, and the window before it.",
      spot.x_px, spot.y_px, spot.width_px);
  return text.data();
}

std::string failure_text(const DeviceFailure& failure) {
  std::string text = std::string(failure.device) + ": " + sentence(failure.status.code());
  if (!failure.detail.empty()) text += " (" + std::string(failure.detail) + ")";
  if (failure.status.error_number() != 0) {
    text += " [" + std::string(std::strerror(failure.status.error_number())) + "]";
  }
  return text;
}

std::string scan_text(const ScanResult& result) {
  std::string text = "Scan " + std::to_string(result.scan);
  if (!result.tray.empty()) text += " (" + std::string(result.tray) + ")";
  text += ": ";
  const bool measured = result.outcome == ScanOutcome::measured;
  if (measured) {
    const char* separator = "";
    if (result.measurement->items.empty()) text += "no food";
    for (const ItemResult& item : result.measurement->items) {
      text += separator + item_text(item);
      separator = ", ";
    }
  }
  if (!measured || !result.measurement->status.ok()) {
    text += measured ? ". " + message(result) : message(result);
  }
  if (result.measurement != nullptr) {
    for (const ReportedWarning& warning : warnings_of(result)) {
      text += (text.back() == '.' ? " Warning: " : ". Warning: ") + describe(warning);
    }
  }
  return text + "\n";
}

std::string scan_json(const ScanResult& result, const ScanIdentity* identity) {
  Json json = {{"version", kMeasureVersion}};
  if (identity != nullptr) add_identity(*identity, json);
  json.update({{"scan", result.scan},
               {"tray", result.tray.empty() ? Json() : Json(result.tray)},
               {"status", status_name(result)},
               {"message", message(result)},
               {"items", Json::array()},
               {"relative_angle_deg", nullptr},
               {"duration_ms", std::chrono::duration<double, std::milli>(result.duration).count()},
               {"timing_ms", nullptr},
               {"checks", Json::array()},
               {"blur_px", {nullptr, nullptr}},
               {"lens_spot", nullptr},
               {"warnings", Json::array()}});
  if (result.measurement != nullptr) add_measurement(result, json);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Delivery ScanPrinter::deliver(const ScanResult& result) {
  out_ << (format_ == Format::json ? scan_json(result) + "\n" : scan_text(result)) << std::flush;
  return out_.good() ? Delivery::done : Delivery::failed;
}

void ScanPrinter::report_fault(const DeviceFailure& failure) {
  log_ << failure_text(failure) << std::endl;
}

void ScanPrinter::report_restart() {
  log_ << "The button was held: all devices are opened anew, the arm goes home." << std::endl;
}

void ScanPrinter::report_recovery(std::string_view what) {
  log_ << what << ": works again." << std::endl;
}

}  // namespace traygauge
