// What a camera offers, and the choice of what the configuration asks for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/device_status.hpp"
#include "drivers/pixels/raw_format.hpp"
#include "drivers/v4l2/video_device.hpp"

namespace traygauge {

// A format with its sizes: one, or all between two in steps.
struct OfferedMode {
  RawFormat format;
  std::uint32_t fourcc = 0;  // the kernel's name of the format
  int min_width = 0;
  int min_height = 0;
  int max_width = 0;
  int max_height = 0;
  int step_width = 1;
  int step_height = 1;
  std::vector<double> rates_per_s;  // falling; empty where the camera does not say

  bool has_size(int width, int height) const;
};

struct ModeWish {
  int width = 1600;
  int height = 1200;
  std::string format;         // by its name; empty: what is best
  double frames_per_s = 0.0;  // at least; 0: any, 10 and more where there is a choice
};

// Every mode in a format that we can convert, a range of sizes with its rates at the one that is wished.
// Others are named in `unknown`.
DeviceStatus list_modes(VideoDevice& device, const ModeWish& wish, std::vector<OfferedMode>& modes,
                        std::vector<std::string>& unknown);

struct ChosenMode {
  RawFormat format;
  std::uint32_t fourcc = 0;
  int width = 0;
  int height = 0;
  double frames_per_s = 0.0;  // 0: the camera does not say
};

// Formats without loss come before JPEG, colour before grey. Nothing when no mode fits.
std::optional<ChosenMode> choose_mode(const std::vector<OfferedMode>& modes, const ModeWish& wish);

// "MJPEG 1600x1200 (30, 15 a second), YUYV 640x480 (30 a second)" and what else there is.
std::string describe_modes(const std::vector<OfferedMode>& modes, const std::vector<std::string>& unknown);
std::string describe_wish(const ModeWish& wish);

// The formats that `format` of a wish may name, best first: "BGR24, RGB24, YUYV".
std::string list_known_formats();
bool is_known_format(const std::string& format);

// What the kernel says of the numbers of a format that was set.
YuvCoding yuv_coding_of(std::uint32_t colorspace, std::uint32_t encoding, std::uint32_t quantization);

// The format of the kernel's name; nothing when we cannot convert it.
std::optional<RawFormat> raw_format_of(std::uint32_t fourcc);

}  // namespace traygauge
