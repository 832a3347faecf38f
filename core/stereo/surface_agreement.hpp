// At which height over or below its description a bare surface lies, a dish's glaze or the table: there both
// pictures show the same scratches, grains and crumbs on it.
//
// Plane sweeping (R. T. Collins, A space-sweep approach to true multi-image matching, CVPR 1996) of one
// surface as a whole: all its places vote for one height, so that faint structure suffices.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/image/gray_sampler.hpp"
#include "core/image_view/image_view.hpp"
#include "core/stereo/surface_view.hpp"

namespace traygauge {

struct SurfaceAgreementParams {
  double reach_mm = 6.0;  // sought above and below; what is further off fails by its rim
  double grain_mm = 2.0;  // what differs from its surroundings over this length; wider gradients are shade
  double max_contrast = 12.0;  // grey values; more counts as this much, as edges of shine do
  // Structure correlates at its height by so much more than anywhere 4 mm or further off. Of captures' dishes
  // shade and shine reach 0.25, structure 0.45 and more.
  double min_lead = 0.4;
  double apart_mm = 4.0;
  double max_sigma_mm = 0.5;      // where parts of the surface agree worse, it is none
  std::size_t min_samples = 200;  // 25 in each of the eight parts of the jackknife
};

struct AgreedHeight {
  bool is_known = false;  // there is structure, and it agrees at one height within reach
  double offset_mm = 0.0;
  double sigma_mm = 0.0;
  double lead = 0.0;  // of its correlation
};

// Takes places of a surface one by one; a few kB.
class SurfaceAgreement {
 public:
  // `middle_mm` of the surface, around which it is divided into parts. Where both pictures are labelled
  // `label`, the surface is bare.
  SurfaceAgreement(const SurfaceView& first, const SurfaceView& second, std::uint8_t label,
                   const Vec3& middle_mm, const SurfaceAgreementParams& params);

  // A place on the surface as described, in the table frame. Left out where it is not bare.
  void add(const Vec3& place_mm);
  // Sigma is the jackknife's over eight parts (J. W. Tukey, Ann. Math. Stat. 29 (1958), 614).
  AgreedHeight solve() const;

 private:
  static constexpr std::size_t kParts = 8;
  static constexpr std::size_t kHeightsUp = 6;
  static constexpr std::size_t kHeights = 2 * kHeightsUp + 1;

  // Of contrasts in both pictures.
  struct Sums {
    double count = 0.0;
    double first = 0.0;
    double first_squared = 0.0;
    std::array<double, kHeights> second{};
    std::array<double, kHeights> second_squared{};
    std::array<double, kHeights> product{};
  };
  // A picture at the level at which grains have some pixels.
  struct Sampled {
    ImageView<const std::uint8_t> picture;
    std::size_t level = 0;
    double ring_px = 0.0;  // of the level, around a grain
    double bare_px = 0.0;  // of the stored picture: so far around it has to be bare
  };

  Sampled sample(const SurfaceView& view, const Vec3& middle_mm) const;
  bool is_bare(std::size_t view, const Vec2& pixel) const;
  bool contrast(std::size_t view, const Vec2& pixel, double& value) const;
  bool peak_mm(const Sums& sums, double& offset_mm, double& lead) const;
  static void add(const Sums& part, double sign, Sums& sums);

  SurfaceAgreementParams params_;
  std::array<const SurfaceView*, 2> views_;
  std::uint8_t label_;
  Vec2 middle_mm_;
  Vec3 eye_mm_;  // of the first picture
  std::array<Sampled, 2> sampled_;
  std::array<Sums, kParts> parts_{};
};

}  // namespace traygauge
