#include "tests/firmware/store/sample_scan.hpp"

#include <nlohmann/json.hpp>

namespace traygauge::test {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson sample_item(std::size_t index, const std::string& food) {
  const double volume_ml = 83.25 + 31.125 * static_cast<double>(index);
  return {{"label", index + 2},
          {"dish", 1},
          {"status", "ok"},
          {"volume_ml", volume_ml},
          {"sigma_ml", 0.0213456789 * volume_ml},
          {"column_volume_ml", 1.0123456789 * volume_ml},
          {"area_mm2", 5123.456789012345 + static_cast<double>(index)},
          {"mean_height_mm", 16.123456789012345},
          {"max_height_mm", 31.98765432109876},
          {"food", food},
          {"food_probability", 0.9123456789012345},
          {"mass_g", 0.85 * volume_ml},
          {"mass_sigma_g", 3.123456789012345},
          {"nutrients",
           {{"energy_kcal", 1.3123456789 * volume_ml},
            {"protein_g", 0.0523456789 * volume_ml},
            {"fat_g", 0.0423456789 * volume_ml},
            {"carbohydrate_g", 0.1123456789 * volume_ml},
            {"salt_g", 0.0043456789 * volume_ml}}}};
}

OrderedJson sample_timing() {
  OrderedJson timing = OrderedJson::object();
  for (const char* const stage : {"undistort", "card", "dish", "tracking", "adjustment", "rectify", "stereo",
                                  "fusion", "height_map", "volume", "segmentation"}) {
    timing[stage] = 17.123456789012345;
  }
  timing["total"] = 188.12345678901234;
  return timing;
}

OrderedJson sample_check(const char* name, std::size_t label, double value, double limit) {
  return {{"name", name},   {"label", label},     {"value", value}, {"sigma", 0.2123456789012345},
          {"limit", limit}, {"verdict", "passed"}};
}

OrderedJson sample_checks(const SampleScan& scan) {
  OrderedJson checks = OrderedJson::array();
  if (scan.scale_percent) {
    checks.push_back(sample_check("dish_slip_mm", 1, 0.1512345678901234, 0.75));
    checks.push_back(sample_check("scale_percent", 1, *scan.scale_percent, 1.0));
    checks.push_back(sample_check("dish_height_mm", 1, scan.dish_height_mm, 1.0));
  }
  if (scan.glaze_height_mm) checks.push_back(sample_check("glaze_height_mm", 1, *scan.glaze_height_mm, 1.0));
  for (std::size_t i = 0; i < scan.foods.size(); ++i) {
    checks.push_back(sample_check("item_slip_mm", i + 2, 0.0812345678901234, 0.25));
    checks.push_back(sample_check("item_foot_mm", i + 2, 1.2312345678901234, 0.75));
  }
  return checks;
}

}  // namespace

std::string sample_document(const SampleScan& scan) {
  OrderedJson json = {
      {"version", 2},
      {"id", scan_id_text(scan.id)},
      {"station", scan.id.station},
      {"number", scan.id.number},
      {"taken_at", utc_text(scan.taken_ms)},
      {"clock_synchronised", scan.clock_synchronised},
      {"supersedes", scan.supersedes ? OrderedJson(scan_id_text(*scan.supersedes)) : OrderedJson()},
      {"tray", scan.tray.empty() ? OrderedJson() : OrderedJson(scan.tray)},
      {"status", scan.status},
      {"message", "All items were measured."},
      {"items", OrderedJson::array()},
      {"relative_angle_deg", 18.123456789012345},
      {"duration_ms", 2211.123456789},
      {"timing_ms", sample_timing()},
      {"warnings", OrderedJson::array()}};
  if (scan.has_checks) {
    json["checks"] = sample_checks(scan);
    json["blur_px"] = OrderedJson::array();
    for (const std::optional<double>& blur_px : scan.blur_px)
      json["blur_px"].push_back(blur_px ? OrderedJson(*blur_px) : OrderedJson());
  }
  for (std::size_t i = 0; i < scan.foods.size(); ++i) json["items"].push_back(sample_item(i, scan.foods[i]));
  json["warnings"].push_back({{"code", "items_doubtful"},
                              {"message", "Two items touch and have one colour: they may be one food."},
                              {"label", 3}});
  return json.dump();
}

std::string sample_document(std::uint64_t number) {
  SampleScan scan;
  scan.id.number = number;
  scan.taken_ms = kMorningMs + static_cast<std::int64_t>(number) * 60'000;
  return sample_document(scan);
}

WallTime at(std::int64_t unix_ms) {
  return {unix_ms, true};
}

}  // namespace traygauge::test
