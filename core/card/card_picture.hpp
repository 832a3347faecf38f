// The labelled card of a picture in tiles of 8 × 8 pixels, and how it compares with the print under a pose.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/status.hpp"
#include "core/card/card_pattern.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "core/geometry/levenberg_marquardt.hpp"
#include "core/labels/label_regions.hpp"

namespace traygauge {

struct CardPictureParams {
  int max_tiles =
      2048;  // 131 072 px, a card that fills a quarter of a 0.5 MP frame; of a larger one, every n-th tile
};

inline constexpr int kCardTileSide = 8;  // a tile's pixels are the bits of a word of 64

struct CardTile {
  int x = 0;  // of its top left pixel
  int y = 0;
  std::uint64_t labelled = 0;  // bit 8 row + column: inside the label
  std::uint64_t used = 0;      // of those, where the print is seen under the pose chosen
  Vec2 ray = Vec2::Zero();     // of its centre
  Eigen::Matrix2d ray_by_pixel = Eigen::Matrix2d::Zero();
};

// Which pixels are taken: whole rows, since eight pixels cost as much as one.
enum class CardSampling : std::uint8_t {
  all,
  half,       // every second row
  quarter,    // every fourth row
  sixteenth,  // every fourth row of every fourth tile
};

// How the print's grey values turn into the picture's: gain and offset change linearly over the card, as
// gloss and light do. In the order 1, x, y of gain, then of offset; x and y from −1 to 1 over the card.
using CardTone = Eigen::Matrix<double, 6, 1>;

// Which residuals count: those within `cutoff_gray` under the tone.
struct CardInliers {
  CardTone tone = CardTone::Zero();
  double cutoff_gray = std::numeric_limits<double>::infinity();
};

// Over the samples that count.
struct CardCorrelation {
  double correlation = 0.0;
  double rms_gray = 0.0;  // of the residual
  int samples = 0;
  int inliers = 0;
  CardTone tone = CardTone::Zero();  // constant over the card
};

// A linearisation of all residuals by pose and tone: 6 of the pose's step as in `moved`, then those of
// CardTone.
struct CardLinearisation {
  NormalEquations<12> equations;
  // Sum of the outer products of the tiles' gradients, lower triangle: the variance of the gradient that the
  // data show, whatever their noise.
  NormalEquations<12>::Matrix scatter = NormalEquations<12>::Matrix::Zero();
  double spread_gray = 0.0;  // robust standard deviation of the residuals
  double weights = 0.0;      // their sum over the samples
  double slopes = 0.0;       // sum of the weighted residuals' derivatives; less, since weights fall
  int samples = 0;
};

class CardPicture {
 public:
  template <class Allocator>
  constexpr void allocate(Allocator& arena, const CardPictureParams& params) {
    storage_ = arena.template take<CardTile>(static_cast<std::size_t>(params.max_tiles));
  }

  // Keeps `gray` until the next call. card_not_found without a labelled pixel.
  Status load(ImageView<const std::uint8_t> gray, ImageView<const std::uint8_t> labels, const PixelBox& box,
              const LensModel& lens);

  // Uses the labelled pixels that show the print at least `margin_mm` inside its edge.
  void select(const Pose& camera_from_table, const CardModelSize& size, double margin_mm);

  CardCorrelation correlate(const Pose& camera_from_table, const CardModelSize& size,
                            const CardPatternLevel& level, CardSampling sampling,
                            const CardInliers& inliers) const;

  // Weighs a residual r by Geman and McClure: 1 / (1 + (r / cutoff_gray)²)².
  CardLinearisation linearise(const Pose& camera_from_table, const CardModelSize& size,
                              const CardPatternLevel& level, const CardTone& tone, double cutoff_gray,
                              CardSampling sampling) const;

  // All pixels with the label, in the box.
  int labelled_pixels() const { return labelled_; }
  int used_pixels() const { return used_; }

  ImageView<const std::uint8_t> gray() const { return gray_; }
  std::span<const CardTile> tiles() const { return tiles_; }

 private:
  ImageView<const std::uint8_t> gray_;
  std::span<CardTile> storage_;
  std::span<CardTile> tiles_;
  int labelled_ = 0;
  int used_ = 0;
};

}  // namespace traygauge
