#include "tests/board/usb_camera.hpp"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <random>

#include "drivers/clock.hpp"
#include "tests/board/usb_descriptors.hpp"

namespace traygauge {
namespace {

using Bytes = UsbBytes;

// USB/IP: every packet has a header of twelve words, high byte first.
constexpr std::size_t kHeaderWords = 12;
constexpr std::uint32_t kSubmit = 1;
constexpr std::uint32_t kUnlink = 2;
constexpr std::uint32_t kSubmitted = 3;
constexpr std::uint32_t kUnlinked = 4;
constexpr int kStalled = -EPIPE;
constexpr int kReset = -ECONNRESET;
constexpr const char* kAttach = "/sys/devices/platform/vhci_hcd.0/attach";
constexpr int kFirstDevice = 65538;  // bus 1, device 2
constexpr int kHighSpeed = 3;

// USB video class 1.0.
constexpr std::uint8_t kSet = 0x01;
constexpr std::uint8_t kGetCurrent = 0x81;
constexpr std::uint8_t kGetMin = 0x82;
constexpr std::uint8_t kGetMax = 0x83;
constexpr std::uint8_t kGetStep = 0x84;
constexpr std::uint8_t kGetInfo = 0x86;
constexpr std::size_t kPayloadBytes = 16384;
constexpr std::size_t kPayloadHeader = 2;

std::uint16_t word(const std::uint8_t* bytes) {
  return static_cast<std::uint16_t>(bytes[0] | bytes[1] << 8);
}

double now_s() {
  return std::chrono::duration<double>(SystemClock().now().time_since_epoch()).count();
}

}  // namespace

UsbCamera::UsbCamera(int width, int height, double frames_per_s, std::function<Picture()> picture, int port)
    : width_(width),
      height_(height),
      frame_s_(1.0 / frames_per_s),
      picture_(std::move(picture)),
      port_(port),
      configuration_(describe_configuration(width_, height_, frame_s_)) {}

bool UsbCamera::plug_in() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) != 0) return false;
  std::ofstream attach(kAttach);
  attach << port_ << " " << ends[1] << " " << kFirstDevice + port_ << " " << kHighSpeed << std::flush;
  ::close(ends[1]);
  socket_ = ends[0];
  if (!attach) {
    ::close(socket_);
    return false;
  }
  waiting_.clear();
  frame_.clear();
  sent_ = 0;
  is_silent_ = false;
  thread_ = std::thread([this] { serve(); });
  return true;
}

void UsbCamera::unplug() {
  if (!thread_.joinable()) return;
  ::shutdown(socket_, SHUT_RDWR);
  thread_.join();
  ::close(socket_);
}

bool UsbCamera::receive(void* bytes, std::size_t count) {
  auto* to = static_cast<char*>(bytes);
  while (count > 0) {
    const ssize_t got = ::read(socket_, to, count);
    if (got <= 0) return false;
    to += got;
    count -= static_cast<std::size_t>(got);
  }
  return true;
}

void UsbCamera::answer(std::uint32_t sequence, int status, const Bytes& data, std::uint32_t length) {
  std::array<std::uint32_t, kHeaderWords> header{};
  header[0] = htonl(kSubmitted);
  header[1] = htonl(sequence);
  header[5] = htonl(static_cast<std::uint32_t>(status));
  header[6] = htonl(length);
  Bytes packet(sizeof header + data.size());
  std::memcpy(packet.data(), header.data(), sizeof header);
  std::copy(data.begin(), data.end(), packet.begin() + sizeof header);
  std::size_t sent = 0;
  while (sent < packet.size()) {
    const ssize_t count = ::send(socket_, packet.data() + sent, packet.size() - sent, MSG_NOSIGNAL);
    if (count <= 0) return;
    sent += static_cast<std::size_t>(count);
  }
}

void UsbCamera::serve() {
  while (true) {
    pollfd watched{socket_, POLLIN, 0};
    const double wait_s =
        waiting_.empty() || is_silent_ ? 0.05 : std::clamp(next_frame_s_ - now_s(), 0.0, 0.05);
    ::poll(&watched, 1, static_cast<int>(std::ceil(wait_s * 1000.0)));
    if (watched.revents != 0 && !handle_packet()) return;
    send_payloads();
  }
}

bool UsbCamera::handle_packet() {
  std::array<std::uint32_t, kHeaderWords> header{};
  if (!receive(header.data(), sizeof header)) return false;
  const std::uint32_t command = ntohl(header[0]);
  const std::uint32_t sequence = ntohl(header[1]);
  if (command == kUnlink) {
    const std::uint32_t unlinked = ntohl(header[5]);
    const auto found =
        std::find_if(waiting_.begin(), waiting_.end(),
                     [unlinked](const Submission& submission) { return submission.sequence == unlinked; });
    std::array<std::uint32_t, kHeaderWords> reply{};
    reply[0] = htonl(kUnlinked);
    reply[1] = htonl(sequence);
    reply[5] = htonl(static_cast<std::uint32_t>(found != waiting_.end() ? kReset : 0));
    if (found != waiting_.end()) waiting_.erase(found);
    return ::send(socket_, reply.data(), sizeof reply, MSG_NOSIGNAL) == static_cast<ssize_t>(sizeof reply);
  }
  if (command != kSubmit) return false;
  const bool is_in = ntohl(header[3]) != 0;
  const std::uint32_t length = ntohl(header[6]);
  Bytes data(is_in ? 0 : length);
  if (!data.empty() && !receive(data.data(), data.size())) return false;
  if (ntohl(header[4]) == 0) {
    handle_control(sequence, reinterpret_cast<const std::uint8_t*>(&header[10]), data);
  } else {
    waiting_.push_back({sequence, length});
  }
  return true;
}

