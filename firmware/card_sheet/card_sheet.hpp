// The sheet from which a reference card is made: both sides of it at true size, and rulers to check the
// print.
#pragma once

#include <filesystem>

#include "firmware/card_sheet/page_ruler.hpp"
#include "firmware/card_sheet/sheet_paper.hpp"

namespace traygauge {

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
