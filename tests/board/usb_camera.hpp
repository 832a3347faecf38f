// A USB camera made of software: it speaks USB/IP to the kernel's virtual host controller (vhci-hcd), so that
// the kernel's own uvcvideo serves it as /dev/videoN. Needs root in a guest.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace traygauge {

// What is wrong with the next frame.
enum class UsbFrameFault : std::uint8_t {
  none,
  flagged,  // the camera itself says that it is damaged
  half,     // ends in the middle
  junk,     // noise of the same length
  lost,     // never sent
};

class UsbCamera {
 public:
  using Picture = std::vector<std::uint8_t>;

  // Motion JPEG of this size. `picture` gives each frame's bytes, from the camera's own thread. On port 0 its
  // serial number is T0001, on port 1 T0002.
  UsbCamera(int width, int height, double frames_per_s, std::function<Picture()> picture, int port = 0);
  UsbCamera(const UsbCamera&) = delete;
  UsbCamera& operator=(const UsbCamera&) = delete;
  ~UsbCamera() { unplug(); }

  // False when the kernel has no virtual host controller.
  bool plug_in();
  // As if the cable was pulled.
  void unplug();
  void spoil_next(UsbFrameFault fault) { fault_ = fault; }
  // Sends nothing any more, and says nothing of it.
  void fall_silent(bool is_silent) { is_silent_ = is_silent; }
  int exposure() const { return exposure_; }
  bool is_exposure_automatic() const { return exposure_mode_ != 1; }

 private:
  struct Submission {
    std::uint32_t sequence = 0;
    std::uint32_t length = 0;
  };

  void serve();
  bool handle_packet();
  void handle_control(std::uint32_t sequence, const std::uint8_t* setup,
                      const std::vector<std::uint8_t>& data);
  bool read_standard(const std::uint8_t* setup, std::vector<std::uint8_t>& reply) const;
  bool handle_class(const std::uint8_t* setup, const std::vector<std::uint8_t>& data,
                    std::vector<std::uint8_t>& reply);
  bool handle_unit(const std::uint8_t* setup, const std::vector<std::uint8_t>& data,
                   std::vector<std::uint8_t>& reply);
  void send_payloads();
  void begin_frame();
  bool receive(void* bytes, std::size_t count);
  void answer(std::uint32_t sequence, int status, const std::vector<std::uint8_t>& data,
              std::uint32_t length);
  std::vector<std::uint8_t> describe_stream() const;

  int width_;
  int height_;
  double frame_s_;
  std::function<Picture()> picture_;
  int port_;
  std::vector<std::uint8_t> configuration_;
  std::atomic<UsbFrameFault> fault_ = UsbFrameFault::none;
  std::atomic<bool> is_silent_ = false;
  std::atomic<int> exposure_ = 156;
  std::atomic<int> exposure_mode_ = 8;
  int gain_ = 16;

  int socket_ = -1;
  std::thread thread_;
  std::deque<Submission> waiting_;
  Picture frame_;
  std::size_t sent_ = 0;
  bool is_odd_ = false;
  bool is_flagged_ = false;
  double next_frame_s_ = 0.0;
};

}  // namespace traygauge
