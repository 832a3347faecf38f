#include "core/card/card_search.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "core/card/card_detection.hpp"
#include "core/card/card_hypotheses.hpp"
#include "core/card/compared_corners.hpp"
#include "core/card/homography.hpp"
#include "core/image/resample.hpp"

namespace traygauge {
namespace {

// Whether two matches may show the same card: each has its turn and scale, and lies where the other puts it.
bool agrees(const CardSearchMatch& a, const CardSearchMatch& b, const CardSearchParams& params) {
  if (a.turn.dot(b.turn) < params.min_turn_cosine) return false;
  if (a.px_per_mm > params.max_scale_ratio * b.px_per_mm ||
      b.px_per_mm > params.max_scale_ratio * a.px_per_mm)
    return false;
  const Vec2 away = a.px_per_mm * turned_by(b.pattern_mm - a.pattern_mm, a.turn);
  const Vec2 off_px = b.pixel - a.pixel - away;
  const double reach_px = params.near_px + params.reach_fraction * away.norm();
  return off_px.squaredNorm() <= reach_px * reach_px;
}

// A strict order, so that equal ones do not depend on the search.
bool is_clearer(const CardSearchMatch& a, const CardSearchMatch& b) {
  if (a.clarity != b.clarity) return a.clarity > b.clarity;
  return a.pixel.y() != b.pixel.y() ? a.pixel.y() < b.pixel.y() : a.pixel.x() < b.pixel.x();
}

// How much speaks for the card where `seed` puts it.
double rate(const CardSearchMatch& seed, std::span<const CardSearchMatch> matches,
            const CardSearchParams& params) {
  double sum = 0.0;
  for (const CardSearchMatch& match : matches) {
    if (agrees(seed, match, params)) sum += match.clarity;
  }
  return sum;
}

// Where a part of the picture as stored was taken from, and how much it was shrunk.
struct Excerpt {
  Vec2 corner_px = Vec2::Zero();
  Vec2 shrink = Vec2::Ones();

  Vec2 stored(const Vec2& pixel) const {
    return corner_px + Vec2(scale_coordinate(pixel.x(), shrink.x()), scale_coordinate(pixel.y(), shrink.y()));
  }
};

class CardSearch {
 public:
  CardSearch(ImageView<const std::uint8_t> gray, const LensModel& lens, const CardModelSize& size,
             const PrintCorners& print, const CardSearchParams& params, const CardParams& card,
             CardSearchWorkspace& workspace)
      : gray_(gray),
        lens_(lens),
        size_(size),
        print_(print),
        params_(params),
        card_(card),
        workspace_(workspace) {}

  // Compares corners of the picture with the print's, the strongest first, until those so far show the card:
  // a print has much contrast, so that most of the others need not be looked at.
  Status run(double scale) {
    closer_count_ = 0;
    ComparedCorners& compared = workspace_.whole;
    const ImageView<const std::uint8_t> picture = resize_into(gray_, scale, compared.picture_storage);
    const Excerpt excerpt{Vec2::Zero(), shrink_of(gray_, picture)};
    find_compared_corners(picture, params_, workspace_.corner_search, compared);
    const std::span<Corner> all = compared.corners.items();
    std::sort(all.begin(), all.end(), is_better);
    std::size_t looked_at = 0;
    for (auto wanted = static_cast<std::size_t>(params_.first_corners); looked_at < all.size(); wanted *= 3) {
      const std::size_t end = std::min(all.size(), wanted);
      match_corners(all.subspan(looked_at, end - looked_at), print_, params_, compared);
      looked_at = end;
      const auto second_chance = [&](const CardSearchMatch& seed) {
        return can_look_closer(seed, scale) ? look_closer(excerpt, seed, scale)
                                            : fit_all_about(excerpt, seed, compared);
      };
      if (fit_matches(excerpt, compared, second_chance).ok()) return StatusCode::ok;
    }
    return StatusCode::card_not_found;
  }

