// The card in a picture without labels: corners of the picture that look like corners of the print, whatever
// their turn and scale, and a homography that explains them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/arena.hpp"
#include "core/base/bounded_list.hpp"
#include "core/base/result.hpp"
#include "core/base/status.hpp"
#include "core/card/card.hpp"
#include "core/card/card_pattern.hpp"
#include "core/features/binary_descriptor.hpp"
#include "core/features/corners.hpp"
#include "core/features/descriptor_block.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/geometry.hpp"
#include "core/image_view/image_view.hpp"

namespace traygauge {

inline constexpr std::size_t kCardSearchScales = 6;  // a factor of 4 in steps of a third

// Chosen on the captures' cards. Half or twice of a number here refuses cards or leaves the MAPE of six pairs
// of the captures with found outlines within 0.11 points (tests/evaluation/numbers.tsv), but for the glossy
// egg of m06, which turns over after most changes: +2 points.
struct CardSearchParams {
  // Of the picture searched, one after the other until the card is found: 1600 × 1200 at half size, where
  // most cards have 80 px and more, and at 0.68. Smaller pictures are enlarged: the corners' patches cover
  // less of the print then, and less of what lies about it.
  std::array<int, 2> search_px{480'000, 900'000};
  double max_enlargement = 2.0;  // of a side; 3 also finds cards in poses that are wrong (labels.md)
  // Of the print as it is learned, px/mm in the picture searched; descriptors bear 15% more or less.
  std::array<double, kCardSearchScales> scales_px_per_mm{0.6, 0.8, 1.05, 1.4, 1.85, 2.45};
  int max_pattern_corners = 160;  // at each scale
  int max_corners = 6000;         // of the picture
  int first_corners = 300;        // the strongest, with which most prints are found; else with thrice as many
  CornerParams corners{16, 4, 4, 4.0F, 0.02F, 0, 255};
  // Of 256 bits. The same corner, seen at a slant and between two scales, differs by 20 to 60.
  int max_distance = 68;
  int max_half_distance = 46;        // of the first 128 bits, for the others to be compared at all
  double max_distance_ratio = 0.96;  // over the distance to the next best, elsewhere on the print
  double same_place_mm = 3.0;        // corners of two scales that are nearer are one
  // How far a corner may lie from where another one's turn and scale put it, and of their distance: a tilt of
  // 35 degrees shortens by a fifth.
  double near_px = 2.0;
  double reach_fraction = 0.22;
  double min_turn_cosine = 0.8;  // between the turns of two corners of one card
  double max_scale_ratio = 1.4;  // … their scales
  int max_seeds = 120;           // of the clearest matches, each of which may say where the card lies
  int max_tried = 4;             // places that are looked at in full, those that most speaks for first
  // A place whose corners do not suffice, but for a homography, is looked at again: in a finer picture of its
  // own, where there is one, and with all corners about it, since a print that is small, blurred and noisy
  // has few that resemble one place alone.
  double close_px_per_mm = 2.0;  // about, of the print in that picture: as fine as it is learned
  int close_px = 250'000;        // of that picture, at most

  // By which a side is multiplied so that the picture has `pixels`.
  double scale_to(int pixels, int width, int height) const {
    return std::min(max_enlargement, std::sqrt(pixels / (static_cast<double>(width) * height)));
  }
};

// A corner of the picture and the print's that looks like it.
struct CardSearchMatch {
  Vec2 pixel = Vec2::Zero();  // of the picture searched
  Vec2 turn = Vec2::UnitX();  // that leads from the print's direction to the picture's
  double px_per_mm = 0.0;
  Vec2 pattern_mm = Vec2::Zero();
  double clarity = 0.0;  // 0: as near to another place of the print
};

struct PrintCorner {
  BinaryDescriptor descriptor{};
  Vec2 direction = Vec2::UnitX();
  Vec2 pattern_mm = Vec2::Zero();
  double px_per_mm = 0.0;
};

// What the print looks like; made once.
struct PrintCorners {
  std::span<BinarySampling> sampling;  // one
  BoundedList<PrintCorner> corners;
  std::span<DescriptorBlock> blocks;  // of their descriptors, in order

  template <class Allocator>
  constexpr void allocate(Allocator& arena, const CardSearchParams& params) {
    sampling = arena.template take<BinarySampling>(1);
    const std::size_t count = kCardSearchScales * static_cast<std::size_t>(params.max_pattern_corners);
    corners = BoundedList<PrintCorner>(arena.template take<PrintCorner>(count));
    blocks =
        arena.template take<DescriptorBlock>((count + DescriptorBlock::kSide - 1) / DescriptorBlock::kSide);
  }
};

// The corners of a picture, and those of the print that they look like.
struct ComparedCorners {
  std::span<std::uint8_t> picture_storage;
  std::span<std::uint8_t> smooth_storage;
  ImageView<std::uint8_t> smooth;
  BoundedList<Corner> corners;
  BoundedList<CardSearchMatch> matches;

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_px, int max_corners) {
    picture_storage = arena.template take<std::uint8_t>(static_cast<std::size_t>(max_px));
    smooth_storage = arena.template take<std::uint8_t>(static_cast<std::size_t>(max_px));
    const auto count = static_cast<std::size_t>(max_corners);
    corners = BoundedList<Corner>(arena.template take<Corner>(count));
    matches = BoundedList<CardSearchMatch>(arena.template take<CardSearchMatch>(count));
  }
};

struct CardSearchWorkspace {
  ComparedCorners whole;  // of the picture, and of the print as it is learned
  ComparedCorners close;  // of a part of it
  CornerWorkspace corner_search;
  std::span<CardTrack> tracks;
  CardWorkspace card;
  // Of the picture searched, and of the print as it is learned.
  int max_width = 0;
  int max_height = 0;

  // `wanted_scale`, or less where a picture of this size would not fit.
  double fit(int width, int height, double wanted_scale) const {
    return std::min(
        {wanted_scale, static_cast<double>(max_width) / width, static_cast<double>(max_height) / height});
  }

  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_frame_width, int max_frame_height,
                          const CardSearchParams& params) {
    const int pixels = std::max(params.search_px[0], params.search_px[1]);
    whole.allocate(arena, pixels, params.max_corners);
    close.allocate(arena, params.close_px, params.max_corners);
    const double scale = params.scale_to(pixels, max_frame_width, max_frame_height);
    max_width = static_cast<int>(scale * max_frame_width) + 1;
    max_height = static_cast<int>(scale * max_frame_height) + 1;
    corner_search.allocate(arena, max_width, max_height, params.corners);
    tracks = arena.template take<CardTrack>(static_cast<std::size_t>(params.max_corners));
    card.allocate(arena, params.max_corners);
  }
};

// Uses the workspace as scratch. invalid_configuration when the print shows no corners.
Status learn_print_corners(const CardPattern& pattern, const CardSearchParams& params,
                           CardSearchWorkspace& workspace, PrintCorners& print);

// The card's corners (rays), clockwise in the picture from the print's top left one. card_not_found where no
// homography of the print is beyond chance.
Result<std::array<Vec2, 4>> search_card(ImageView<const std::uint8_t> gray, const LensModel& lens,
                                        const CardModelSize& size, const PrintCorners& print,
                                        const CardSearchParams& params, const CardParams& card,
                                        CardSearchWorkspace& workspace);

}  // namespace traygauge
