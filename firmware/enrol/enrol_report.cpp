#include "firmware/enrol/enrol_report.hpp"

#include <nlohmann/json.hpp>

#include "firmware/base/json_number.hpp"
#include "firmware/base/percent.hpp"
#include "firmware/base/text.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kEnrolVersion = 1;
constexpr std::size_t kTitleWidth = 9;
constexpr std::size_t kPointWidth = 10;

bool has_edge(const DishSurvey& survey) {
  return survey.errors.size_mm > 0.0;
}

bool is_measured(const DishSurvey& survey) {
  return survey.status.ok();
}

std::string mm(double value) {
  return fixed(value, 2) + " mm";
}

std::string size_of(const DishSurvey& survey) {
  const auto& size_mm = survey.fitted.dish.outer_size_mm;
  const std::string size = size_mm[0] == size_mm[1]
                               ? "round, " + mm(size_mm[0])
                               : "oval, " + fixed(size_mm[0], 2) + " x " + mm(size_mm[1]);
  return size + " (± " + fixed(survey.errors.size_mm, 2) + ")";
}

std::string line(const char* title, const std::string& text) {
  return pad_right(title, kTitleWidth) + text + "\n";
}

std::string profile_rows(const DishDescription& dish) {
  std::string text = pad_left("inset mm", kPointWidth) + pad_left("height mm", kPointWidth) + "\n";
  for (const ProfilePoint& point : dish.profile) {
    text += pad_left(fixed(point.inset_mm, 1), kPointWidth) +
            pad_left(fixed(point.height_mm, 2), kPointWidth) + "\n";
  }
  return text + "\n";
}

Json to_json(const DishDescription& dish) {
  Json profile = Json::array();
  for (const ProfilePoint& point : dish.profile) profile.push_back({point.inset_mm, point.height_mm});
  return {{"style", dish.style},
          {"outer_size_mm", dish.outer_size_mm},
          {"rim_height_mm", dish.rim_height_mm},
          {"bottom_height_mm", dish.bottom_height_mm},
          {"profile", profile}};
}

}  // namespace

std::string compose_enrol_message(const EnrolReport& report) {
  const DishSurvey& survey = *report.survey;
  if (is_measured(survey)) return "The dish was measured and written to " + printable(report.file) + ".";
  if (survey.status.code() != StatusCode::too_little_depth) return sentence(survey.status.code());
  std::string text = "The glaze shows too little for a profile: heights are known on " +
                     fixed(kPercent * survey.fitted.known_fraction, 0) +
                     "% of the way from the edge to the middle";
  if (survey.fitted.residual_mm > 0.0)
    text += ", and lie " + fixed(survey.fitted.residual_mm, 1) + " mm off any profile";
  return text +
         ". Draw a fine pattern on it with a washable pen, or dust it, keep lamps from being mirrored in it, "
         "and "
         "take both pictures again.";
}

std::string compose_enrol_document(const EnrolReport& report) {
  const DishSurvey& survey = *report.survey;
  const bool measured = is_measured(survey);
  const bool edge = has_edge(survey);
  Json document;
  document["version"] = kEnrolVersion;
  document["capture"] = report.capture;
  document["pair"] = report.pair;
  document["seed"] = report.seed;
  document["status"] = name(survey.status.code());
  document["message"] = compose_enrol_message(report);
  document["file"] = measured ? Json(report.file) : Json(nullptr);
  document["dish"] = measured ? to_json(report.dish) : Json(nullptr);
  document["edge"] = edge ? Json{{"outer_size_mm", survey.fitted.dish.outer_size_mm},
                                 {"height_mm", survey.place.edge_height_mm}}
                          : Json(nullptr);
  document["sigma_mm"] = {{"outer_size", number_or_null(survey.errors.size_mm, edge)},
                          {"edge_height", number_or_null(survey.errors.edge_height_mm, edge)},
                          {"surface", number_or_null(survey.errors.height_mm, measured)}};
  document["residual_mm"] = number_or_null(survey.fitted.residual_mm, measured);
  document["spread_mm"] = number_or_null(survey.fitted.spread_mm, measured);
  document["known_fraction"] = number_or_null(survey.fitted.known_fraction, edge);
  document["widest_gap_mm"] = number_or_null(survey.fitted.widest_gap_mm, measured);
  document["lean_deg"] = number_or_null(survey.lean_deg, measured);
  document["relative_angle_deg"] = number_or_null(survey.relative_angle_deg, edge);
  // A path may hold bytes that are not UTF-8.
  return document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string compose_enrol_table(const EnrolReport& report) {
  const DishSurvey& survey = *report.survey;
  std::string text =
      line("capture", printable(report.capture) + ", views " + std::to_string(report.pair[0]) + " and " +
                          std::to_string(report.pair[1]) + ", seed " + std::to_string(report.seed));
  text +=
      line("status", std::string(name(survey.status.code())) + ": " + compose_enrol_message(report)) + "\n";
  if (is_measured(survey)) text += profile_rows(report.dish);
  if (has_edge(survey)) {
    text += line("outside", size_of(survey));
    text += line("edge", mm(survey.place.edge_height_mm) + " over the table (± " +
                             fixed(survey.errors.edge_height_mm, 2) + "), outlines " +
                             fixed(survey.outline.rms_px, 2) + " px about it");
  }
  if (is_measured(survey)) {
    text += line("rim", mm(report.dish.rim_height_mm));
    text += line("bottom", mm(report.dish.bottom_height_mm));
    text += line("surface", "± " + mm(survey.errors.height_mm) + " as a whole; medians over the azimuth " +
                                mm(survey.fitted.residual_mm) + " about the profile, single points " +
                                mm(survey.fitted.spread_mm) + "; " +
                                fixed(kPercent * survey.fitted.known_fraction, 0) + "% of the way known");
    text += line("lean", fixed(survey.lean_deg, 2) + "°");
  }
  if (has_edge(survey)) text += line("views", fixed(survey.relative_angle_deg, 1) + "° apart");
  return text;
}

}  // namespace traygauge
