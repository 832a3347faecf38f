#include "core/scale/card_location.hpp"

#include <algorithm>
#include <cstddef>

#include "core/scale/card_hypotheses.hpp"
#include "core/scale/print_plane.hpp"
#include "core/segmentation/convex_fill.hpp"
#include "core/segmentation/label_regions.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kSideCorners = 8;  // on each side, which a lens bends

void draw_card(const std::array<Vec2, 4>& corners, const LensModel& lens, ImageView<std::uint8_t> labels) {
  for (int y = 0; y < labels.height; ++y) std::fill_n(labels.row(y), labels.width, kBackgroundLabel);
  std::array<Vec2, 4 * kSideCorners> outline;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::size_t side = i / kSideCorners;
    const double t = static_cast<double>(i % kSideCorners) / kSideCorners;
    outline[i] = lens.pinhole.pixel(lens.distort((1.0 - t) * corners[side] + t * corners[(side + 1) % 4]));
  }
  fill_convex(labels, outline, kCardLabel);
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
                   const CardLocationParams& params, CardLocationWorkspace& workspace,
                   CardAlignment& alignment) {
  alignment = {};
  const CardModelSize& size = workspace.pattern.size;
  CardParams card;
  card.detection = params.detection;
  std::array<Vec2, 4> corners;
  const Status found =
      search_card(gray, lens, size, workspace.print, params.search, card, workspace.search, corners);
  if (!found.ok()) return found;
  for (int round = 0; round < params.max_alignments; ++round) {
    draw_card(corners, lens, labels);
    CardAlignment aligned;
    const Status reached = align_card(gray, labels, measure_regions(labels).card, lens, workspace.pattern,
                                      params.alignment, workspace.alignment, aligned);
    if (!reached.ok() && round == 0) return reached;
    if (!reached.ok() || aligned.correlation <= alignment.correlation) break;
    alignment = aligned;
    corners = print_corners_mm(size);
    for (Vec2& corner : corners)
      corner = (aligned.camera_from_table * print_point_mm(corner, size.thickness_mm)).hnormalized();
    if (aligned.correlation >= params.sure_correlation) break;
  }
  draw_card(corners, lens, labels);
  return StatusCode::ok;
}

}  // namespace traygauge
