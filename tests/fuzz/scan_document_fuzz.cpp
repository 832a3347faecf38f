// A scan's document and, each after a zero byte, corrections of it, as the hub reads them: whatever is
// accepted keeps its meaning when it is written, and the corrected scan is one that can be booked.
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/store/corrected_scan.hpp"
#include "firmware/store/scan_document.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace traygauge {
namespace {

void check_document(const std::string& text, const ScanDocument& document) {
  demand(is_same_document(text, text), "a document says the same as itself");
  demand(!document.id.station.empty(), "whose scan it is");
  for (const MeasuredItem& item : document.items) {
    demand(!item.volume_ml || std::isfinite(*item.volume_ml), "a volume that is a number");
    demand(!item.sigma_ml || std::isfinite(*item.sigma_ml), "a sigma that is a number");
  }
}

CorrectionAction written_and_read(const CorrectionAction& action) {
  const Expected<CorrectionAction> again = parse_correction(correction_json(action));
  demand(again.ok() && *again == action, "a correction stays the same when it is written");
  return *again;
}

void check_corrected(const CorrectedScan& scan) {
  const double booked_ml = booked_volume_ml(scan);
  demand(std::isfinite(booked_ml), "what is booked is a number");
  for (std::size_t i = 0; i < scan.items.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) demand(scan.items[i].label != scan.items[k].label, "no label twice");
  }
}

}  // namespace
}  // namespace traygauge

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace traygauge;
  std::string_view rest = text_of_input(data, size);
  const std::string text(take_until(rest, '\0'));
  const Expected<ScanDocument> document = read_scan_document(text);
  if (!document.ok()) {
    demand(!document.failure().empty(), "a sentence about the document");
    return 0;
  }
  check_document(text, *document);
  std::vector<Correction> corrections;
  while (!rest.empty()) {
    const Expected<CorrectionAction> action = parse_correction(take_until(rest, '\0'));
    if (!action.ok()) {
      demand(!action.failure().empty(), "a sentence about the correction");
      continue;
    }
    const CorrectedScan before = correct_scan(document->items, corrections);
    if (!refuse_correction(before, *action).empty()) continue;
    corrections.push_back(
        {static_cast<int>(corrections.size()) + 1, {}, "somebody", "", written_and_read(*action)});
    check_corrected(correct_scan(document->items, corrections));
  }
  return 0;
}
