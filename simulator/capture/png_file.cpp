#include <cstddef>
#include <string>
#include <vector>

#include "simulator/capture/input_bytes.hpp"
#include "simulator/capture/picture_file.hpp"
#include "simulator/capture/png_decoder.hpp"

namespace traygauge {

std::string describe_layout(const PngDecoder& decoder) {
  const char* kind = "grey";
  if (decoder.color_type() == PNG_COLOR_TYPE_PALETTE) kind = "palette";
  if (decoder.color_type() == PNG_COLOR_TYPE_RGB) kind = "RGB";
  if (decoder.color_type() == PNG_COLOR_TYPE_RGB_ALPHA) kind = "RGB with transparency";
  if (decoder.color_type() == PNG_COLOR_TYPE_GRAY_ALPHA) kind = "grey with transparency";
  return std::to_string(decoder.bit_depth()) + "-bit " + kind;
}

void read_header(PngDecoder& decoder, const InputFile& file, std::optional<PictureSize> required) {
  if (!decoder.read_header()) refuse_damaged_png(decoder, file);
  check_picture_size(file, decoder.width(), decoder.height(), required);
}

void refuse_damaged_png(const PngDecoder& decoder, const InputFile& file) {
  throw InputError(file, "a whole, undamaged PNG picture", decoder.message(),
                   "copy or take the picture again");
}

Picture decode_png(const InputFile& file, std::span<const std::uint8_t> bytes,
                   std::optional<PictureSize> required) {
  PngDecoder decoder(bytes);
  read_header(decoder, file, required);
  if (decoder.bit_depth() > 8) {
    throw InputError(file, "8 bits a channel", describe_layout(decoder), "convert it to 8-bit grey or RGB");
  }
  if (!decoder.expand_to_picture()) refuse_damaged_png(decoder, file);
  const bool gray = (decoder.color_type() & PNG_COLOR_MASK_COLOR) == 0;
  Picture picture({static_cast<int>(decoder.width()), static_cast<int>(decoder.height())},
                  gray ? PixelFormat::gray8 : PixelFormat::rgb8);
  if (!decoder.read_rows(picture.pixels.data(), static_cast<std::size_t>(picture.stride_bytes()))) {
    refuse_damaged_png(decoder, file);
  }
  return picture;
}

DepthPicture read_depth_picture(const InputFile& file, PictureSize required) {
  constexpr const char* expected = "16-bit grey PNG";
  constexpr const char* hint = "store depth as 16-bit grey PNG";
  const std::vector<std::uint8_t> bytes = read_bytes(file, kMaxPictureFileBytes, expected);
  if (!is_png(bytes)) {
    throw InputError(file, expected, bytes.empty() ? "an empty file" : "bytes of another kind", hint);
  }
  PngDecoder decoder(bytes);
  read_header(decoder, file, required);
  if (decoder.color_type() != PNG_COLOR_TYPE_GRAY || decoder.bit_depth() != 16) {
    throw InputError(file, expected, describe_layout(decoder), hint);
  }
  const std::size_t stride = 2 * static_cast<std::size_t>(required.width);
  std::vector<std::uint8_t> samples(stride * static_cast<std::size_t>(required.height));
  if (!decoder.read_rows(samples.data(), stride)) refuse_damaged_png(decoder, file);
  DepthPicture depth{required, std::vector<std::uint16_t>(samples.size() / 2)};
  for (std::size_t i = 0; i < depth.pixels.size(); ++i) {  // PNG stores the high byte first
    depth.pixels[i] = static_cast<std::uint16_t>(samples[2 * i] << 8U | samples[2 * i + 1]);
  }
  return depth;
}

}  // namespace traygauge
