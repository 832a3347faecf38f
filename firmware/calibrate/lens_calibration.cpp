#include "firmware/calibrate/lens_calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "firmware/base/text.hpp"
#include "firmware/measure/pair_setup.hpp"

namespace traygauge {
namespace {

using Sightings = std::vector<const BoardSighting*>;

constexpr int kFieldsAcross = 8;
constexpr int kFieldsDown = 6;

double covered_fraction(const Sightings& sightings, PictureSize size) {
  std::set<int> fields;
  for (const BoardSighting* sighting : sightings) {
    for (const Vec2& corner : sighting->corners_px) {
      const int column =
          std::clamp(static_cast<int>(corner.x() * kFieldsAcross / size.width), 0, kFieldsAcross - 1);
      const int row =
          std::clamp(static_cast<int>(corner.y() * kFieldsDown / size.height), 0, kFieldsDown - 1);
      fields.insert(row * kFieldsAcross + column);
    }
  }
  return static_cast<double>(fields.size()) / (kFieldsAcross * kFieldsDown);
}

double widest_angle_deg(const std::vector<Vec3>& directions) {
  double least_cosine = 1.0;
  for (const Vec3& a : directions) {
    for (const Vec3& b : directions) least_cosine = std::min(least_cosine, a.dot(b));
  }
  return std::acos(std::clamp(least_cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

// The pictures that agree with the others. Misread boards pull the lens, so that the worst goes first.
Sightings leave_out_misread(Sightings sightings, const Chessboard& board, PictureSize size,
                            const LensCalibrationParams& params, std::vector<std::string>& left_out) {
  while (sightings.size() > static_cast<std::size_t>(params.min_pictures)) {
    const auto fit = fit_lens(sightings, board, size, LensTerms::tangential);
    if (!fit) break;
    std::vector<double> rms_px = fit->picture_rms_px;
    const auto worst = std::max_element(rms_px.begin(), rms_px.end()) - rms_px.begin();
    const double worst_px = rms_px[static_cast<std::size_t>(worst)];
    const auto middle = rms_px.begin() + static_cast<std::ptrdiff_t>(rms_px.size() / 2);
    std::nth_element(rms_px.begin(), middle, rms_px.end());
    if (worst_px <= std::max(params.max_picture_rms_ratio * *middle, params.min_outlier_px)) break;
    left_out.push_back(sightings[static_cast<std::size_t>(worst)]->picture);
    sightings.erase(sightings.begin() + worst);
  }
  return sightings;
}

struct CrossValidation {
  std::vector<CameraDescription> cameras;  // each without one group
  double rms_px = std::numeric_limits<double>::infinity();
};

CrossValidation cross_validate(const Sightings& sightings, const Chessboard& board, PictureSize size,
                               LensTerms terms, int most_groups) {
  const std::size_t groups = std::min(sightings.size(), static_cast<std::size_t>(most_groups));
  CrossValidation validation;
  double sum = 0.0;
  for (std::size_t group = 0; group < groups; ++group) {
    Sightings rest;
    for (std::size_t i = 0; i < sightings.size(); ++i) {
      if (i % groups != group) rest.push_back(sightings[i]);
    }
    const auto fit = fit_lens(rest, board, size, terms);
    if (!fit) return {};
    validation.cameras.push_back(fit->camera);
    for (std::size_t i = group; i < sightings.size(); i += groups) {
      const double off_px = reprojection_rms_px(*sightings[i], board, fit->camera);
      sum += off_px * off_px;
    }
  }
  validation.rms_px = std::sqrt(sum / static_cast<double>(sightings.size()));
  return validation;
}

// Two standard deviations of the volume of a standard meal, by the delete-a-group jackknife (Kott 2001): the
// lens is fitted anew without each group of pictures, and the meal, seen through the lens of all, is measured
// with each of those. Unlike the covariance of the fit this needs no model of the corners' errors, which hang
// together within a picture: a bent board, blur, a corner detector's bias. What is wrong with all pictures
// alike does not show.
double volume_percent(const CameraDescription& camera, const std::vector<CameraDescription>& without_groups,
                      const StandardMealParams& meal) {
  double sum = 0.0;
  for (const CameraDescription& other : without_groups) {
    const auto deviation = volume_deviation(lens_of(camera), lens_of(other), meal);
    if (!deviation) return std::numeric_limits<double>::infinity();
    sum += *deviation * *deviation;
  }
  const auto groups = static_cast<double>(without_groups.size());
  return 100.0 * 2.0 * std::sqrt((groups - 1.0) / groups * sum);
}

bool too_few(std::size_t found, const LensCalibrationParams& params, CalibrationProblem& problem) {
  if (found >= static_cast<std::size_t>(params.min_pictures)) return false;
  problem = {"at least " + std::to_string(params.min_pictures) + " pictures that show the whole board",
             std::to_string(found), "check --board (inner corners), light and focus, and take more pictures"};
  return true;
}

}  // namespace

bool calibrate_lens(const std::vector<BoardSighting>& sightings, const Chessboard& board, PictureSize size,
                    const LensCalibrationParams& params, LensCalibration& calibration,
                    CalibrationProblem& problem) {
  calibration = {};
  Sightings used;
  for (const BoardSighting& sighting : sightings) used.push_back(&sighting);
  if (too_few(used.size(), params, problem)) return false;
  used = leave_out_misread(used, board, size, params, calibration.left_out);
  calibration.pictures = static_cast<int>(used.size());

  const std::string tilt_hint =
      "tilt the board to the left, the right, towards you and away, by 20 to 40 degrees";
  auto fit = fit_lens(used, board, size, LensTerms::radial);
  calibration.facing_spread_deg = fit ? widest_angle_deg(fit->board_normals) : 0.0;
  if (calibration.facing_spread_deg < params.min_facing_spread_deg) {
    problem = {"boards that face different ways, " + fixed(params.min_facing_spread_deg, 0) +
                   " degrees apart at least",
               fit ? "all within " + fixed(calibration.facing_spread_deg, 0) + " degrees"
                   : "pictures that fix no lens",
               tilt_hint};
    return false;
  }
  calibration.covered_fraction = covered_fraction(used, size);
  if (calibration.covered_fraction < params.min_covered_fraction) {
    problem = {"boards all over the picture, in " + fixed(100.0 * params.min_covered_fraction, 0) +
                   " % of its fields",
               "in " + fixed(100.0 * calibration.covered_fraction, 0) + " %",
               "hold the board into the picture's corners and along its edges, too"};
    return false;
  }

  CrossValidation best = cross_validate(used, board, size, LensTerms::radial, params.groups);
  for (const LensTerms terms : {LensTerms::tangential, LensTerms::all}) {
    CrossValidation other = cross_validate(used, board, size, terms, params.groups);
    if (!(other.rms_px < (1.0 - params.min_improvement) * best.rms_px)) continue;
    auto richer = fit_lens(used, board, size, terms);
    if (!richer) continue;
    best = std::move(other);
    fit = std::move(richer);
  }
  if (best.cameras.empty()) {
    problem = {"pictures that fix the lens whichever is left out", "some that do not",
               "take more pictures; " + tilt_hint};
    return false;
  }
  calibration.camera = fit->camera;
  calibration.rms_px = fit->rms_px();
  calibration.held_out_rms_px = best.rms_px;
  calibration.volume_percent = volume_percent(fit->camera, best.cameras, params.meal);
  return true;
}

}  // namespace traygauge
