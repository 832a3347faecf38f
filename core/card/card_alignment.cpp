#include "core/card/card_alignment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/base/bounded_list.hpp"
#include "core/card/card_hypotheses.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kRefined = 3;  // first poses of an outline, by correlation

struct Candidate {
  CardFitState state;
  double correlation = -1.0;
};

using Finalists = std::array<Candidate, 2>;

void sort_by_correlation(std::span<Candidate> candidates) {
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.correlation > b.correlation; });
}

// That takes at least so many of the pixels, or all.
CardSampling sparsest_sampling(int pixels, int min_samples) {
  if (pixels >= 16 * min_samples) return CardSampling::sixteenth;
  if (pixels >= 4 * min_samples) return CardSampling::quarter;
  return pixels >= 2 * min_samples ? CardSampling::half : CardSampling::all;
}

// Chooses and refines poses of one view.
class Search {
 public:
  Search(CardRefinement& refinement, const CardModelSize& size, const CardAlignmentParams& params)
      : refinement_(refinement), size_(size), params_(params) {}

  // The two best poses of an outline after the coarse stage; −1 where there is none.
  Finalists best_of(const CardOutline& outline) {
    std::array<Candidate, kPosesPerOutline> storage;
    const std::span<Candidate> all(storage.data(), rate_poses(outline, storage));
    sort_by_correlation(all);
    const std::span<Candidate> best = all.first(std::min(all.size(), kRefined));
    const double least = best.empty() ? 0.0 : best[0].correlation - params_.max_correlation_lag;
    for (Candidate& candidate : best) {
      if (candidate.correlation < least) continue;
      refine(params_.coarse_blur_px, CardSampling::sixteenth, params_.coarse_iterations, candidate);
    }
    sort_by_correlation(best);
    Finalists finalists;
    std::copy_n(best.begin(), std::min(best.size(), finalists.size()), finalists.begin());
    return finalists;
  }

  // The same when one side at a time is not the card's.
  Finalists best_without_a_side(const CardOutline& outline) {
    Finalists best;
    for (std::size_t side = 0; side < 4; ++side) {
      for (const bool is_wide : {false, true}) {
        const double opposite_mm = is_wide ? size_.width_mm : size_.height_mm;
        const double beside_mm = is_wide ? size_.height_mm : size_.width_mm;
        CardOutline completed;
        if (!complete_outline(outline, side, opposite_mm, beside_mm, completed)) continue;
        const Finalists found = best_of(completed);
        if (found[0].correlation > best[0].correlation) best = found;
      }
    }
    return best;
  }

  // The better one after the medium stage: at the coarse blur a card seen from afar fits its mirror pose
  // nearly as well. Few pixels are enough to compare them where one is far behind; sharper ones decide where
  // neither is.
  Candidate choose(const Finalists& finalists) {
    Candidate best = finalists[0];
    refine(params_.medium_blur_px, CardSampling::quarter, params_.iterations, best);
    if (finalists[1].correlation < finalists[0].correlation - params_.max_mirror_lag) return best;
    Candidate other = finalists[1];
    refine(params_.medium_blur_px, CardSampling::sixteenth, params_.iterations, other);
    if (other.correlation < best.correlation - params_.max_medium_lag) return best;
    refine(params_.medium_blur_px, CardSampling::quarter, params_.iterations, other);
    if (other.correlation < best.correlation - params_.max_medium_lag) return best;
    if (best.correlation < other.correlation - params_.max_medium_lag) return other;
    refine(params_.finest_blur_px, CardSampling::quarter, params_.iterations, best);
    refine(params_.finest_blur_px, CardSampling::quarter, params_.iterations, other);
    return other.correlation > best.correlation ? other : best;
  }

  // Refines at this blur and correlates again; a lost pose gets −1. A small card is sampled more densely.
  void refine(double blur_px, CardSampling sparsest, int iterations, Candidate& candidate) {
    const Pose& pose = candidate.state.camera_from_table;
    const CardPatternLevel& level = refinement_.level_for(pose, blur_px);
    refinement_.select(pose, level);
    const CardSampling sampling =
        std::min(sparsest, sparsest_sampling(refinement_.selected_pixels(), params_.min_stage_samples));
    const bool is_kept = refinement_.refine(level, sampling, iterations, candidate.state);
    candidate.correlation =
        is_kept ? refinement_.correlate_inliers(candidate.state, level, sampling).correlation : -1.0;
  }

