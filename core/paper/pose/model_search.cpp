#include "core/paper/pose/model_search.hpp"

#include <algorithm>
#include <array>

#include "core/base/ransac.hpp"
#include "core/paper/pose/five_point.hpp"

namespace traygauge::paper {
namespace {

constexpr std::size_t kMinimalSample = 5;
constexpr std::size_t kMaxSample = 32;

class ModelSearch {
 public:
  ModelSearch(const RelativePoseParams& params, double focal_px, const ThresholdEstimator& thresholds,
              Random& random, RelativePoseWorkspace& workspace)
      : params_(params),
        focal_px_(focal_px),
        thresholds_(thresholds),
        random_(random),
        workspace_(workspace),
        matches_(workspace.matches) {}

  FoundModel run() {
    IterationBound bound(params_.confidence, params_.min_iterations, params_.max_iterations);
    for (; bound.proceed(); bound.count_iteration()) {
      const int count = solve_sample(kMinimalSample, {}, models_);
      for (int m = 0; m < count; ++m) {
        if (consider(models_[static_cast<std::size_t>(m)])) bound.update(inlier_rate(), kMinimalSample);
      }
    }
    best_.iterations = bound.iterations();
    return best_;
  }

 private:
  using Models = std::array<Mat3, kMaxEssentials>;

  // Draws distinct matches, from all or from those listed, and solves for models.
  int solve_sample(std::size_t size, std::span<const std::uint32_t> among, Models& models) {
    std::array<std::size_t, kMaxSample> drawn;
    std::array<RayMatch, kMaxSample> sample;
    sample_distinct(random_, among.empty() ? matches_.size() : among.size(), std::span(drawn).first(size));
    for (std::size_t k = 0; k < size; ++k) {
      sample[k] = matches_[among.empty() ? drawn[k] : among[drawn[k]]];
    }
    return solve_five_point(std::span(sample).first(size), models);
  }

  // The main loop's score is the inlier rate. True when the best model changes.
  bool consider(const Mat3& model) {
    const bool is_first = best_.threshold_px < 0.0;
    const double threshold = is_first ? thresholds_.threshold_px(model) : best_.threshold_px;
    if (threshold < 0.0) return false;
    const std::size_t inliers = matches_.count_inliers(model, focal_px_, threshold, record_);
    if (inliers <= record_) return false;
    if (is_first && !is_non_trivial(inliers, matches_.size(), params_)) return false;
    record_ = inliers;
    return adopt(model, threshold);
  }

  // Optimises the new record locally and keeps it unless eq. (1) prefers the model that we have: at a wide
  // threshold the inlier rate alone cannot tell two good models apart.
  bool adopt(const Mat3& model, double threshold) {
    Mat3 candidate = model;
    double fitness = matches_.fitness(candidate, focal_px_, threshold, -1.0);
    if (params_.local_optimisation) optimise_locally(threshold, candidate, fitness);
    if (best_.threshold_px >= 0.0 &&
        matches_.fitness(best_.essential, focal_px_, threshold, fitness) >= fitness) {
      return false;
    }
    best_.essential = candidate;
    const double updated = thresholds_.threshold_px(candidate);
    best_.threshold_px = updated < 0.0 ? threshold : updated;
    record_ = matches_.count_inliers(candidate, focal_px_, best_.threshold_px, 0);
    return true;
  }

  // LO: models from larger samples of the inliers, scored by eq. (1); each better one starts it again.
  void optimise_locally(double threshold, Mat3& model, double& fitness) {
    std::span<const std::uint32_t> inliers = list_inliers(model, focal_px_, threshold, workspace_);
    int restarts = 0;
    for (int i = 0; i < params_.local_iterations; ++i) {
      const auto wanted = static_cast<std::size_t>(std::max(params_.local_samples, 0));
      const std::size_t size = std::min({wanted, inliers.size(), kMaxSample});
      if (size < kMinimalSample) return;
      const int count = solve_sample(size, inliers, local_models_);
      bool improved = false;
      for (int m = 0; m < count; ++m) {
        const Mat3& candidate = local_models_[static_cast<std::size_t>(m)];
        const double score = matches_.fitness(candidate, focal_px_, threshold, fitness);
        if (score <= fitness) continue;
        fitness = score;
        model = candidate;
        improved = true;
      }
      if (!improved) continue;
      inliers = list_inliers(model, focal_px_, threshold, workspace_);
      if (restarts++ < params_.max_restarts) i = -1;
    }
  }

  double inlier_rate() const { return static_cast<double>(record_) / static_cast<double>(matches_.size()); }

  const RelativePoseParams& params_;
  double focal_px_;
  const ThresholdEstimator& thresholds_;
  Random& random_;
  RelativePoseWorkspace& workspace_;
  const MatchTable& matches_;
  Models models_;
  Models local_models_;
  FoundModel best_;
  std::size_t record_ = 0;
};

}  // namespace

FoundModel search_model(const RelativePoseParams& params, double focal_px,
                        const ThresholdEstimator& thresholds, Random& random,
                        RelativePoseWorkspace& workspace) {
  return ModelSearch(params, focal_px, thresholds, random, workspace).run();
}

std::span<const std::uint32_t> list_inliers(const Mat3& essential, double focal_px, double threshold_px,
                                            RelativePoseWorkspace& workspace) {
  const std::size_t size = workspace.matches.size();
  const std::span<double> distances = workspace.data_px.first(size);
  workspace.matches.measure_distances(essential, focal_px, distances);
  std::size_t count = 0;
  for (std::size_t i = 0; i < size; ++i) {
    if (distances[i] <= threshold_px) workspace.inliers[count++] = static_cast<std::uint32_t>(i);
  }
  return workspace.inliers.first(count);
}

bool is_non_trivial(std::size_t inliers, std::size_t matches, const RelativePoseParams& params) {
  return static_cast<double>(inliers) >= params.min_inliers &&
         static_cast<double>(inliers) >= params.min_inlier_rate * static_cast<double>(matches);
}

}  // namespace traygauge::paper
