// What recordings of captures and of single pictures share.
#pragma once

#include <filesystem>
#include <string>

#include "simulator/capture/picture.hpp"

namespace traygauge {

// Throws OutputError where it cannot be made.
void make_output_folder(const std::filesystem::path& folder);

// "0007".
std::string four_digits(int number);

// As PNG has it, red first; grey stays grey.
Picture as_rgb(const FrameView& frame);

}  // namespace traygauge