  // Rays, as search_card gives them.
  std::array<Vec2, 4> corners() const {
    const Mat3 ray_from_pattern = fit_.pattern_from_first.inverse();
    std::array<Vec2, 4> corners = print_corners_mm(size_);
    for (Vec2& corner : corners) corner = (ray_from_pattern * corner.homogeneous()).hnormalized();
    return corners;
  }

 private:
  static Vec2 shrink_of(ImageView<const std::uint8_t> from, ImageView<const std::uint8_t> to) {
    return {static_cast<double>(from.width) / to.width, static_cast<double>(from.height) / to.height};
  }

  // The card among the matches so far. Places for which something speaks, but too little, get the second
  // chance, which returns a status.
  template <class SecondChance>
  Status fit_matches(const Excerpt& excerpt, ComparedCorners& compared, SecondChance&& second_chance) {
    std::span<CardSearchMatch> matches = compared.matches.items();
    std::sort(matches.begin(), matches.end(), is_clearer);
    for (int tried = 0; tried < params_.max_tried && !matches.empty(); ++tried) {
      const CardSearchMatch seed = best_seed(matches);
      // Those that agree are used, and out of the way of the next try.
      const auto rest = std::partition(matches.begin(), matches.end(), [&](const CardSearchMatch& match) {
        return !agrees(seed, match, params_);
      });
      track_count_ = 0;
      for (auto match = rest; match != matches.end(); ++match)
        add_track(excerpt.stored(match->pixel), match->pattern_mm);
      matches = matches.first(static_cast<std::size_t>(rest - matches.begin()));
      std::sort(matches.begin(), matches.end(), is_clearer);
      if (fit_tracks(card_).ok()) return StatusCode::ok;
      if (track_count_ < kHomographySample) continue;
      if (second_chance(seed).ok()) return StatusCode::ok;
    }
    return StatusCode::card_not_found;
  }

  CardSearchMatch best_seed(std::span<const CardSearchMatch> matches) const {
    double most = -1.0;
    CardSearchMatch seed;
    for (const CardSearchMatch& match :
         matches.first(std::min(matches.size(), static_cast<std::size_t>(params_.max_seeds)))) {
      const double rating = rate(match, matches, params_);
      if (rating <= most) continue;
      most = rating;
      seed = match;
    }
    return seed;
  }

  void add_track(const Vec2& stored_px, const Vec2& pattern_mm) {
    CardTrack track;
    track.pattern_mm = pattern_mm;
    if (lens_.undistort_pixel(stored_px, track.first)) workspace_.tracks[track_count_++] = track;
  }

  Status fit_tracks(const CardParams& card) {
    Random random(kFixedSeed);
    return traygauge::find_card(workspace_.tracks.first(track_count_), size_, card, random, workspace_.card,
                                fit_);
  }

  // Once it is known about where the card lies, a corner need not resemble one place of the print more than
  // all others: of the print's corners that may lie there, it shows the one that it differs from least.
  Status fit_all_about(const Excerpt& excerpt, const CardSearchMatch& seed, const ComparedCorners& compared) {
    const double card_mm = std::hypot(size_.width_mm, size_.height_mm);
    const double reach_px = params_.near_px + (1.0 + params_.reach_fraction) * seed.px_per_mm * card_mm;
    track_count_ = 0;
    for (const Corner& corner : compared.corners) {
      const Vec2 pixel(corner.x, corner.y);
      BinaryDescriptor descriptor;
      Vec2 direction;
      if ((pixel - seed.pixel).squaredNorm() > reach_px * reach_px) continue;
      if (!describe_binary(compared.smooth, corner.x, corner.y, print_.sampling.front(), descriptor,
                           direction))
        continue;
      const PrintCorner* nearest = nullptr;
      int least = params_.max_distance + 1;
      for (const PrintCorner& like : print_.corners) {
        const int distance = hamming_distance(descriptor, like.descriptor);
        if (distance >= least) continue;
        const CardSearchMatch match{pixel, turned_back_by(direction, like.direction), like.px_per_mm,
                                    like.pattern_mm, 0.0};
        if (!agrees(seed, match, params_)) continue;
        least = distance;
        nearest = &like;
      }
      if (nearest != nullptr) add_track(excerpt.stored(pixel), nearest->pattern_mm);
    }
    // A homography of few corners in one part of the card need not be that of any card.
    CardParams rigid = card_;
    rigid.detection.model = CardModel::absolute_pose;
    return fit_tracks(rigid);
  }

