// What a person may say about a scan that was measured.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/base/wall_clock.hpp"

namespace traygauge {

// Items are named by their labels: those of the document, or of a part that was split off.
struct RenameItem {
  int item = 0;
  std::string food;
  friend bool operator==(const RenameItem&, const RenameItem&) = default;
};

// The others become part of `item`: one food that was measured as several.
struct MergeItems {
  int item = 0;
  std::vector<int> others;
  friend bool operator==(const MergeItems&, const MergeItems&) = default;
};

// A part of `item` is another food.
struct SplitItem {
  int item = 0;
  double volume_ml = 0.0;
  std::string food;  // empty: not named yet
  friend bool operator==(const SplitItem&, const SplitItem&) = default;
};

struct MarkItemWrong {
  int item = 0;
  friend bool operator==(const MarkItemWrong&, const MarkItemWrong&) = default;
};

struct MarkScanWrong {
  friend bool operator==(const MarkScanWrong&, const MarkScanWrong&) = default;
};

// Takes back the last correction that still holds; its number guards against two people at once.
struct UndoCorrection {
  int number = 0;
  friend bool operator==(const UndoCorrection&, const UndoCorrection&) = default;
};

using CorrectionAction =
    std::variant<RenameItem, MergeItems, SplitItem, MarkItemWrong, MarkScanWrong, UndoCorrection>;

struct Correction {
  int number = 0;  // of its scan, from 1
  WallTime made;
  std::string author;
  std::string reason;
  CorrectionAction action;
};

// {"action":"rename","item":2,"food":"rice"}; {"action":"merge","item":2,"others":[3]};
// {"action":"split","item":2,"volume_ml":40,"food":"peas"}; {"action":"item_wrong","item":2};
// {"action":"scan_wrong"}; {"action":"undo","number":3}
std::string correction_json(const CorrectionAction& action);
// Other keys are passed over. Fails with a sentence about the key.
Expected<CorrectionAction> parse_correction(std::string_view json);

}  // namespace traygauge
