// The papers that sheets are printed on.
#pragma once

#include <string>

namespace traygauge {

struct SheetPaper {
  double width_mm = 0.0;
  double height_mm = 0.0;
  bool has_inches = false;  // a ruler in inches, too
};
inline constexpr SheetPaper kA4Paper{210.0, 297.0, false};
inline constexpr SheetPaper kLetterPaper{215.9, 279.4, true};

// "a4" or "letter", as typed after --paper. Throws UsageError.
SheetPaper choose_paper(const std::string& name);

}  // namespace traygauge
