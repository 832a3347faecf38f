// The poses that an outline of four sides, or three, allows for the card.
#pragma once

#include <array>
#include <span>

#include "core/base/bounded_list.hpp"
#include "core/card/card.hpp"
#include "core/card/card_outline.hpp"
#include "core/geometry/geometry.hpp"

namespace traygauge {

inline constexpr std::size_t kPosesPerOutline = 8;  // four ways to lay the print, two poses each

// The print's corners in its own mm, clockwise from the origin.
std::array<Vec2, 4> print_corners_mm(const CardModelSize& size);

// camera_from_table for each way to lay the print on the outline, with its mirror pose (Schweighofer & Pinz
// 2006).
void list_poses(const CardOutline& outline, const CardModelSize& size, BoundedList<Pose>& poses);

// The outline whose side `hidden` is replaced by where it must lie if the other three are the card's: the two
// beside it meet in the vanishing point of their direction, the third is perpendicular to that and
// `opposite_mm` long, the two `beside_mm`. False when that is no view of a card.
bool complete_outline(const CardOutline& outline, std::size_t hidden, double opposite_mm, double beside_mm,
                      CardOutline& completed);

}  // namespace traygauge
