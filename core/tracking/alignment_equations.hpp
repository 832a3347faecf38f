// The least-squares problem of aligning a patch: a template with its gradients, the normal matrix, which
// stays while the patch only shifts, and the residuals against a window of the second picture.
#pragma once

#include <cstdint>

#include "core/geometry/geometry.hpp"
#include "core/geometry/levenberg_marquardt.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

inline constexpr int kAlignmentSide = 20;  // of the patch, in pixels of the second picture
inline constexpr int kAlignmentPixels = kAlignmentSide * kAlignmentSide;
inline constexpr double kAlignmentReach = 0.5 * (kAlignmentSide - 1);  // from its centre to its first pixel

enum class PatchMotion : std::uint8_t {
  shift,   // the affine map is known: a plane in known attitude
  affine,  // it is refined as well
};

// Parameters: second(u) = first(u + shift + matrix · u) · (1 + gain) + offset.
inline constexpr int kShiftX = 0;
inline constexpr int kShiftY = kShiftX + 1;
inline constexpr int kXByX = kShiftY + 1;
inline constexpr int kXByY = kXByX + 1;
inline constexpr int kYByX = kXByY + 1;
inline constexpr int kYByY = kYByX + 1;
inline constexpr int kGain = kYByY + 1;
inline constexpr int kOffset = kGain + 1;
inline constexpr int kAlignmentColumns = kOffset + 1;
using AlignmentEquations = NormalEquations<kAlignmentColumns>;
using ShiftEquations = NormalEquations<4>;  // shift, gain, offset
inline constexpr int kGainOfShift = kXByX;  // in the place of the matrix

// The same equations with the matrix held.
ShiftEquations without_matrix(const AlignmentEquations& equations);

// The first view's patch on the grid of the second.
struct AlignmentTemplate {
  alignas(16) float values[kAlignmentPixels];
  alignas(16) float weighted_dx[kAlignmentPixels];  // gradients times the window's weights
  alignas(16) float weighted_dy[kAlignmentPixels];
  AlignmentEquations equations;   // only the columns that the motion needs
  double weighted_squares = 0.0;  // Σ w v²
};

// False when the patch leaves the picture. `map` is first_from_second.
bool make_template(ImageView<const std::uint8_t> first, const Vec2& pixel, const Eigen::Matrix2d& map,
                   PatchMotion motion, AlignmentTemplate& patch);

struct AlignmentResiduals {
  double squares = 0.0;       // Σ w r²
  double seen = 0.0;          // Σ w s, s the second view's values
  double seen_squares = 0.0;  // Σ w s²
};

// r = second − first. The gradient becomes such that solve() yields the step that fits r.
AlignmentResiduals gather_residuals(const float* window, PatchMotion motion, AlignmentTemplate& patch);

}  // namespace traygauge
