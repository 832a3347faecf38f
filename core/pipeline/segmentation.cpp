#include "core/pipeline/segmentation.hpp"

#include "core/pipeline/measurement.hpp"

namespace traygauge {

Status blame_card(const Segmentation& segmentation, Status status) {
  const bool has_other_reason = is_measured(status) || status.code() == StatusCode::dish_moved;
  return segmentation.is_card_doubtful && !has_other_reason ? Status(StatusCode::card_hidden) : status;
}

void warn_about_labels(const Segmentation& segmentation, WarningSet& warnings) {
  for (const SegmentedDish& dish : segmentation.sought()) {
    warnings.raise_if(!dish.status.ok(), Warning::dish_not_found, dish.label);
    warnings.raise_if(dish.is_bare, Warning::dish_empty, dish.label);
  }
  for (const SegmentedDish& dish : segmentation.drawn())
    warnings.raise_if(dish.has_doubtful_items(), Warning::items_doubtful, dish.label);
  warnings.raise_if(segmentation.misses_hint, Warning::items_doubtful);
  warnings.raise_if(segmentation.leaves_food, Warning::unknown_object);
  warnings.raise_if(segmentation.is_card_doubtful, Warning::card_partly_hidden);
}

}  // namespace traygauge
