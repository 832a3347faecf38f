// Rulers by which people check that a page was printed at its true size.
#pragma once

#include "firmware/card_sheet/page_pen.hpp"

namespace traygauge {

inline constexpr double kRulerMm = 100.0;
inline constexpr double kInchRulerMm = 4 * 25.4;

PagePoint moved(PagePoint point, double x_mm, double y_mm);

// To the right of `zero`, the end at 0 of their base line, with their unit behind them.
void draw_millimetre_ruler(PagePen& pen, PagePoint zero);
void draw_inch_ruler(PagePen& pen, PagePoint zero);

}  // namespace traygauge
