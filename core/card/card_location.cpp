#include "core/card/card_location.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

#include "core/card/card_hypotheses.hpp"
#include "core/card/print_plane.hpp"
#include "core/labels/convex_fill.hpp"
#include "core/labels/label_regions.hpp"

namespace traygauge {
namespace {

// Four straight sides through the lens.
CardPolygon outline_of(const std::array<Vec2, 4>& corners, const LensModel& lens) {
  CardPolygon outline;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::size_t side = i / kCardSideCorners;
    const double t = static_cast<double>(i % kCardSideCorners) / kCardSideCorners;
    outline[i] = lens.pixel((1.0 - t) * corners[side] + t * corners[(side + 1) % 4]);
  }
  return outline;
}

std::array<Vec2, 4> corners_of(const Pose& camera_from_table, const CardModelSize& size) {
  std::array<Vec2, 4> corners = print_corners_mm(size);
  for (Vec2& corner : corners)
    corner = (camera_from_table * print_point_mm(corner, size.thickness_mm)).hnormalized();
  return corners;
}

void draw_card(std::span<const Vec2> outline_px, ImageView<std::uint8_t> labels) {
  for (int y = 0; y < labels.height; ++y) std::fill_n(labels.row(y), labels.width, kBackgroundLabel);
  fill_convex(labels, outline_px, kCardLabel);
}

}  // namespace

Status learn_card(ImageView<const std::uint8_t> picture, const CardModelSize& size,
                  const CardLocationParams& params, CardLocationWorkspace& workspace) {
  const Status status = prepare_card_pattern(picture, size, params.alignment.pattern, workspace.pattern);
  if (!status.ok()) return status;
  return learn_print_corners(workspace.pattern, params.search, workspace.search, workspace.print);
}

// The search gives the outline to a pixel or two. One that is off by more may end in a print half aligned,
// which a second start mends.
Status locate_card(ImageView<const std::uint8_t> gray, ImageView<std::uint8_t> labels, const LensModel& lens,
                   const CardLocator& locator, CardAlignment& alignment, CardPolygon& outline_px) {
  alignment = {};
  const Result<std::array<Vec2, 4>> corners =
      search_card(gray, lens, locator.pattern.size, locator.print, locator.search, locator.detection,
                  locator.search_space);
  if (!corners.ok()) return corners.status();
  outline_px = outline_of(*corners, lens);
  for (int round = 0; round < locator.rounds.max_alignments; ++round) {
    draw_card(outline_px, labels);
    const Result<CardAlignment> aligned =
        align_card(gray, labels, measure_regions(labels).card, lens, locator.pattern, locator.alignment,
                   locator.alignment_space);
    if (!aligned.ok() && round == 0) return aligned.status();
    if (!aligned.ok() || aligned->correlation <= alignment.correlation) break;
    alignment = *aligned;
    outline_px = outline_of(corners_of(aligned->camera_from_table, locator.pattern.size), lens);
    if (aligned->correlation >= locator.rounds.sure_correlation) break;
  }
  draw_card(outline_px, labels);
  return StatusCode::ok;
}

Result<CardAlignment> locate_card(ImageView<const std::uint8_t> gray, ImageView<std::uint8_t> labels,
                                  const LensModel& lens, const CardLocationParams& params,
                                  CardLocationWorkspace& workspace) {
  CardParams detection;
  detection.detection = params.detection;
  CardAlignment alignment;
  CardPolygon outline_px;
  const Status located = locate_card(gray, labels, lens,
                                     {workspace.pattern, workspace.print, params.search, detection,
                                      params.alignment, params.rounds, workspace.search, workspace.alignment},
                                     alignment, outline_px);
  if (!located.ok()) return located;
  return alignment;
}

}  // namespace traygauge
