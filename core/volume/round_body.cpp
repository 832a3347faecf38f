#include "core/volume/round_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/labels/label_regions.hpp"
#include "core/stereo/dish_projection.hpp"

namespace traygauge {
namespace {

constexpr double kMiddle = 0.5;        // of the greatest bulge: what has less lies outside of a body's middle
constexpr int kCentreCorrections = 2;  // Newton steps: the second changes 0.1 mm at most

// An ellipsoid's surface as a view sees it. Where the level meets the line of sight, and z / (H − z) for the
// height z over the level with the camera at height H: in these coordinates lines of sight are parallel and
// an ellipsoid is one still, so that it is limb ± amplitude · √bulge. The plane of its limb falls towards the
// camera, by half its squared height times the slope of its axis along the gradient of bulge / its most.
struct BodyShape {
  double camera_mm = 0.0;  // H
  double middle = 0.0;
  double limb_slope = 0.0;
  double amplitude = 0.0;

  double limb(const BodySample& sample) const {
    return middle - limb_slope * sample.run.dot(sample.gradient_mm);
  }
  double half(const BodySample& sample) const { return amplitude * std::sqrt(sample.bulge_mm2); }
  double height_mm(double scaled) const { return camera_mm * scaled / (1.0 + scaled); }
  double top_mm(const BodySample& sample) const { return height_mm(limb(sample) + half(sample)); }
};

struct BodyWidth {
  double half_mm = 0.0;  // of the body from above
  double elongation = 1.0;
  double edge_rise_mm = 0.0;  // of the dish under its outline, over the level
  double fullness = 1.0;      // of the bulge, in the view that has the less
};

class RoundBody {
 public:
  RoundBody(const RoundBodyGrids& grids, const InnerSurface& dish, const RoundBodyParams& params,
            const OutlineRows& outline, std::uint8_t label, std::span<OutlineChord> columns)
      : grids_(grids),
        dish_(dish),
        params_(params),
        outline_(outline),
        level_mm_(dish.profile.bottom_height_mm()),
        pictures_{BodyPicture(grids.views[0], 0, outline, label, level_mm_, columns),
                  BodyPicture(grids.views[1], 1, outline, label, level_mm_, columns)} {}

  // Finds the body's height; false for what is no round body.
  bool fit();
  void shape() const;

 private:
  double floor_mm(std::size_t v, const BodySample& sample) const {
    return settled_height_mm(dish_, grids_.views[v].camera_mm, sample.run) - level_mm_;
  }
  double matched_mm(std::size_t v, const BodySample& sample) const {
    return static_cast<double>(grids_.views[v].points.at(sample.x, sample.y).z_mm) - level_mm_;
  }
  SurfaceEvidence evidence_of(std::size_t v, const BodySample& sample) const {
    return grids_.views[v].evidence.at(sample.x, sample.y);
  }
  bool is_matched(std::size_t v, const BodySample& sample) const {
    const SurfaceEvidence evidence = evidence_of(v, sample);
    return evidence == SurfaceEvidence::single || evidence == SurfaceEvidence::both;
  }
  bool is_in_middle(std::size_t v, const BodySample& sample) const {
    return sample.bulge_mm2 >= kMiddle * most_mm2_[v];
  }
  BodyWidth measure_width();
  BodyShape shape_in(std::size_t v) const;
  void correct_centre();
  double raise_fraction() const;
  // Of the samples that count, how many meet a condition; mean over both views.
  template <class Counts, class Meets>
  double mean_fraction(Counts&& counts, Meets&& meets) const;
  double rim_above_fraction() const;
  double sunken_fraction() const;

