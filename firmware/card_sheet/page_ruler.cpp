#include "firmware/card_sheet/page_ruler.hpp"

#include <string>

namespace traygauge {
namespace {

constexpr double kTickMm = 0.2;
constexpr PageText kNumber{2.8, false};
constexpr PageText kUnit{3.2, false};

struct RulerScale {
  int ticks = 0;
  double tick_mm = 0.0;
  int ticks_a_number = 0;
  int units_a_number = 0;
};
constexpr RulerScale kMillimetres{100, 1.0, 10, 10};
constexpr RulerScale kInches{32, 25.4 / 8, 8, 1};

// Long ticks have a number, middle ones stand half way between them.
double tick_length_mm(int tick, const RulerScale& scale) {
  if (tick % scale.ticks_a_number == 0) return 4.0;
  return 2 * tick % scale.ticks_a_number == 0 ? 3.0 : 2.0;
}

void draw_ruler(PagePen& pen, PagePoint zero, const RulerScale& scale) {
  pen.line(zero, moved(zero, scale.ticks * scale.tick_mm, 0.0), kTickMm);
  for (int i = 0; i <= scale.ticks; ++i) {
    const PagePoint at = moved(zero, i * scale.tick_mm, 0.0);
    pen.line(at, moved(at, 0.0, -tick_length_mm(i, scale)), kTickMm);
    if (i % scale.ticks_a_number != 0) continue;
    const int number = i / scale.ticks_a_number * scale.units_a_number;
    pen.write_centred(moved(at, 0.0, 3.2), std::to_string(number), kNumber);
  }
}

}  // namespace

PagePoint moved(PagePoint point, double x_mm, double y_mm) {
  return {point.x_mm + x_mm, point.y_mm + y_mm};
}

void draw_millimetre_ruler(PagePen& pen, PagePoint zero) {
  draw_ruler(pen, zero, kMillimetres);
  pen.write(moved(zero, kRulerMm + 4.0, 0.0), "mm", kUnit, 20.0);
}

void draw_inch_ruler(PagePen& pen, PagePoint zero) {
  draw_ruler(pen, zero, kInches);
  pen.write(moved(zero, kInchRulerMm + 4.0, 0.0), "inches", kUnit, 20.0);
}

}  // namespace traygauge
