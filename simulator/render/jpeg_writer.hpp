// JPEG pictures out.
#pragma once

#include <filesystem>

#include "simulator/capture/picture.hpp"

namespace traygauge {

// RGB, baseline, colours at half the resolution as cameras store them. `quality`: 1 to 100. Throws
// OutputError, and leaves no half-written picture behind; std::invalid_argument for another format or
// quality.
void write_jpeg(const std::filesystem::path& file, const Picture& picture, int quality);

}  // namespace traygauge
