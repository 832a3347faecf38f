#include "core/pipeline/item_checks.hpp"

#include <algorithm>

#include "core/adjustment/item_motion.hpp"
#include "core/volume/foot_height.hpp"

namespace traygauge {
namespace {

Check check_shift(const CheckedItem& item, const SceneGeometry& geometry, const TrayCheckParams& params) {
  Check check{CheckKind::item_slip_mm, item.label, 0.0, 0.0, params.item_slip_warning_mm, Verdict::passed};
  const CamerasMatrix covariance =
      geometry.bundle.covariance.topLeftCorner<kCameraParameters, kCameraParameters>();
  const ItemMotion motion =
      find_item_motion(item.label, {geometry.tracks, geometry.strays}, geometry.bundle.camera_from_table,
                       covariance, item.focal_px, params.motion);
  if (!motion.is_known) return check;
  check.value = motion.across_mm;
  check.sigma = motion.sigma_mm;
  if (motion.across_mm > params.max_item_sigmas * motion.sigma_mm)
    check.verdict = judge(motion.across_mm, params.item_slip_warning_mm, params.max_item_slip_mm);
  return check;
}

Check check_foot(const CheckedItem& item, const std::array<SurfaceGrid, 2>& grids, const InnerSurface& inner,
                 const TrayCheckParams& params) {
  Check check{CheckKind::item_foot_mm, item.label, 0.0, 0.0, params.foot_warning_mm, Verdict::passed};
  if (item.is_liquid) return check;
  const std::optional<double> height_mm = foot_height_mm(grids, inner, item.label);
  if (!height_mm) return check;
  check.value = *height_mm;
  check.verdict = judge(std::min(*height_mm, 0.0), params.foot_warning_mm, params.max_sunken_mm);
  return check;
}

}  // namespace

StatusCode check_item(const CheckedItem& item, const SceneGeometry& geometry,
                      const std::array<SurfaceGrid, 2>& grids, const InnerSurface& inner,
                      const TrayCheckParams& params, CheckList& checks, WarningSet& warnings) {
  Verdict worst = Verdict::passed;
  for (const Check& check : {check_shift(item, geometry, params), check_foot(item, grids, inner, params)}) {
    checks.add(check);
    worst = std::max(worst, check.verdict);
  }
  warnings.raise_if(worst == Verdict::warned, Warning::item_moved, item.label);
  return worst == Verdict::refused ? StatusCode::item_moved : StatusCode::ok;
}

void check_likeness(std::uint8_t item, double unlike_share, const TrayCheckParams& params, CheckList& checks,
                    WarningSet& warnings) {
  constexpr double kPercent = 100.0;
  const bool is_unlike = unlike_share > params.pictures.max_unlike;
  checks.add({CheckKind::item_unlike_percent, item, kPercent * unlike_share, 0.0,
              kPercent * params.pictures.max_unlike, is_unlike ? Verdict::warned : Verdict::passed});
  warnings.raise_if(is_unlike, Warning::pictures_differ, item);
}

}  // namespace traygauge
