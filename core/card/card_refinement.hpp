// Refines a camera's pose by the card's grey values: Gauss-Newton with iteratively reweighted residuals.
#pragma once

#include <algorithm>

#include "core/card/card_condition.hpp"
#include "core/card/card_pattern.hpp"
#include "core/card/card_picture.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge {

// Half or twice of any number here moves the MAPE of six pairs of the captures by 0.02 points at most
// (tests/evaluation/numbers.tsv), but for half of cutoff_spreads: 0.09.
struct CardRefinementParams {
  // Of Geman and McClure's weights, in robust standard deviations. Noise is largest on the print's edges,
  // which fix the pose: fewer than 5 throw away a third of what they tell, more than 10 let a fork through.
  double cutoff_spreads = 6.0;
  double min_spread_gray = 1.0;  // a grey value: below it residuals are rounding
  double max_step_px = 8.0;      // of a corner in one iteration: further, the linearisation means nothing
  double converged_px = 0.01;    // a corner's step that ends a stage; the next would be a tenth of it
  int min_samples = 100;         // for a pose of six numbers, most of them with little gradient
  // What grey values do not show: error of a corner's place by lens, print and flatness, per axis and corner.
  double systematic_px = 0.01;
};

// What the iterations carry on.
struct CardFitState {
  Pose camera_from_table;
  CardTone tone = CardTone::Zero();
  double spread_gray = 0.0;
};

using PoseInformation = Eigen::Matrix<double, 6, 6>;

class CardRefinement {
 public:
  CardRefinement(const LensModel& lens, const CardPattern& pattern, const CardRefinementParams& params,
                 CardPicture& picture)
      : pattern_(pattern), params_(params), picture_(picture), focal_px_(lens.pinhole.mean_focal_px()) {}

  // The print faces the camera and lies in front of it.
  bool is_possible(const Pose& camera_from_table) const;

  // The print as a picture blurs it whose pixels are blurred by `blur_px`.
  const CardPatternLevel& level_for(const Pose& camera_from_table, double blur_px) const;
  double blur_px(const Pose& camera_from_table, const CardPatternLevel& level) const;

  // Takes the pixels well inside the print: near its edge the blur mixes in the table.
  void select(const Pose& camera_from_table, const CardPatternLevel& level);

  int selected_pixels() const { return picture_.used_pixels(); }

  // Over all samples.
  CardCorrelation correlate(const Pose& camera_from_table, const CardPatternLevel& level,
                            CardSampling sampling) const {
    return picture_.correlate(camera_from_table, pattern_.size, level, sampling, {});
  }
  // Over those whose residuals lie within the cutoff: a fork or glare on the card does not count.
  CardCorrelation correlate_inliers(const CardFitState& state, const CardPatternLevel& level,
                                    CardSampling sampling) const {
    return picture_.correlate(state.camera_from_table, pattern_.size, level, sampling,
                              {state.tone, cutoff_gray(state)});
  }

  // False when the pose is lost.
  bool refine(const CardPatternLevel& level, CardSampling sampling, int iterations,
              CardFitState& state) const;

  // What a refined pose is worth: inverse covariance from the scatter of the residuals' gradients (White
  // 1980, clustered by tiles, so that noise which differs or hangs together is counted rightly) and the
  // systematic error. False when the print does not fix the pose.
  bool inform(const CardPatternLevel& level, CardSampling sampling, CardFitState& state,
              PoseInformation& information) const;

  // Whether the card is seen whole and flat under a refined pose.
  CardCondition judge(const CardPatternLevel& level, CardSampling sampling, const CardFitState& state,
                      const CardConditionParams& params) const {
    const Pose& pose = state.camera_from_table;
    return judge_card(
        {picture_, pattern_.size, level, sampling, pose, state.tone, cutoff_gray(state), px_per_mm(pose)},
        params);
  }

  // Of the whole print in the picture, but for the lens's distortion.
  double projected_px2(const Pose& camera_from_table) const;

 private:
  Vec3 centre_mm() const;
  Vec3 corner_mm(std::size_t corner) const;
  Vec2 corner_ray(const Pose& camera_from_table, std::size_t corner) const {
    return (camera_from_table * corner_mm(corner)).hnormalized();
  }
  double px_per_mm(const Pose& camera_from_table) const {
    return focal_px_ / (camera_from_table * centre_mm()).z();
  }
  double cutoff_gray(const CardFitState& state) const {
    return params_.cutoff_spreads * std::max(state.spread_gray, params_.min_spread_gray);
  }
  double corner_motion_px(const Pose& from, const Pose& to) const;
  CardLinearisation linearise(const CardPatternLevel& level, CardSampling sampling,
                              const CardFitState& state) const;
  PoseInformation corner_information(const Pose& camera_from_table) const;

  const CardPattern& pattern_;
  const CardRefinementParams& params_;
  CardPicture& picture_;
  double focal_px_;
};

}  // namespace traygauge
