#include "firmware/card_sheet/body_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "firmware/base/text.hpp"
#include "firmware/card_sheet/page_ruler.hpp"
#include "simulator/bodies/body_texture.hpp"

namespace traygauge {
namespace {

constexpr double kCutMm = 0.15;
constexpr double kFoldMm = 0.2;
constexpr double kDashMm = 1.5;
constexpr double kOverlapMm = 0.02;  // of neighbouring squares, so that no viewer shows paper between them
constexpr PageText kInstructionText{3.4, false};
constexpr PageText kGermanText{2.9, false};
constexpr PageText kLabel{2.8, false};

struct Instruction {
  const char* english;
  const char* german;
};
constexpr std::array<Instruction, 7> kInstructions{
    {{"1. Print in grey at 100 % on stiff matt paper of 120 to 200 g/m², 0.15 to 0.25 mm thick. The ruler on "
      "each page must be 100 mm long; if it is not, print again.",
      "In Grau mit 100 % auf steifes mattes Papier von 120 bis 200 g/m² drucken, 0,15 bis 0,25 mm dick. Das "
      "Lineal jeder Seite muss 100 mm lang sein; sonst neu drucken."},
     {"2. Score all dashed lines with a blunt blade along a ruler. Cut along the thin lines.",
      "Alle gestrichelten Linien mit stumpfer Klinge am Lineal ritzen. An den dünnen Linien schneiden."},
     {"3. Fold with the print outside. The white tabs go inside; glue them below the neighbouring face, edge "
      "to edge.",
      "Mit dem Druck nach außen falten. Die weißen Laschen kommen nach innen und werden unter die "
      "Nachbarfläche geklebt, Kante an Kante."},
     {"4. Fold the lowest tabs inward and glue the white bottom with the body's number under them. Faces "
      "must be "
      "flat; fill a large body with crumpled paper or foam before you close it.",
      "Die untersten Laschen nach innen falten und den weißen Boden mit der Nummer darunter kleben. Die "
      "Flächen müssen eben sein; große Körper vor dem Schließen mit Papier oder Schaum füllen."},
     {"5. The nominal volume is that of the drawn lines. Paper of 0.2 mm adds up to 0.1 mm on each side and "
      "0.2 mm in height: 0.9 % of C400, 1.7 % of C50. Folds by hand are good to 0.3 mm.",
      "Das Nennvolumen ist das der gezeichneten Linien. Papier von 0,2 mm trägt je Seite bis 0,1 mm auf und "
      "0,2 mm in der Höhe: 0,9 % von C400, 1,7 % von C50. Von Hand wird auf 0,3 mm genau gefaltet."},
     {"6. Better: measure the finished body with a caliper, each length in three places, and write the means "
      "into the plan as measured_mm. The volume is then computed from them.",
      "Besser: den fertigen Körper mit der Schieblehre messen, jede Länge an drei Stellen, und die Mittel "
      "als "
      "measured_mm in den Plan schreiben. Daraus wird das Volumen berechnet."},
     {"7. traygauge verify plan writes the plan, traygauge verify run PLAN leads through it, traygauge "
      "verify "
      "report writes the certificate.",
      "traygauge verify plan schreibt den Plan, traygauge verify run PLAN führt hindurch, traygauge verify "
      "report schreibt das Zertifikat."}}};

std::vector<PagePoint> on_page(const PlacedPiece& placed, const NetPolygon& polygon) {
  std::vector<PagePoint> points;
  points.reserve(polygon.size());
  for (const NetPoint& at : polygon) points.push_back(placed.on_page(at));
  return points;
}

struct Square {
  int column = 0;
  int row = 0;
};

void add_square(PagePen& pen, const PlacedPiece& placed, const Square& square) {
  const double left = kBodyCellMm * square.column - kOverlapMm;
  const double low = kBodyCellMm * square.row - kOverlapMm;
  const double right = kBodyCellMm * (square.column + 1) + kOverlapMm;
  const double high = kBodyCellMm * (square.row + 1) + kOverlapMm;
  pen.move_to(placed.on_page({left, low}));
  for (const NetPoint& corner : {NetPoint(right, low), NetPoint(right, high), NetPoint(left, high)})
    pen.line_to(placed.on_page(corner));
}

// The squares that a face may need, by their grey.
std::map<int, std::vector<Square>> squares_of(const PlacedPiece& placed, const NetPolygon& face) {
  NetPoint low = face.front();
  NetPoint high = face.front();
  for (const NetPoint& corner : face) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const auto cell = [](double at) { return static_cast<int>(std::floor(at / kBodyCellMm)); };
  std::map<int, std::vector<Square>> squares;
  for (int row = cell(low.y()); row <= cell(high.y()); ++row) {
    for (int column = cell(low.x()); column <= cell(high.x()); ++column)
      squares[body_cell_gray(placed.body->id, placed.number, column, row)].push_back({column, row});
  }
  return squares;
}

// One shape a grey, because cairo writes the clip anew for each shape.
void draw_texture(PagePen& pen, const PlacedPiece& placed, const NetPolygon& face) {
  pen.begin_clip(on_page(placed, face));
  for (const auto& [gray, squares] : squares_of(placed, face)) {
    for (const Square& square : squares) add_square(pen, placed, square);
    pen.fill_gray(gray);
  }
  pen.end_clip();
}

void write_label(PagePen& pen, const PlacedPiece& placed) {
  const NetPolygon& face = placed.piece.faces.front().net;
  NetPoint middle = NetPoint::Zero();
  for (const NetPoint& corner : face) middle += corner / static_cast<double>(face.size());
  const PagePoint at = placed.on_page(middle);
  pen.write_centred(moved(at, 0.0, -5.0), std::string(placed.body->id), {8.0, true});
  pen.write_centred(moved(at, 0.0, 0.0),
                    fixed(body_volume_ml(placed.body->kind, placed.body->size_mm), 1) + " ml", {4.0, false});
  double y = 5.0;
  const auto names = size_names(placed.body->kind);
  for (std::size_t i = 0; i < names.size(); ++i, y += 3.6) {
    pen.write_centred(moved(at, 0.0, y),
                      std::string(names[i]) + " " + fixed(placed.body->size_mm[i], 0) + ": _____ mm", kLabel);
  }
}

// Columns from the left margin.
constexpr std::array<double, 4> kColumnsMm = {0.0, 18.0, 50.0, 150.0};

void write_row(PagePen& pen, double left_mm, double y_mm, const std::array<std::string, 4>& cells,
               bool is_bold) {
  for (std::size_t i = 0; i < cells.size(); ++i)
    pen.write({left_mm + kColumnsMm[i], y_mm}, cells[i], {3.4, is_bold}, 100.0);
}

}  // namespace

std::string describe_body(const ProofBody& body) {
  return std::string(body.id) + ", " + std::string(name(body.kind)) + ": " +
         fixed(body_volume_ml(body.kind, body.size_mm), 1) + " ml";
}

std::string describe_size(const ProofBody& body) {
  std::string text;
  const auto names = size_names(body.kind);
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : ", ") + std::string(names[i]) + " " + fixed(body.size_mm[i], 0);
  return text + " mm";
}

