#include "core/paper/pipeline/view_preparation.hpp"

#include <algorithm>
#include <cmath>

#include "core/quality/exposure.hpp"
#include "core/quality/view_input.hpp"

namespace traygauge::paper {
namespace {

// Scale that brings `pixels` to `target_pixels`.
double area_scale(double pixels, double target_pixels) {
  return std::sqrt(target_pixels / pixels);
}

// The smallest upright rectangle of the undistorted, scaled picture that holds the box and a margin. The
// box's edge is sampled because lens distortion bends it.
Roi cut_out(const LensModel& lens, const PixelBox& box, double scale, double margin_px) {
  PinholeCamera scaled{lens.pinhole.fx_px * scale, lens.pinhole.fy_px * scale,
                       scale_coordinate(lens.pinhole.cx_px, scale),
                       scale_coordinate(lens.pinhole.cy_px, scale)};
  constexpr int kSamplesPerSide = 8;
  Vec2 low = Vec2::Constant(1e9);
  Vec2 high = Vec2::Constant(-1e9);
  for (int i = 0; i <= kSamplesPerSide; ++i) {
    const double t = static_cast<double>(i) / kSamplesPerSide;
    const double x = box.left + t * (box.width() - 1);
    const double y = box.top + t * (box.height() - 1);
    for (const Vec2& pixel :
         {Vec2(x, box.top), Vec2(x, box.bottom - 1), Vec2(box.left, y), Vec2(box.right - 1, y)}) {
      Vec2 ray;
      if (!lens.undistort_pixel(pixel, ray)) continue;
      low = low.cwiseMin(scaled.pixel(ray));
      high = high.cwiseMax(scaled.pixel(ray));
    }
  }
  if (high.x() < low.x()) return {};
  const double left = std::floor(low.x() - margin_px);
  const double top = std::floor(low.y() - margin_px);
  scaled.cx_px -= left;
  scaled.cy_px -= top;
  return {scaled, static_cast<int>(std::ceil(high.x() + margin_px) - left) + 1,
          static_cast<int>(std::ceil(high.y() + margin_px) - top) + 1};
}

// A dish that is long and lies obliquely needs more working pixels than the memory holds: the scale gives
// way. Where the background is matched too (paper V-B), the whole picture is worked on at that scale.
Status choose_cutout(const Configuration& configuration, PreparedView& view) {
  const PixelBox whole{0, 0, view.lens.width, view.lens.height};
  double scale = area_scale(view.regions.dish_pixels, configuration.view.matching_dish_px);
  constexpr int kShrinkAttempts = 8;
  for (int attempt = 0; attempt < kShrinkAttempts; ++attempt) {
    view.dish = cut_out(view.lens, view.regions.dish, scale, configuration.view.working_margin_px);
    view.cutout = configuration.view.match_dish_only ? view.dish : cut_out(view.lens, whole, scale, 0.0);
    const double pixels = static_cast<double>(view.cutout.width) * view.cutout.height;
    if (view.cutout.width <= 0) return StatusCode::invalid_configuration;
    if (pixels <= configuration.caps.max_working_px) return StatusCode::ok;
    scale *= 0.98 * area_scale(pixels, configuration.caps.max_working_px);
  }
  return StatusCode::out_of_memory;
}

}  // namespace

Status prepare_picture(const FrameView& frame, const Configuration& configuration,
                       PreparationWorkspace& workspace, PreparedView& view) {
  Status status = check_sizes(frame, view.labels, view.lens, configuration.limits);
  if (!status.ok()) return status;
  view.regions = measure_regions(view.labels);
  status = check_labels(view.regions);
  if (!status.ok()) return status;

  workspace.frame_gray = {workspace.gray.data, frame.width, frame.height};
  convert_to_gray(frame, workspace.frame_gray);
  status = check_exposure(workspace.frame_gray, configuration.exposure);
  if (!status.ok()) return status;
  const CheckedView checked{frame, workspace.frame_gray, view.labels, &view.regions, &view.lens};
  assess_view(checked, {configuration.card.width_mm, configuration.card.height_mm}, configuration.view_checks,
              workspace.card_silhouette, view.quality_storage.front());
  status = judge_view(view.quality(), configuration.view_checks);
  if (!status.ok()) return status;

  status = choose_cutout(configuration, view);
  if (!status.ok()) return status;
  view.gray = {view.gray_storage.data(), view.cutout.width, view.cutout.height};
  view.working_labels = {view.label_storage.data(), view.cutout.width, view.cutout.height};
  resample_undistorted(frame, view.lens, view.cutout, view.gray);
  resample_labels_undistorted(view.labels, view.lens, view.cutout, view.working_labels);
  return StatusCode::ok;
}

}  // namespace traygauge::paper
