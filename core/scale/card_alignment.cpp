#include "core/scale/card_alignment.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/bounded_list.hpp"
#include "core/base/levenberg_marquardt.hpp"
#include "core/scale/card_pose.hpp"
#include "core/scale/homography.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kCandidates = 8;  // four ways to lay the print, two poses each
constexpr std::size_t kRefined = 3;     // of those, by correlation
constexpr double kDamping = 1e-6;       // of Gauss and Newton's step, relative: keeps flat directions still

using Information = Eigen::Matrix<double, 6, 6>;
using Step = Eigen::Matrix<double, 6, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;

// What the iterations carry on.
struct Fit {
  Pose pose;
  CardTone tone = CardTone::Zero();
  double spread_gray = 0.0;
};

struct Candidate {
  Fit fit;
  double correlation = -1.0;
};

// The print's corners in its own mm, clockwise from the origin.
std::array<Vec2, 4> print_corners_mm(const CardModelSize& size) {
  return {Vec2(0.0, 0.0), Vec2(size.width_mm, 0.0), Vec2(size.width_mm, size.height_mm),
          Vec2(0.0, size.height_mm)};
}

Pose table_pose(const Pose& camera_from_card, double thickness_mm) {
  Pose card_from_table;
  card_from_table.rotation = Vec3(1.0, -1.0, -1.0).asDiagonal();
  card_from_table.translation = Vec3(0.0, 0.0, thickness_mm);
  return camera_from_card * card_from_table;
}

class Aligner {
 public:
  Aligner(const LensModel& lens, const CardPattern& pattern, const CardAlignmentParams& params,
          CardPicture& picture)
      : pattern_(pattern), params_(params), picture_(picture), focal_px_(lens.pinhole.mean_focal_px()) {}

  bool is_possible(const Pose& pose) const {
    if (!pose.rotation.allFinite() || !pose.translation.allFinite()) return false;
    const Vec3 centre = pose * centre_mm();
    return centre.z() > 0.0 && -pose.rotation.col(2).dot(centre) > params_.min_tilt_cosine * centre.norm();
  }

  // Picture pixels a mm of the print, at its centre.
  double px_per_mm(const Pose& pose) const { return focal_px_ / (pose * centre_mm()).z(); }

  const CardPatternLevel& level_for(const Pose& pose, double blur_px) const {
    return pattern_.nearest_level(blur_px / px_per_mm(pose));
  }

  // Takes the pixels well inside the print: near its edge the blur mixes in the table.
  void select(const Pose& pose, const CardPatternLevel& level) {
    picture_.select(pose, pattern_.size, 2.0 * level.blur_mm + 1.0 / px_per_mm(pose));
  }

  CardCorrelation correlate(const Pose& pose, const CardPatternLevel& level, CardSampling sampling) const {
    return picture_.correlate(pose, pattern_.size, level, sampling);
  }

  // Gauss-Newton with iteratively reweighted residuals; false when the pose is lost.
  bool refine(const CardPatternLevel& level, CardSampling sampling, int iterations, Fit& fit) const {
    const CardCorrelation start = correlate(fit.pose, level, sampling);
    if (start.samples < kMinSamples) return false;
    fit.tone = start.tone;
    fit.spread_gray = start.rms_gray;
    for (int i = 0; i < iterations; ++i) {
      const CardLinearisation linearised = linearise(level, sampling, fit);
      Eigen::Matrix<double, 12, 1> change;
      if (!linearised.equations.solve(kDamping, change)) return false;
      const double moved_px = corner_motion_px(fit.pose, change.head<6>());
      if (!std::isfinite(moved_px)) return false;
      if (moved_px > params_.max_step_px) change *= params_.max_step_px / moved_px;
      fit.pose = moved(fit.pose, change.head<6>());
      fit.tone += change.tail<6>();
      fit.spread_gray = linearised.spread_gray;
      if (!is_possible(fit.pose)) return false;
      if (moved_px < params_.converged_px) break;
    }
    return true;
  }

  // What a refined pose is worth.
  bool measure(const CardPatternLevel& level, CardSampling sampling, const Fit& fit,
               CardAlignment& alignment) const {
    const CardLinearisation linearised = linearise(level, sampling, fit);
    alignment.camera_from_table = fit.pose;
    alignment.correlation = correlate(fit.pose, level, CardSampling::quarter).correlation;
    alignment.rms_gray = linearised.spread_gray;
    alignment.gain = fit.tone[0];
    alignment.blur_px = level.blur_mm * px_per_mm(fit.pose);
    alignment.visible_share = picture_.labelled_pixels() / projected_px2(fit.pose);
    return inform(linearised, alignment);
  }

