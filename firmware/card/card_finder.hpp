// Where the camera stands, from a picture that shows the reference card.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "core/card/card_location.hpp"
#include "core/geometry/table_frame.hpp"
#include "core/pipeline/configuration.hpp"
#include "firmware/base/aligned_block.hpp"

namespace traygauge {

class CardFinder {
 public:
  // Takes its memory, for pictures of this size at most.
  CardFinder(int max_frame_width, int max_frame_height);
  // Works in `lent`, of required_bytes() at least.
  CardFinder(std::span<std::byte> lent, int max_frame_width, int max_frame_height);
  static std::size_t required_bytes(int max_frame_width, int max_frame_height);

  // Before find(); the pattern is copied. invalid_configuration when it shows too little to be recognised.
  Status learn(const ReferenceCard& card);
  // frame_size_mismatch with the lens or the memory; card_not_found.
  Status find(const FrameView& frame, const LensModel& lens, CardAlignment& card);

  // Where the last card that was found lies in its picture: kCardLabel, on background. Until the next find().
  ImageView<const std::uint8_t> outline() const { return outline_; }

  // Of the print, in the table's frame.
  Vec3 card_centre_mm() const {
    const CardModelSize& size = memory_.card.pattern.size;
    return print_point_mm({0.5 * size.width_mm, 0.5 * size.height_mm}, size.thickness_mm);
  }

 private:
  struct Memory {
    CardLocationWorkspace card;
    ImageView<std::uint8_t> gray;
    ImageView<std::uint8_t> labels;

    template <class Allocator>
    void allocate(Allocator& arena, int width, int height, const CardLocationParams& params);
  };
  CardLocationParams params_;
  Memory memory_;
  ImageView<const std::uint8_t> outline_;
  std::optional<AlignedBlock> block_;  // where nothing is lent
};

}  // namespace traygauge
