// One line of a board's general purpose inputs and outputs, by libgpiod. Version 1 and 2 of that library have
// different interfaces: gpio_line_v1.cpp and gpio_line_v2.cpp, of which the build takes the one that fits.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "drivers/clock.hpp"
#include "drivers/device_status.hpp"

namespace traygauge {

enum class GpioBias : std::uint8_t { as_is, pull_up, pull_down };

struct GpioLineParams {
  // The line's name ("TRIGGER"), or a chip's name, label or path and the line's number ("gpiochip0/17").
  std::string line;
  bool is_active_low = false;
  GpioBias bias = GpioBias::as_is;
};

// A line became active or inactive.
struct GpioEdge {
  Instant at;  // by the kernel
  bool to_active = false;
};

class GpioLine {
 public:
  GpioLine() = default;
  GpioLine(const GpioLine&) = delete;
  GpioLine& operator=(const GpioLine&) = delete;
  virtual ~GpioLine() = default;

  // Takes the line; nobody else can then. in_use, no_permission, device_gone: problem() names the line and
  // says more. It is closed.
  virtual DeviceStatus open_input() = 0;
  virtual DeviceStatus open_edges() = 0;  // an input that notes its edges
  virtual DeviceStatus open_output(bool active) = 0;
  virtual void close() = 0;

  virtual DeviceStatus read(bool& is_active) = 0;
  virtual DeviceStatus write(bool active) = 0;
  // The next edge, waiting at most `timeout` (0: does not wait): timed_out when there was none. After
  // open_edges().
  virtual DeviceStatus wait_for_edge(Nanoseconds timeout, GpioEdge& edge) = 0;
  virtual std::string problem() const = 0;
};

// The kernel's line. Any call fails with device_gone when the chip has disappeared.
std::unique_ptr<GpioLine> make_gpio_line(const GpioLineParams& params);

// Where a line is, by `GpioLineParams::line`.
struct GpioPlace {
  std::string chip;     // empty: on any chip, by `name`
  unsigned offset = 0;  // on `chip`
  std::string name;
};
// False when it has neither form.
bool parse_gpio_place(const std::string& line, GpioPlace& place);

// The line, and why it could not be opened. `consumer`: which program has taken it; empty: not known.
std::string describe_line(const std::string& line, DeviceStatus status, const std::string& consumer);

}  // namespace traygauge
