// What the station's loop needs of a measurement.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "core/base/status.hpp"
#include "core/image_view/image_view.hpp"
#include "drivers/clock.hpp"
#include "firmware/station/lens_watch.hpp"
#include "firmware/station/tray_hint.hpp"

namespace traygauge {

struct Measurement;

// A picture as the station took it.
struct StationView {
  FrameView frame;
  std::uint64_t sequence = 0;           // the camera's number of the frame
  std::optional<double> arm_angle_deg;  // where the arm stood, 0 at home; none without an arm
  bool is_of_second_camera = false;
};

// begin_scan, add_view up to twice, measure. Called by one thread.
class Measurer {
 public:
  Measurer() = default;
  Measurer(const Measurer&) = delete;
  Measurer& operator=(const Measurer&) = delete;
  virtual ~Measurer() = default;

  // A new tray lies there, of which `hint` is known: forgets the last one.
  virtual void begin_scan(const TrayHint& hint) = 0;
  // Does what can be done with this view alone; the arm may move meanwhile. The pixels stay valid until the
  // next begin_scan(). After a failure measure() reports the same.
  virtual Status add_view(const StationView& view) = 0;
  // Valid until the next call of any function.
  virtual const Measurement& measure() = 0;
  // The same in two steps, between which the caller may do something else. await_measurement() waits at most
  // `timeout`; null: not there yet. Who cannot work meanwhile measures when awaited.
  virtual void begin_measuring() {}
  virtual const Measurement* await_measurement(Nanoseconds /*timeout*/) { return &measure(); }
  // Whether turned_deg() is of use; else a hand that moves the camera gets no guidance.
  virtual bool can_guide() const { return false; }
  // After the first view: by how many degrees the line of sight to the tray has turned since, in a picture
  // taken on the way; none where that is not seen. The picture is not kept.
  virtual std::optional<double> turned_deg(const FrameView& /*live*/) { return std::nullopt; }
  // What the last trays showed on the lens, the one just measured among them.
  virtual std::optional<LensSpot> lens_spot() const { return std::nullopt; }
  // What is known to lie there, for people; empty when nothing is.
  virtual std::string_view tray_name() const = 0;
};

}  // namespace traygauge
