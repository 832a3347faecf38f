// What is drawn and written of a proof body on its page.
#pragma once

#include "firmware/card_sheet/body_sheet.hpp"

namespace traygauge {

// "R180, ridge: 180.0 ml".
std::string describe_body(const ProofBody& body);
// "length 100, width 80, height 45 mm".
std::string describe_size(const ProofBody& body);

// Texture, folds, tabs and cuts; a bottom carries the body's id, size and volume instead of a texture.
void draw_piece(PagePen& pen, const PlacedPiece& placed);

// The first page: what to do, a table of the bodies.
void write_instructions(PagePen& pen, const SheetPaper& paper);

}  // namespace traygauge
