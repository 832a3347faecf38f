// One document with everything that the tables show; what is not defined is null.
#include <cmath>
#include <nlohmann/json.hpp>

#include "firmware/evaluate/evaluation.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kEvaluationVersion = 1;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json interval_of(const std::optional<ConfidenceInterval>& interval) {
  return interval ? Json{interval->low, interval->high} : Json(nullptr);
}

Json thirds_of(const std::array<double, 3>& thirds) {
  return Json{number(thirds[0]), number(thirds[1]), number(thirds[2])};
}

Json accuracy_of(const SetFigures& figures) {
  return {{"items", figures.items},
          {"items_tried", figures.items_tried},
          {"estimates", figures.estimates},
          {"refused", figures.refused},
          {"refused_percent", number(figures.refused_fraction)},
          {"mape_percent", number(figures.mape)},
          {"mape_refusals_as_100_percent", number(figures.mape_refusals_as_100)},
          {"pmae_percent", number(figures.pmae)},
          {"bias_percent", number(figures.bias)},
          {"limits_of_agreement_percent", {number(figures.limit_low), number(figures.limit_high)}},
          {"within_10_percent", number(figures.within_10)},
          {"within_20_percent", number(figures.within_20)},
          {"worst_percent", number(figures.worst)},
          {"beyond_20", figures.beyond_20},
          {"beyond_20_unwarned", figures.beyond_20_unwarned},
          {"cv_percent", number(figures.cv)},
          {"cv_below_1_5_percent", number(figures.cv_below_1_5)},
          {"cv_below_10_percent", number(figures.cv_below_10)},
          {"cv_seeds_percent", number(figures.cv_seeds)}};
}

Json sigma_of(const SigmaFigures& sigma) {
  if (!sigma.is_estimated) return nullptr;
  return {{"without_sigma", sigma.without_sigma},
          {"within_two_sigma_percent", number(sigma.coverage)},
          {"by_thirds_of_sigma_percent", thirds_of(sigma.coverage_by_thirds)},
          {"by_thirds_of_relative_sigma_percent", thirds_of(sigma.coverage_by_relative_thirds)},
          {"median_relative_sigma_percent", number(sigma.median_relative_sigma)},
          {"rank_correlation", number(sigma.rank_correlation)},
          {"relative_rank_correlation", number(sigma.relative_rank_correlation)}};
}

Json group_of(const GroupEvaluation& group) {
  Json document = accuracy_of(group.figures);
  document["mape_interval_percent"] = interval_of(group.mape_interval);
  document["bias_interval_percent"] = interval_of(group.bias_interval);
  document["sigma"] = sigma_of(group.sigma);
  document["within_two_sigma_interval_percent"] = interval_of(group.coverage_interval);
  return document;
}

Json capture_of(const CaptureEvaluation& capture) {
  const StageFigures& stages = capture.stages;
  Json document = {{"capture", capture.capture}};
  document["foods"] = accuracy_of(capture.foods);
  document["median_errors"] = {{"rotation_deg", number(stages.rotation_deg)},
                               {"direction_deg", number(stages.direction_deg)},
                               {"scale_percent", number(stages.scale_percent)},
                               {"table_tilt_deg", number(stages.table_tilt_deg)},
                               {"table_offset_mm", number(stages.table_offset_mm)},
                               {"bottom_tilt_deg", number(stages.bottom_tilt_deg)},
                               {"bottom_offset_mm", number(stages.bottom_offset_mm)}};
  document["median_ms"] = number(stages.time_ms);
  return document;
}

Json item_of(const ItemEvaluation& item) {
  return {{"capture", item.series.capture},
          {"label", item.series.label},
          {"name", item.series.name},
          {"kind", item.series.overhangs ? "scan" : "heightfield"},
          {"truth_ml", item.series.truth_ml},
          {"mean_ml", number(item.figures.mean_ml)},
          {"estimates", item.figures.estimates},
          {"refused", item.figures.refused},
          {"mape_percent", number(item.figures.mape)},
          {"bias_percent", number(item.figures.bias)},
          {"cv_percent", number(item.figures.cv)},
          {"cv_seeds_percent", number(item.figures.cv_seeds)},
          {"median_relative_sigma_percent", number(item.sigma.median_relative_sigma)},
          {"within_two_sigma_percent", number(item.sigma.coverage)}};
}

Json angle_of(const AngleEvaluation& angle) {
  Json document = {{"low_deg", angle.low_deg}, {"high_deg", angle.high_deg}, {"pairs", angle.pairs}};
  document["foods"] = accuracy_of(angle.foods);
  return document;
}

template <class List, class Compose>
Json list_of(const List& list, Compose compose) {
  Json array = Json::array();
  for (const auto& element : list) array.push_back(compose(element));
  return array;
}

Json outlines_of(const OutlineFigures& figures) {
  return {{"capture", figures.capture},
          {"pairs", figures.pairs},
          {"food_iou", figures.food_iou},
          {"item_iou", figures.item_iou},
          {"card_iou", figures.card_iou},
          {"axes_error_percent", figures.axes_error_percent},
          {"right_count_percent", figures.right_count_percent},
          {"all_food_percent", figures.all_food_percent},
          {"time_ms", figures.time_ms}};
}

}  // namespace

std::string compose_summary_json(const Evaluation& evaluation) {
  Json document = {{"version", kEvaluationVersion}, {"set", evaluation.set},
                   {"profile", evaluation.profile}, {"seeds", evaluation.seeds},
                   {"pairs", evaluation.pairs},     {"measurements", evaluation.measurements}};
  document["groups"] = Json::object();
  for (const GroupEvaluation& group : evaluation.groups) document["groups"][group.key] = group_of(group);
  document["all"] = capture_of(evaluation.all);
  document["captures"] = list_of(evaluation.captures, capture_of);
  document["items"] = list_of(evaluation.items, item_of);
  document["angles"] = list_of(evaluation.angles, angle_of);
  document["at_15_to_20_deg"] =
      evaluation.optimal_angles ? angle_of(*evaluation.optimal_angles) : Json(nullptr);
  document["refusals"] = Json::object();
  for (const auto& [cause, count] : evaluation.refusals) document["refusals"][cause] = count;
  document["skipped"] = evaluation.skipped;
  document["items_without_volume"] = evaluation.items_without_volume;
  if (!evaluation.outlines.empty()) document["outlines"] = list_of(evaluation.outlines, outlines_of);
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace traygauge
