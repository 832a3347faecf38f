// The sheets from which proof bodies are folded.
#pragma once

#include <filesystem>
#include <vector>

#include "firmware/card_sheet/page_pen.hpp"
#include "firmware/card_sheet/sheet_paper.hpp"
#include "simulator/bodies/body_net.hpp"

namespace traygauge {

// A piece on a page; it may be turned by a right angle there.
struct PlacedPiece {
  const ProofBody* body = nullptr;
  int number = 0;  // of unfold()
  NetPiece piece;
  int page = 0;  // from 0
  bool is_turned = false;
  NetPoint low = NetPoint::Zero();  // of the piece's lines, as it is turned
  PagePoint corner;                 // where the upper left end of the piece's lines comes to lie
  double height_mm = 0.0;

  PagePoint on_page(const NetPoint& at) const;
};

// All pieces of all proof bodies: a page for each shell and what fits beside it, bottoms on pages of their
// own. Page 0 is the instructions'.
std::vector<PlacedPiece> lay_out_bodies(const SheetPaper& paper);

// A PDF with a ruler on each page, its lengths exact. Throws OutputError.
void write_body_sheets(const std::filesystem::path& file, const SheetPaper& paper);

}  // namespace traygauge
