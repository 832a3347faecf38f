// The dishes that a capture is measured with.
#pragma once

#include <string>
#include <vector>

#include "simulator/capture/capture.hpp"

namespace traygauge {

// One dish of label 1, or none named: what profile paper measures.
bool has_one_dish(const Capture& capture);
// Throws InputError where it has not.
void require_one_dish(const Capture& capture);

// The capture's dishes, or where it names none, those of the library in the folder `config` (empty: the usual
// one) as candidates for the only dish. Throws InputError.
std::vector<DishDescription> choose_dishes(const Capture& capture, const std::string& config);

}  // namespace traygauge
