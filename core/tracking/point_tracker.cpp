#include "core/tracking/point_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace traygauge {
namespace {

constexpr std::size_t kFirstLookLevel = kPyramidLevels - 1;
constexpr std::size_t kSecondLookLevel = kCornerLevel;
constexpr int kMaxBands = 16;  // of a search

Vec2 at_level(const Vec2& stored, std::size_t level) {
  return {to_level(stored.x(), level), to_level(stored.y(), level)};
}

Vec2 stored_from(const Vec2& coordinates, std::size_t level) {
  return {from_level(coordinates.x(), level), from_level(coordinates.y(), level)};
}

Vec2 stored_pixel(const Corner& corner) {
  return stored_from(Vec2(corner.x, corner.y), kCornerLevel);
}

}  // namespace

bool PointTracker::known_height(std::uint8_t label, double& height_mm) const {
  const Ground ground = ground_of(label);
  if (ground == Ground::table) height_mm = 0.0;
  if (ground == Ground::card) height_mm = card_mm_;
  return ground == Ground::table || ground == Ground::card;
}

bool PointTracker::search(const Vec2& pixel, const TableRay& ray, const HeightRange& range, const Look& look,
                          FoundPatch& found) {
  Vec2 low;
  Vec2 high;
  if (!transfer_.transfer(ray, range.low_mm, low) || !transfer_.transfer(ray, range.high_mm, high))
    return false;
  const double scale = 1.0 / static_cast<double>(1U << look.level);
  // Bands short enough for one warp and for the search's memory.
  const double longest_px = kMaxBandSide - 4.0 - 4.0 * look.margin_px * scale;
  const double wanted = std::max((range.high_mm - range.low_mm) / params_.band_height_mm,
                                 (high - low).norm() * scale / std::max(longest_px, 1.0));
  if (!(wanted <= kMaxBands)) return false;
  const int bands = std::max(1, static_cast<int>(std::ceil(wanted)));
  PatchSearch patch_search(first_.gray.levels[look.level], second_.gray.levels[look.level],
                           workspace_.search);
  patch_search.begin();
  for (int band = 0; band < bands; ++band) {
    const double step_mm = (range.high_mm - range.low_mm) / bands;
    const double begin_mm = range.low_mm + band * step_mm;
    TransferredPixel middle;
    Vec2 begin;
    Vec2 end;
    if (!transfer_.transfer(ray, begin_mm + 0.5 * step_mm, middle) ||
        !transfer_.transfer(ray, begin_mm, begin) || !transfer_.transfer(ray, begin_mm + step_mm, end)) {
      return false;
    }
    if (!(std::abs(middle.second_from_first.determinant()) > 0.05)) return false;
    patch_search.search(at_level(pixel, look.level),
                        {at_level(begin, look.level), at_level(end, look.level), look.margin_px * scale,
                         middle.second_from_first.inverse()});
  }
  if (!patch_search.find_best(found)) return false;
  found.pixel = stored_from(found.pixel, look.level);
  return true;
}

std::span<const std::uint8_t> PointTracker::find_occluded_cells() {
  const ImageView<const std::uint8_t> picture = first_.gray.levels[kCornerLevel];
  const CornerGrid grid(picture.width, picture.height, params_.corners);
  const std::span<std::uint8_t> hidden = workspace_.hidden_cells.first(grid.cells());
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const Vec2 centre = (Vec2(column, row) + Vec2::Constant(0.5)) * grid.cell_px;
      TableRay ray;
      Vec2 there;
      const bool seen = transfer_.cast_ray(stored_from(centre, kCornerLevel), ray) &&
                        transfer_.transfer(ray, 0.0, there) && there.x() > 0.0 && there.y() > 0.0 &&
                        there.x() < second_.lens.width - 1.0 && there.y() < second_.lens.height - 1.0;
      hidden[grid.cell_of(column * grid.cell_px, row * grid.cell_px)] = seen ? 0 : 1;
    }
  }
  return hidden;
}

