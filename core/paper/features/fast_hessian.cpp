// The detector of SURF (Bay et al., section 3): maxima of det(H) in space and scale.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/lanes.hpp"
#include "core/paper/features/box_hessian.hpp"
#include "core/paper/features/strongest_keypoints.hpp"
#include "core/paper/features/surf.hpp"

namespace traygauge::paper {
namespace {

// How far from its sample, in samples, an interpolated maximum may lie. OpenSURF's 0.5 loses a tenth of the
// correct matches: the box filters' responses are no quadrics, and their vertex overshoots.
constexpr float kMaxOffset = 1.0F;

// How far a refinement may jump, in thirds of a lobe; beyond, the quadric describes another blob.
constexpr double kMaxRefinement = 2.0;

// The 3 × 3 × 3 responses around a sample: [layer][row][column].
using Neighbourhood = std::array<std::array<std::array<float, 3>, 3>, 3>;

Neighbourhood neighbourhood_of(const SurfWorkspace& workspace, int layer, int row, int column) {
  Neighbourhood values;
  for (std::size_t l = 0; l < 3; ++l) {
    const auto& rows = workspace.responses[static_cast<std::size_t>(layer) - 1 + l];
    for (std::size_t r = 0; r < 3; ++r) {
      const auto slot = (static_cast<std::size_t>(row) - 1 + r) % 3;
      for (std::size_t c = 0; c < 3; ++c) {
        values[l][r][c] = rows[slot][static_cast<std::size_t>(column) - 1 + c];
      }
    }
  }
  return values;
}

// Equal neighbours: the first in the order of layers, rows and columns is the maximum.
bool is_maximum(const Neighbourhood& values) {
  const float centre = values[1][1][1];
  constexpr std::size_t kCentreIndex = 13;
  for (std::size_t i = 0; i < 27; ++i) {
    const float other = values[i / 9][i / 3 % 3][i % 3];
    if (i < kCentreIndex ? other >= centre : other > centre) return false;
  }
  return true;
}

// Vertex of the quadric through the neighbourhood (Brown & Lowe 2002), in samples: column, row, layer.
// False where it is no maximum or lies beyond the neighbours.
bool interpolate_maximum(const Neighbourhood& v, Eigen::Vector3f& offset) {
  const float centre = v[1][1][1];
  const Eigen::Vector3f gradient(0.5F * (v[1][1][2] - v[1][1][0]), 0.5F * (v[1][2][1] - v[1][0][1]),
                                 0.5F * (v[2][1][1] - v[0][1][1]));
  const float xx = v[1][1][2] + v[1][1][0] - 2.0F * centre;
  const float yy = v[1][2][1] + v[1][0][1] - 2.0F * centre;
  const float ss = v[2][1][1] + v[0][1][1] - 2.0F * centre;
  const float xy = 0.25F * (v[1][2][2] - v[1][2][0] - v[1][0][2] + v[1][0][0]);
  const float xs = 0.25F * (v[2][1][2] - v[2][1][0] - v[0][1][2] + v[0][1][0]);
  const float ys = 0.25F * (v[2][2][1] - v[2][0][1] - v[0][2][1] + v[0][0][1]);
  Eigen::Matrix3f hessian;
  hessian << xx, xy, xs, xy, yy, ys, xs, ys, ss;
  const float determinant = hessian.determinant();
  if (!(determinant < 0.0F)) return false;
  offset = -(hessian.inverse() * gradient);
  return offset.cwiseAbs().maxCoeff() <= kMaxOffset;
}

struct Octave {
  int index = 0;
  int step = 1;
};

// Moves a maximum that was interpolated between coarse samples to the vertex of the quadric through nine
// responses around its own pixel, of the filter nearest to its scale and a third of a lobe apart. So near to
// the vertex the errors of a quadric cancel.
void refine_position(ImageView<const std::uint32_t> integral, Keypoint& keypoint) {
  constexpr int kMaxMoves = 3;
  const float lobe = keypoint.scale_px / (3.0F * kSigmaPerFilterPixel);
  const BoxFilter filter{2 * static_cast<int>(0.5F * lobe) + 1};
  Vec2& pixel = keypoint.pixel;
  const int distance = std::max(1, filter.lobe / 3);
  const int margin = filter.radius() + distance;
  for (int move = 0; move < kMaxMoves; ++move) {
    const int x = static_cast<int>(std::floor(pixel.x() + 0.5));
    const int y = static_cast<int>(std::floor(pixel.y() + 0.5));
    if (x < margin || y < margin || x + margin >= integral.width - 1 || y + margin >= integral.height - 1)
      return;
    const auto at = [&](int column, int row) {
      return derivatives_at(integral, filter, x + column * distance, y + row * distance).response();
    };
    const float centre = at(0, 0);
    const float left = at(-1, 0), right = at(1, 0), above = at(0, -1), below = at(0, 1);
    const float gx = 0.5F * (right - left);
    const float gy = 0.5F * (below - above);
    const float xx = right + left - 2.0F * centre;
    const float yy = below + above - 2.0F * centre;
    const float xy = 0.25F * (at(1, 1) - at(-1, 1) - at(1, -1) + at(-1, -1));
    const float determinant = xx * yy - xy * xy;
    if (!(determinant > 0.0F) || xx >= 0.0F) return;
    const Vec2 offset((xy * gy - yy * gx) / determinant, (xy * gx - xx * gy) / determinant);
    if (offset.cwiseAbs().maxCoeff() > kMaxRefinement) return;
    pixel = Vec2(x, y) + distance * offset;
    if (std::abs(pixel.x() - x) <= 0.5 && std::abs(pixel.y() - y) <= 0.5) return;
  }
}

// Lowe 2004, section 4.1: the ratio of the eigenvalues of H from its trace and determinant.
bool is_elongated(const BoxDerivatives& derivatives, float max_elongation) {
  const float trace = derivatives.xx + derivatives.yy;
  const float sum = max_elongation + 1.0F;
  return trace * trace * max_elongation > sum * sum * derivatives.response();
}

void add_maximum(ImageView<const std::uint32_t> integral, const SurfParams& params,
                 const SurfWorkspace& workspace, Octave octave, int layer, int row, int column,
                 StrongestKeypoints& strongest) {
  const Neighbourhood values = neighbourhood_of(workspace, layer, row, column);
  Eigen::Vector3f offset;
  if (!is_maximum(values) || !interpolate_maximum(values, offset)) return;
  const BoxFilter filter = filter_of(octave.index, layer);
  const BoxDerivatives derivatives =
      derivatives_at(integral, filter, column * octave.step, row * octave.step);
  if (is_elongated(derivatives, params.max_elongation)) return;
  const auto step = static_cast<float>(octave.step);
  Keypoint keypoint;
  keypoint.pixel = {(static_cast<float>(column) + offset.x()) * step,
                    (static_cast<float>(row) + offset.y()) * step};
  // Filter sizes grow linearly with the layer, and sigma with the filter.
  keypoint.scale_px =
      kSigmaPerFilterPixel *
      (static_cast<float>(filter.size()) + offset.z() * static_cast<float>(filter_increment(octave.index)));
  keypoint.response = values[1][1][1];
  keypoint.laplacian = derivatives.laplacian();
  strongest.add(keypoint);
}

// What comparing lanes gives.
using Flags [[gnu::vector_size(16)]] = std::int32_t;

// Three rows of one layer around the samples that are looked at.
struct ResponseRows {
  const float* above = nullptr;
  const float* centre = nullptr;
  const float* below = nullptr;

