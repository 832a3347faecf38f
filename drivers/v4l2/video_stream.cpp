#include "drivers/v4l2/video_stream.hpp"

#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>

namespace traygauge {
namespace {

v4l2_buffer describe(std::uint32_t index) {
  v4l2_buffer buffer{};
  buffer.index = index;
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  return buffer;
}

}  // namespace

DeviceStatus VideoStream::start(int count) {
  last_stamp_.reset();
  DeviceStatus status = map_buffers(count);
  for (std::uint32_t i = 0; status.ok() && i < buffers_.size(); ++i) status = queue(i);
  if (status.ok()) {
    int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    status = status_of_errno(device_.request(VIDIOC_STREAMON, &type));
    is_streaming_ = status.ok();
  }
  if (!status.ok()) stop();
  return status;
}

DeviceStatus VideoStream::map_buffers(int count) {
  v4l2_requestbuffers request{};
  request.count = static_cast<std::uint32_t>(count);
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  if (const int error = device_.request(VIDIOC_REQBUFS, &request); error != 0) return status_of_errno(error);
  if (request.count < 2) return {DeviceCode::io_error, ENOMEM};
  buffers_.reserve(request.count);
  for (std::uint32_t i = 0; i < request.count; ++i) {
    v4l2_buffer buffer = describe(i);
    if (const int error = device_.request(VIDIOC_QUERYBUF, &buffer); error != 0)
      return status_of_errno(error);
    const auto memory = device_.map(buffer.length, buffer.m.offset);
    if (memory.empty()) return {DeviceCode::io_error, ENOMEM};
    buffers_.push_back(memory);
  }
  return DeviceCode::ok;
}

void VideoStream::stop() {
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (is_streaming_) device_.request(VIDIOC_STREAMOFF, &type);
  is_streaming_ = false;
  for (const auto memory : buffers_) device_.unmap(memory);
  const bool had_buffers = !buffers_.empty();
  buffers_.clear();
  if (!had_buffers) return;
  v4l2_requestbuffers request{};
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  device_.request(VIDIOC_REQBUFS, &request);
}

DeviceStatus VideoStream::queue(std::uint32_t index) {
  v4l2_buffer buffer = describe(index);
  return status_of_errno(device_.request(VIDIOC_QBUF, &buffer));
}

DeviceStatus VideoStream::give_back(const FilledBuffer& buffer) {
  return queue(buffer.index);
}

std::optional<Instant> VideoStream::believe(Instant stamp) {
  const bool moves = stamp != Instant() && (!last_stamp_ || stamp > *last_stamp_);
  if (!moves) return std::nullopt;
  last_stamp_ = stamp;
  return stamp;
}

DeviceStatus VideoStream::take(Nanoseconds timeout, FilledBuffer& filled) {
  bool has_news = false;
  if (const int error = device_.wait(timeout, has_news); error != 0) return status_of_errno(error);
  if (!has_news) return DeviceCode::timed_out;
  v4l2_buffer buffer = describe(0);
  const int error = device_.request(VIDIOC_DQBUF, &buffer);
  if (error == EAGAIN) return DeviceCode::timed_out;  // the news was no frame
  if (error != 0) return status_of_errno(error);
  if (buffer.index >= buffers_.size()) return DeviceCode::io_error;
  const std::span<const std::uint8_t> memory = buffers_[buffer.index];
  filled.index = buffer.index;
  filled.bytes = memory.first(std::min<std::size_t>(buffer.bytesused, memory.size()));
  filled.sequence = buffer.sequence;
  filled.stamped_at.reset();
  if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) {
    filled.stamped_at = believe(Instant(std::chrono::seconds(buffer.timestamp.tv_sec) +
                                        std::chrono::microseconds(buffer.timestamp.tv_usec)));
  }
  filled.is_stamped_at_start = (buffer.flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  filled.is_damaged = (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0;
  return DeviceCode::ok;
}

}  // namespace traygauge