// The strongest corner of each ground in each large cell.
void PointTracker::choose_strongest(std::span<const Corner> corners, FirstLooks& strongest) const {
  const ImageView<const std::uint8_t> picture = first_.gray.levels[kCornerLevel];
  constexpr auto kAcross = static_cast<int>(kFirstLookCells);
  const int side = std::max(picture.width, picture.height) / kAcross + 1;
  for (const Corner& corner : corners) {
    const auto cell = static_cast<std::size_t>(corner.y / side) * kFirstLookCells +
                      static_cast<std::size_t>(corner.x / side);
    const Corner*& place = strongest[kGrounds * cell + static_cast<std::size_t>(ground_of(corner.label))];
    if (place == nullptr || corner.response > place->response) place = &corner;
  }
}

void PointTracker::look_first(std::span<const Corner> corners) {
  FirstLooks chosen{};
  if (params_.follows_table) {
    choose_strongest(corners, chosen);
  } else {
    // A dish may have turned far, and there are few.
    for (std::size_t i = 0; i < std::min(corners.size(), chosen.size()); ++i) chosen[i] = &corners[i];
  }
  BoundedList<SeenPoint> seen(workspace_.seen_storage);
  const Look look{kFirstLookLevel, params_.first_look_margin_px};
  for (const Corner* corner : chosen) {
    if (corner == nullptr) continue;
    const Vec2 pixel = stored_pixel(*corner);
    TableRay ray;
    if (!transfer_.cast_ray(pixel, ray)) continue;
    SeenPoint point;
    HeightRange range = all_heights();
    point.height_known = known_height(corner->label, range.low_mm);
    if (point.height_known) range.high_mm = range.low_mm;
    FoundPatch found;
    if (!search(pixel, ray, range, look, found)) continue;
    if (found.correlation < params_.min_correlation ||
        found.correlation - found.runner_up < params_.min_lead) {
      continue;
    }
    if (point.height_known && !transfer_.point_at(ray, range.low_mm, point.table_mm)) continue;
    point.first = ray.in_camera;
    if (!second_.lens.undistort_pixel(found.pixel, point.second)) continue;
    seen.push_back(point);
  }
  report_.first_look = seen.size();
  correct_second_pose(seen.items(), focal_px(), params_.correction, cameras_);
  transfer_ = HeightTransfer(first_.lens, second_.lens, cameras_);
}

bool PointTracker::look_closer(const Vec2& pixel, const TableRay& ray, std::uint8_t label,
                               FoundPatch& found) {
  double height_mm = 0.0;
  if (known_height(label, height_mm) &&
      search(pixel, ray, {height_mm, height_mm}, {kSecondLookLevel, params_.table_margin_px}, found) &&
      found.correlation >= params_.min_correlation) {
    return true;
  }
  return search(pixel, ray, all_heights(), {kSecondLookLevel, params_.margin_px}, found) &&
         found.correlation >= params_.min_height_correlation;
}

bool PointTracker::align(const Vec2& pixel, const TableRay& ray, std::uint8_t label, const FoundPatch& found,
                         PatchAlignment& alignment) {
  // The height whose transfer lies nearest gives the warp.
  Vec2 low;
  Vec2 high;
  if (!transfer_.transfer(ray, params_.min_height_mm, low) ||
      !transfer_.transfer(ray, params_.max_height_mm, high)) {
    return false;
  }
  const Vec2 segment = high - low;
  const double length = segment.squaredNorm();
  const double share = length > 0.0 ? std::clamp((found.pixel - low).dot(segment) / length, 0.0, 1.0) : 0.0;
  TransferredPixel there;
  const double height_mm = params_.min_height_mm + share * (params_.max_height_mm - params_.min_height_mm);
  if (!transfer_.transfer(ray, height_mm, there)) return false;
  if (!(std::abs(there.second_from_first.determinant()) > 0.05)) return false;
  alignment.pixel = found.pixel;
  alignment.first_from_second = there.second_from_first.inverse();
  double known_mm = 0.0;
  const PatchMotion motion = known_height(label, known_mm) ? PatchMotion::shift : PatchMotion::affine;
  if (!align_patch(first_.gray.levels[0], pixel, second_.gray.levels[0], motion, params_.alignment,
                   alignment)) {
    return false;
  }
  return alignment.correlation >= params_.min_correlation && alignment.sigma_px <= params_.max_sigma_px;
}

