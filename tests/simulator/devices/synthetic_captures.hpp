// Captures whose every pixel says which view of which capture it belongs to.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "simulator/devices/capture_source.hpp"

namespace traygauge {

struct SyntheticCapture {
  int width = 8;
  int height = 6;
  std::optional<double> first_angle_deg = {};
  std::optional<double> second_angle_deg = {};
  bool readable = true;
};

class SyntheticCaptures final : public CaptureSource {
 public:
  explicit SyntheticCaptures(std::vector<SyntheticCapture> captures) : captures_(std::move(captures)) {}
  explicit SyntheticCaptures(std::size_t count)
      : SyntheticCaptures(std::vector<SyntheticCapture>(count, SyntheticCapture{})) {}

  static std::uint8_t gray_of(std::size_t capture, int view) {
    return static_cast<std::uint8_t>(20 * (capture + 1) + 100 * static_cast<std::size_t>(view));
  }

  std::size_t capture_count() const override { return captures_.size(); }
  CameraFormat largest_frame() const override {
    CameraFormat format{0, 0, PixelFormat::bgr8};
    for (const auto& capture : captures_) {
      format.width = std::max(format.width, capture.width);
      format.height = std::max(format.height, capture.height);
    }
    return format;
  }
  bool open(std::size_t index) override {
    const SyntheticCapture& capture = captures_.at(index);
    name_ = std::string("tray ").append(std::to_string(index));
    problem_ = capture.readable ? std::string() : std::string(name_).append("/view_0.jpg: damaged");
    for (int view = 0; view < 2; ++view) {
      const auto i = static_cast<std::size_t>(view);
      const std::uint8_t gray = gray_of(same_pictures ? 0 : index, view);
      pixels_[i].assign(static_cast<std::size_t>(3 * capture.width * capture.height), gray);
      pair_[i] = {{pixels_[i].data(), capture.width, capture.height, 3 * capture.width, PixelFormat::bgr8},
                  {pixels_[i].data(), capture.width, capture.height},
                  view == 0 ? capture.first_angle_deg : capture.second_angle_deg};
    }
    return capture.readable;
  }
  std::string_view problem() const override { return problem_; }
  std::string_view capture_name() const override { return name_; }
  const std::array<PlayedView, 2>& pair() const override { return pair_; }

  bool same_pictures = false;  // all captures show what the first shows

 private:
  std::vector<SyntheticCapture> captures_;
  std::array<std::vector<std::uint8_t>, 2> pixels_;
  std::array<PlayedView, 2> pair_;
  std::string name_;
  std::string problem_;
};

}  // namespace traygauge
