#include "drivers/v4l2/v4l2_camera.hpp"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "drivers/v4l2/brightness_watch.hpp"
#include "drivers/v4l2/device_finder.hpp"

namespace traygauge {
namespace {

// One for the frame that is kept or looked at, one that the camera fills. Each takes as much as a whole raw
// picture, for MJPEG too: 3.7 MiB at 1600x1200.
constexpr int kBuffers = 2;
constexpr double kAssumedRate_per_s = 30.0;
// Linux 6.1 stumbles over a null pointer in media_device_unregister_entity() when a USB camera's node is
// closed for the last time while its removal is under way.
constexpr Nanoseconds kRemoval = std::chrono::milliseconds(200);

}  // namespace

V4l2Camera::V4l2Camera(std::unique_ptr<VideoDevice> device, Clock& clock, const V4l2CameraParams& params)
    : Camera("camera " + params.device),
      device_(std::move(device)),
      clock_(clock),
      params_(params),
      stream_(*device_),
      controls_(*device_) {}

DeviceStatus V4l2Camera::fail(DeviceStatus status, std::string_view what) {
  set_detail(what);
  return status;
}

DeviceStatus V4l2Camera::do_start() {
  set_detail({});
  counters_ = {};
  last_number_.reset();
  last_fingerprint_.reset();
  DeviceStatus status = open_and_set_up();
  if (status.ok()) status = controls_.prepare(params_.controls, mode_.width);
  if (!status.ok() && !controls_.problem().empty()) set_detail(controls_.problem());
  if (status.ok()) status = start_stream();
  if (status.ok()) status = settle();
  if (status.ok()) status = lock_controls();
  status = notice_removal(status);
  if (!status.ok()) do_stop();
  return status;
}

// The camera may take another rate than it was asked for, and says which.
void V4l2Camera::set_rate() {
  if (mode_.frames_per_s <= 0.0) return;
  constexpr double kFractions = 10'000.0;
  v4l2_streamparm rate{};
  rate.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  v4l2_fract& interval = rate.parm.capture.timeperframe;
  interval.numerator = static_cast<std::uint32_t>(kFractions);
  interval.denominator = static_cast<std::uint32_t>(mode_.frames_per_s * kFractions + 0.5);
  if (device_->request(VIDIOC_S_PARM, &rate) != 0) {
    mode_.frames_per_s = 0.0;
  } else if (interval.numerator > 0 && interval.denominator > 0) {
    mode_.frames_per_s = static_cast<double>(interval.denominator) / interval.numerator;
  }
}

DeviceStatus V4l2Camera::start_stream() {
  const DeviceStatus status = stream_.start(kBuffers);
  if (status.error_number() == ENOSPC) {
    return fail(
        DeviceCode::unsupported,
        "the USB bus has too little room left for pictures of " + describe_wish(params_.mode) + " from " +
            node_ +
            "; plug the camera into a port of another USB controller than other cameras, no hub between, "
            "or set format = \"MJPEG\", smaller pictures or fewer frames_per_s");
  }
  if (status.error_number() != EPIPE) return status;
  return fail({DeviceCode::unsupported, EPIPE},
              "the parts behind " + node_ +
                  " are not connected, or set to another format; set each link to " +
                  describe_wish(params_.mode) + " with media-ctl before the station starts");
}

// A camera that is being unplugged may fail in any way before the kernel has removed it.
DeviceStatus V4l2Camera::notice_removal(DeviceStatus status) {
  if (status.code() == DeviceCode::io_error && is_open_) {
    clock_.sleep_for(kRemoval);
    v4l2_capability capability{};
    const DeviceStatus now = status_of_errno(device_->request(VIDIOC_QUERYCAP, &capability));
    if (now.code() == DeviceCode::device_gone) status = now;
  }
  is_gone_ = status.code() == DeviceCode::device_gone;
  return status;
}

void V4l2Camera::do_stop() {
  sharpest_.reset();
  stream_.stop();
  if (is_open_ && is_gone_) clock_.sleep_for(kRemoval);
  is_open_ = false;
  device_->close();
}

DeviceStatus V4l2Camera::open_and_set_up() {
  std::string problem;
  if (const DeviceStatus found = find_camera(*device_, params_.device, node_, problem); !found.ok()) {
    return fail(found, problem);
  }
  if (const int error = device_->open(node_); error != 0) return fail(status_of_errno(error), node_);
  is_open_ = true;
  v4l2_capability capability{};
  const int error = device_->request(VIDIOC_QUERYCAP, &capability);
  if (error == ENOTTY || error == EINVAL) return fail(DeviceCode::unsupported, node_ + " is no camera");
  if (error != 0) return fail(status_of_errno(error), node_);
  const std::uint32_t own = node_capabilities(capability);
  if ((own & V4L2_CAP_VIDEO_CAPTURE) != 0) return set_mode();
  if ((own & V4L2_CAP_VIDEO_CAPTURE_MPLANE) != 0) {
    return fail(DeviceCode::unsupported,
                node_ +
                    " keeps a picture in several memories (multi-planar), which is not read here; choose a "
                    "USB camera, or a node of the sensor's that v4l2-ctl --all calls \"Video Capture\"");
  }
  return fail(
      DeviceCode::unsupported,
      node_ + " delivers no pictures; a camera may have several nodes, of which the first usually does");
}

DeviceStatus V4l2Camera::set_mode() {
  std::vector<OfferedMode> modes;
  std::vector<std::string> unknown;
  if (const DeviceStatus status = list_modes(*device_, params_.mode, modes, unknown); !status.ok())
    return status;
  const auto chosen = choose_mode(modes, params_.mode);
  const auto refuse = [&](const std::string& what) {
    return fail(DeviceCode::unsupported, what + "; it offers " + describe_modes(modes, unknown));
  };
  if (!chosen) return refuse("asked for " + describe_wish(params_.mode));
  mode_ = *chosen;
  v4l2_format format{};
  format.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  format.fmt.pix.width = static_cast<std::uint32_t>(mode_.width);
  format.fmt.pix.height = static_cast<std::uint32_t>(mode_.height);
  format.fmt.pix.pixelformat = mode_.fourcc;
  format.fmt.pix.field = V4L2_FIELD_NONE;
  format.fmt.pix.priv = V4L2_PIX_FMT_PRIV_MAGIC;  // else the kernel leaves the colours' coding out
  if (const int error = device_->request(VIDIOC_S_FMT, &format); error != 0) {
    return fail(status_of_errno(error), "the format could not be set");
  }
  const auto& pix = format.fmt.pix;
  const bool is_set = pix.width == static_cast<std::uint32_t>(mode_.width) &&
                      pix.height == static_cast<std::uint32_t>(mode_.height) &&
                      pix.pixelformat == mode_.fourcc;
  if (!is_set) return refuse("asked for " + describe_wish(params_.mode) + ", which it then did not do");
  if (pix.field != V4L2_FIELD_NONE) return refuse("its pictures are interlaced");
  set_rate();
  const auto least = static_cast<std::ptrdiff_t>(row_bytes(mode_.format, mode_.width));
  converter_.emplace(mode_.format, mode_.width, mode_.height,
                     std::max<std::ptrdiff_t>(least, pix.bytesperline),
                     yuv_coding_of(pix.colorspace, pix.ycbcr_enc, pix.quantization));
  return DeviceCode::ok;
}

DeviceStatus V4l2Camera::take(Instant deadline, FilledBuffer& filled) {
  while (true) {
    const Nanoseconds left = deadline - clock_.now();
    const DeviceStatus status = stream_.take(std::max(left, Nanoseconds::zero()), filled);
    if (status.code() != DeviceCode::timed_out || clock_.now() >= deadline) return status;
  }
}

// The first frames, and those in which an automatic still moves.
DeviceStatus V4l2Camera::settle() {
  BrightnessWatch watch;
  const bool watches = params_.settle_frames > 0 && controls_.is_automatic();
  const int limit = watches ? std::max(params_.settle_frames, params_.settle_frames_at_most) : 0;
  for (int i = 0; i < params_.settle_frames || (i < limit && !watch.is_steady()); ++i) {
    FilledBuffer filled;
    DeviceStatus status = take(clock_.now() + params_.first_frame_timeout, filled);
    if (status.code() == DeviceCode::timed_out) return fail(status, "it streams no pictures");
    if (!status.ok()) return status;
    count(filled);
    if (watches && !filled.is_damaged && converter_->is_whole(filled.bytes)) {
      if (const auto mean = converter_->brightness(filled.bytes)) watch.add(*mean);
    }
    status = stream_.give_back(filled);
    if (!status.ok()) return status;
  }
  return DeviceCode::ok;
}

DeviceStatus V4l2Camera::lock_controls() {
  const DeviceStatus status = controls_.lock(params_.controls);
  return status.ok() ? status : fail(status, controls_.problem());
}

DeviceStatus V4l2Camera::do_settle_again() {
  DeviceStatus status = controls_.release(params_.controls);
  if (!status.ok()) set_detail(controls_.problem());
  if (status.ok() && controls_.is_automatic()) {
    status = settle();
    if (status.ok()) status = lock_controls();
  }
  return notice_removal(status);
}

CameraFormat V4l2Camera::do_format() const {
  if (!converter_) return {params_.mode.width, params_.mode.height, PixelFormat::bgr8};
  return {converter_->width(), converter_->height(), converter_->pixels()};
}

// The kernel's numbers have 32 bits and may start anew.
void V4l2Camera::count(const FilledBuffer& filled) {
  const auto step = last_number_ ? static_cast<std::uint32_t>(filled.sequence - *last_number_) : 1U;
  const bool starts_anew = step == 0 || step > (1U << 31U);
  last_number_ = filled.sequence;
  number_ += starts_anew ? 1 : step;
  if (!starts_anew) counters_.missed += step - 1;
}

// Also a stamp that is said to be of the exposure's start may come after it: uvcvideo's are of the first
// bytes. Before these the exposure took an interval or what is held, and readout and packing take another.
CapturedFrame V4l2Camera::date(const FilledBuffer& filled) const {
  CapturedFrame times;
  const double rate = mode_.frames_per_s > 0.0 ? mode_.frames_per_s : kAssumedRate_per_s;
  const auto interval = std::chrono::round<Nanoseconds>(std::chrono::duration<double>(1.0 / rate));
  const Nanoseconds exposure = std::chrono::microseconds(held(CameraControl::exposure).value_or(0));
  const Instant now = clock_.now();
  // Some drivers round their stamps up, into the future.
  const Instant stamped_at = std::min(filled.stamped_at.value_or(now), now);
  times.delivered_at = filled.is_stamped_at_start ? now : stamped_at;
  times.exposed_at = stamped_at - std::max(exposure, interval) - interval;
  times.sequence = number_;
  return times;
}

bool V4l2Camera::is_usable(const FilledBuffer& filled) {
  if (filled.is_damaged) {
    set_detail("the kernel marks the picture as damaged");
    return false;
  }
  const bool is_whole = converter_->is_whole(filled.bytes);
  if (!is_whole) set_detail(converter_->problem());
  return is_whole;
}

// Keeps the sharpest of as many frames that were exposed after `asked_at` as a burst has, until `deadline`.
// One that is the same as the last delivered picture is as little use as a damaged one, but has come in time.
DeviceStatus V4l2Camera::collect(Instant asked_at, Instant deadline) {
  bool saw_damage = false;
  bool saw_repeat = false;
  int seen = 0;
  while (seen < std::max(1, params_.burst)) {
    FilledBuffer filled;
    DeviceStatus status = take(deadline, filled);
    if (status.code() == DeviceCode::timed_out) {
      if (sharpest_ || saw_repeat) break;
      return saw_damage ? DeviceCode::torn_frame : DeviceCode::timed_out;
    }
    if (!status.ok()) return status;
    count(filled);
    const CapturedFrame times = date(filled);
    const bool is_new = times.exposed_at >= asked_at;
    if (is_new && is_usable(filled)) {
      ++seen;
      const std::uint64_t own_fingerprint = fingerprint(filled.bytes);
      const bool repeats = !params_.may_repeat && own_fingerprint == last_fingerprint_;
      if (repeats) ++counters_.repeated;
      saw_repeat = saw_repeat || repeats;
      status = repeats
                   ? stream_.give_back(filled)
                   : keep_if_sharper({filled, times, converter_->sharpness(filled.bytes), own_fingerprint});
    } else {
      if (is_new || filled.is_damaged) ++counters_.damaged;
      saw_damage = saw_damage || is_new;
      status = stream_.give_back(filled);
    }
    if (!status.ok()) return status;
  }
  return sharpest_ ? DeviceStatus() : fail(DeviceCode::stale_frame, "the same picture, byte by byte, again");
}

// The other's buffer goes back to the camera, which would soon have none.
DeviceStatus V4l2Camera::keep_if_sharper(const Candidate& next) {
  if (!sharpest_) {
    sharpest_ = next;
    return DeviceCode::ok;
  }
  const Candidate blurred = next.sharpness > sharpest_->sharpness ? std::exchange(*sharpest_, next) : next;
  return stream_.give_back(blurred.filled);
}

DeviceStatus V4l2Camera::deliver_sharpest(std::span<std::uint8_t> buffer, CapturedFrame& frame) {
  if (!converter_->convert(sharpest_->filled.bytes, buffer.data())) {
    ++counters_.damaged;
    return fail(DeviceCode::torn_frame, converter_->problem());
  }
  last_fingerprint_ = sharpest_->fingerprint;
  frame = sharpest_->times;
  frame.view = {buffer.data(), mode_.width, mode_.height,
                std::ptrdiff_t{mode_.width} * bytes_per_pixel(converter_->pixels()), converter_->pixels()};
  ++counters_.delivered;
  set_detail({});
  return DeviceCode::ok;
}

DeviceStatus V4l2Camera::capture_burst(Instant asked_at, Instant deadline, std::span<std::uint8_t> buffer,
                                       CapturedFrame& frame) {
  DeviceStatus status = collect(asked_at, deadline);
  if (status.ok()) status = deliver_sharpest(buffer, frame);
  if (!sharpest_) return status;
  const DeviceStatus returned = stream_.give_back(sharpest_->filled);
  sharpest_.reset();
  return returned.ok() || !status.ok() ? status : returned;
}

// What turns out damaged only when it is decoded gets one more burst.
DeviceStatus V4l2Camera::do_capture(std::span<std::uint8_t> buffer, Nanoseconds timeout,
                                    CapturedFrame& frame) {
  const Instant asked_at = clock_.now();
  CapturedFrame sharpest;
  const Instant deadline = asked_at + timeout;
  DeviceStatus status = capture_burst(asked_at, deadline, buffer, sharpest);
  if (status.code() == DeviceCode::torn_frame && clock_.now() < deadline) {
    const DeviceStatus again = capture_burst(asked_at, deadline, buffer, sharpest);
    if (again.code() != DeviceCode::timed_out) status = again;
  }
  status = notice_removal(status);
  if (status.ok()) frame = sharpest;
  return status;
}

std::string V4l2Camera::describe_setup() const {
  ModeWish mode{mode_.width, mode_.height, name(mode_.format), mode_.frames_per_s};
  return node_ + ": " + describe_wish(mode) + "; " + controls_.describe();
}

}  // namespace traygauge
