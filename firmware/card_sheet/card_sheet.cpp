#include "firmware/card_sheet/card_sheet.hpp"

#include <array>
#include <string>

#include "firmware/card/card_drawing.hpp"
#include "firmware/card_sheet/page_ruler.hpp"

namespace traygauge {
namespace {

constexpr double kHairMm = 0.1;
constexpr double kEdgeMm = 0.4;  // as of the pattern's own line
constexpr PageText kPlain{3.2, false};
constexpr PageText kSmall{2.8, false};
constexpr PageText kHeading{5.6, true};

struct Step {
  const char* english;
  const char* german;
};
constexpr std::array<Step, 5> kSteps{
    {{"1. Print on plain white paper at 100 %. The ruler above must be 100 mm long; if it is not, print "
      "again.",
      "Auf weißes Papier mit 100 % drucken. Das Lineal oben muss 100 mm lang sein; sonst neu drucken."},
     {"2. Cut out both sides along the outer edge of the black line; the marks at the corners show where.",
      "Beide Seiten an der Außenkante der schwarzen Linie ausschneiden; die Marken an den Ecken zeigen sie."},
     {"3. Glue them flat onto a plastic card of credit-card size, one on each side. No film over it: gloss "
      "hides the pattern.",
      "Flach auf beide Seiten einer Plastikkarte im Scheckkartenformat kleben. Keine Folie darüber: Glanz "
      "verdeckt das Muster."},
     {"4. Measure the card with a caliper, between the outer edges of the black line, and its thickness.",
      "Die Karte mit einer Schieblehre messen, zwischen den Außenkanten der schwarzen Linie, und ihre "
      "Dicke."},
     {"5. traygauge card --measured WIDTHxHEIGHTxTHICKNESS says which lines the station file needs. card.png "
      "belongs beside that file.",
      "traygauge card --measured BREITExHÖHExDICKE sagt, welche Zeilen in die Datei der Station gehören. "
      "card.png gehört daneben."}}};

// Eight short lines that point at the corners and stay clear of the card.
void draw_cut_marks(PagePen& pen, PagePoint corner) {
  constexpr double kGapMm = 1.5;
  constexpr double kLengthMm = 5.0;
  for (const double x : {0.0, kCardWidthMm}) {
    const double out = x > 0.0 ? 1.0 : -1.0;
    for (const double y : {0.0, kCardHeightMm}) {
      const double down = y > 0.0 ? 1.0 : -1.0;
      const PagePoint at = moved(corner, x, y);
      pen.line(moved(at, out * kGapMm, 0.0), moved(at, out * (kGapMm + kLengthMm), 0.0), kHairMm);
      pen.line(moved(at, 0.0, down * kGapMm), moved(at, 0.0, down * (kGapMm + kLengthMm)), kHairMm);
    }
  }
}

void draw_pattern(PagePen& pen, PagePoint corner, int pattern) {
  pen.begin_clip(corner, kCardWidthMm, kCardHeightMm);
  for (const CardShape& shape : draw_card(pattern)) {
    for (std::size_t i = 0; i < shape.corners.size(); ++i) {
      const PagePoint at = moved(corner, static_cast<double>(shape.corners[i].x) / kCardUnitsPerMm,
                                 static_cast<double>(shape.corners[i].y) / kCardUnitsPerMm);
      if (i == 0) {
        pen.move_to(at);
      } else {
        pen.line_to(at);
      }
    }
    pen.fill(shape.is_ink);
  }
  pen.end_clip();
}

void draw_edge(PagePen& pen, PagePoint corner) {
  constexpr double kHalf = 0.5 * kEdgeMm;
  for (const double y : {kHalf, kCardHeightMm - kHalf})
    pen.line(moved(corner, 0.0, y), moved(corner, kCardWidthMm, y), kEdgeMm);
  for (const double x : {kHalf, kCardWidthMm - kHalf})
    pen.line(moved(corner, x, 0.0), moved(corner, x, kCardHeightMm), kEdgeMm);
}

void draw_back(PagePen& pen, PagePoint corner, int pattern) {
  constexpr double kMarginMm = 4.0;
  constexpr double kWidthMm = kCardWidthMm - 2.0 * kMarginMm;
  draw_edge(pen, corner);
  pen.write(moved(corner, kMarginMm, 13.0), card_id(pattern), {11.0, true}, kWidthMm);
  pen.write(moved(corner, 42.0, 8.0), "Traygauge reference card", {2.6, true}, kWidthMm);
  pen.write(moved(corner, 42.0, 12.5), "drawn: 85.60 × 53.98 mm", kSmall, kWidthMm);
  pen.write(moved(corner, kMarginMm, 20.0), "measured: _______ × _______ × ______ mm", kPlain, kWidthMm);
  const double english_end =
      pen.write(moved(corner, kMarginMm, 27.0),
                "This side down. Lay the card flat beside the dish, on what the dish stands on, the pattern "
                "up and all of it in both pictures. Do not move it between them.",
                kSmall, kWidthMm);
  pen.write({corner.x_mm + kMarginMm, english_end + 1.2},
            "Diese Seite nach unten. Die Karte flach neben das Geschirr legen, auf dieselbe Fläche, das "
            "Muster nach oben und in beiden Bildern ganz zu sehen. Dazwischen nicht bewegen.",
            kSmall, kWidthMm);
}

void write_headings(PagePen& pen, const SheetLayout& layout, int pattern) {
  pen.write({layout.left_mm, 16.0}, "Traygauge reference card " + card_id(pattern), {4.4, false},
            layout.text_width_mm);
  pen.write({layout.left_mm, 25.0}, "Print at 100 % (actual size). Do not fit to page.", kHeading,
            layout.text_width_mm);
  pen.write({layout.left_mm, 33.0}, "Mit 100 % drucken. Nicht an Seite anpassen.", kHeading,
            layout.text_width_mm);
}

void write_steps(PagePen& pen, const SheetLayout& layout, double y_mm) {
  for (const Step& step : kSteps) {
    y_mm = pen.write({layout.left_mm, y_mm}, step.english, kPlain, layout.text_width_mm);
    y_mm = pen.write({layout.left_mm + 4.0, y_mm}, step.german, kSmall, layout.text_width_mm - 4.0) + 1.4;
  }
}

}  // namespace

SheetLayout lay_out_sheet(const SheetPaper& paper) {
  constexpr double kMarginMm = 18.0;
  const double card_x_mm = 0.5 * (paper.width_mm - kCardWidthMm);
  return {{0.5 * (paper.width_mm - kRulerMm), 43.0},
          {0.5 * (paper.width_mm - kInchRulerMm), 55.0},
          {card_x_mm, 73.0},
          {card_x_mm, 146.0},
          kMarginMm,
          paper.width_mm - 2.0 * kMarginMm};
}

void write_card_sheet(const std::filesystem::path& file, int pattern, const SheetPaper& paper) {
  const SheetLayout layout = lay_out_sheet(paper);
  PagePen pen(paper.width_mm, paper.height_mm, "Traygauge reference card " + card_id(pattern));
  write_headings(pen, layout, pattern);
  draw_millimetre_ruler(pen, layout.ruler);
  if (paper.has_inches) draw_inch_ruler(pen, layout.inch_ruler);
  pen.write(moved(layout.front, 0.0, -8.0), "Front, for the upper side / Vorderseite, nach oben", kPlain,
            layout.text_width_mm);
  draw_cut_marks(pen, layout.front);
  draw_pattern(pen, layout.front, pattern);
  pen.write(moved(layout.back, 0.0, -8.0), "Back, for the lower side / Rückseite, nach unten", kPlain,
            layout.text_width_mm);
  draw_cut_marks(pen, layout.back);
  draw_back(pen, layout.back, pattern);
  write_steps(pen, layout, 212.0);
  pen.save(file);
}

}  // namespace traygauge
