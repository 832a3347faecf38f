#include "firmware/store/corrected_scan.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <type_traits>
#include <variant>

namespace traygauge {
namespace {

constexpr std::size_t kMaxFoodBytes = 200;

CorrectedItem as_measured(const MeasuredItem& item) {
  CorrectedItem corrected;
  corrected.label = item.label;
  corrected.dish = item.dish;
  corrected.status = item.status;
  corrected.food = corrected.measured_food = item.food;
  corrected.volume_ml = corrected.measured_volume_ml = item.volume_ml;
  corrected.sigma_ml = corrected.measured_sigma_ml = item.sigma_ml;
  return corrected;
}

template <class Items>
auto find_item(Items& items, int label) {
  return std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.label == label; });
}

bool has_item(const CorrectedScan& scan, int label) {
  return find_item(scan.items, label) != scan.items.end();
}

std::string no_such_item(int label) {
  return "The scan has no item " + std::to_string(label) + ".";
}

// Each of these says why its action cannot follow.
std::string refuse(const CorrectedScan& scan, const RenameItem& action) {
  if (!has_item(scan, action.item)) return no_such_item(action.item);
  if (action.food.empty() || !is_plain_text(action.food, kMaxFoodBytes)) {
    return "The name of a food is plain text of 1 to 200 bytes.";
  }
  return {};
}

std::string refuse(const CorrectedScan& scan, const MergeItems& action) {
  std::vector<int> labels = action.others;
  labels.push_back(action.item);
  if (action.others.empty() || labels.size() > scan.items.size()) {
    return "Name the items that become part of the other, each once.";
  }
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto item = find_item(scan.items, labels[i]);
    if (item == scan.items.end()) return no_such_item(labels[i]);
    if (std::count(labels.begin(), labels.end(), labels[i]) > 1) {
      return "Item " + std::to_string(labels[i]) + " is named twice.";
    }
    if (!item->volume_ml) {
      return "Item " + std::to_string(labels[i]) + " was not measured, so it cannot be merged.";
    }
    if (item->is_wrong) return "Item " + std::to_string(labels[i]) + " is marked as wrong.";
  }
  return {};
}

std::string refuse(const CorrectedScan& scan, const SplitItem& action) {
  const auto item = find_item(scan.items, action.item);
  if (item == scan.items.end()) return no_such_item(action.item);
  if (!item->volume_ml) return "Item " + std::to_string(action.item) + " was not measured.";
  if (!(action.volume_ml > 0.0 && action.volume_ml < *item->volume_ml)) {
    return "The part has to be larger than 0 ml and smaller than the item.";
  }
  if (!is_plain_text(action.food, kMaxFoodBytes)) {
    return "The name of a food is plain text of at most 200 bytes.";
  }
  return {};
}

std::string refuse(const CorrectedScan& scan, const MarkItemWrong& action) {
  const auto item = find_item(scan.items, action.item);
  if (item == scan.items.end()) return no_such_item(action.item);
  return item->is_wrong ? "The item is marked as wrong already." : "";
}

std::string refuse(const CorrectedScan& scan, const MarkScanWrong&) {
  return scan.is_wrong ? "The scan is marked as wrong already." : "";
}

std::string refuse(const CorrectedScan& scan, const UndoCorrection& action) {
  if (scan.holding.empty()) return "There is no correction to take back.";
  if (scan.holding.back() == action.number) return {};
  return "Only the last correction that holds, number " + std::to_string(scan.holding.back()) +
         ", can be taken back.";
}

// Each of these follows from a refuse() that found nothing.
void apply(CorrectedScan& scan, const RenameItem& action, int) {
  find_item(scan.items, action.item)->food = action.food;
}

// Sigmas add up: the parts share the plane below them, and whether their errors go together is not known.
void apply(CorrectedScan& scan, const MergeItems& action, int) {
  for (const int label : action.others) {
    const auto other = find_item(scan.items, label);
    const auto item = find_item(scan.items, action.item);
    item->volume_ml = *item->volume_ml + *other->volume_ml;
    item->sigma_ml =
        item->sigma_ml && other->sigma_ml ? std::optional(*item->sigma_ml + *other->sigma_ml) : std::nullopt;
    item->merged.push_back(label);
    scan.items.erase(other);
  }
}

void apply(CorrectedScan& scan, const SplitItem& action, int number) {
  const auto item = find_item(scan.items, action.item);
  const double fraction = action.volume_ml / *item->volume_ml;
  CorrectedItem part;
  part.label = kSplitLabelBase + number;
  part.dish = item->dish;
  part.status = item->status;
  part.food = action.food;
  part.volume_ml = action.volume_ml;
  part.is_wrong = item->is_wrong;
  part.split_from = action.item;
  item->volume_ml = *item->volume_ml - action.volume_ml;
  if (item->sigma_ml) {
    part.sigma_ml = *item->sigma_ml * fraction;
    item->sigma_ml = *item->sigma_ml - *part.sigma_ml;
  }
  scan.items.insert(std::next(item), part);
}

void apply(CorrectedScan& scan, const MarkItemWrong& action, int) {
  find_item(scan.items, action.item)->is_wrong = true;
}

void apply(CorrectedScan& scan, const MarkScanWrong&, int) {
  scan.is_wrong = true;
}

// The others undo: see holding_corrections().
void apply(CorrectedScan&, const UndoCorrection&, int) {}

std::vector<const Correction*> holding_corrections(std::span<const Correction> corrections) {
  std::vector<const Correction*> holding;
  for (const Correction& correction : corrections) {
    const auto* const undo = std::get_if<UndoCorrection>(&correction.action);
    if (undo == nullptr) {
      holding.push_back(&correction);
    } else if (!holding.empty() && holding.back()->number == undo->number) {
      holding.pop_back();
    }
  }
  return holding;
}

}  // namespace

CorrectedScan correct_scan(const std::vector<MeasuredItem>& measured,
                           std::span<const Correction> corrections) {
  CorrectedScan scan;
  std::transform(measured.begin(), measured.end(), std::back_inserter(scan.items), as_measured);
  for (const Correction* const correction : holding_corrections(corrections)) {
    if (!refuse_correction(scan, correction->action).empty()) continue;
    std::visit([&](const auto& action) { apply(scan, action, correction->number); }, correction->action);
    scan.holding.push_back(correction->number);
  }
  scan.is_corrected = !scan.holding.empty();
  return scan;
}

std::string refuse_correction(const CorrectedScan& scan, const CorrectionAction& action) {
  return std::visit([&](const auto& kind) { return refuse(scan, kind); }, action);
}

double booked_volume_ml(const CorrectedScan& scan) {
  if (scan.is_wrong) return 0.0;
  double volume_ml = 0.0;
  for (const CorrectedItem& item : scan.items) {
    if (!item.is_wrong) volume_ml += item.volume_ml.value_or(0.0);
  }
  return volume_ml;
}

}  // namespace traygauge
