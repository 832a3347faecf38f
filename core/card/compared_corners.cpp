#include "core/card/compared_corners.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/image/pyramid.hpp"
#include "core/image/resample.hpp"

namespace traygauge {
namespace {

// Calls take(corner, descriptor, direction) for each corner of `smooth` that has a descriptor.
template <class Take>
void describe_corners(std::span<const Corner> corners, ImageView<const std::uint8_t> smooth,
                      const BinarySampling& sampling, Take&& take) {
  for (const Corner& corner : corners) {
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

}  // namespace

ImageView<std::uint8_t> resize_into(ImageView<const std::uint8_t> source, double scale,
                                    std::span<std::uint8_t> storage) {
  const int width = static_cast<int>(source.width * scale);
  const int height = static_cast<int>(source.height * scale);
  const ImageView<std::uint8_t> target{storage.data(), width, height};
  if (2 * width == source.width && 2 * height == source.height) {
    halve(source, target);
  } else if (scale > 1.0) {
    enlarge_linear(source, target);
  } else {
    reduce_area(source, target);
  }
  return target;
}

void find_compared_corners(ImageView<const std::uint8_t> picture, const CardSearchParams& params,
                           CornerWorkspace& workspace, ComparedCorners& compared) {
  compared.smooth = {compared.smooth_storage.data(), picture.width, picture.height};
  box_blur(picture, compared.smooth);
  Random random(kFixedSeed);
  find_corners({picture, {}, 1, {}}, params.corners, random, workspace, compared.corners);
  compared.matches.clear();
}

void match_corners(std::span<const Corner> corners, const PrintCorners& print, const CardSearchParams& params,
                   ComparedCorners& compared) {
  describe_corners(corners, compared.smooth, print.sampling.front(),
                   [&](const Vec2& pixel, const BinaryDescriptor& descriptor, const Vec2& direction) {
                     double ratio = 1.0;
                     const PrintCorner* like = find_like(descriptor, print, params, ratio);
                     if (like == nullptr) return;
                     compared.matches.push_back({pixel, turned_back_by(direction, like->direction),
                                                 like->px_per_mm, like->pattern_mm, 1.0 - ratio});
                   });
}

Status learn_print_corners(const CardPattern& pattern, const CardSearchParams& params,
                           CardSearchWorkspace& workspace, PrintCorners& print) {
  BinarySampling& sampling = print.sampling.front();
  sampling.draw(kFixedSeed);
  print.corners.clear();
  CardSearchParams learning = params;
  learning.corners.cell_px = std::max(8, params.corners.cell_px / 2);
  for (const double scale : params.scales_px_per_mm) {
    const ImageView<const std::uint8_t> finest = pattern.levels[0].gray;
    const double reduction = workspace.fit(finest.width, finest.height,
                                           std::min(1.0, scale / pattern.levels[0].px_per_axis_mm[0]));
    ComparedCorners& learned = workspace.whole;
    const ImageView<std::uint8_t> picture = resize_into(finest, reduction, learned.picture_storage);
    if (std::min(picture.width, picture.height) <= 2 * kBinaryPatchRadius) continue;
    const double px_per_mm = picture.width / pattern.size.width_mm;
    int room = params.max_pattern_corners;
    find_compared_corners(picture, learning, workspace.corner_search, learned);
    describe_corners(learned.corners.items(), learned.smooth, sampling,
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

}  // namespace traygauge