  const RoundBodyGrids& grids_;
  const InnerSurface& dish_;
  const RoundBodyParams& params_;
  const OutlineRows& outline_;
  double level_mm_;
  std::array<BodyPicture, 2> pictures_;
  std::array<double, 2> most_mm2_{};  // greatest bulge, by view
  double centre_mm_ = 0.0;            // over the level
};

bool RoundBody::fit() {
  if (outline_.steepest_run > params_.max_run || outline_.usable < params_.min_rows ||
      outline_.usable < params_.min_usable_fraction * outline_.shared)
    return false;
  centre_mm_ = centre_height_mm(outline_, grids_.views, level_mm_);
  if (!(centre_mm_ > params_.min_centre_mm)) return false;
  const BodyWidth width = measure_width();
  const double roundness = centre_mm_ / width.half_mm;
  if (!(roundness > params_.least_roundness && roundness < params_.most_roundness) ||
      width.edge_rise_mm > params_.max_edge_rise * centre_mm_) {
    return false;
  }
  for (int i = 0; i < kCentreCorrections; ++i) correct_centre();
  const double by_outline = 1.0 / std::pow(params_.outline_sigma * width.elongation, 2);
  const double by_width = 1.0 / std::pow(params_.flatness_sigma, 2);
  centre_mm_ =
      std::exp((by_outline * std::log(centre_mm_) + by_width * std::log(params_.flatness * width.half_mm)) /
               (by_outline + by_width));
  const auto has_room = [&] { return shape_in(0).amplitude > 0.0 && shape_in(1).amplitude > 0.0; };
  if (!has_room()) return false;
  centre_mm_ *= raise_fraction();
  if (!has_room() || rim_above_fraction() > params_.max_rim_above) return false;
  return width.fullness >= params_.least_fullness || sunken_fraction() <= params_.max_sunken;
}

// The bulge of an ellipse with half axes a ≥ b has its most a²b² / (a² + b²) over the area πab. A view along
// a slope lengthens it, as if half height and half width were alike, and the level lies behind it.
BodyWidth RoundBody::measure_width() {
  BodyWidth width{0.0, 0.0, 0.0, 1.0};
  for (std::size_t v = 0; v < 2; ++v) {
    double most_mm2 = 0.0;
    double along_sight = 0.0;
    double gradients = 0.0;
    double bulges_mm2 = 0.0;
    int samples = 0;
    double rise_mm = 0.0;
    int ends = 0;
    pictures_[v].for_each_sample([&](const BodySample& sample) {
      most_mm2 = std::max(most_mm2, sample.bulge_mm2);
      bulges_mm2 += sample.bulge_mm2;
      ++samples;
      along_sight += std::pow(sample.run.dot(sample.gradient_mm), 2);
      gradients += sample.gradient_mm.squaredNorm();
      const OutlineChord& chord = outline_.rows[static_cast<std::size_t>(sample.y)].chords[v];
      if (sample.x != chord.first && sample.x + 1 != chord.end) return;
      rise_mm += floor_mm(v, sample);
      ++ends;
    });
    most_mm2_[v] = most_mm2;
    const double area_mm2 = samples * pictures_[v].sample_mm2();
    width.fullness = std::min(width.fullness, bulges_mm2 / (samples * most_mm2));
    const double mean_ratio = std::max(0.5 * area_mm2 / (std::numbers::pi * most_mm2), 1.0);
    const double elongation = mean_ratio + std::sqrt(mean_ratio * mean_ratio - 1.0);
    const double seen_mm2 = most_mm2 * (1.0 + 1.0 / (elongation * elongation));
    const double nearer = 1.0 - centre_mm_ / (grids_.views[v].camera_mm.z() - level_mm_);
    width.half_mm += 0.5 * nearer * std::sqrt(seen_mm2 / (1.0 + along_sight / std::max(gradients, 1e-6)));
    width.elongation += 0.5 * elongation;
    width.edge_rise_mm += 0.5 * rise_mm / std::max(ends, 1);
  }
  return width;
}

// As thick as the dish below lets it be.
BodyShape RoundBody::shape_in(std::size_t v) const {
  BodyShape body;
  body.camera_mm = grids_.views[v].camera_mm.z() - level_mm_;
  // Half way between the dish and the top, whose axis runs (H - 2b) / (H - b) times as far as the line of
  // sight to the outline's middle.
  const double over_top_mm = body.camera_mm - 2.0 * centre_mm_;
  body.middle = centre_mm_ / over_top_mm;
  const double axis_mm = body.camera_mm * over_top_mm / (over_top_mm + centre_mm_);
  body.limb_slope = 0.5 * body.middle * body.middle * axis_mm / most_mm2_[v];
  body.amplitude = std::numeric_limits<double>::max();
  pictures_[v].for_each_sample([&](const BodySample& sample) {
    if (sample.bulge_mm2 < params_.contact_fraction * most_mm2_[v]) return;
    const double floor = floor_mm(v, sample);
    const double room = body.limb(sample) - floor / (body.camera_mm - floor);
    body.amplitude = std::min(body.amplitude, room / std::sqrt(sample.bulge_mm2));
  });
  return body;
}

// Either view's body must have its middle, in every row of the other view, where that sees it: sections that
// are no ellipses, as those of a bent body, have theirs elsewhere.
void RoundBody::correct_centre() {
  double sum = 0.0;
  double slopes = 0.0;
  for (std::size_t v = 0; v < 2; ++v) {
    const BodyShape body = shape_in(v);
    const Vec3& eye = grids_.views[v].camera_mm;
    const Vec3& other = grids_.views[1 - v].camera_mm;
    const double other_fall_mm = other.z() - level_mm_;
    int current = -1;
    double least = 0.0;
    double most = 0.0;
    const auto finish_row = [&] {
      if (current < 0) return;
      const OutlineRow& row = outline_.rows[static_cast<std::size_t>(current)];
      const double slope = row.middle_run[1 - v] - row.middle_run[v];  // of the run, for every mm of height
      const double off = 0.5 * (least + most) - row.middle_run[1 - v];
      sum += row.weight * slope * other_fall_mm * off;
      slopes += row.weight * slope * slope;
    };
    pictures_[v].for_each_sample([&](const BodySample& sample) {
      const OutlineRow& row = outline_.rows[static_cast<std::size_t>(sample.y)];
      if (!(row.weight > 0.0)) return;
      if (sample.y != current) {
        finish_row();
        current = sample.y;
        least = std::numeric_limits<double>::max();
        most = -least;
      }
      const double from_other_mm = row.direction.dot((eye - other).head<2>());
      const double run = row.direction.dot(sample.run);
      const double limb = body.limb(sample);
      const double half = body.half(sample);
      for (const double scaled : {limb - half, limb + half}) {
        const double z_mm = body.height_mm(scaled);
        const double seen = (from_other_mm + (body.camera_mm - z_mm) * run) / (other_fall_mm - z_mm);
        least = std::min(least, seen);
        most = std::max(most, seen);
      }
    });
    finish_row();
  }
  if (slopes > 0.0) centre_mm_ = std::max(centre_mm_ - sum / slopes, params_.min_centre_mm);
}

// What is matched wrongly on shine lies too low: what is matched higher is right.
double RoundBody::raise_fraction() const {
  // A histogram from 0.9 to 1.22 of the body, beyond max_raise; half a percent of the height is 0.3 mm.
  constexpr double kBin = 0.005;
  constexpr double kFirst = 0.9;
  std::array<int, 64> bins{};
  int samples = 0;
  for (std::size_t v = 0; v < 2; ++v) {
    const BodyShape body = shape_in(v);
    pictures_[v].for_each_sample([&](const BodySample& sample) {
      if (!is_in_middle(v, sample) || !is_matched(v, sample)) return;
      const double at = (matched_mm(v, sample) / body.top_mm(sample) - kFirst) / kBin;
      ++bins[at > 0.0 ? static_cast<std::size_t>(std::min(at, bins.size() - 1.0)) : 0];
      ++samples;
    });
  }
  if (samples < params_.min_raise_samples) return 1.0;
  std::size_t bin = 0;
  int below = 0;
  while (bin + 1 < bins.size() && below + bins[bin] < params_.raise_quantile * samples) below += bins[bin++];
  return std::clamp(kFirst + kBin * (static_cast<double>(bin) + 0.5), 1.0, params_.max_raise);
}

template <class Counts, class Meets>
double RoundBody::mean_fraction(Counts&& counts, Meets&& meets) const {
  double mean = 0.0;
  for (std::size_t v = 0; v < 2; ++v) {
    const BodyShape body = shape_in(v);
    int counted = 0;
    int met = 0;
    pictures_[v].for_each_sample([&](const BodySample& sample) {
      if (!counts(v, sample)) return;
      ++counted;
      met += meets(v, sample, body) ? 1 : 0;
    });
    mean += 0.5 * met / std::max(counted, 1);
  }
  return mean;
}

double RoundBody::rim_above_fraction() const {
  return mean_fraction(
      [&](std::size_t v, const BodySample& sample) {
        return sample.bulge_mm2 <= params_.rim_fraction * most_mm2_[v] && is_matched(v, sample);
      },
      [&](std::size_t v, const BodySample& sample, const BodyShape& body) {
        return matched_mm(v, sample) > body.top_mm(sample) + params_.above_rim * centre_mm_;
      });
}

// Of the middle: a mirrored lamp covers a part of it, and what is plain around that is not confirmed.
double RoundBody::sunken_fraction() const {
  return mean_fraction([&](std::size_t v, const BodySample& sample) { return is_in_middle(v, sample); },
                       [&](std::size_t v, const BodySample& sample, const BodyShape& body) {
                         return evidence_of(v, sample) == SurfaceEvidence::both &&
                                matched_mm(v, sample) < params_.sunken_top * body.top_mm(sample);
                       });
}

void RoundBody::shape() const {
  for (std::size_t v = 0; v < 2; ++v) {
    const BodyShape body = shape_in(v);
    const Vec3& eye = grids_.views[v].camera_mm;
    const double reach_mm = params_.reach * centre_mm_;
    pictures_[v].for_each_sample([&](const BodySample& sample) {
      double z_mm = body.top_mm(sample);
      if (is_matched(v, sample)) {
        const double off_mm = matched_mm(v, sample) - z_mm;
        z_mm += off_mm * std::exp(-0.5 * std::pow(off_mm / reach_mm, 2));
      }
      z_mm += level_mm_;
      const Vec2 place = eye.head<2>() + (eye.z() - z_mm) * sample.run;
      const std::size_t at =
          static_cast<std::size_t>(sample.y) * static_cast<std::size_t>(grids_.views[v].points.width) +
          static_cast<std::size_t>(sample.x);
      grids_.points[v][at] = {static_cast<float>(place.x()), static_cast<float>(place.y()),
                              static_cast<float>(z_mm)};
    });
  }
}

}  // namespace

LabelSet shape_round_bodies(const RoundBodyGrids& grids, const InnerSurface& dish,
                            const RoundBodyParams& params, RoundBodyWorkspace& workspace) {
  LabelSet shaped;
  const LabelRegions regions = measure_regions(grids.views[0].labels);
  for (int value = kFirstItemLabel; value <= kLastItemLabel; ++value) {
    const auto label = static_cast<std::uint8_t>(value);
    if (regions.pixels[label] == 0) continue;
    const OutlineRows outline =
        collect_outline_rows(grids.views, label, dish.profile.bottom_height_mm(), workspace.rows);
    RoundBody body(grids, dish, params, outline, label, workspace.columns);
    const auto in_pieces = [&](const SurfaceGrid& view) { return count_pieces(view.labels, label) > 1; };
    if (!body.fit() || (in_pieces(grids.views[0]) && in_pieces(grids.views[1]))) continue;
    body.shape();
    shaped.add(label);
  }
  return shaped;
}

}  // namespace traygauge
