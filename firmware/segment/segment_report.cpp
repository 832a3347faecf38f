#include "firmware/segment/segment_report.hpp"

#include <nlohmann/json.hpp>

#include "core/labels/label_regions.hpp"
#include "firmware/base/json_number.hpp"
#include "firmware/base/text.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kSegmentVersion = 1;

Json dish_of(const SegmentedDish& dish) {
  const bool is_found = dish.status.ok();
  const DishPose& place = dish.found.place;
  return {{"label", dish.label},
          {"status", name(dish.status.code())},
          {"centre_mm", is_found ? Json({place.centre_mm.x(), place.centre_mm.y()}) : Json(nullptr)},
          {"size_mm", is_found ? Json(place.size_mm) : Json(nullptr)},
          {"edge_height_mm", number_or_null(place.edge_height_mm, is_found)},
          {"rim_seen_fraction", number_or_null(dish.found.support, is_found)}};
}

Json view_of(int view, const LabelRegions& regions) {
  Json items = Json::array();
  for (int label = kFirstItemLabel; label <= kLastItemLabel; ++label) {
    const auto at = static_cast<std::size_t>(label);
    if (regions.pixels[at] > 0) items.push_back({{"label", label}, {"pixels", regions.pixels[at]}});
  }
  return {{"view", view}, {"items", items}};
}

Json scores_of(const LabelScores& scores) {
  Json items = Json::array();
  for (const ItemScore& item : scores.items)
    items.push_back({{"label", item.label}, {"found", item.found}, {"iou", item.iou}});
  Json dishes = Json::array();
  for (const DishScore& dish : scores.dishes)
    dishes.push_back({{"label", dish.label}, {"axes_error", dish.axes_error}});
  return {{"food_iou", scores.food_iou},
          {"card_iou", scores.card_iou},
          {"items", items},
          {"items_found", scores.items_found},
          {"dishes", dishes}};
}

std::string score_line(const LabelScores& scores) {
  return "food IoU " + fixed(scores.food_iou, 3) + ", items " + fixed(scores.mean_item_iou(), 3) + ", " +
         std::to_string(scores.items_found) + " found of " + std::to_string(scores.items.size());
}

}  // namespace

std::string compose_segment_document(const SegmentReport& report) {
  const Segmentation& segmentation = report.drawn->segmentation;
  Json document;
  document["version"] = kSegmentVersion;
  document["capture"] = report.capture;
  document["pair"] = report.pair;
  document["status"] = name(segmentation.status.code());
  document["message"] = report.message;
  document["cards"] = Json::array();
  for (const CardAlignment& card : segmentation.cards)
    document["cards"].push_back({{"correlation", number_or_null(card.correlation, card.correlation > 0.0)}});
  document["dishes"] = Json::array();
  for (std::size_t d = 0; d < segmentation.dish_count; ++d)
    document["dishes"].push_back(dish_of(segmentation.dishes[d]));
  document["items"] = segmentation.items;
  document["items_doubtful"] = segmentation.has_doubtful_items();
  document["views"] = Json::array();
  for (std::size_t v = 0; v < 2; ++v)
    document["views"].push_back(view_of(report.pair[v], measure_regions(report.drawn->labels[v].gray())));
  if (report.scores)
    document["against_given_labels"] = {scores_of((*report.scores)[0]), scores_of((*report.scores)[1])};
  document["timing_ms"] = {{"card", segmentation.card_ms},
                           {"dishes", segmentation.dish_ms},
                           {"food", segmentation.food_ms},
                           {"total", segmentation.total_ms()}};
  document["memory_bytes"] = {{"reserved", report.drawn->reserved_bytes}};
  return document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string compose_segment_table(const SegmentReport& report) {
  const Segmentation& segmentation = report.drawn->segmentation;
  const auto line = [](const char* title, const std::string& text) {
    return pad_right(title, 9) + text + "\n";
  };
  std::string text = line("capture", printable(report.capture) + ", views " + std::to_string(report.pair[0]) +
                                         " and " + std::to_string(report.pair[1]));
  text += line("status", std::string(name(segmentation.status.code())) + ": " + report.message);
  text += line("card", "print and pictures correlate by " + fixed(segmentation.cards[0].correlation, 3) +
                           " and " + fixed(segmentation.cards[1].correlation, 3) +
                           (segmentation.is_card_doubtful ? "; part of it is covered, or bent" : ""));
  for (std::size_t d = 0; d < segmentation.dish_count; ++d) {
    const SegmentedDish& dish = segmentation.dishes[d];
    const DishPose& place = dish.found.place;
    text += line("dish", std::to_string(dish.label) + ": " +
                             (dish.status.ok()
                                  ? fixed(place.size_mm[0], 0) + " x " + fixed(place.size_mm[1], 0) +
                                        " mm, " + fixed(100.0 * dish.found.support, 0) + " % of its rim seen"
                                  : std::string(name(dish.status.code()))));
    if (dish.is_told_by_height) text += line("", "some of its food is told by its height alone");
  }
  if (segmentation.status.ok()) {
    text += line(
        "items",
        std::to_string(segmentation.items) +
            (segmentation.has_doubtful_items() ? "; it is not sure where one ends and the next begins" : ""));
  }
  if (report.scores) {
    for (std::size_t v = 0; v < 2; ++v)
      text += line(v == 0 ? "given" : "",
                   "view " + std::to_string(report.pair[v]) + ": " + score_line((*report.scores)[v]));
  }
  text += line("time", fixed(segmentation.total_ms(), 1) + " ms (card " + fixed(segmentation.card_ms, 1) +
                           ", dishes " + fixed(segmentation.dish_ms, 1) + ", food " +
                           fixed(segmentation.food_ms, 1) + ")");
  return text + line("memory", mebibytes(report.drawn->reserved_bytes) + " MiB");
}

}  // namespace traygauge
