#include "drivers/pixels/frame_converter.hpp"

#include <bit>
#include <cstdlib>
#include <cstring>

#include "drivers/pixels/bayer.hpp"
#include "drivers/pixels/yuv.hpp"

namespace traygauge {
namespace {

constexpr int kRowStep = 8;  // of the rows that tell how bright and how sharp a picture is

}  // namespace

FrameConverter::FrameConverter(const RawFormat& format, int width, int height, std::ptrdiff_t stride_bytes,
                               const YuvCoding& coding)
    : format_(format), width_(width), height_(height), stride_bytes_(stride_bytes), coding_(coding) {
  if (format.encoding == RawEncoding::bayer) scratch_.resize(bayer_scratch_bytes(width));
  if (format.encoding == RawEncoding::mjpeg) jpeg_.emplace();
}

bool FrameConverter::is_whole(std::span<const std::uint8_t> bytes) {
  problem_ = {};
  if (format_.encoding == RawEncoding::mjpeg) {
    const JpegExtent extent = find_jpeg(bytes);
    if (extent.length == 0) {
      problem_ = "a JPEG picture without its beginning";
    } else if (!extent.has_end && !jpeg_->mean_grey(bytes.first(extent.length))) {
      problem_ = "a JPEG picture without its end";
    }
  } else if (bytes.size() < frame_bytes(format_, width_, height_, stride_bytes_)) {
    problem_ = "a picture with rows missing";
  }
  return problem_.empty();
}

bool FrameConverter::convert(std::span<const std::uint8_t> bytes, std::uint8_t* out) {
  const RawFrame frame{bytes, width_, height_, stride_bytes_};
  switch (format_.encoding) {
    case RawEncoding::yuyv:
      convert_yuyv(frame, coding_, out);
      break;
    case RawEncoding::nv12:
      convert_nv12(frame, coding_, out);
      break;
    case RawEncoding::bayer:
      convert_bayer(format_, frame, scratch_, out);
      break;
    case RawEncoding::mjpeg:
      if (jpeg_->decode(bytes.first(find_jpeg(bytes).length), width_, height_, out)) break;
      problem_ = jpeg_->problem();
      return false;
    case RawEncoding::grey:
    case RawEncoding::rgb24:
    case RawEncoding::bgr24:
      copy_rows(frame, out);
      break;
  }
  return true;
}

void FrameConverter::copy_rows(const RawFrame& frame, std::uint8_t* out) const {
  const std::size_t bytes = row_bytes(format_, width_);
  for (int y = 0; y < height_; ++y) {
    std::memcpy(out + static_cast<std::size_t>(y) * bytes, frame.bytes.data() + y * stride_bytes_, bytes);
  }
}

FrameConverter::Samples FrameConverter::samples_at(std::span<const std::uint8_t> bytes, int y) {
  const std::uint8_t* const row = bytes.data() + y * stride_bytes_;
  if (format_.encoding == RawEncoding::bayer) {
    unpack_bayer_row(format_, row, width_, scratch_.data());
    return {scratch_.data(), static_cast<std::size_t>(width_), 2};
  }
  const bool has_three = format_.encoding == RawEncoding::rgb24 || format_.encoding == RawEncoding::bgr24;
  return {row, row_bytes(format_, width_), std::size_t{has_three ? 3U : 2U}};  // YUYV: grey to grey
}

std::optional<double> FrameConverter::brightness(std::span<const std::uint8_t> bytes) {
  if (jpeg_) return jpeg_->mean_grey(bytes.first(find_jpeg(bytes).length));
  const std::size_t step = format_.encoding == RawEncoding::yuyv ? 2 : 1;
  double sum = 0.0;
  double count = 0.0;
  for (int y = 0; y < height_; y += kRowStep) {
    const Samples samples = samples_at(bytes, y);
    std::uint64_t row_sum = 0;
    for (std::size_t i = 0; i < samples.count; i += step) row_sum += samples.first[i];
    sum += static_cast<double>(row_sum);
    const std::size_t summed = samples.count / step;
    count += static_cast<double>(summed);
  }
  return sum / count;
}

// Differences between neighbours of one colour, squared.
double FrameConverter::sharpness(std::span<const std::uint8_t> bytes) {
  if (format_.encoding == RawEncoding::mjpeg) return static_cast<double>(find_jpeg(bytes).length);
  double sum = 0.0;
  for (int y = 0; y < height_; y += kRowStep) {
    const auto [first, count, step] = samples_at(bytes, y);
    std::int64_t row_sum = 0;
    for (std::size_t i = 0; i + step < count; i += step) {
      const int difference = first[i] - first[i + step];
      row_sum += std::int64_t{difference} * difference;
    }
    sum += static_cast<double>(row_sum);
  }
  return sum;
}

std::uint64_t fingerprint(std::span<const std::uint8_t> bytes) {
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15U;
  std::uint64_t sum = bytes.size();
  std::size_t i = 0;
  std::uint64_t word = 0;
  for (; i + sizeof(word) <= bytes.size(); i += sizeof(word)) {
    std::memcpy(&word, bytes.data() + i, sizeof(word));
    sum = std::rotl((sum ^ word) * kOdd, 31);
  }
  word = 0;
  if (i < bytes.size()) std::memcpy(&word, bytes.data() + i, bytes.size() - i);
  return (sum ^ word) * kOdd;
}

}  // namespace traygauge