void draw_piece(PagePen& pen, const PlacedPiece& placed) {
  if (placed.piece.is_textured) {
    for (const NetFace& face : placed.piece.faces) draw_texture(pen, placed, face.net);
  } else {
    write_label(pen, placed);
  }
  for (const NetPolygon& cut : placed.piece.cuts) {
    for (std::size_t i = 1; i < cut.size(); ++i)
      pen.line(placed.on_page(cut[i - 1]), placed.on_page(cut[i]), kCutMm);
  }
  for (const GlueTab& tab : placed.piece.tabs)
    pen.dashed_line(placed.on_page(tab[0]), placed.on_page(tab[1]), kFoldMm, kDashMm);
  for (const NetLine& fold : placed.piece.folds)
    pen.dashed_line(placed.on_page(fold[0]), placed.on_page(fold[1]), kFoldMm, kDashMm);
}

void write_instructions(PagePen& pen, const SheetPaper& paper) {
  constexpr double kTextMarginMm = 18.0;
  const double width_mm = paper.width_mm - 2.0 * kTextMarginMm;
  pen.write({kTextMarginMm, 18.0}, "Traygauge proof bodies", {6.4, true}, width_mm);
  pen.write({kTextMarginMm, 27.0}, "Print at 100 % (actual size). Do not fit to page.", {4.4, true},
            width_mm);
  pen.write({kTextMarginMm, 34.0}, "Mit 100 % drucken. Nicht an Seite anpassen.", {4.4, true}, width_mm);
  draw_millimetre_ruler(pen, {kTextMarginMm, 46.0});
  if (paper.has_inches) draw_inch_ruler(pen, {kTextMarginMm, 58.0});
  double y = paper.has_inches ? 72.0 : 62.0;
  for (const Instruction& instruction : kInstructions) {
    y = pen.write({kTextMarginMm, y}, instruction.english, kInstructionText, width_mm);
    y = pen.write({kTextMarginMm + 4.0, y}, instruction.german, kGermanText, width_mm - 4.0) + 2.0;
  }
  y += 6.0;
  write_row(pen, kTextMarginMm, y, {"body", "kind", "drawn size in mm", "volume in ml"}, true);
  for (const ProofBody& body : proof_bodies()) {
    y += 6.0;
    std::string size = describe_size(body);
    size.erase(size.size() - 3);
    write_row(pen, kTextMarginMm, y,
              {std::string(body.id), std::string(name(body.kind)), size,
               fixed(body_volume_ml(body.kind, body.size_mm), 2)},
              false);
  }
}

}  // namespace traygauge
