#include "core/adjustment/bundle_problem.hpp"

namespace traygauge {
namespace {

double robust_cost(double residual, double variance, double squared_scale) {
  const double square = residual * residual;
  return square / (variance * (1.0 + square / squared_scale));
}

// Weight of the residual in the normal equations.
double robust_weight(double residual, double variance, double squared_scale) {
  const double shrink = 1.0 / (1.0 + residual * residual / squared_scale);
  return shrink * shrink / variance;
}

// Sums over outline points of one view and one dish.
struct ViewSums {
  static constexpr int kSize = kPoseParameters + kPlaceParameters;
  NormalEquations<kSize> equations;
};

}  // namespace

double BundleProblem::cards_cost(const BundleState& state) const {
  const Pose table_from_card = state.card.table_from_card(terms_.card_pivot_mm);
  double cost = terms_.lie_tilt_information * state.card.tilt_rad.squaredNorm() +
                terms_.lie_raised_information * state.card.raised_mm * state.card.raised_mm;
  for (std::size_t view = 0; view < 2; ++view) {
    const Vec6 deviation =
        card_deviation(terms_.cards[view], state.camera_from_table[view] * table_from_card);
    cost += deviation.dot(terms_.cards[view].information * deviation);
  }
  return cost;
}

double BundleProblem::add_cards(const BundleState& state, Equations& equations) const {
  const Pose table_from_card = state.card.table_from_card(terms_.card_pivot_mm);
  BundleMatrix hessian = BundleMatrix::Zero();
  BundleVector gradient = BundleVector::Zero();
  hessian.diagonal().segment<2>(kLieParameter).setConstant(terms_.lie_tilt_information);
  hessian(kLieParameter + 2, kLieParameter + 2) = terms_.lie_raised_information;
  gradient.tail<3>() << terms_.lie_tilt_information * state.card.tilt_rad,
      terms_.lie_raised_information * state.card.raised_mm;
  for (std::size_t view = 0; view < 2; ++view) {
    const Pose& camera = state.camera_from_table[view];
    const CardPrior& card = terms_.cards[view];
    const Vec6 deviation = card_deviation(card, camera * table_from_card);
    Eigen::Matrix<double, 6, 9> jacobian;
    jacobian << deviation_by_camera(camera, table_from_card),
        deviation_by_lie(camera, table_from_card, terms_.card_pivot_mm);
    const Eigen::Matrix<double, 6, 9> weighted = card.information.lazyProduct(jacobian);
    const Eigen::Matrix<double, 9, 9> square = jacobian.transpose().lazyProduct(weighted);
    const Eigen::Matrix<double, 9, 1> slope = weighted.transpose() * deviation;
    const auto begin = static_cast<Eigen::Index>(6 * view);
    hessian.block<6, 6>(begin, begin) += square.topLeftCorner<6, 6>();
    hessian.block<3, 6>(kLieParameter, begin) += square.bottomLeftCorner<3, 6>();
    hessian.block<3, 3>(kLieParameter, kLieParameter) += square.bottomRightCorner<3, 3>();
    gradient.segment<6>(begin) += slope.head<6>();
    gradient.tail<3>() += slope.tail<3>();
  }
  equations.hessian += hessian;
  equations.gradient += gradient;
  return cards_cost(state);
}

double BundleProblem::tracks_cost(const BundleState& state) const {
  const TrackResiduals residuals(state.camera_from_table, terms_.focals_px[1]);
  double cost = 0.0;
  for (std::size_t i = 0; i < terms_.tracks.size(); ++i) {
    const TrackWeight& weight = terms_.weights[i];
    double residual = 0.0;
    if (weight.uses_line && residuals.off_line(terms_.tracks[i], residual))
      cost += robust_cost(residual, weight.line_variance, weight.line_squared_scale);
    if (weight.uses_table && residuals.along_line(terms_.tracks[i], residual))
      cost += robust_cost(residual, weight.table_variance, weight.table_squared_scale);
  }
  return cost;
}

double BundleProblem::add_tracks(const BundleState& state, Equations& equations) const {
  const TrackResiduals residuals(state.camera_from_table, terms_.focals_px[1]);
  NormalEquations<6> line;
  NormalEquations<kPairParameters> table;
  double cost = 0.0;
  for (std::size_t i = 0; i < terms_.tracks.size(); ++i) {
    const TrackWeight& weight = terms_.weights[i];
    double residual = 0.0;
    Vec6 by_line;
    PairVector by_table;
    double by_height = 0.0;
    if (weight.uses_line && residuals.off_line(terms_.tracks[i], residual, by_line)) {
      cost += robust_cost(residual, weight.line_variance, weight.line_squared_scale);
      line.add(residual, by_line, robust_weight(residual, weight.line_variance, weight.line_squared_scale));
    }
    if (weight.uses_table && residuals.along_line(terms_.tracks[i], residual, by_table, by_height)) {
      cost += robust_cost(residual, weight.table_variance, weight.table_squared_scale);
      table.add(residual, by_table,
                robust_weight(residual, weight.table_variance, weight.table_squared_scale));
    }
  }
  table.hessian.topLeftCorner<6, 6>() += line.hessian;
  table.gradient.head<6>() += line.gradient;
  const PairMatrix hessian = table.hessian.selfadjointView<Eigen::Lower>();
  const PairByCameras chain = residuals.by_cameras();
  const PairByCameras weighted = hessian.lazyProduct(chain);
  equations.hessian.topLeftCorner<kCameraParameters, kCameraParameters>() +=
      chain.transpose().lazyProduct(weighted);
  equations.gradient.head<kCameraParameters>() += chain.transpose() * table.gradient;
  return cost;
}

double BundleProblem::rim_cost(const BundleState& state, std::size_t index) const {
  const BundleRim& rim = terms_.rims[index];
  const double variance = 1.0 / static_cast<double>(rim.step);
  const double squared_scale = rim.scale_px * rim.scale_px;
  double cost = rim.prior.cost(state.places[index]);
  for (std::size_t view = 0; view < 2; ++view) {
    const RimProjection projection(state.places[index], state.camera_from_table[view],
                                   terms_.focals_px[view]);
    for (std::size_t i = 0; i < rim.outlines[view].size(); i += rim.step) {
      double residual = 0.0;
      if (!projection.residual(rim.outlines[view][i], residual)) return kUnseenPlace;
      cost += robust_cost(residual, variance, squared_scale);
    }
  }
  return cost;
}

double BundleProblem::add_rim(const BundleState& state, std::size_t index, Equations& equations) const {
  const BundleRim& rim = terms_.rims[index];
  const double variance = 1.0 / static_cast<double>(rim.step);
  const double squared_scale = rim.scale_px * rim.scale_px;
  PlaceMatrix information = rim.prior.information.asDiagonal();
  PlaceVector slope = rim.prior.information.cwiseProduct(as_vector(state.places[index]) - rim.prior.mean);
  Eigen::Matrix<double, kPlaceParameters, kCameraParameters> mixed;
  double cost = rim.prior.cost(state.places[index]);
  for (std::size_t view = 0; view < 2; ++view) {
    const RimProjection projection(state.places[index], state.camera_from_table[view],
                                   terms_.focals_px[view]);
    NormalEquations<kPoseParameters + kPlaceParameters> sums;
    for (std::size_t i = 0; i < rim.outlines[view].size(); i += rim.step) {
      double residual = 0.0;
      Vec6 by_camera;
      PlaceVector by_place;
      if (!projection.linearise(rim.outlines[view][i], residual, by_camera, by_place)) return kUnseenPlace;
      Eigen::Matrix<double, kPoseParameters + kPlaceParameters, 1> jacobian;
      jacobian << by_camera, by_place;
      cost += robust_cost(residual, variance, squared_scale);
      sums.add(residual, jacobian, robust_weight(residual, variance, squared_scale));
    }
    const auto begin = static_cast<Eigen::Index>(6 * view);
    equations.hessian.block<6, 6>(begin, begin) += sums.hessian.topLeftCorner<6, 6>();
    equations.gradient.segment<6>(begin) += sums.gradient.head<6>();
    mixed.middleCols<6>(begin) = sums.hessian.bottomLeftCorner<kPlaceParameters, 6>();
    information += sums.hessian.bottomRightCorner<kPlaceParameters, kPlaceParameters>();
    slope += sums.gradient.tail<kPlaceParameters>();
  }
  PlaceElimination& gone = eliminations_[index];
  information.diagonal() *= 1.0 + kRounding;  // an azimuth may be almost free
  gone.covariance = inverse_information<kPlaceParameters>(information);
  gone.from_place = gone.covariance * slope;
  gone.from_cameras = gone.covariance.lazyProduct(mixed);
  equations.hessian.topLeftCorner<kCameraParameters, kCameraParameters>() -=
      mixed.transpose().lazyProduct(gone.from_cameras);
  equations.gradient.head<kCameraParameters>() -= mixed.transpose() * gone.from_place;
  return cost;
}

double BundleProblem::cost(const BundleState& state) const {
  double cost = cards_cost(state) + tracks_cost(state);
  for (std::size_t i = 0; i < terms_.rims.size(); ++i) cost += rim_cost(state, i);
  return cost;
}

double BundleProblem::linearise(const BundleState& state, Equations& equations) const {
  double cost = add_cards(state, equations) + add_tracks(state, equations);
  for (std::size_t i = 0; i < terms_.rims.size(); ++i) cost += add_rim(state, i, equations);
  return cost;
}

BundleState BundleProblem::moved(const BundleState& state, const BundleVector& step) const {
  BundleState next = state;
  next.camera_from_table = {traygauge::moved(state.camera_from_table[0], step.head<6>()),
                            traygauge::moved(state.camera_from_table[1], step.segment<6>(6))};
  next.card.tilt_rad += step.segment<2>(kLieParameter);
  next.card.raised_mm += step[kLieParameter + 2];
  for (std::size_t i = 0; i < terms_.rims.size(); ++i) {
    const PlaceElimination& gone = eliminations_[i];
    next.places[i] = place_from_vector(as_vector(state.places[i]) - gone.from_place -
                                       gone.from_cameras * step.head<kCameraParameters>());
  }
  return next;
}

}  // namespace traygauge
