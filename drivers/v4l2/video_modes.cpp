#include "drivers/v4l2/video_modes.hpp"

#include <linux/videodev2.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>

namespace traygauge {
namespace {

constexpr double kUsefulRate_per_s = 10.0;  // below, a scan waits for its pictures
constexpr double kRateTolerance = 0.005;    // 29.97 is 30
// A camera that names more sizes or rates than this is broken.
constexpr std::uint32_t kMaxEntries = 256;

struct KnownFormat {
  std::uint32_t fourcc;
  RawFormat format;
};

constexpr RawFormat bayer(BayerPattern pattern, int bits, bool is_packed = false) {
  return {RawEncoding::bayer, pattern, bits, is_packed};
}

using enum BayerPattern;
// clang-format off
constexpr auto kKnownFormats = std::to_array<KnownFormat>({
    // Best first: without loss, colours at full resolution.
    {V4L2_PIX_FMT_BGR24, {RawEncoding::bgr24}},
    {V4L2_PIX_FMT_RGB24, {RawEncoding::rgb24}},
    {V4L2_PIX_FMT_YUYV, {RawEncoding::yuyv}},
    {V4L2_PIX_FMT_NV12, {RawEncoding::nv12}},
    {V4L2_PIX_FMT_MJPEG, {RawEncoding::mjpeg}},
    {V4L2_PIX_FMT_JPEG, {RawEncoding::mjpeg}},
    {V4L2_PIX_FMT_SRGGB12, bayer(rggb, 12)},
    {V4L2_PIX_FMT_SGRBG12, bayer(grbg, 12)},
    {V4L2_PIX_FMT_SGBRG12, bayer(gbrg, 12)},
    {V4L2_PIX_FMT_SBGGR12, bayer(bggr, 12)},
    {V4L2_PIX_FMT_SRGGB12P, bayer(rggb, 12, true)},
    {V4L2_PIX_FMT_SGRBG12P, bayer(grbg, 12, true)},
    {V4L2_PIX_FMT_SGBRG12P, bayer(gbrg, 12, true)},
    {V4L2_PIX_FMT_SBGGR12P, bayer(bggr, 12, true)},
    {V4L2_PIX_FMT_SRGGB10, bayer(rggb, 10)},
    {V4L2_PIX_FMT_SGRBG10, bayer(grbg, 10)},
    {V4L2_PIX_FMT_SGBRG10, bayer(gbrg, 10)},
    {V4L2_PIX_FMT_SBGGR10, bayer(bggr, 10)},
    {V4L2_PIX_FMT_SRGGB10P, bayer(rggb, 10, true)},
    {V4L2_PIX_FMT_SGRBG10P, bayer(grbg, 10, true)},
    {V4L2_PIX_FMT_SGBRG10P, bayer(gbrg, 10, true)},
    {V4L2_PIX_FMT_SBGGR10P, bayer(bggr, 10, true)},
    {V4L2_PIX_FMT_SRGGB8, bayer(rggb, 8)},
    {V4L2_PIX_FMT_SGRBG8, bayer(grbg, 8)},
    {V4L2_PIX_FMT_SGBRG8, bayer(gbrg, 8)},
    {V4L2_PIX_FMT_SBGGR8, bayer(bggr, 8)},
    {V4L2_PIX_FMT_GREY, {RawEncoding::grey}},
});
// clang-format on

std::size_t rank(std::uint32_t fourcc) {
  return static_cast<std::size_t>(std::ranges::find(kKnownFormats, fourcc, &KnownFormat::fourcc) -
                                  kKnownFormats.begin());
}

double rate_of(const v4l2_fract& interval) {
  return interval.numerator > 0 ? static_cast<double>(interval.denominator) / interval.numerator : 0.0;
}

std::vector<double> list_rates(VideoDevice& device, std::uint32_t fourcc, int width, int height) {
  std::vector<double> rates;
  for (std::uint32_t i = 0; i < kMaxEntries; ++i) {
    v4l2_frmivalenum entry{};
    entry.index = i;
    entry.pixel_format = fourcc;
    entry.width = static_cast<std::uint32_t>(width);
    entry.height = static_cast<std::uint32_t>(height);
    if (device.request(VIDIOC_ENUM_FRAMEINTERVALS, &entry) != 0) break;
    const bool is_discrete = entry.type == V4L2_FRMIVAL_TYPE_DISCRETE;
    rates.push_back(rate_of(is_discrete ? entry.discrete : entry.stepwise.min));
    if (!is_discrete) break;
  }
  std::sort(rates.rbegin(), rates.rend());
  return rates;
}

void add_sizes(VideoDevice& device, const OfferedMode& format, const ModeWish& wish,
               std::vector<OfferedMode>& modes) {
  for (std::uint32_t i = 0; i < kMaxEntries; ++i) {
    v4l2_frmsizeenum entry{};
    entry.index = i;
    entry.pixel_format = format.fourcc;
    if (device.request(VIDIOC_ENUM_FRAMESIZES, &entry) != 0) return;
    OfferedMode mode = format;
    const bool is_discrete = entry.type == V4L2_FRMSIZE_TYPE_DISCRETE;
    if (is_discrete) {
      mode.min_width = mode.max_width = static_cast<int>(entry.discrete.width);
      mode.min_height = mode.max_height = static_cast<int>(entry.discrete.height);
    } else {
      mode.min_width = static_cast<int>(entry.stepwise.min_width);
      mode.max_width = static_cast<int>(entry.stepwise.max_width);
      mode.min_height = static_cast<int>(entry.stepwise.min_height);
      mode.max_height = static_cast<int>(entry.stepwise.max_height);
      mode.step_width = std::max(1, static_cast<int>(entry.stepwise.step_width));
      mode.step_height = std::max(1, static_cast<int>(entry.stepwise.step_height));
    }
    // The largest of a range is the slowest.
    const bool has_wish = mode.has_size(wish.width, wish.height);
    mode.rates_per_s = list_rates(device, mode.fourcc, has_wish ? wish.width : mode.max_width,
                                  has_wish ? wish.height : mode.max_height);
    modes.push_back(mode);
    if (!is_discrete) return;
  }
}

double best_rate(const OfferedMode& mode) {
  return mode.rates_per_s.empty() ? 0.0 : mode.rates_per_s.front();
}

bool reaches(double rate, double wanted) {
  return rate >= wanted * (1.0 - kRateTolerance);
}

// A camera that does not say how fast it is gets the benefit of the doubt.
bool reaches(const OfferedMode& mode, double wanted) {
  return mode.rates_per_s.empty() || reaches(best_rate(mode), wanted);
}

// The slowest that is fast enough spares the bus; without a wish the fastest.
double choose_rate(const OfferedMode& mode, double wanted) {
  double chosen = best_rate(mode);
  for (const double rate : mode.rates_per_s) {
    if (wanted > 0.0 && reaches(rate, wanted)) chosen = rate;
  }
  return chosen;
}

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

bool OfferedMode::has_size(int width, int height) const {
  return width >= min_width && width <= max_width && height >= min_height && height <= max_height &&
         (width - min_width) % step_width == 0 && (height - min_height) % step_height == 0 &&
         is_size_supported(format, width, height);
}

std::optional<RawFormat> raw_format_of(std::uint32_t fourcc) {
  const std::size_t index = rank(fourcc);
  if (index == kKnownFormats.size()) return std::nullopt;
  return kKnownFormats.at(index).format;
}

YuvCoding yuv_coding_of(std::uint32_t colorspace, std::uint32_t encoding, std::uint32_t quantization) {
  if (encoding == V4L2_YCBCR_ENC_DEFAULT) encoding = V4L2_MAP_YCBCR_ENC_DEFAULT(colorspace);
  if (quantization == V4L2_QUANTIZATION_DEFAULT) {
    quantization = V4L2_MAP_QUANTIZATION_DEFAULT(false, colorspace, encoding);
  }
  return {quantization == V4L2_QUANTIZATION_FULL_RANGE,
          encoding == V4L2_YCBCR_ENC_709 || encoding == V4L2_YCBCR_ENC_XV709};
}

DeviceStatus list_modes(VideoDevice& device, const ModeWish& wish, std::vector<OfferedMode>& modes,
                        std::vector<std::string>& unknown) {
  for (std::uint32_t i = 0; i < kMaxEntries; ++i) {
    v4l2_fmtdesc entry{};
    entry.index = i;
    entry.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    const int error = device.request(VIDIOC_ENUM_FMT, &entry);
    if (error == EINVAL) break;
    if (error != 0) return status_of_errno(error);
    if (const auto format = raw_format_of(entry.pixelformat)) {
      OfferedMode mode;
      mode.format = *format;
      mode.fourcc = entry.pixelformat;
      add_sizes(device, mode, wish, modes);
    } else {
      unknown.emplace_back(reinterpret_cast<const char*>(entry.description));
    }
  }
  return DeviceCode::ok;
}

std::optional<ChosenMode> choose_mode(const std::vector<OfferedMode>& modes, const ModeWish& wish) {
  const OfferedMode* best = nullptr;
  const double wanted = wish.frames_per_s > 0.0 ? wish.frames_per_s : kUsefulRate_per_s;
  for (const OfferedMode& mode : modes) {
    const bool fits = mode.has_size(wish.width, wish.height) &&
                      (wish.format.empty() || wish.format == name(mode.format)) &&
                      (wish.frames_per_s <= 0.0 || reaches(mode, wish.frames_per_s));
    if (!fits) continue;
    const bool is_better = best == nullptr || (reaches(mode, wanted) && !reaches(*best, wanted)) ||
                           (reaches(mode, wanted) == reaches(*best, wanted) &&
                            (reaches(mode, wanted) ? rank(mode.fourcc) < rank(best->fourcc)
                                                   : best_rate(mode) > best_rate(*best)));
    if (is_better) best = &mode;
  }
  if (best == nullptr) return std::nullopt;
  return ChosenMode{best->format, best->fourcc, wish.width, wish.height,
                    choose_rate(*best, wish.frames_per_s)};
}

std::string describe_modes(const std::vector<OfferedMode>& modes, const std::vector<std::string>& unknown) {
  std::string text;
  for (const OfferedMode& mode : modes) {
    text += (text.empty() ? "" : ", ") + name(mode.format) + " ";
    const bool is_range = mode.min_width != mode.max_width || mode.min_height != mode.max_height;
    if (is_range) text += size_text(mode.min_width, mode.min_height) + " to ";
    text += size_text(mode.max_width, mode.max_height);
    const char* separator = " (";
    for (const double rate : mode.rates_per_s) {
      text += separator + number(rate);
      separator = ", ";
    }
    if (!mode.rates_per_s.empty()) text += " a second)";
  }
  if (text.empty()) text = "no format that can be converted";
  const char* separator = "; formats of no use here: ";
  for (const std::string& format : unknown) {
    text += separator + format;
    separator = ", ";
  }
  return text;
}

std::string list_known_formats() {
  std::string names;
  std::string last;
  for (const KnownFormat& known : kKnownFormats) {
    const std::string next = name(known.format);
    if (next != last) names += (names.empty() ? "" : ", ") + next;
    last = next;
  }
  return names;
}

bool is_known_format(const std::string& format) {
  return std::ranges::any_of(kKnownFormats,
                             [&](const KnownFormat& known) { return name(known.format) == format; });
}

std::string describe_wish(const ModeWish& wish) {
  std::string text = wish.format.empty() ? "" : wish.format + " ";
  text += size_text(wish.width, wish.height);
  if (wish.frames_per_s > 0.0) text += " at " + number(wish.frames_per_s) + " a second";
  return text;
}

}  // namespace traygauge
