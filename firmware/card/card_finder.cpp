#include "firmware/card/card_finder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/image/resample.hpp"

namespace traygauge {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

}  // namespace

template <class Allocator>
void CardFinder::Memory::allocate(Allocator& arena, int width, int height, const CardLocationParams& params) {
  card.allocate(arena, width, height, params);
  gray = arena.template take_image<std::uint8_t>(width, height);
  labels = arena.template take_image<std::uint8_t>(width, height);
}

std::size_t CardFinder::bytes_for(int width, int height) {
  ArenaPlan plan;
  Memory memory;
  memory.allocate(plan, width, height, {});
  return plan.high_water_bytes();
}

CardFinder::CardFinder(int max_frame_width, int max_frame_height)
    : block_(bytes_for(max_frame_width, max_frame_height)) {
  Arena arena(block_.bytes());
  memory_.allocate(arena, max_frame_width, max_frame_height, params_);
}

Status CardFinder::learn(const ReferenceCard& card) {
  return learn_card(card.pattern, {card.width_mm, card.height_mm, card.thickness_mm}, params_, memory_.card);
}

Status CardFinder::find(const FrameView& frame, const LensModel& lens, CardAlignment& card) {
  if (frame.width != lens.width || frame.height != lens.height || frame.width > memory_.gray.width ||
      frame.height > memory_.gray.height) {
    return StatusCode::frame_size_mismatch;
  }
  const ImageView<std::uint8_t> gray{memory_.gray.data, frame.width, frame.height};
  const ImageView<std::uint8_t> labels{memory_.labels.data, frame.width, frame.height};
  convert_to_gray(frame, gray);
  return locate_card(gray, labels, lens, params_, memory_.card, card);
}

double angle_of_sight_deg(const Pose& first, const Pose& second, const Vec3& point_mm) {
  const Vec3 to_first = (camera_centre_mm(first) - point_mm).normalized();
  const Vec3 to_second = (camera_centre_mm(second) - point_mm).normalized();
  return kDegrees * std::acos(std::clamp(to_first.dot(to_second), -1.0, 1.0));
}

double turn_deg(const Mat3& rotation) {
  return kDegrees * std::abs(Eigen::AngleAxisd(rotation).angle());
}

}  // namespace traygauge
