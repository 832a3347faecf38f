// What libjpeg's warnings mean for a picture: one rule for cameras and for files.
#pragma once

#include <cstdint>

struct jpeg_error_mgr;  // of jpeglib.h, which wants to be included in an order of its own

namespace traygauge {

enum class JpegWarning : std::uint8_t {
  few_bytes_too_many,  // before a marker: several cameras send them in every picture; every row is there
  end_missing,         // the end marker; whether rows are missing, too, another warning says
  damage,
};

// Of the warning that the library has just raised. It goes on after each, and invents what is missing.
JpegWarning judge_jpeg_warning(const jpeg_error_mgr& errors);

}  // namespace traygauge