// `setup`: request type, request, value, index, length.
void UsbCamera::handle_control(std::uint32_t sequence, const std::uint8_t* setup, const Bytes& data) {
  const bool is_in = (setup[0] & 0x80) != 0;
  const bool is_class = (setup[0] & 0x60) == 0x20;
  Bytes reply;
  bool is_known = true;
  if (is_class) {
    is_known = handle_class(setup, data, reply);
  } else if (is_in) {
    is_known = read_standard(setup, reply);
  }
  if (!is_known) return answer(sequence, kStalled, {}, 0);
  if (!is_in) return answer(sequence, 0, {}, static_cast<std::uint32_t>(data.size()));
  reply.resize(std::min<std::size_t>(reply.size(), word(setup + 6)));
  answer(sequence, 0, reply, static_cast<std::uint32_t>(reply.size()));
}

bool UsbCamera::read_standard(const std::uint8_t* setup, Bytes& reply) const {
  constexpr std::uint8_t kGetStatus = 0;
  constexpr std::uint8_t kGetDescriptor = 6;
  if (setup[1] == kGetStatus) reply = {0, 0};
  if (setup[1] == kGetDescriptor && setup[3] == 1) reply = describe_device();
  if (setup[1] == kGetDescriptor && setup[3] == 2) reply = configuration_;
  if (setup[1] == kGetDescriptor && setup[3] == 3) reply = describe_text(setup[2], port_);
  return !reply.empty();
}

// What is negotiated is always the same: there is one format and size.
Bytes UsbCamera::describe_stream() const {
  Bytes state = {1, 0, 1, 1};
  add(state, static_cast<std::uint32_t>(std::lround(frame_s_ * 1e7)), 4);
  state.resize(18);
  add(state, static_cast<std::uint32_t>(2 * width_ * height_), 4);
  add(state, kPayloadBytes, 4);
  return state;
}

bool UsbCamera::handle_class(const std::uint8_t* setup, const Bytes& data, Bytes& reply) {
  const bool is_stream = setup[4] == 1;
  if (!is_stream) return handle_unit(setup, data, reply);
  if (setup[1] == kSet) {
    sent_ = 0;
    frame_.clear();
    return true;
  }
  reply = setup[1] == kGetInfo ? Bytes{3} : describe_stream();
  return true;
}

bool UsbCamera::handle_unit(const std::uint8_t* setup, const Bytes& data, Bytes& reply) {
  const int unit = setup[5];
  const int selector = setup[3];
  struct Control {
    int min, max, step, bytes;
  };
  const bool is_mode = unit == 1 && selector == 2;
  const bool is_exposure = unit == 1 && selector == 4;
  const bool is_gain = unit == 2 && selector == 4;
  if (!is_mode && !is_exposure && !is_gain) return false;
  const Control control = is_mode       ? Control{0, 0, 9, 1}
                          : is_exposure ? Control{1, 5000, 1, 4}
                                        : Control{0, 100, 1, 2};
  int value = is_mode ? exposure_mode_.load() : is_exposure ? exposure_.load() : gain_;
  if (setup[1] == kSet) {
    value = 0;
    for (std::size_t i = 0; i < data.size() && i < 4; ++i) value |= data[i] << (8 * i);
    if (is_mode) exposure_mode_ = value;
    if (is_exposure) exposure_ = value;
    if (is_gain) gain_ = value;
    return true;
  }
  if (setup[1] == kGetInfo) {
    reply = {3};
    return true;
  }
  if (setup[1] == kGetMin) value = control.min;
  if (setup[1] == kGetMax) value = control.max;
  if (setup[1] == kGetStep) value = control.step;
  if (setup[1] != kGetCurrent && setup[1] != kGetMin && setup[1] != kGetMax && setup[1] != kGetStep) {
    value = is_mode ? 8 : is_exposure ? 156 : 16;
  }
  add(reply, static_cast<std::uint32_t>(value), control.bytes);
  return true;
}

void UsbCamera::begin_frame() {
  const UsbFrameFault fault = fault_.exchange(UsbFrameFault::none);
  next_frame_s_ = std::max(next_frame_s_ + frame_s_, now_s());
  frame_ = picture_();
  sent_ = 0;
  is_odd_ = !is_odd_;
  is_flagged_ = fault == UsbFrameFault::flagged;
  if (fault == UsbFrameFault::half) frame_.resize(frame_.size() / 2);
  if (fault == UsbFrameFault::lost) frame_.clear();
  if (fault == UsbFrameFault::junk) {
    std::minstd_rand random(1);
    for (auto& byte : frame_) byte = static_cast<std::uint8_t>(random() >> 8);
  }
}

void UsbCamera::send_payloads() {
  while (!waiting_.empty() && !is_silent_) {
    if (sent_ >= frame_.size()) {
      if (now_s() < next_frame_s_) return;
      begin_frame();
      if (frame_.empty()) continue;
    }
    const Submission submission = waiting_.front();
    waiting_.pop_front();
    const std::size_t room = std::min<std::size_t>(submission.length, kPayloadBytes) - kPayloadHeader;
    const std::size_t count = std::min(room, frame_.size() - sent_);
    const bool is_last = sent_ + count == frame_.size();
    Bytes payload(kPayloadHeader + count);
    payload[0] = kPayloadHeader;
    payload[1] =
        static_cast<std::uint8_t>(0x80 | (is_odd_ ? 1 : 0) | (is_last ? 2 : 0) | (is_flagged_ ? 0x40 : 0));
    std::memcpy(payload.data() + kPayloadHeader, frame_.data() + sent_, count);
    sent_ += count;
    answer(submission.sequence, 0, payload, static_cast<std::uint32_t>(payload.size()));
  }
}

}  // namespace traygauge
