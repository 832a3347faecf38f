#include "tests/drivers/v4l2/fake_video_device.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <deque>
#include <random>
#include <set>

namespace traygauge {
namespace {

constexpr Nanoseconds kFrameTime = std::chrono::nanoseconds(33'333'333);
constexpr Nanoseconds kTransferTime = std::chrono::milliseconds(10);

bool is_off(const v4l2_control& automatic) {
  return automatic.value == (automatic.id == V4L2_CID_EXPOSURE_AUTO ? V4L2_EXPOSURE_MANUAL : 0);
}

template <class T>
T& as(void* argument) {
  return *static_cast<T*>(argument);
}

class FakeVideoDevice final : public VideoDevice {
 public:
  explicit FakeVideoDevice(FakeCamera& camera) : camera_(camera) {}
  ~FakeVideoDevice() override { FakeVideoDevice::close(); }

  int open(const std::string& path) override;
  void close() override;
  int request(IoctlCode code, void* argument) override;
  std::span<std::uint8_t> map(std::size_t length, std::uint32_t offset) override;
  void unmap(std::span<std::uint8_t> buffer) override;
  int wait(Nanoseconds timeout, bool& has_news) override;

 private:
  struct Filled {
    std::uint32_t index;
    std::size_t length;
    std::uint32_t sequence;
    std::uint32_t flags;
    Instant stamped_at;
  };

  int enumerate_format(v4l2_fmtdesc& entry) const;
  int enumerate_size(v4l2_frmsizeenum& entry) const;
  int enumerate_rate(v4l2_frmivalenum& entry) const;
  int set_format(v4l2_format& format);
  int request_buffers(v4l2_requestbuffers& request);
  int query_control(v4l2_queryctrl& query) const;
  int write_control(const v4l2_control& control);
  int queue(const v4l2_buffer& buffer);
  int dequeue(v4l2_buffer& buffer);
  void produce_until(Instant instant);
  void fill(int number, Instant begun_at);

