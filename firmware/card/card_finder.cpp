#include "firmware/card/card_finder.hpp"

#include "core/image/resample.hpp"

namespace traygauge {

template <class Allocator>
void CardFinder::Memory::allocate(Allocator& arena, int width, int height, const CardLocationParams& params) {
  card.allocate(arena, width, height, params);
  gray = arena.template take_image<std::uint8_t>(width, height);
  labels = arena.template take_image<std::uint8_t>(width, height);
}

std::size_t CardFinder::required_bytes(int max_frame_width, int max_frame_height) {
  ArenaPlan plan;
  Memory memory;
  memory.allocate(plan, max_frame_width, max_frame_height, {});
  return plan.high_water_bytes();
}

CardFinder::CardFinder(int max_frame_width, int max_frame_height)
    : block_(required_bytes(max_frame_width, max_frame_height)) {
  Arena arena(block_->bytes());
  memory_.allocate(arena, max_frame_width, max_frame_height, params_);
}

CardFinder::CardFinder(std::span<std::byte> lent, int max_frame_width, int max_frame_height) {
  Arena arena(lent);
  memory_.allocate(arena, max_frame_width, max_frame_height, params_);
}

Status CardFinder::learn(const ReferenceCard& card) {
  return learn_card(card.pattern, card.size(), params_, memory_.card);
}

Status CardFinder::find(const FrameView& frame, const LensModel& lens, CardAlignment& card) {
  if (frame.width != lens.width || frame.height != lens.height || frame.width > memory_.gray.width ||
      frame.height > memory_.gray.height) {
    return StatusCode::frame_size_mismatch;
  }
  const ImageView<std::uint8_t> gray{memory_.gray.data, frame.width, frame.height};
  const ImageView<std::uint8_t> labels{memory_.labels.data, frame.width, frame.height};
  convert_to_gray(frame, gray);
  const Result<CardAlignment> found = locate_card(gray, labels, lens, params_, memory_.card);
  if (found.ok()) card = *found;
  outline_ = labels;
  return found.status();
}

}  // namespace traygauge
