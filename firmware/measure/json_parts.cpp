#include "firmware/measure/json_parts.hpp"

#include <nlohmann/json.hpp>

#include "firmware/base/json_number.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Json item_document(const ItemResult& item) {
  const bool measured = item.status == StatusCode::ok;
  return {{"label", item.label},
          {"dish", item.dish},
          {"status", name(item.status)},
          {"volume_ml", number_or_null(item.volume_ml, measured)},
          {"sigma_ml", number_or_null(item.sigma_ml, measured && item.sigma_ml > 0.0)},
          {"column_volume_ml", number_or_null(item.column_volume_ml, measured)},
          {"area_mm2", number_or_null(item.area_mm2, measured)},
          {"mean_height_mm", number_or_null(item.mean_height_mm, measured)},
          {"max_height_mm", number_or_null(item.max_height_mm, measured)}};
}

Json check_documents(const CheckList& checks) {
  Json list = Json::array();
  for (const Check& check : checks.items()) {
    list.push_back({{"name", name(check.kind)},
                    {"label", check.label},
                    {"value", check.value},
                    {"sigma", check.sigma},
                    {"limit", check.limit},
                    {"verdict", name(check.verdict)}});
  }
  return list;
}

Json blur_document(const PictureReport& pictures) {
  Json list = Json::array();
  for (const double blur_px : pictures.blur_px) list.push_back(number_or_null(blur_px, blur_px > 0.0));
  return list;
}

Json warning_documents(const std::vector<ReportedWarning>& warnings) {
  Json list = Json::array();
  for (const ReportedWarning& warning : warnings) {
    const bool has_label = warning.label != kBackgroundLabel;
    list.push_back({{"code", warning.code},
                    {"message", warning.message},
                    {"label", has_label ? Json(warning.label) : Json(nullptr)}});
  }
  return list;
}

}  // namespace traygauge
