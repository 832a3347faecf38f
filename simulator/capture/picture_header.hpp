// What a picture's file says of it before it is decoded.
#pragma once

#include <filesystem>
#include <optional>

#include "simulator/capture/picture.hpp"

namespace traygauge {

struct PictureHeader {
  PictureSize size;     // as stored
  int orientation = 1;  // of EXIF; 5 to 8: whoever shows the picture turns it by 90 degrees

  bool is_shown_turned() const { return orientation >= 5; }
};

// Of a JPEG or PNG; nothing where it is neither, or cannot be read.
std::optional<PictureHeader> peek_header(const std::filesystem::path& file);

}  // namespace traygauge
