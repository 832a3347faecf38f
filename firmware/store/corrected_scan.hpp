// A scan as people corrected it, beside what was measured.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/store/correction.hpp"
#include "firmware/store/scan_document.hpp"

namespace traygauge {

// A part that the correction with number n split off has the label kSplitLabelBase + n.
inline constexpr int kSplitLabelBase = 1000;

struct CorrectedItem {
  int label = 0;
  int dish = 0;
  std::string status;
  std::string food;                 // empty where nothing names it
  std::optional<double> volume_ml;  // none where it was not measured
  std::optional<double> sigma_ml;
  bool is_wrong = false;
  // As measured, whatever was corrected; none of a part that was split off.
  std::string measured_food;
  std::optional<double> measured_volume_ml;
  std::optional<double> measured_sigma_ml;
  std::optional<int> split_from;  // the item that it was a part of
  std::vector<int> merged;        // the items that became part of it

  friend bool operator==(const CorrectedItem&, const CorrectedItem&) = default;
};

struct CorrectedScan {
  std::vector<CorrectedItem> items;  // without those that were merged into others
  bool is_wrong = false;             // the scan as a whole
  bool is_corrected = false;
  std::vector<int> holding;  // numbers of the corrections that hold, oldest first

  friend bool operator==(const CorrectedScan&, const CorrectedScan&) = default;
};

// The corrections have to be all of this scan, oldest first.
CorrectedScan correct_scan(const std::vector<MeasuredItem>& measured,
                           std::span<const Correction> corrections);

// Why this action cannot follow, for who asked for it; empty where it can.
std::string refuse_correction(const CorrectedScan& scan, const CorrectionAction& action);

// Of the items that are not marked as wrong, of a scan that is not; ml.
double booked_volume_ml(const CorrectedScan& scan);

}  // namespace traygauge
