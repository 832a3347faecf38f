// The sheet from which a reference card is made: both sides of it at true size, and rulers to check the
// print.
#pragma once

#include <filesystem>

#include "firmware/card_sheet/page_pen.hpp"

namespace traygauge {

struct SheetPaper {
  double width_mm = 0.0;
  double height_mm = 0.0;
  bool has_inches = false;  // a ruler in inches, too
};
inline constexpr SheetPaper kA4Paper{210.0, 297.0, false};
inline constexpr SheetPaper kLetterPaper{215.9, 279.4, true};

inline constexpr double kRulerMm = 100.0;
inline constexpr double kInchRulerMm = 4 * 25.4;

// Where things stand on the sheet.
struct SheetLayout {
  PagePoint ruler;       // the end at 0 of its base line
  PagePoint inch_ruler;  // the same
  PagePoint front;       // the card's top left corner
  PagePoint back;
  double left_mm = 0.0;  // of texts
  double text_width_mm = 0.0;
};
SheetLayout lay_out_sheet(const SheetPaper& paper);

// One page as PDF, its lengths exact, the pattern as shapes. Throws OutputError.
void write_card_sheet(const std::filesystem::path& file, int pattern, const SheetPaper& paper);

}  // namespace traygauge