bool PointTracker::returns(const Vec2& pixel, const PatchAlignment& alignment) const {
  PatchAlignment back;
  back.pixel = pixel;
  back.first_from_second = alignment.first_from_second.inverse();
  return align_patch(second_.gray.levels[0], alignment.pixel, first_.gray.levels[0], PatchMotion::shift,
                     params_.alignment, back) &&
         (back.pixel - pixel).squaredNorm() <= params_.max_return_px * params_.max_return_px;
}

bool PointTracker::same_ground(std::uint8_t label, const Vec2& pixel) const {
  if (second_.labels.empty()) return true;
  const int x = static_cast<int>(std::lround(pixel.x()));
  const int y = static_cast<int>(std::lround(pixel.y()));
  if (!second_.labels.contains(x, y)) return false;
  return ground_of(second_.labels.at(x, y)) == ground_of(label);
}

bool PointTracker::track(const Corner& corner, PointTrack& track) {
  const Vec2 pixel = stored_pixel(corner);
  TableRay ray;
  FoundPatch found;
  if (!transfer_.cast_ray(pixel, ray) || !look_closer(pixel, ray, corner.label, found)) {
    ++report_.not_found;
    return false;
  }
  return finish(corner, ray, found, track);
}

bool PointTracker::track_lost(const Corner& corner, PointTrack& track) {
  const PointTrackingReport counted = report_;  // each corner once
  const Vec2 pixel = stored_pixel(corner);
  TableRay ray;
  FoundPatch found;
  const bool is_found = transfer_.cast_ray(pixel, ray) &&
                        search(pixel, ray, all_heights(), {kFirstLookLevel, params_.lost_margin_px}, found) &&
                        finish(corner, ray, found, track);
  report_ = counted;
  return is_found;
}

bool PointTracker::finish(const Corner& corner, const TableRay& ray, const FoundPatch& found,
                          PointTrack& track) {
  if (found.correlation - found.runner_up < params_.min_lead) {
    ++report_.ambiguous;
    return false;
  }
  const Vec2 pixel = stored_pixel(corner);
  PatchAlignment alignment;
  if (!align(pixel, ray, corner.label, found, alignment) || !same_ground(corner.label, alignment.pixel)) {
    ++report_.not_aligned;
    return false;
  }
  if (alignment.sigma_px > params_.sure_sigma_px && !returns(pixel, alignment)) {
    ++report_.not_returned;
    return false;
  }
  track.first = ray.in_camera;
  track.sigma_px = static_cast<float>(alignment.sigma_px);
  track.label = corner.label;
  return second_.lens.undistort_pixel(alignment.pixel, track.second);
}

void PointTracker::drop_contradicting(BoundedList<PointTrack>& tracks) {
  BoundedList<SeenPoint> seen(workspace_.seen_storage);
  for (const PointTrack& track : tracks) seen.push_back({Vec3::Zero(), track.first, track.second, false});
  PoseCorrectionParams correction = params_.correction;
  correction.coarsest_scale_px = params_.max_epipolar_px;
  correction.finest_scale_px = params_.max_epipolar_px;
  correct_second_pose(seen.items(), focal_px(), correction, cameras_);
  const EpipolarDistance distance(second_from_first(cameras_), focal_px());
  std::size_t kept = 0;
  for (PointTrack& track : tracks) {
    const double allowed_px =
        std::min(params_.max_epipolar_px, params_.pose_error_px + params_.max_deviations * track.sigma_px);
    if (std::abs(distance(track.first, track.second)) <= allowed_px) std::swap(tracks[kept++], track);
  }
  report_.off_line = tracks.size() - kept;
  report_.tracks = kept;
}

}  // namespace traygauge
