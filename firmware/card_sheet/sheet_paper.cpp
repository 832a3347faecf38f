#include "firmware/card_sheet/sheet_paper.hpp"

#include "firmware/base/exit_status.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {

SheetPaper choose_paper(const std::string& name) {
  if (name == "a4") return kA4Paper;
  if (name == "letter") return kLetterPaper;
  throw UsageError("--paper: expected a4 or letter, found " + printable(name));
}

}  // namespace traygauge
