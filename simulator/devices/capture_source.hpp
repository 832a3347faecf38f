// What the simulated devices need to know of recorded captures.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "core/image_view/image_view.hpp"
#include "drivers/camera.hpp"

namespace traygauge {

// A recorded view, decoded. Without recorded labels `labels` is empty.
struct PlayedView {
  FrameView frame;
  ImageView<const std::uint8_t> labels;
  std::optional<double> arm_angle_deg;
};

// The trays that will be put under the camera, in the order in which they are played. Their metadata has been
// read and checked; the pictures are decoded one capture at a time.
class CaptureSource {
 public:
  CaptureSource() = default;
  CaptureSource(const CaptureSource&) = delete;
  CaptureSource& operator=(const CaptureSource&) = delete;
  virtual ~CaptureSource() = default;

  virtual std::size_t capture_count() const = 0;
  // Holds every picture of every capture.
  virtual CameraFormat largest_frame() const = 0;
  // Decodes the active pair of capture `index` < capture_count(); what the last open() gave is gone. False
  // when a file cannot be read: problem() then says which and why.
  virtual bool open(std::size_t index) = 0;
  virtual std::string_view problem() const = 0;
  // Of the open capture: its name for people, and its pair in order.
  virtual std::string_view capture_name() const = 0;
  virtual const std::array<PlayedView, 2>& pair() const = 0;
};

}  // namespace traygauge