  double closer_scale(const CardSearchMatch& seed, double scale) const {
    return std::min(params_.max_enlargement, scale * params_.close_px_per_mm / seed.px_per_mm);
  }

  bool can_look_closer(const CardSearchMatch& seed, double scale) const {
    return closer_scale(seed, scale) > scale;
  }

  // The card where `seed` puts it, in a finer picture of that place alone.
  Status look_closer(const Excerpt& excerpt, const CardSearchMatch& seed, double scale) {
    const auto looked_at = std::span(closer_).first(closer_count_);
    const bool is_known = std::any_of(looked_at.begin(), looked_at.end(), [&](const CardSearchMatch& other) {
      return agrees(other, seed, params_);
    });
    if (is_known || closer_count_ == closer_.size()) return StatusCode::card_not_found;
    closer_[closer_count_++] = seed;
    const Vec2 middle_mm(0.5 * size_.width_mm, 0.5 * size_.height_mm);
    const Vec2 away_px = seed.px_per_mm * turned_by(middle_mm - seed.pattern_mm, seed.turn);
    const Vec2 middle_px = excerpt.stored(seed.pixel + away_px);
    const double reach_px = (params_.near_px + params_.max_scale_ratio * seed.px_per_mm * middle_mm.norm() +
                             params_.reach_fraction * away_px.norm()) /
                            scale;
    const auto within = [](double value, int size) {
      return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size)));
    };
    const int left = within(middle_px.x() - reach_px, gray_.width);
    const int top = within(middle_px.y() - reach_px, gray_.height);
    const int width = within(middle_px.x() + reach_px, gray_.width) - left;
    const int height = within(middle_px.y() + reach_px, gray_.height) - top;
    if (std::min(width, height) <= 4 * kBinaryPatchRadius) return StatusCode::card_not_found;
    const double fits =
        std::sqrt(static_cast<double>(params_.close_px) / std::max(1.0, static_cast<double>(width) * height));
    const double closer = workspace_.fit(width, height, std::min(closer_scale(seed, scale), fits));
    ComparedCorners& compared = workspace_.close;
    const ImageView<const std::uint8_t> part{gray_.row(top) + left, width, height, gray_.stride};
    const ImageView<const std::uint8_t> picture = resize_into(part, closer, compared.picture_storage);
    find_compared_corners(picture, params_, workspace_.corner_search, compared);
    match_corners(compared.corners.items(), print_, params_, compared);
    const Excerpt close{Vec2(left, top), shrink_of(part, picture)};
    return fit_matches(close, compared,
                       [&](const CardSearchMatch& again) { return fit_all_about(close, again, compared); });
  }

  ImageView<const std::uint8_t> gray_;
  const LensModel& lens_;
  const CardModelSize& size_;
  const PrintCorners& print_;
  const CardSearchParams& params_;
  const CardParams& card_;
  CardSearchWorkspace& workspace_;
  std::size_t track_count_ = 0;
  CardFit fit_;
  // Places that were looked at more closely.
  std::array<CardSearchMatch, 8> closer_;
  std::size_t closer_count_ = 0;
};

}  // namespace

Result<std::array<Vec2, 4>> search_card(ImageView<const std::uint8_t> gray, const LensModel& lens,
                                        const CardModelSize& size, const PrintCorners& print,
                                        const CardSearchParams& params, const CardParams& card,
                                        CardSearchWorkspace& workspace) {
  CardSearch search(gray, lens, size, print, params, card, workspace);
  double searched = 0.0;
  for (const int pixels : params.search_px) {
    const double wanted = params.scale_to(pixels, gray.width, gray.height);
    const double scale = workspace.fit(gray.width, gray.height, wanted);
    if (scale == searched) break;
    searched = scale;
    if (search.run(scale).ok()) return search.corners();
  }
  return StatusCode::card_not_found;
}

}  // namespace traygauge
