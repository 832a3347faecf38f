// Specks of labels: what smoothed edges, JPEG and slips of the mouse leave in a label picture.
#pragma once

#include <vector>

#include "simulator/capture/input_error.hpp"
#include "simulator/capture/input_warning.hpp"
#include "simulator/capture/picture.hpp"

namespace traygauge {

// A speck is a connected part of a label that is smaller than 64 pixels and nowhere 3 × 3 pixels wide: too
// little for an item, which is measured from 64 pixels on. Hundreds of them, many labels that are nowhere
// wider, or labels along edges that lie between those of both sides: these are the edges of a picture that
// was smoothed, InputError. Of fewer, those are painted over with what is beside them that have no other part
// of their label near; a warning names them. The others are left alone: an item that is seen through a gap
// looks like this.
void ignore_specks(const InputFile& file, Picture& labels, std::vector<InputWarning>& warnings);

}  // namespace traygauge