  // Area of the print in the picture, without the lens's distortion.
  double projected_px2(const Pose& pose) const {
    double doubled = 0.0;
    std::array<Vec2, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) corners[i] = corner_ray(pose, i);
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec2& a = corners[i];
      const Vec2& b = corners[(i + 1) % 4];
      doubled += a.x() * b.y() - a.y() * b.x();
    }
    return 0.5 * std::abs(doubled) * focal_px_ * focal_px_;
  }

 private:
  static constexpr int kMinSamples = 100;

  Vec3 centre_mm() const {
    const CardModelSize& size = pattern_.size;
    return print_point_mm({0.5 * size.width_mm, 0.5 * size.height_mm}, size.thickness_mm);
  }

  CardLinearisation linearise(const CardPatternLevel& level, CardSampling sampling, const Fit& fit) const {
    const double cutoff_gray = params_.cutoff_spreads * std::max(fit.spread_gray, params_.min_spread_gray);
    return picture_.linearise(fit.pose, pattern_.size, level, fit.tone, cutoff_gray, sampling);
  }

  Vec3 corner_point(std::size_t corner) const {
    return print_point_mm(print_corners_mm(pattern_.size)[corner], pattern_.size.thickness_mm);
  }

  Vec2 corner_ray(const Pose& pose, std::size_t corner) const {
    return (pose * corner_point(corner)).hnormalized();
  }

  double corner_motion_px(const Pose& pose, const Step& step) const {
    const Pose after = moved(pose, step);
    double largest = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      largest = std::max(largest, (corner_ray(after, i) - corner_ray(pose, i)).norm());
    }
    return largest * focal_px_;
  }

  // Covariance that errors of `systematic_px` in each corner leave.
  bool systematic_covariance(const Pose& pose, Information& covariance) const {
    Information information = Information::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 turned = pose.rotation * corner_point(i);
      const Vec3 point = turned + pose.translation;
      for (int row = 0; row < 2; ++row) {
        const Vec3 by_point =
            (Vec3::Unit(row) - point[row] / point.z() * Vec3::UnitZ()) * (focal_px_ / point.z());
        Step by_step;
        by_step << turned.cross(by_point), by_point;
        information += by_step * by_step.transpose();
      }
    }
    const double variance = params_.systematic_px * params_.systematic_px;
    covariance = variance * information.inverse();
    return covariance.allFinite();
  }

  bool inform(const CardLinearisation& at_pose, CardAlignment& alignment) const {
    const Eigen::LDLT<Matrix12, Eigen::Lower> factors(at_pose.equations.hessian);
    if (factors.info() != Eigen::Success || !factors.isPositive()) return false;
    const Matrix12 inverse = factors.solve(Matrix12::Identity());
    const double flattening =
        at_pose.slopes / at_pose.weights;  // a redescending weight bends the normal equations
    if (!(flattening > 0.0)) return false;
    const Matrix12 scatter = at_pose.scatter.selfadjointView<Eigen::Lower>();
    const Matrix12 sandwich = inverse * scatter * inverse / (flattening * flattening);
    Information systematic;
    if (!systematic_covariance(alignment.camera_from_table, systematic)) return false;
    const Information covariance = sandwich.topLeftCorner<6, 6>() + systematic;
    alignment.information = covariance.inverse();
    alignment.information = (0.5 * (alignment.information + alignment.information.transpose())).eval();
    return alignment.information.allFinite();
  }

  const CardPattern& pattern_;
  const CardAlignmentParams& params_;
  CardPicture& picture_;
  double focal_px_;
};

using Candidates = std::array<Candidate, kCandidates>;

// Both poses for each way to lay the print on the outline; returns their number.
std::size_t lay_print(const CardOutline& outline, const CardModelSize& size, const Aligner& aligner,
                      Candidates& candidates) {
  const std::array<Vec2, 4> print = print_corners_mm(size);
  const Vec3 centre(0.5 * size.width_mm, 0.5 * size.height_mm, 0.0);
  std::size_t count = 0;
  for (std::size_t turn = 0; turn < 4; ++turn) {
    std::array<Vec2, 4> rays;
    for (std::size_t i = 0; i < 4; ++i) rays[i] = outline.corners[(i + turn) % 4];
    Mat3 print_from_ray;
    Pose camera_from_card;
    if (!homography_from_four(rays, print, print_from_ray)) continue;
    if (!pose_from_homography(print_from_ray, camera_from_card)) continue;
    for (const Pose& pose : {camera_from_card, mirrored_pose(camera_from_card, centre)}) {
      candidates[count].fit.pose = table_pose(pose, size.thickness_mm);
      if (aligner.is_possible(candidates[count].fit.pose)) ++count;
    }
  }
  return count;
}

