// The card in label pictures where nobody outlined it.
#pragma once

#include <array>
#include <vector>

#include "firmware/measure/measure_report.hpp"
#include "firmware/measure/pair_setup.hpp"
#include "simulator/capture/capture.hpp"

namespace traygauge {

// Looks for the card in the pictures whose labels have none, as where all labels are to be found, and
// outlines it there. A label that lies on it almost whole is the card under another number. A warning names
// each file; where the card is not found, the labels stay as they are.
void outline_missing_cards(const PairSetup& setup, const std::array<const ViewDescription*, 2>& descriptions,
                           std::array<LoadedView, 2>& views, std::vector<ReportedWarning>& warnings);

}  // namespace traygauge
