// Label pictures as people's tools store them.
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "simulator/capture/input_bytes.hpp"
#include "simulator/capture/picture_file.hpp"
#include "simulator/capture/png_decoder.hpp"

namespace traygauge {
namespace {

constexpr const char* kLabelPng = "a PNG picture of labels";
constexpr const char* kLabelHint =
    "store the labels as 8-bit grey PNG: 0 background, 1 dish, 2 to 199 food, 255 card";

// A decoded picture of one or two bytes a sample; the last of two or four channels is opacity.
struct LabelSamples {
  std::vector<std::uint8_t> bytes;
  std::size_t channels = 1;
  std::size_t sample_bytes = 1;

  unsigned value(std::size_t pixel, std::size_t channel) const {
    const std::uint8_t* sample = &bytes[(pixel * channels + channel) * sample_bytes];
    return sample_bytes == 1 ? sample[0] : (static_cast<unsigned>(sample[0]) << 8U) + sample[1];
  }
  std::size_t colours() const { return channels - (channels % 2 == 0 ? 1 : 0); }
  bool is_transparent(std::size_t pixel) const {
    return colours() < channels && value(pixel, channels - 1) == 0;
  }
  bool has_equal_colours(std::size_t pixel) const {
    return colours() == 1 || (value(pixel, 0) == value(pixel, 1) && value(pixel, 0) == value(pixel, 2));
  }
};

std::string place_of(std::size_t pixel, PictureSize size) {
  const auto width = static_cast<std::size_t>(size.width);
  return " at x " + std::to_string(pixel % width) + ", y " + std::to_string(pixel / width);
}

std::uint8_t label_at(const LabelSamples& samples, std::size_t pixel, PictureSize size,
                      const InputFile& file) {
  if (samples.is_transparent(pixel)) return 0;
  const unsigned value = samples.value(pixel, 0);
  if (!samples.has_equal_colours(pixel)) {
    throw InputError(file, "the labels themselves",
                     "the colour " + std::to_string(value) + " " + std::to_string(samples.value(pixel, 1)) +
                         " " + std::to_string(samples.value(pixel, 2)) + place_of(pixel, size),
                     "export label numbers, as grey or palette, and not their colours");
  }
  if (value > 255) {
    throw InputError(file, "labels from 0 to 255", std::to_string(value) + place_of(pixel, size), kLabelHint);
  }
  return static_cast<std::uint8_t>(value);
}

LabelSamples read_samples(PngDecoder& decoder, const InputFile& file) {
  if (!decoder.keep_values()) refuse_damaged_png(decoder, file);
  LabelSamples samples;
  samples.channels = static_cast<std::size_t>(decoder.channels());
  samples.sample_bytes = decoder.bit_depth() == 16 ? 2 : 1;
  const std::size_t stride = decoder.width() * samples.channels * samples.sample_bytes;
  samples.bytes.resize(stride * decoder.height());
  if (!decoder.read_rows(samples.bytes.data(), stride)) refuse_damaged_png(decoder, file);
  return samples;
}

}  // namespace

Picture read_label_picture(const InputFile& file, PictureSize required) {
  const std::vector<std::uint8_t> bytes = read_bytes(file, kMaxPictureFileBytes, kLabelPng);
  if (is_jpeg(bytes)) {
    throw InputError(file, kLabelPng, "a JPEG picture, which changes the labels at every edge",
                     "export the labels again, as PNG");
  }
  if (!is_png(bytes)) {
    throw InputError(file, kLabelPng, bytes.empty() ? "an empty file" : "bytes of another kind", kLabelHint);
  }
  PngDecoder decoder(bytes);
  read_header(decoder, file, required);
  LabelSamples samples = read_samples(decoder, file);
  Picture labels;
  labels.size = required;
  if (samples.channels * samples.sample_bytes == 1) {
    labels.pixels = std::move(samples.bytes);
    return labels;
  }
  labels.pixels.resize(Picture::area(required));
  for (std::size_t i = 0; i < labels.pixels.size(); ++i)
    labels.pixels[i] = label_at(samples, i, required, file);
  return labels;
}

}  // namespace traygauge
