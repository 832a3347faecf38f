#include "firmware/record/capture_recorder.hpp"

#include <array>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "firmware/measure/pair_setup.hpp"
#include "firmware/record/recorded_files.hpp"
#include "simulator/capture/capture_document.hpp"
#include "simulator/capture/png_writer.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kViews = 2;

}  // namespace

CaptureRecorder::CaptureRecorder(fs::path out, const std::array<CameraDescription, 2>& cameras,
                                 const CardDescription& card)
    : out_(std::move(out)), cameras_(cameras), card_(card), pattern_(load_pattern(card)) {
  make_output_folder(out_);
}

void CaptureRecorder::begin_scan(const TrayHint& /*hint*/) {
  views_.clear();
  guide_knows_view_ = false;
  std::error_code ignored;
  do {
    folder_name_ = four_digits(++number_);
  } while (fs::exists(out_ / folder_name_, ignored));
}

Status CaptureRecorder::add_view(const StationView& view) {
  const PictureSize& size = cameras_.at(views_.size()).size;
  views_.push_back({view.frame, view.arm_angle_deg});
  const bool has_size = view.frame.width == size.width && view.frame.height == size.height;
  return has_size ? StatusCode::ok : StatusCode::frame_size_mismatch;
}

std::optional<double> CaptureRecorder::turned_deg(const FrameView& live) {
  if (views_.empty()) return std::nullopt;
  if (!guide_knows_view_) {
    guide_.begin(card_of(card_, pattern_), lens_of(cameras_[0]), views_[0].frame);
  }
  guide_knows_view_ = true;
  return guide_.turned_deg(live);
}

const Measurement& CaptureRecorder::measure() {
  measurement_ = {};
  problem_.clear();
  try {
    if (views_.size() == kViews) save();
    if (views_.size() != kViews) measurement_.status = StatusCode::frame_size_mismatch;
  } catch (const OutputError& error) {
    problem_ = error.what();
    measurement_.status = StatusCode::frame_missing;
  }
  return measurement_;
}

void CaptureRecorder::save() const {
  const fs::path folder = out_ / folder_name_;
  std::error_code error;
  fs::create_directory(folder, error);
  if (error) throw OutputError(folder, error.message());
  nlohmann::ordered_json json;
  json["version"] = 1;
  json["card"] = {{"pattern", "card.png"},
                  {"width_mm", card_.width_mm},
                  {"height_mm", card_.height_mm},
                  {"thickness_mm", card_.thickness_mm}};
  write_png(folder / "card.png", pattern_.frame());
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const std::string image = "view_" + std::to_string(i) + ".png";
    write_png(folder / image, as_rgb(views_[i].frame).frame());
    nlohmann::ordered_json view = {{"image", image}, {"camera", compose_camera(cameras_[i])}};
    if (views_[i].arm_angle_deg) view["arm_angle_deg"] = *views_[i].arm_angle_deg;
    json["views"].push_back(view);
  }
  json["pairs"] = {{0, 1}};
  const std::string text = json.dump(1) + "\n";
  write_stream(folder / "capture.json", [&text](std::FILE* stream) {
    return std::fwrite(text.data(), 1, text.size(), stream) == text.size();
  });
}

}  // namespace traygauge
