// Speeded-up robust features: Bay, Ess, Tuytelaars, Van Gool 2008 (paper reference [14]; the paper ran
// OpenSURF [37]). Detection: determinant of box-filter Hessians over an integral image, 3 × 3 × 3 maxima,
// interpolated. Description: 4 × 4 subregions of Haar sums (dx, |dx|, dy, |dy|), 64-d, unit length.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/status.hpp"
#include "core/image_view/image_view.hpp"
#include "core/paper/features/keypoint.hpp"

namespace traygauge::paper {

inline constexpr int kMaxOctaves = 5;
inline constexpr int kLayersPerOctave = 4;

struct SurfParams {
  // [14] section 3.3, 1 to 5; filter sizes 9…27, 15…51, 27…99, 51…195. Sharp pictures match as well with 3;
  // blurred ones need the large filters.
  int octaves = 4;
  // Sampling step of the first octave in pixels, 1 to 4. OpenSURF's 2 halves the detector's time, and finds
  // 11% fewer correct matches between two views of a meal, 22% fewer on the food.
  int first_step_px = 1;
  // Determinant on a grey range of 0…1, from which a blob counts. OpenSURF's 4e-4 starves smooth food and
  // loses a third of the correct matches. Lower adds noise, and costs time until the cap on keypoints is
  // met.
  float min_response = 5e-5F;
  // Largest ratio of the two curvatures of a blob, from 1; not in [14], the value is SIFT's [13]. Points on
  // the rim of the dish slide along it and take places from the food: 10 drops 3% of the keypoints and adds
  // 6% to the matches that the true depth confirms. 6 adds 13%, but takes 15% where keypoints are few.
  float max_elongation = 10.0F;
};

// invalid_configuration unless octaves are 1…5, the step 1…4, the response positive and finite, and the
// elongation 1 or more.
Status validate(const SurfParams& params);

// Scratch of the detector for pictures up to `max_width` wide. The responses are needed three rows at a time,
// so it holds 15 rows: 4 (4 · 3 / first_step_px + 3) bytes per column, whatever the height.
struct SurfWorkspace {
  // Responses of each layer, three rows in a ring; a row for each of the three second derivatives.
  std::array<std::array<std::span<float>, 3>, kLayersPerOctave> responses;
  std::span<std::int32_t> columns_xx;
  std::span<std::int32_t> columns_yy;
  std::span<std::int32_t> columns_xy;

  template <class Allocator>
  constexpr void allocate(Allocator& allocator, int max_width, const SurfParams& params) {
    const auto columns = static_cast<std::size_t>(max_width) + 1;
    const auto samples = static_cast<std::size_t>(max_width / params.first_step_px) + 1;
    for (auto& layer : responses) {
      for (auto& row : layer) row = allocator.template take<float>(samples);
    }
    columns_xx = allocator.template take<std::int32_t>(columns);
    columns_yy = allocator.template take<std::int32_t>(columns);
    columns_xy = allocator.template take<std::int32_t>(columns);
  }
};

// Finds blobs in the picture behind `integral` (one larger each way), strongest first. When there are more
// than `keypoints` holds, the strongest are kept and keypoints.dropped() counts the others. Angles are 0.
void detect_surf(ImageView<const std::uint32_t> integral, const SurfParams& params, SurfWorkspace& workspace,
                 BoundedList<Keypoint>& keypoints);

// Sets the angle of each keypoint and its descriptor. Equal sizes. A keypoint on uniform ground gets zeros.
void describe_surf(ImageView<const std::uint32_t> integral, std::span<Keypoint> keypoints,
                   std::span<Descriptor> descriptors);

}  // namespace traygauge::paper