  // Large enough, and no smaller than the four neighbours in the layer: the rest of the neighbourhood is
  // looked at for those few only.
  bool is_peak(int column, float min_response) const {
    const float response = centre[column];
    return response >= min_response && response > centre[column - 1] && response >= centre[column + 1] &&
           response > above[column] && response >= below[column];
  }
  // Whether any of kFloatLanes samples is.
  bool has_peak(int column, float min_response) const {
    const FloatLanes response = load_floats(centre + column);
    const Flags found = (response >= min_response) & (response > load_floats(centre + column - 1)) &
                        (response >= load_floats(centre + column + 1)) &
                        (response > load_floats(above + column)) & (response >= load_floats(below + column));
    return (found[0] | found[1] | found[2] | found[3]) != 0;
  }
};

// Maxima of one row, whose neighbours are all computed. The top layer's filter must fit around all of them.
void find_maxima(ImageView<const std::uint32_t> integral, const SurfParams& params,
                 const SurfWorkspace& workspace, Octave octave, int row, StrongestKeypoints& strongest) {
  const int width = integral.width - 1;
  const int height = integral.height - 1;
  for (int layer = 1; layer + 1 < kLayersPerOctave; ++layer) {
    const int margin = filter_of(octave.index, layer + 1).radius() + octave.step;
    const int y = row * octave.step;
    if (y < margin || y + margin >= height || width <= 2 * margin) continue;
    const int last = (width - 1 - margin) / octave.step;
    const auto& ring = workspace.responses[static_cast<std::size_t>(layer)];
    const auto slot = [&](int r) { return ring[static_cast<std::size_t>(r % 3)].data(); };
    const ResponseRows rows{slot(row - 1), slot(row), slot(row + 1)};
    for (int begin = (margin + octave.step - 1) / octave.step; begin <= last; begin += kFloatLanes) {
      const int end = std::min(begin + kFloatLanes, last + 1);
      if (end - begin == kFloatLanes && !rows.has_peak(begin, params.min_response)) continue;
      for (int column = begin; column < end; ++column) {
        if (!rows.is_peak(column, params.min_response)) continue;
        add_maximum(integral, params, workspace, octave, layer, row, column, strongest);
      }
    }
  }
}

}  // namespace

Status validate(const SurfParams& params) {
  const bool valid = params.octaves >= 1 && params.octaves <= kMaxOctaves && params.first_step_px >= 1 &&
                     params.first_step_px <= 4 && params.min_response > 0.0F &&
                     std::isfinite(params.min_response) && params.max_elongation >= 1.0F;
  return valid ? StatusCode::ok : StatusCode::invalid_configuration;
}

void detect_surf(ImageView<const std::uint32_t> integral, const SurfParams& params, SurfWorkspace& workspace,
                 BoundedList<Keypoint>& keypoints) {
  StrongestKeypoints strongest(keypoints);
  const int height = integral.height - 1;
  for (int index = 0; index < params.octaves; ++index) {
    const Octave octave{index, params.first_step_px << index};
    for (int row = 0; row * octave.step < height; ++row) {
      for (int layer = 0; layer < kLayersPerOctave; ++layer) {
        const std::span<float> responses =
            workspace.responses[static_cast<std::size_t>(layer)][static_cast<std::size_t>(row % 3)];
        compute_response_row(integral, filter_of(index, layer), row * octave.step, octave.step, workspace,
                             responses);
      }
      if (row >= 2) find_maxima(integral, params, workspace, octave, row - 1, strongest);
    }
  }
  strongest.sort();
  for (Keypoint& keypoint : keypoints) refine_position(integral, keypoint);
}

}  // namespace traygauge::paper
