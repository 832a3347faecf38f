// A serial line that carries lines of text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "drivers/clock.hpp"
#include "drivers/device_status.hpp"

namespace traygauge {

// Whether a line can run so fast: 9600, 19200, 38400, 57600, 115200 or 230400 baud.
bool is_serial_speed(int baud);

class SerialPort {
 public:
  SerialPort() = default;
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;
  ~SerialPort() { close(); }

  // 8 bits, no parity, one stop bit, no flow control; forgets what was received before. Another `baud` than
  // is_serial_speed() is an invalid_argument. in_use while another program has it.
  DeviceStatus open(const std::string& path, int baud);
  void close();
  bool is_open() const { return descriptor_ >= 0; }

  // Sends the line and its end, waiting at most `timeout`.
  DeviceStatus send(std::string_view line, Nanoseconds timeout);
  // The next line without its end; timed_out when none was complete in time. A line of more than 200
  // characters is noise: io_error.
  DeviceStatus receive(std::string& line, Nanoseconds timeout);
  // Forgets what has arrived.
  void discard();

 private:
  DeviceStatus wait(std::int16_t events, Instant deadline);

  SystemClock clock_;
  int descriptor_ = -1;
  std::string received_;
};

}  // namespace traygauge
