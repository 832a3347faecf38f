// Nonlinear least squares over a fixed number of parameters: the skeleton of Levenberg and Marquardt
// (paper [29]) that the problems plug into.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/geometry/geometry.hpp"

namespace traygauge {

// JᵀJ and Jᵀr, gathered residual by residual.
template <int kParameters>
struct NormalEquations {
  using Vector = Eigen::Matrix<double, kParameters, 1>;
  using Matrix = Eigen::Matrix<double, kParameters, kParameters>;

  Matrix hessian = Matrix::Zero();  // lower triangle
  Vector gradient = Vector::Zero();

  // `jacobian`: derivatives of the residual; `weight` is that of its square.
  void add(double residual, const Vector& jacobian, double weight = 1.0) {
    for (int i = 0; i < kParameters; ++i) {
      const double scaled = weight * jacobian[i];
      gradient[i] += scaled * residual;
      for (int j = 0; j <= i; ++j) hessian(i, j) += scaled * jacobian[j];
    }
  }

  // step = −(H + damping · diag H)⁻¹ g by Cholesky's factors; false when that matrix is not positive
  // definite.
  bool solve(double damping, Vector& step) const {
    Matrix factor = Matrix::Zero();
    for (int i = 0; i < kParameters; ++i) {
      double rest = -gradient[i];
      for (int j = 0; j <= i; ++j) {
        double sum = i == j ? hessian(i, i) * (1.0 + damping) : hessian(i, j);
        for (int k = 0; k < j; ++k) sum -= factor(i, k) * factor(j, k);
        if (i == j && !(sum > 0.0)) return false;
        factor(i, j) = i == j ? std::sqrt(sum) : sum / factor(j, j);
        if (j < i) rest -= factor(i, j) * step[j];
      }
      step[i] = rest / factor(i, i);
    }
    for (int i = kParameters - 1; i >= 0; --i) {
      for (int k = i + 1; k < kParameters; ++k) step[i] -= factor(k, i) * step[k];
      step[i] /= factor(i, i);
    }
    return step.allFinite();
  }
};

// The inverse of a positive definite matrix given by its lower triangle; zero when it is not.
template <int kSize>
Eigen::Matrix<double, kSize, kSize> inverse_information(
    const Eigen::Matrix<double, kSize, kSize>& information) {
  NormalEquations<kSize> unit;
  unit.hessian = information;
  Eigen::Matrix<double, kSize, kSize> covariance;
  for (int i = 0; i < kSize; ++i) {
    typename NormalEquations<kSize>::Vector column = NormalEquations<kSize>::Vector::Zero();
    unit.gradient = -NormalEquations<kSize>::Vector::Unit(i);
    if (!unit.solve(0.0, column)) return Eigen::Matrix<double, kSize, kSize>::Zero();
    covariance.col(i) = column;
  }
  return covariance;
}

struct LevenbergMarquardtParams {
  int max_iterations = kMaxNewtonSteps;  // linearisations, and rejected steps, together
  double initial_damping = 1e-4;         // relative to the diagonal of JᵀJ
  double damping_factor = 10.0;          // up after a step that failed, down after one that helped
  double min_improvement = 1e-10;        // relative decrease of the cost that still counts
};

struct LevenbergMarquardtReport {
  int iterations = 0;
  double initial_cost = 0.0;
  double cost = 0.0;  // never above initial_cost
  bool converged = false;
};

// Moves `state` to a local minimum of the cost. `problem` offers, for states of any copyable type:
//   double linearise(const State&, NormalEquations<n>&) const   adds all residuals, returns the cost
//   double cost(const State&) const                             the same cost
//   State moved(const State&, const Vector& step) const         the state after a step of n parameters
template <int kParameters, class State, class Problem>
LevenbergMarquardtReport minimise(const Problem& problem, const LevenbergMarquardtParams& params,
                                  State& state) {
  NormalEquations<kParameters> equations;
  LevenbergMarquardtReport report;
  report.initial_cost = report.cost = problem.linearise(state, equations);
  double damping = params.initial_damping;
  while (report.iterations < params.max_iterations && !report.converged) {
    ++report.iterations;
    typename NormalEquations<kParameters>::Vector step = NormalEquations<kParameters>::Vector::Zero();
    const bool solved = equations.solve(damping, step);
    const State candidate = solved ? problem.moved(state, step) : state;
    const double cost = solved ? problem.cost(candidate) : report.cost;
    const double decrease = report.cost - cost;
    if (solved && decrease >= 0.0) {
      report.converged = decrease <= params.min_improvement * report.cost;
      state = candidate;
      report.cost = cost;
      damping /= params.damping_factor;
      if (report.converged) break;
      equations = {};
      problem.linearise(state, equations);
    } else {
      damping *= params.damping_factor;
    }
  }
  return report;
}

}  // namespace traygauge
