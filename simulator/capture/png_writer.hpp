// PNG pictures out.
#pragma once

#include <filesystem>

#include "core/image_view/image_view.hpp"
#include "simulator/capture/output_file.hpp"
#include "simulator/capture/picture.hpp"

namespace traygauge {

// 8-bit grey or RGB. Throws OutputError, and leaves no half-written picture behind.
void write_png(const std::filesystem::path& file, const FrameView& picture);

// 16-bit grey, for the rest as write_png.
void write_depth_png(const std::filesystem::path& file, const DepthPicture& depth);

}  // namespace traygauge