void sort_by_correlation(std::span<Candidate> candidates) {
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.correlation > b.correlation; });
}

// Refines at this blur and measures again; a pose that got lost comes last.
void refine_candidate(Aligner& aligner, double blur_px, CardSampling sampling, int iterations,
                      Candidate& candidate) {
  const CardPatternLevel& level = aligner.level_for(candidate.fit.pose, blur_px);
  aligner.select(candidate.fit.pose, level);
  const bool kept = aligner.refine(level, sampling, iterations, candidate.fit);
  candidate.correlation = kept ? aligner.correlate(candidate.fit.pose, level, sampling).correlation : -1.0;
}

// The best pose of the coarse stages.
Candidate choose(const CardOutline& outline, const CardModelSize& size, const CardAlignmentParams& params,
                 Aligner& aligner) {
  Candidates storage;
  const std::span<Candidate> all(storage.data(), lay_print(outline, size, aligner, storage));
  for (Candidate& candidate : all) {
    const CardPatternLevel& level = aligner.level_for(candidate.fit.pose, params.coarse_blur_px);
    aligner.select(candidate.fit.pose, level);
    candidate.correlation = aligner.correlate(candidate.fit.pose, level, CardSampling::sixteenth).correlation;
  }
  sort_by_correlation(all);
  const std::span<Candidate> best = all.first(std::min(all.size(), kRefined));
  for (Candidate& candidate : best) {
    const bool is_close = candidate.correlation >= best[0].correlation - params.max_correlation_lag;
    if (is_close)
      refine_candidate(aligner, params.coarse_blur_px, CardSampling::sixteenth, params.coarse_iterations,
                       candidate);
  }
  sort_by_correlation(best);
  return best.empty() ? Candidate{} : best[0];
}

// Which of the finer blurs the picture has.
const CardPatternLevel& find_blur(const Aligner& aligner, const Pose& pose, double finest_px) {
  const CardPatternLevel* best = &aligner.level_for(pose, finest_px);
  double correlation = -1.0;
  for (const double factor : {1.0, std::sqrt(2.0), 2.0, 2.0 * std::sqrt(2.0)}) {
    const CardPatternLevel& level = aligner.level_for(pose, finest_px * factor);
    const double reached = aligner.correlate(pose, level, CardSampling::quarter).correlation;
    if (!(reached > correlation)) continue;
    correlation = reached;
    best = &level;
  }
  return *best;
}

}  // namespace

Status align_card(ImageView<const std::uint8_t> gray, ImageView<const std::uint8_t> labels,
                  const PixelBox& box, const LensModel& lens, const CardPattern& pattern,
                  const CardAlignmentParams& params, CardAlignmentWorkspace& workspace,
                  CardAlignment& alignment) {
  alignment = {};
  CardPicture& picture = workspace.picture;
  CardOutline outline;
  Status status = find_card_outline(labels, box, lens, params.outline, workspace.outline, outline);
  if (status.ok()) status = picture.load(gray, labels, box, lens, params.picture);
  if (!status.ok()) return status;
  Aligner aligner(lens, pattern, params, picture);
  Candidate candidate = choose(outline, pattern.size, params, aligner);
  if (candidate.correlation < 0.0) return StatusCode::card_not_found;
  refine_candidate(aligner, params.medium_blur_px, CardSampling::quarter, params.medium_iterations,
                   candidate);
  if (!(candidate.correlation >= params.min_correlation)) return StatusCode::card_not_found;

  const CardPatternLevel& level = find_blur(aligner, candidate.fit.pose, params.finest_blur_px);
  aligner.select(candidate.fit.pose, level);
  const CardSampling sampling = picture.used_pixels() > 4 * params.max_samples   ? CardSampling::sixteenth
                                : picture.used_pixels() > 2 * params.max_samples ? CardSampling::quarter
                                : picture.used_pixels() > params.max_samples     ? CardSampling::half
                                                                                 : CardSampling::all;
  if (!aligner.refine(level, sampling, params.fine_iterations, candidate.fit)) {
    return StatusCode::card_not_found;
  }
  if (!aligner.measure(level, sampling, candidate.fit, alignment)) return StatusCode::card_not_found;
  const bool is_seen =
      alignment.correlation >= params.min_correlation && alignment.visible_share >= params.min_visible_share;
  return is_seen ? StatusCode::ok : StatusCode::card_not_found;
}

}  // namespace traygauge
