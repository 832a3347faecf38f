#include "core/scale/card_search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include <Eigen/LU>

#include "core/image/pyramid.hpp"
#include "core/image/resample.hpp"
#include "core/scale/card_detection.hpp"
#include "core/scale/card_hypotheses.hpp"
#include "core/scale/homography.hpp"

namespace traygauge {
namespace {

// Shrinks `source` into `storage`.
ImageView<std::uint8_t> reduced(ImageView<const std::uint8_t> source, double scale,
                                std::span<std::uint8_t> storage) {
  const int width = static_cast<int>(source.width * scale);
  const int height = static_cast<int>(source.height * scale);
  const ImageView<std::uint8_t> target{storage.data(), width, height};
  if (2 * width == source.width && 2 * height == source.height) {
    halve(source, target);
  } else {
    reduce_area(source, target);
  }
  return target;
}

// Finds corners in `picture` and calls take(corner, descriptor, direction) for each that has a descriptor.
template <class Take>
void for_each_corner(ImageView<const std::uint8_t> picture, const BinarySampling& sampling,
                     const CardSearchParams& params, CardSearchWorkspace& workspace, Take&& take) {
  const ImageView<std::uint8_t> smooth{workspace.smooth.data(), picture.width, picture.height};
  box_blur(picture, smooth);
  Random random(params.seed);
  find_corners({picture, {}, 1, {}}, params.corners, random, workspace.corner_search, workspace.corners);
  for (const Corner& corner : workspace.corners) {
    BinaryDescriptor descriptor;
    Vec2 direction;
    if (describe_binary(smooth, corner.x, corner.y, sampling, descriptor, direction))
      take(Vec2(corner.x, corner.y), descriptor, direction);
  }
}

// Of eight bytes up to 128, the highest bit of those that are at most `limit`; the first byte lowest.
std::uint64_t bytes_up_to(int limit, const std::uint8_t* bytes) {
  static_assert(std::endian::native == std::endian::little);
  std::uint64_t eight = 0;
  std::memcpy(&eight, bytes, sizeof(eight));
  const auto rest = static_cast<std::uint64_t>(127 - std::min(limit, 127));
  return ~(eight + 0x0101010101010101U * rest) & 0x8080808080808080U;
}

// The print's corner that differs least, and clearly less than those elsewhere on the print; nullptr when
// there is none. `ratio` of the two distances.
const PrintCorner* find_like(const BinaryDescriptor& descriptor, const PrintCorners& print,
                             const CardSearchParams& params, double& ratio) {
  const auto is_elsewhere = [&](const PrintCorner& a, const PrintCorner& b) {
    return (a.pattern_mm - b.pattern_mm).squaredNorm() > params.same_place_mm * params.same_place_mm;
  };
  const PrintCorner* nearest = nullptr;
  int least = 256;
  int least_elsewhere = 256;
  const auto compare = [&](const PrintCorner& corner, int half) {
    const int distance =
        half + hamming_distance(descriptor, corner.descriptor, kHalfWords, descriptor.size());
    if (distance < least) {
      if (nearest != nullptr && is_elsewhere(*nearest, corner)) least_elsewhere = least;
      least = distance;
      nearest = &corner;
    } else if (distance < least_elsewhere && is_elsewhere(*nearest, corner)) {
      least_elsewhere = distance;
    }
  };
  const std::span<const PrintCorner> corners = print.corners.items();
  const DescriptorBlock::Spread spread = DescriptorBlock::spread(descriptor);
  for (std::size_t begin = 0; begin < corners.size(); begin += DescriptorBlock::kSide) {
    const DescriptorBlock::Distances halves = print.blocks[begin / DescriptorBlock::kSide].distances(spread);
    for (std::size_t eight = 0; eight < halves.size(); eight += 8) {
      std::uint64_t near = bytes_up_to(params.max_half_distance, &halves[eight]);
      for (; near != 0; near &= near - 1) {
        const std::size_t i = eight + static_cast<std::size_t>(std::countr_zero(near)) / 8;
        if (begin + i < corners.size()) compare(corners[begin + i], halves[i]);
      }
    }
  }
  ratio = static_cast<double>(least) / std::max(1, least_elsewhere);
  return least <= params.max_distance && ratio <= params.max_distance_ratio ? nearest : nullptr;
}

// Whether two matches may show the same card: each has its turn and scale, and lies where the other puts it.
bool agrees(const CardSearchMatch& a, const CardSearchMatch& b, const CardSearchParams& params) {
  if (a.turn.dot(b.turn) < params.min_turn_cosine) return false;
  if (a.px_per_mm > params.max_scale_ratio * b.px_per_mm ||
      b.px_per_mm > params.max_scale_ratio * a.px_per_mm)
    return false;
  const Vec2 away = a.px_per_mm * turned_by(b.pattern_mm - a.pattern_mm, a.turn);
  const Vec2 off_px = b.pixel - a.pixel - away;
  const double reach_px = params.near_px + params.reach_share * away.norm();
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

// Once it is known about where the card lies, a corner need not resemble one place of the print more than all
// others: of the print's corners that may lie there, it shows the one that it differs from least.
template <class Take>
void for_each_match_about(const CardSearchMatch& seed, ImageView<const std::uint8_t> picture,
                          const PrintCorners& print, double card_mm, const CardSearchParams& params,
                          const CardSearchWorkspace& workspace, Take&& take) {
  const ImageView<const std::uint8_t> smooth{workspace.smooth.data(), picture.width, picture.height};
  const double reach_px = params.near_px + (1.0 + params.reach_share) * seed.px_per_mm * card_mm;
  for (const Corner& corner : workspace.corners) {
    const Vec2 pixel(corner.x, corner.y);
    BinaryDescriptor descriptor;
    Vec2 direction;
    if ((pixel - seed.pixel).squaredNorm() > reach_px * reach_px) continue;
    if (!describe_binary(smooth, corner.x, corner.y, print.sampling.front(), descriptor, direction)) continue;
    const PrintCorner* nearest = nullptr;
    int least = params.max_distance + 1;
    for (const PrintCorner& like : print.corners) {
      const int distance = hamming_distance(descriptor, like.descriptor);
      if (distance >= least) continue;
      const CardSearchMatch match{pixel, turned_back_by(direction, like.direction), like.px_per_mm,
                                  like.pattern_mm, 0.0};
      if (!agrees(seed, match, params)) continue;
      least = distance;
      nearest = &like;
    }
    if (nearest != nullptr) take(pixel, nearest->pattern_mm);
  }
}

Status search_at_scale(ImageView<const std::uint8_t> gray, double scale, const LensModel& lens,
                       const CardModelSize& size, const PrintCorners& print, const CardSearchParams& params,
                       const CardParams& card, CardSearchWorkspace& workspace, std::array<Vec2, 4>& corners) {
  const ImageView<const std::uint8_t> picture = reduced(gray, scale, workspace.picture);
  workspace.matches.clear();
  for_each_corner(picture, print.sampling.front(), params, workspace,
                  [&](const Vec2& pixel, const BinaryDescriptor& descriptor, const Vec2& direction) {
                    double ratio = 1.0;
                    const PrintCorner* like = find_like(descriptor, print, params, ratio);
                    if (like == nullptr) return;
                    workspace.matches.push_back({pixel, turned_back_by(direction, like->direction),
                                                 like->px_per_mm, like->pattern_mm, 1.0 - ratio});
                  });
  std::span<CardSearchMatch> matches = workspace.matches.items();
  std::sort(matches.begin(), matches.end(), is_clearer);
  for (int tried = 0; tried < params.max_tried && !matches.empty(); ++tried) {
    double most = -1.0;
    CardSearchMatch seed;
    for (const CardSearchMatch& match :
         matches.first(std::min(matches.size(), static_cast<std::size_t>(params.max_seeds)))) {
      const double rating = rate(match, matches, params);
      if (rating <= most) continue;
      most = rating;
      seed = match;
    }
    // Those that agree are used, and out of the way of the next try.
    const auto rest = std::partition(matches.begin(), matches.end(), [&](const CardSearchMatch& match) {
      return !agrees(seed, match, params);
    });
    std::size_t count = 0;
    const auto add_track = [&](const Vec2& pixel, const Vec2& pattern_mm) {
      CardTrack track;
      track.pattern_mm = pattern_mm;
      const Vec2 stored(scale_coordinate(pixel.x(), static_cast<double>(gray.width) / picture.width),
                        scale_coordinate(pixel.y(), static_cast<double>(gray.height) / picture.height));
      if (lens.undistort_pixel(stored, track.first)) workspace.tracks[count++] = track;
    };
    for (auto match = rest; match != matches.end(); ++match) add_track(match->pixel, match->pattern_mm);
    matches = matches.first(static_cast<std::size_t>(rest - matches.begin()));
    std::sort(matches.begin(), matches.end(), is_clearer);
    Random random(params.seed);
    CardFit fit;
    Status found = find_card(workspace.tracks.first(count), size, card, random, workspace.card, fit);
    if (!found.ok() && count >= static_cast<std::size_t>(params.min_agreeing)) {
      count = 0;
      for_each_match_about(seed, picture, print, std::hypot(size.width_mm, size.height_mm), params, workspace,
                           add_track);
      // A homography of few corners in one part of the card need not be that of any card.
      CardParams rigid = card;
      rigid.detection.model = CardModel::absolute_pose;
      found = find_card(workspace.tracks.first(count), size, rigid, random, workspace.card, fit);
    }
    if (!found.ok()) continue;
    const Mat3 ray_from_pattern = fit.pattern_from_first.inverse();
    const std::array<Vec2, 4> print_mm = print_corners_mm(size);
    for (std::size_t i = 0; i < 4; ++i)
      corners[i] = (ray_from_pattern * print_mm[i].homogeneous()).hnormalized();
    return StatusCode::ok;
  }
  return StatusCode::card_not_found;
}

}  // namespace

Status learn_print_corners(const CardPattern& pattern, const CardSearchParams& params,
                           CardSearchWorkspace& workspace, PrintCorners& print) {
  BinarySampling& sampling = print.sampling.front();
  sampling.draw(params.seed);
  print.corners.clear();
  CardSearchParams learning = params;
  learning.corners.cell_px = std::max(8, params.corners.cell_px / 2);
  for (const double scale : params.scales_px_per_mm) {
    const ImageView<const std::uint8_t> finest = pattern.levels[0].gray;
    const double reduction = workspace.fit(finest.width, finest.height,
                                           std::min(1.0, scale / pattern.levels[0].px_per_axis_mm[0]));
    const ImageView<std::uint8_t> picture = reduced(finest, reduction, workspace.picture);
    if (std::min(picture.width, picture.height) <= 2 * kBinaryPatchRadius) continue;
    const double px_per_mm = picture.width / pattern.size.width_mm;
    int room = params.max_pattern_corners;
    for_each_corner(picture, sampling, learning, workspace,
                    [&](const Vec2& pixel, const BinaryDescriptor& descriptor, const Vec2& direction) {
                      if (room-- <= 0) return;
                      const Vec2 place = pattern_mm(pixel, picture.width, pattern.size);
                      print.corners.push_back({descriptor, direction, place, px_per_mm});
                    });
  }
  for (std::size_t i = 0; i < print.corners.size(); ++i) {
    print.blocks[i / DescriptorBlock::kSide].set(i % DescriptorBlock::kSide,
                                                 print.corners.items()[i].descriptor);
  }
  return print.corners.empty() ? StatusCode::invalid_configuration : StatusCode::ok;
}

Status search_card(ImageView<const std::uint8_t> gray, const LensModel& lens, const CardModelSize& size,
                   const PrintCorners& print, const CardSearchParams& params, const CardParams& card,
                   CardSearchWorkspace& workspace, std::array<Vec2, 4>& corners) {
  Status status = StatusCode::card_not_found;
  double searched = 0.0;
  for (const int pixels : params.search_px) {
    const double by_area = std::sqrt(pixels / (static_cast<double>(gray.width) * gray.height));
    const double scale = workspace.fit(gray.width, gray.height, std::min(1.0, by_area));
    if (status.ok() || scale == searched) break;
    searched = scale;
    status = search_at_scale(gray, scale, lens, size, print, params, card, workspace, corners);
  }
  return status;
}

}  // namespace traygauge
