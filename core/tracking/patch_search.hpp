// A patch of the first view looked for in a band of the second, by zero-mean normalised correlation at whole
// pixels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/bounded_list.hpp"
#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

inline constexpr int kSearchSide = 8;                      // of the patch, pixels of the level searched
inline constexpr int kMaxBandSide = 64;                    // of a band's box: a longer band is not searched
inline constexpr int kMaxCorrelationPeaks = kMaxBandSide;  // of all bands of a search together

// Positions of the patch's centre.
struct SearchBand {
  Vec2 begin = Vec2::Zero();
  Vec2 end = Vec2::Zero();
  double margin_px = 2.0;  // around the segment, on all sides
  Eigen::Matrix2d first_from_second = Eigen::Matrix2d::Identity();
};

// A local maximum of the correlation.
struct CorrelationPeak {
  Vec2 pixel = Vec2::Zero();  // of the patch's centre, to a fraction by a parabola through the scores
  float correlation = -1.0F;
};

struct PatchSearchWorkspace {
  static constexpr int kAreaSide = kMaxBandSide + kSearchSide;
  static constexpr int kScoreSide = kMaxBandSide + 2;
  std::span<std::int16_t> area;
  std::span<float> scores;  // of a band's box, with a frame of one
  std::span<CorrelationPeak> peaks;

  template <class Allocator>
  constexpr void allocate(Allocator& arena) {
    area = arena.template take<std::int16_t>(static_cast<std::size_t>(kAreaSide) * kAreaSide);
    scores = arena.template take<float>(static_cast<std::size_t>(kScoreSide) * kScoreSide);
    peaks = arena.template take<CorrelationPeak>(kMaxCorrelationPeaks);
  }
};

struct FoundPatch {
  Vec2 pixel = Vec2::Zero();
  float correlation = -1.0F;
  float runner_up = -1.0F;  // the best peak elsewhere
};

class PatchSearch {
 public:
  PatchSearch(ImageView<const std::uint8_t> first, ImageView<const std::uint8_t> second,
              PatchSearchWorkspace& workspace)
      : first_(first), second_(second), workspace_(workspace), peaks_(workspace.peaks) {}

  void begin() { peaks_.clear(); }
  // Scores the whole pixels of the band, with the patch about `centre` warped as the band says, and notes the
  // local maxima inside of the band, not on its edge. False when the patch leaves the first picture, has no
  // contrast, or the band is too large.
  bool search(const Vec2& centre, const SearchBand& band);
  // The best peak of all bands since begin(); false without any.
  bool find_best(FoundPatch& found) const;

 private:
  void note_peaks(int left, int top, int width, int height);

  ImageView<const std::uint8_t> first_;
  ImageView<const std::uint8_t> second_;
  PatchSearchWorkspace& workspace_;
  BoundedList<CorrelationPeak> peaks_;
};

}  // namespace traygauge