  FakeCamera& camera_;
  bool is_open_ = false;
  bool is_streaming_ = false;
  FakeMode mode_;
  std::vector<std::vector<std::uint8_t>> buffers_;
  std::deque<std::uint32_t> queued_;
  std::deque<Filled> filled_;
  std::set<const std::uint8_t*> mapped_;
  Instant next_frame_at_;
};

int FakeVideoDevice::open(const std::string& path) {
  EXPECT_FALSE(is_open_) << "opened twice";
  if (camera_.is_gone || path != camera_.node) return ENOENT;
  if (camera_.may_not_open) return EACCES;
  is_open_ = true;
  ++camera_.opened;
  ++camera_.open_now;
  return 0;
}

void FakeVideoDevice::close() {
  if (!is_open_) return;
  is_open_ = is_streaming_ = false;
  --camera_.open_now;
  EXPECT_TRUE(mapped_.empty()) << "closed with buffers mapped";
  buffers_.clear();
  queued_.clear();
  filled_.clear();
}

int FakeVideoDevice::request(IoctlCode code, void* argument) {
  EXPECT_TRUE(is_open_);
  if (camera_.is_gone) return ENODEV;
  if (const auto error = camera_.errors.find(code); error != camera_.errors.end()) {
    const int number = error->second;
    camera_.errors.erase(error);
    return number;
  }
  switch (code) {
    case VIDIOC_QUERYCAP:
      as<v4l2_capability>(argument).capabilities = camera_.capabilities;
      return 0;
    case VIDIOC_ENUM_FMT:
      return enumerate_format(as<v4l2_fmtdesc>(argument));
    case VIDIOC_ENUM_FRAMESIZES:
      return enumerate_size(as<v4l2_frmsizeenum>(argument));
    case VIDIOC_ENUM_FRAMEINTERVALS:
      return enumerate_rate(as<v4l2_frmivalenum>(argument));
    case VIDIOC_S_FMT:
      return set_format(as<v4l2_format>(argument));
    case VIDIOC_S_PARM:
      if (camera_.granted_rate_per_s > 0)
        as<v4l2_streamparm>(argument).parm.capture.timeperframe = {1, camera_.granted_rate_per_s};
      return 0;
    case VIDIOC_QUERYCTRL:
      return query_control(as<v4l2_queryctrl>(argument));
    case VIDIOC_G_CTRL: {
      auto& control = as<v4l2_control>(argument);
      const auto found = camera_.controls.find(control.id);
      if (found == camera_.controls.end()) return EINVAL;
      control.value = found->second.value;
      return 0;
    }
    case VIDIOC_G_EXT_CTRLS: {
      v4l2_ext_control& control = *as<v4l2_ext_controls>(argument).controls;
      const auto found = camera_.controls.find(control.id);
      if (found == camera_.controls.end()) return EINVAL;
      control.value64 = found->second.value;
      return 0;
    }
    case VIDIOC_S_CTRL:
      return write_control(as<v4l2_control>(argument));
    case VIDIOC_REQBUFS:
      return request_buffers(as<v4l2_requestbuffers>(argument));
    case VIDIOC_QUERYBUF: {
      auto& buffer = as<v4l2_buffer>(argument);
      buffer.length = static_cast<std::uint32_t>(fake_frame_bytes(mode_));
      buffer.m.offset = buffer.index;
      return buffer.index < buffers_.size() ? 0 : EINVAL;
    }
    case VIDIOC_QBUF:
      return queue(as<v4l2_buffer>(argument));
    case VIDIOC_DQBUF:
      return dequeue(as<v4l2_buffer>(argument));
    case VIDIOC_STREAMON:
      is_streaming_ = true;
      next_frame_at_ = camera_.clock.now() + kFrameTime;
      return 0;
    case VIDIOC_STREAMOFF:
      is_streaming_ = false;
      queued_.clear();
      filled_.clear();
      return 0;
    default:
      return ENOTTY;
  }
}

int FakeVideoDevice::enumerate_format(v4l2_fmtdesc& entry) const {
  std::vector<std::uint32_t> formats;
  for (const FakeMode& mode : camera_.modes) {
    if (std::find(formats.begin(), formats.end(), mode.fourcc) == formats.end())
      formats.push_back(mode.fourcc);
  }
  if (entry.index >= formats.size()) return EINVAL;
  entry.pixelformat = formats[entry.index];
  std::copy_n("strange", 8, entry.description);
  return 0;
}

int FakeVideoDevice::enumerate_size(v4l2_frmsizeenum& entry) const {
  std::uint32_t index = 0;
  for (const FakeMode& mode : camera_.modes) {
    if (mode.fourcc != entry.pixel_format || index++ != entry.index) continue;
    const bool is_range = mode.least_width > 0;
    entry.type = is_range ? V4L2_FRMSIZE_TYPE_STEPWISE : V4L2_FRMSIZE_TYPE_DISCRETE;
    if (is_range) entry.stepwise = {mode.least_width, mode.width, 8, mode.least_height, mode.height, 8};
    if (!is_range) entry.discrete = {mode.width, mode.height};
    return 0;
  }
  return EINVAL;
}

int FakeVideoDevice::enumerate_rate(v4l2_frmivalenum& entry) const {
  for (const FakeMode& mode : camera_.modes) {
    const bool is_least = mode.least_width == entry.width && mode.least_height == entry.height;
    const bool is_it = mode.fourcc == entry.pixel_format &&
                       (is_least || (mode.width == entry.width && mode.height == entry.height));
    const auto& rates = is_least ? mode.rates_at_least : mode.rates_per_s;
    if (!is_it || entry.index >= rates.size()) continue;
    entry.type = V4L2_FRMIVAL_TYPE_DISCRETE;
    entry.discrete = {1, rates[entry.index]};
    return 0;
  }
  return EINVAL;
}

int FakeVideoDevice::set_format(v4l2_format& format) {
  EXPECT_TRUE(buffers_.empty()) << "the kernel would say EBUSY";
  for (const FakeMode& mode : camera_.modes) {
    mode_ = mode;
    const auto& wanted = format.fmt.pix;
    if (mode.fourcc != wanted.pixelformat) continue;
    if (mode.width == wanted.width && mode.height == wanted.height) break;
    if (mode.least_width == 0 || wanted.width > mode.width) continue;
    mode_.width = wanted.width;
    mode_.height = wanted.height;
    break;
  }
  format.fmt.pix.width = mode_.width;
  format.fmt.pix.height = mode_.height;
  format.fmt.pix.pixelformat = mode_.fourcc;
  format.fmt.pix.colorspace = camera_.colorspace;
  if (format.fmt.pix.priv == V4L2_PIX_FMT_PRIV_MAGIC) format.fmt.pix.quantization = camera_.quantization;
  format.fmt.pix.bytesperline = static_cast<std::uint32_t>(fake_frame_bytes(mode_) / mode_.height);
  return 0;
}

int FakeVideoDevice::request_buffers(v4l2_requestbuffers& request) {
  EXPECT_TRUE(mapped_.empty()) << "the kernel would say EBUSY";
  request.count = std::min(request.count, camera_.buffer_limit);
  buffers_.assign(request.count, std::vector<std::uint8_t>(fake_frame_bytes(mode_)));
  return 0;
}

int FakeVideoDevice::query_control(v4l2_queryctrl& query) const {
  const auto found = camera_.controls.find(query.id);
  if (found == camera_.controls.end()) return EINVAL;
  query.minimum = found->second.minimum;
  query.maximum = found->second.maximum;
  query.step = found->second.step;
  return 0;
}

int FakeVideoDevice::write_control(const v4l2_control& control) {
  const auto found = camera_.controls.find(control.id);
  if (found == camera_.controls.end()) return EINVAL;
  FakeControl& own = found->second;
  if (control.value < own.minimum || control.value > own.maximum) return ERANGE;
  camera_.set_controls.push_back(std::to_string(control.id) + "=" + std::to_string(control.value));
  for (auto& [id, other] : camera_.controls) {
    const bool is_its = other.automatic == control.id && own.value != control.value;
    if (is_its && !own.is_stubborn && is_off(control)) other.value = other.by_hand;
  }
  if (!own.is_stubborn) own.value = own.minimum + (control.value - own.minimum) / own.step * own.step;
  return 0;
}

std::span<std::uint8_t> FakeVideoDevice::map(std::size_t length, std::uint32_t offset) {
  auto& buffer = buffers_.at(offset);
  EXPECT_EQ(buffer.size(), length);
  EXPECT_TRUE(mapped_.insert(buffer.data()).second);
  ++camera_.mapped_now;
  return buffer;
}

void FakeVideoDevice::unmap(std::span<std::uint8_t> buffer) {
  EXPECT_EQ(mapped_.erase(buffer.data()), 1U);
  --camera_.mapped_now;
}

int FakeVideoDevice::queue(const v4l2_buffer& buffer) {
  if (buffer.index >= buffers_.size()) return EINVAL;
  EXPECT_EQ(std::count(queued_.begin(), queued_.end(), buffer.index), 0) << "queued twice";
  queued_.push_back(buffer.index);
  return 0;
}

int FakeVideoDevice::dequeue(v4l2_buffer& buffer) {
  if (filled_.empty()) return EAGAIN;
  const Filled filled = filled_.front();
  filled_.pop_front();
  buffer.index = filled.index;
  buffer.bytesused = static_cast<std::uint32_t>(filled.length);
  buffer.sequence = filled.sequence;
  buffer.flags = filled.flags;
  const auto since = camera_.fixed_stamp.value_or(filled.stamped_at.time_since_epoch());
  const auto seconds = std::chrono::floor<std::chrono::seconds>(since);
  buffer.timestamp.tv_sec = seconds.count();
  buffer.timestamp.tv_usec = std::chrono::floor<std::chrono::microseconds>(since - seconds).count();
  return 0;
}

int FakeVideoDevice::wait(Nanoseconds timeout, bool& has_news) {
  EXPECT_TRUE(is_streaming_);
  const Instant deadline = camera_.clock.now() + timeout;
  produce_until(camera_.clock.now());
  while (filled_.empty() && !camera_.is_gone && !camera_.is_silent && !queued_.empty() &&
         next_frame_at_ + kTransferTime <= deadline) {
    camera_.clock.sleep_until(next_frame_at_ + kTransferTime);
    produce_until(camera_.clock.now());
  }
  has_news = camera_.is_gone || !filled_.empty();
  if (!has_news) camera_.clock.sleep_until(deadline);
  return 0;
}

void FakeVideoDevice::produce_until(Instant instant) {
  while (!camera_.is_gone && !camera_.is_silent && next_frame_at_ + kTransferTime <= instant) {
    camera_.begun_at.push_back(next_frame_at_);
    fill(camera_.frame_count++, next_frame_at_);
    next_frame_at_ += kFrameTime;
  }
}

// A frame without a buffer to go to is lost.
void FakeVideoDevice::fill(int number, Instant begun_at) {
  const auto special = camera_.frames.find(number);
  const FakeFrame frame = special != camera_.frames.end() ? special->second : FakeFrame{};
  if (frame.is_lost || queued_.empty()) return;
  const std::uint32_t index = queued_.front();
  queued_.pop_front();
  auto& buffer = buffers_[index];
  std::mt19937_64 random(static_cast<std::uint64_t>(number));
  for (auto& byte : buffer) byte = static_cast<std::uint8_t>(random());
  const auto after = camera_.pictures.upper_bound(number);
  std::size_t length = buffer.size();
  if (after != camera_.pictures.begin()) {
    const auto& picture = std::prev(after)->second;
    length = std::min(picture.size(), buffer.size());
    std::copy_n(picture.begin(), length, buffer.begin());
  }
  length = static_cast<std::size_t>(static_cast<double>(length) * frame.length_fraction);
  const bool is_start = (camera_.stamp_flags & V4L2_BUF_FLAG_TSTAMP_SRC_SOE) != 0;
  filled_.push_back({index, length, static_cast<std::uint32_t>(number), frame.flags | camera_.stamp_flags,
                     (is_start ? begun_at : begun_at + kTransferTime) + camera_.stamp_offset});
}

}  // namespace

std::size_t fake_frame_bytes(const FakeMode& mode) {
  const std::size_t pixels = std::size_t{mode.width} * mode.height;
  return mode.fourcc == V4L2_PIX_FMT_GREY ? pixels : 2 * pixels;
}

std::unique_ptr<VideoDevice> make_fake_video_device(FakeCamera& camera) {
  return std::make_unique<FakeVideoDevice>(camera);
}

}  // namespace traygauge
