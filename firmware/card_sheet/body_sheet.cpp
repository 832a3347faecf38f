#include "firmware/card_sheet/body_sheet.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "firmware/card_sheet/body_page.hpp"
#include "firmware/card_sheet/page_ruler.hpp"

namespace traygauge {
namespace {

constexpr double kPageMarginMm = 8.0;  // where office printers print
constexpr double kPageTopMm = 38.0;    // below the heading and the ruler
constexpr double kPieceGapMm = 5.0;

struct NetBox {
  NetPoint low = NetPoint::Constant(std::numeric_limits<double>::max());
  NetPoint high = NetPoint::Constant(std::numeric_limits<double>::lowest());

  void add(const NetPoint& at) {
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  NetPoint size() const { return high - low; }
};

NetPoint turned(const NetPoint& at) {
  return {-at.y(), at.x()};
}

NetBox box_of(const NetPiece& piece, bool is_turned) {
  NetBox box;
  const auto add = [&](const NetPoint& at) { box.add(is_turned ? turned(at) : at); };
  for (const NetFace& face : piece.faces) std::ranges::for_each(face.net, add);
  for (const GlueTab& tab : piece.tabs) std::ranges::for_each(tab, add);
  return box;
}

// Fills pages from the top, row by row.
class PageFiller {
 public:
  explicit PageFiller(const SheetPaper& paper) : paper_(paper) {}

  void begin_page() {
    ++page_;
    at_ = {kPageMarginMm, kPageTopMm};
    row_height_mm_ = 0.0;
  }

  // A piece that no page holds stands where the first page of its own begins.
  void place(PlacedPiece placed, std::vector<PlacedPiece>& all) {
    NetBox box = box_of(placed.piece, false);
    placed.is_turned = box.size().x() > paper_.width_mm - 2.0 * kPageMarginMm;
    if (placed.is_turned) box = box_of(placed.piece, true);
    const NetPoint size = box.size();
    if (at_.x_mm + size.x() > paper_.width_mm - kPageMarginMm) {
      at_ = {kPageMarginMm, at_.y_mm + row_height_mm_ + kPieceGapMm};
      row_height_mm_ = 0.0;
    }
    if (at_.y_mm + size.y() > paper_.height_mm - kPageMarginMm) begin_page();
    placed.page = page_;
    placed.low = box.low;
    placed.height_mm = size.y();
    placed.corner = at_;
    at_.x_mm += size.x() + kPieceGapMm;
    row_height_mm_ = std::max(row_height_mm_, size.y());
    all.push_back(std::move(placed));
  }

 private:
  SheetPaper paper_;
  int page_ = 0;
  PagePoint at_;
  double row_height_mm_ = 0.0;
};

void write_heading(PagePen& pen, const SheetPaper& paper, const PlacedPiece& placed) {
  const double width_mm = paper.width_mm - 2.0 * kPageMarginMm;
  const std::string title =
      placed.piece.is_textured ? describe_body(*placed.body) : "Bottoms, this side outside";
  const std::string what = placed.piece.is_textured ? describe_size(*placed.body) + ". " : "";
  pen.write({kPageMarginMm + 2.0, 14.0}, title, {4.4, true}, width_mm);
  pen.write({kPageMarginMm + 2.0, 19.5},
            "Traygauge proof body. " + what + "Cut along thin lines, fold dashed lines, print outside.",
            {2.8, false}, width_mm);
  draw_millimetre_ruler(pen, {kPageMarginMm + 2.0, 28.0});
}

}  // namespace

PagePoint PlacedPiece::on_page(const NetPoint& at) const {
  const NetPoint placed = (is_turned ? turned(at) : at) - low;
  return {corner.x_mm + placed.x(), corner.y_mm + height_mm - placed.y()};
}

std::vector<PlacedPiece> lay_out_bodies(const SheetPaper& paper) {
  PageFiller filler(paper);
  std::vector<PlacedPiece> all;
  const auto place = [&](bool is_textured) {
    for (const ProofBody& body : proof_bodies()) {
      if (is_textured) filler.begin_page();
      const std::vector<NetPiece> pieces = unfold(body);
      for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (pieces[i].is_textured != is_textured) continue;
        PlacedPiece placed;
        placed.body = &body;
        placed.number = static_cast<int>(i);
        placed.piece = pieces[i];
        filler.place(std::move(placed), all);
      }
    }
  };
  place(true);
  filler.begin_page();
  place(false);
  return all;
}

void write_body_sheets(const std::filesystem::path& file, const SheetPaper& paper) {
  PagePen pen(paper.width_mm, paper.height_mm, "Traygauge proof bodies");
  write_instructions(pen, paper);
  int page = 0;
  for (const PlacedPiece& placed : lay_out_bodies(paper)) {
    if (placed.page != page) {
      pen.next_page();
      page = placed.page;
      write_heading(pen, paper, placed);
    }
    draw_piece(pen, placed);
  }
  pen.save(file);
}

}  // namespace traygauge
