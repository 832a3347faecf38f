// libgpiod 2.x (Debian 13, and bookworm-backports).
#include <gpiod.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "drivers/gpio/gpio_line.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

constexpr const char* kConsumer = "traygauge";
constexpr std::size_t kQueuedEdges = 64;  // that the kernel keeps while nobody reads

template <class T, void (*Free)(T*)>
struct FreedBy {
  void operator()(T* object) const { Free(object); }
};
template <class T, void (*Free)(T*)>
using Owned = std::unique_ptr<T, FreedBy<T, Free>>;

using Chip = Owned<gpiod_chip, gpiod_chip_close>;
using Settings = Owned<gpiod_line_settings, gpiod_line_settings_free>;
using LineConfig = Owned<gpiod_line_config, gpiod_line_config_free>;
using RequestConfig = Owned<gpiod_request_config, gpiod_request_config_free>;
using ChipInfo = Owned<gpiod_chip_info, gpiod_chip_info_free>;
using LineInfo = Owned<gpiod_line_info, gpiod_line_info_free>;
using Request = Owned<gpiod_line_request, gpiod_line_request_release>;
using Events = Owned<gpiod_edge_event_buffer, gpiod_edge_event_buffer_free>;

bool is_called(gpiod_chip* chip, const std::string& path, const std::string& wanted) {
  if (wanted == path || fs::path(path).filename() == wanted) return true;
  const ChipInfo info(gpiod_chip_get_info(chip));
  return info && wanted == gpiod_chip_info_get_label(info.get());
}

// The chip that has the line; empty with errno.
Chip find(const GpioPlace& place, unsigned& offset) {
  int error = ENOENT;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/dev", ignored)) {
    const std::string path = entry.path();
    if (!gpiod_is_gpiochip_device(path.c_str())) continue;
    Chip chip(gpiod_chip_open(path.c_str()));
    if (!chip) {
      error = errno;
      continue;
    }
    if (!place.chip.empty()) {
      offset = place.offset;
      if (is_called(chip.get(), path, place.chip)) return chip;
    } else if (const int found = gpiod_chip_get_line_offset_from_name(chip.get(), place.name.c_str());
               found >= 0) {
      offset = static_cast<unsigned>(found);
      return chip;
    }
  }
  errno = error;
  return nullptr;
}

class GpioLineV2 final : public GpioLine {
 public:
  explicit GpioLineV2(const GpioLineParams& params)
      : params_(params), events_(gpiod_edge_event_buffer_new(1)) {}

  DeviceStatus open_input() override {
    return open([](gpiod_line_settings* settings) {
      gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_INPUT);
    });
  }
  DeviceStatus open_edges() override {
    return open([](gpiod_line_settings* settings) {
      gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_INPUT);
      gpiod_line_settings_set_edge_detection(settings, GPIOD_LINE_EDGE_BOTH);
      gpiod_line_settings_set_event_clock(settings, GPIOD_LINE_CLOCK_MONOTONIC);
    });
  }
  DeviceStatus open_output(bool active) override {
    return open([active](gpiod_line_settings* settings) {
      gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_OUTPUT);
      gpiod_line_settings_set_output_value(settings,
                                           active ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE);
    });
  }
  void close() override { request_.reset(); }

  DeviceStatus read(bool& is_active) override {
    const gpiod_line_value value = gpiod_line_request_get_value(request_.get(), offset_);
    is_active = value == GPIOD_LINE_VALUE_ACTIVE;
    return value == GPIOD_LINE_VALUE_ERROR ? fail(errno) : DeviceStatus();
  }
  DeviceStatus write(bool active) override {
    const auto value = active ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
    return gpiod_line_request_set_value(request_.get(), offset_, value) < 0 ? fail(errno) : DeviceStatus();
  }

  DeviceStatus wait_for_edge(Nanoseconds timeout, GpioEdge& edge) override {
    const int news =
        gpiod_line_request_wait_edge_events(request_.get(), std::max(timeout, Nanoseconds::zero()).count());
    if (news == 0 || (news < 0 && errno == EINTR)) return DeviceCode::timed_out;
    if (news < 0 || gpiod_line_request_read_edge_events(request_.get(), events_.get(), 1) < 1)
      return fail(errno);
    gpiod_edge_event* const event = gpiod_edge_event_buffer_get_event(events_.get(), 0);
    edge.at = Instant(Nanoseconds(gpiod_edge_event_get_timestamp_ns(event)));
    edge.to_active = gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE;
    return DeviceCode::ok;
  }

  std::string problem() const override { return problem_; }

 private:
  template <class Choose>
  DeviceStatus open(const Choose& choose) {
    GpioPlace place;
    if (!parse_gpio_place(params_.line, place)) return refuse(DeviceCode::invalid_argument);
    const Chip chip = find(place, offset_);
    if (!chip) return refuse(fail(errno));
    const LineInfo info(gpiod_chip_get_line_info(chip.get(), offset_));
    if (!info) return refuse(fail(errno == EINVAL ? ENOENT : errno));  // fewer lines than that
    const DeviceStatus status = request(chip.get(), choose);
    const char* const consumer = gpiod_line_info_get_consumer(info.get());
    return status.ok() ? status : refuse(status, consumer != nullptr ? consumer : "");
  }

  DeviceStatus refuse(DeviceStatus status, const std::string& consumer = {}) {
    problem_ = describe_line(params_.line, status, consumer);
    return status;
  }

  template <class Choose>
  DeviceStatus request(gpiod_chip* chip, const Choose& choose) {
    const Settings settings(gpiod_line_settings_new());
    const LineConfig lines(gpiod_line_config_new());
    const RequestConfig request(gpiod_request_config_new());
    if (!settings || !lines || !request || !events_) return fail(ENOMEM);
    choose(settings.get());
    gpiod_line_settings_set_active_low(settings.get(), params_.is_active_low);
    if (params_.bias == GpioBias::pull_up) {
      gpiod_line_settings_set_bias(settings.get(), GPIOD_LINE_BIAS_PULL_UP);
    }
    if (params_.bias == GpioBias::pull_down) {
      gpiod_line_settings_set_bias(settings.get(), GPIOD_LINE_BIAS_PULL_DOWN);
    }
    gpiod_request_config_set_consumer(request.get(), kConsumer);
    gpiod_request_config_set_event_buffer_size(request.get(), kQueuedEdges);
    if (gpiod_line_config_add_line_settings(lines.get(), &offset_, 1, settings.get()) < 0) return fail(errno);
    request_.reset(gpiod_chip_request_lines(chip, request.get(), lines.get()));
    return request_ ? DeviceStatus() : fail(errno);
  }
  static DeviceStatus fail(int error_number) {
    return status_of_errno(error_number != 0 ? error_number : EIO);
  }

  GpioLineParams params_;
  std::string problem_ = "line " + params_.line;
  Events events_;
  Request request_;
  unsigned offset_ = 0;
};

}  // namespace

std::unique_ptr<GpioLine> make_gpio_line(const GpioLineParams& params) {
  return std::make_unique<GpioLineV2>(params);
}

}  // namespace traygauge
