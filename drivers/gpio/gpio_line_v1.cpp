// libgpiod 1.x (Debian 12).
#include <gpiod.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <utility>

#include "drivers/gpio/gpio_line.hpp"

namespace traygauge {
namespace {

constexpr const char* kConsumer = "traygauge";

timespec to_timespec(Nanoseconds duration) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(duration);
  timespec time{};
  time.tv_sec = static_cast<time_t>(seconds.count());
  time.tv_nsec = static_cast<decltype(time.tv_nsec)>((duration - seconds).count());
  return time;
}

class GpioLineV1 final : public GpioLine {
 public:
  explicit GpioLineV1(GpioLineParams params) : params_(std::move(params)) {}
  ~GpioLineV1() override { GpioLineV1::close(); }

  DeviceStatus open_input() override {
    return open([this] { return gpiod_line_request_input_flags(line_, kConsumer, flags()); });
  }
  DeviceStatus open_edges() override {
    return open([this] { return gpiod_line_request_both_edges_events_flags(line_, kConsumer, flags()); });
  }
  DeviceStatus open_output(bool active) override {
    return open([this, active] {
      return gpiod_line_request_output_flags(line_, kConsumer, flags(), active ? 1 : 0);
    });
  }

  void close() override {
    if (line_ != nullptr) gpiod_line_release(line_);
    line_ = nullptr;
    if (chip_ != nullptr) gpiod_chip_close(chip_);
    chip_ = nullptr;
  }

  DeviceStatus read(bool& is_active) override {
    const int value = gpiod_line_get_value(line_);
    is_active = value > 0;
    return value < 0 ? fail(errno) : DeviceStatus();
  }
  DeviceStatus write(bool active) override {
    return gpiod_line_set_value(line_, active ? 1 : 0) < 0 ? fail(errno) : DeviceStatus();
  }

  DeviceStatus wait_for_edge(Nanoseconds timeout, GpioEdge& edge) override {
    const timespec time = to_timespec(std::max(timeout, Nanoseconds::zero()));
    const int news = gpiod_line_event_wait(line_, &time);
    if (news == 0 || (news < 0 && errno == EINTR)) return DeviceCode::timed_out;
    gpiod_line_event event{};
    if (news < 0 || gpiod_line_event_read(line_, &event) < 0) return fail(errno);
    edge.at = Instant(std::chrono::seconds(event.ts.tv_sec) + Nanoseconds(event.ts.tv_nsec));
    edge.to_active = event.event_type == GPIOD_LINE_EVENT_RISING_EDGE;
    return DeviceCode::ok;
  }

  std::string problem() const override { return problem_; }

 private:
  template <class Request>
  DeviceStatus open(const Request& request) {
    GpioPlace place;
    if (!parse_gpio_place(params_.line, place)) return refuse(DeviceCode::invalid_argument);
    errno = 0;
    if (place.chip.empty()) {
      line_ = gpiod_line_find(place.name.c_str());
      if (line_ != nullptr) chip_ = gpiod_line_get_chip(line_);
    } else {
      chip_ = gpiod_chip_open_lookup(place.chip.c_str());
      if (chip_ != nullptr) line_ = gpiod_chip_get_line(chip_, place.offset);
    }
    const int found = line_ == nullptr ? (errno != 0 && errno != EINVAL ? errno : ENOENT) : 0;
    const int error = found == 0 && request() < 0 ? errno : found;
    if (error == 0) return DeviceCode::ok;
    const char* const consumer = line_ != nullptr ? gpiod_line_consumer(line_) : nullptr;
    const DeviceStatus status = refuse(status_of_errno(error), consumer != nullptr ? consumer : "");
    line_ = nullptr;  // it was not taken, so it need not be released
    close();
    return status;
  }

  DeviceStatus refuse(DeviceStatus status, const std::string& consumer = {}) {
    problem_ = describe_line(params_.line, status, consumer);
    return status;
  }

  int flags() const {
    int flags = params_.is_active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
    if (params_.bias == GpioBias::pull_up) flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP;
    if (params_.bias == GpioBias::pull_down) flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN;
    return flags;
  }
  static DeviceStatus fail(int error_number) {
    return status_of_errno(error_number != 0 ? error_number : EIO);
  }

  GpioLineParams params_;
  std::string problem_ = "line " + params_.line;
  gpiod_chip* chip_ = nullptr;
  gpiod_line* line_ = nullptr;
};

}  // namespace

std::unique_ptr<GpioLine> make_gpio_line(const GpioLineParams& params) {
  return std::make_unique<GpioLineV1>(params);
}

}  // namespace traygauge