  // Which of the finer blurs the picture has.
  const CardPatternLevel& find_blur(const Pose& pose) const {
    const CardPatternLevel* best = &refinement_.level_for(pose, params_.finest_blur_px);
    double correlation = -1.0;
    for (const double factor : {1.0, std::sqrt(2.0), 2.0, 2.0 * std::sqrt(2.0)}) {
      const CardPatternLevel& level = refinement_.level_for(pose, params_.finest_blur_px * factor);
      const double reached = refinement_.correlate(pose, level, CardSampling::quarter).correlation;
      if (!(reached > correlation)) continue;
      correlation = reached;
      best = &level;
    }
    return *best;
  }

 private:
  // Their correlations as they are; returns their number.
  std::size_t rate_poses(const CardOutline& outline, std::array<Candidate, kPosesPerOutline>& candidates) {
    std::array<Pose, kPosesPerOutline> storage;
    BoundedList<Pose> poses(storage);
    list_poses(outline, size_, poses);
    std::size_t count = 0;
    for (const Pose& pose : poses) {
      if (!refinement_.is_possible(pose)) continue;
      const CardPatternLevel& level = refinement_.level_for(pose, params_.coarse_blur_px);
      refinement_.select(pose, level);
      candidates[count].state.camera_from_table = pose;
      candidates[count++].correlation =
          refinement_.correlate(pose, level, CardSampling::sixteenth).correlation;
    }
    return count;
  }

  CardRefinement& refinement_;
  const CardModelSize& size_;
  const CardAlignmentParams& params_;
};

CardSampling sampling_for(int pixels, int max_samples) {
  if (pixels <= max_samples) return CardSampling::all;
  if (pixels / 2 <= max_samples) return CardSampling::half;
  return pixels / 4 <= max_samples ? CardSampling::quarter : CardSampling::sixteenth;
}

}  // namespace

Result<CardAlignment> align_card(ImageView<const std::uint8_t> gray, ImageView<const std::uint8_t> labels,
                                 const PixelBox& box, const LensModel& lens, const CardPattern& pattern,
                                 const CardAlignmentParams& params, CardAlignmentWorkspace& workspace) {
  const bool is_one_size = gray.width == labels.width && gray.height == labels.height &&
                           lens.width == labels.width && lens.height == labels.height;
  if (!is_one_size) return StatusCode::labels_size_mismatch;
  if (box.empty() || box.left < 0 || box.top < 0 || box.right > labels.width || box.bottom > labels.height) {
    return StatusCode::card_not_found;
  }
  CardPicture& picture = workspace.picture;
  const Result<CardOutline> outline = find_card_outline(labels, box, lens, params.outline, workspace.outline);
  if (!outline.ok()) return outline.status();
  const Status loaded = picture.load(gray, labels, box, lens);
  if (!loaded.ok()) return loaded;

  CardRefinement refinement(lens, pattern, params.refinement, picture);
  Search search(refinement, pattern.size, params);
  Finalists finalists = search.best_of(*outline);
  if (finalists[0].correlation < params.min_correlation) finalists = search.best_without_a_side(*outline);
  if (finalists[0].correlation < params.min_correlation) return StatusCode::card_not_found;
  Candidate candidate = search.choose(finalists);
  if (candidate.correlation < params.min_correlation) return StatusCode::card_not_found;

  const Pose& pose = candidate.state.camera_from_table;
  const CardPatternLevel& level = search.find_blur(pose);
  refinement.select(pose, level);
  const CardSampling sampling = sampling_for(picture.used_pixels(), params.max_samples);
  CardAlignment alignment;
  if (!refinement.refine(level, sampling, params.iterations, candidate.state) ||
      !refinement.inform(level, sampling, candidate.state, alignment.information)) {
    return StatusCode::card_not_found;
  }
  alignment.camera_from_table = pose;
  const CardCorrelation correlation =
      refinement.correlate_inliers(candidate.state, level, CardSampling::quarter);
  alignment.correlation = correlation.correlation;
  alignment.inlier_fraction = static_cast<double>(correlation.inliers) / std::max(1, correlation.samples);
  alignment.visible_fraction = picture.labelled_pixels() / refinement.projected_px2(pose);
  alignment.rms_gray = candidate.state.spread_gray;
  alignment.gain = candidate.state.tone[0];
  alignment.blur_px = refinement.blur_px(pose, level);
  const bool is_seen = alignment.correlation >= params.min_correlation &&
                       alignment.visible_fraction >= params.min_visible_fraction;
  if (!is_seen) return StatusCode::card_not_found;
  alignment.condition = refinement.judge(level, sampling, candidate.state, params.condition);
  return alignment;
}

}  // namespace traygauge
