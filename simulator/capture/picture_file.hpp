// Pictures from files: JPEG by libjpeg-turbo, PNG by libpng. Every reader throws InputError, and reserves
// memory only for a size that it accepts. The orientation tag of a photograph is ignored: pixels as stored.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "simulator/capture/input_error.hpp"
#include "simulator/capture/input_warning.hpp"
#include "simulator/capture/picture.hpp"

namespace traygauge {

// JPEG or PNG by its first bytes; grey or RGB. `required`: the camera's size, when it is known. A JPEG that
// misses its end marker alone, or has a few bytes too many before a marker, is read; `warnings`, where given,
// get it.
Picture read_picture(const InputFile& file, std::optional<PictureSize> required = {},
                     std::vector<InputWarning>* warnings = nullptr);

// PNG whose values are labels: grey, the indices of a palette, or colours of three equal channels; 16 bits
// where no value is above 255. What is wholly transparent is background.
Picture read_label_picture(const InputFile& file, PictureSize required);

// 16-bit grey PNG.
DepthPicture read_depth_picture(const InputFile& file, PictureSize required);

// RGB to grey with the weights of BT.601, rounded.
Picture to_gray(const Picture& picture);

// By their first bytes.
bool is_jpeg(std::span<const std::uint8_t> bytes);
bool is_png(std::span<const std::uint8_t> bytes);

// The decoders behind read_picture, for bytes that are in memory already.
Picture decode_jpeg(const InputFile& file, std::span<const std::uint8_t> bytes,
                    std::optional<PictureSize> required, std::vector<InputWarning>* warnings = nullptr);
Picture decode_png(const InputFile& file, std::span<const std::uint8_t> bytes,
                   std::optional<PictureSize> required);

// InputError unless each side is 16 to 8192 pixels and the size is the required one.
void check_picture_size(const InputFile& file, std::uint64_t width, std::uint64_t height,
                        std::optional<PictureSize> required);

}  // namespace traygauge
