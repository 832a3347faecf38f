// Saves what the station's loop sees as captures, instead of measuring it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/pipeline/measurement.hpp"
#include "firmware/card/card_guide.hpp"
#include "firmware/station/measurer.hpp"
#include "simulator/capture/capture.hpp"

namespace traygauge {

// A folder 0001, 0002, … below `out` for each scan; numbers that are taken are left out. Pictures are PNG, as
// the camera delivered them; capture.json comes last, so that a folder with it is complete.
class CaptureRecorder final : public Measurer {
 public:
  // `cameras` of the first and the second view. Reads the card's pattern, makes the folder; throws
  // InputError, OutputError.
  CaptureRecorder(std::filesystem::path out, const std::array<CameraDescription, 2>& cameras,
                  const CardDescription& card);

  void begin_scan(const TrayHint& hint) override;
  Status add_view(const StationView& view) override;
  // ok when the capture is on disk. Else problem() says why not.
  const Measurement& measure() override;
  bool can_guide() const override { return true; }
  std::optional<double> turned_deg(const FrameView& live) override;
  // The capture's folder.
  std::string_view tray_name() const override { return folder_name_; }
  const std::string& problem() const { return problem_; }

 private:
  struct View {
    FrameView frame;  // the station's pixels, valid until the next scan
    std::optional<double> arm_angle_deg;
  };
  void save() const;

  std::filesystem::path out_;
  std::array<CameraDescription, 2> cameras_;
  CardDescription card_;
  Picture pattern_;
  int number_ = 0;
  std::string folder_name_;
  std::vector<View> views_;
  CardGuide guide_;
  bool guide_knows_view_ = false;
  Measurement measurement_;
  std::string problem_;
};

}  // namespace traygauge
