// Corners of the first view found in the second, guided by both camera poses from the card: a corner's ray
// meets the heights over the table in a segment of the second view.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/base/bounded_list.hpp"
#include "core/base/random.hpp"
#include "core/base/status.hpp"
#include "core/features/corners.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/table_frame.hpp"
#include "core/image/gray_pyramid.hpp"
#include "core/tracking/patch_alignment.hpp"
#include "core/tracking/patch_search.hpp"
#include "core/tracking/point_track.hpp"
#include "core/tracking/pose_correction.hpp"

namespace traygauge {

inline constexpr std::size_t kFirstLookCells = 10;  // across the picture, of the first look

// Half or twice of any number here moves the MAPE of six pairs of the captures by 0.12 points at most
// (tests/evaluation/numbers.tsv), but for correlations: twice of one is none, and refuses or takes all.
struct PointTrackingParams {
  CornerParams corners;
  PatchAlignmentParams alignment;
  PoseCorrectionParams correction;
  // Corners looked for at most: time grows with them, errors fall with their root.
  int max_corners = 1200;

  // Heights over the table that are searched. Below it lie a tray's foot and the error of a card's pose. What
  // stands higher is told by its outlines (height_by_outlines_mm).
  double min_height_mm = -5.0;
  double max_height_mm = 110.0;
  // One warp serves so much height: at 400 mm the patch grows by 5% over it.
  double band_height_mm = 20.0;

  // First look, at quarter size: a few strong corners, wherever the card's error may have put them. The
  // picture is divided into kFirstLookCells across, and the strongest corner of each ground in each is used.
  // Pixels of the stored picture around the predicted segment: 0.5° and 3 mm at 1400 px and 450 mm.
  double first_look_margin_px = 24.0;

  // Second look, at half size: all corners, near where the corrected pose has them. Pixels of the stored
  // picture around the segment, or around the point where the height is known.
  double margin_px = 5.0;
  double table_margin_px = 6.0;
  // Least correlation: in the first look, where the height is known, and of the finished track; and of a
  // corner that is not found at the height of its ground and is looked for at all heights.
  double min_correlation = 0.8;
  double min_height_correlation = 0.7;
  // Lead of the best correlation over any other peak: below, repeated texture is taken for itself.
  double min_lead = 0.05;

  double max_sigma_px = 0.25;  // standard deviation of the finished track, as aligned
  // How far from its start it may end when followed back; better tracks than the second always return.
  double max_return_px = 0.3;
  double sure_sigma_px = 0.1;
  // Distance from the epipolar line of the pose that most tracks agree on: never more than the first, nor
  // than the error of that pose and so many standard deviations.
  double max_epipolar_px = 1.0;
  double pose_error_px = 0.1;
  double max_deviations = 4.0;

  // False: what stands on the table moved over it, and the table's own corners tell of another motion.
  bool follows_table = true;

  // An item of which hardly a corner is found may have moved by itself: so many of its corners are looked for
  // at quarter size, 15 mm off at 3 px a mm. Tried on slips-10 of seed 71, where items that stood still lost
  // up to all of their corners, too: what is found then does not agree.
  int min_item_corners = 8;
  int max_lost_corners = 16;
  double min_followed_fraction = 0.25;
  double lost_margin_px = 45.0;
};

// Where the corners went.
struct PointTrackingReport {
  std::size_t corners = 0;       // looked for
  std::size_t first_look = 0;    // found in the first look
  std::size_t not_found = 0;     // nothing alike there, or the patch leaves a picture
  std::size_t ambiguous = 0;     // another place looks as much alike
  std::size_t not_aligned = 0;   // drifted, or too weak or dissimilar to be placed well
  std::size_t not_returned = 0;  // followed back, it ends elsewhere
  std::size_t off_line = 0;      // contradicts the motion that the others agree on
  std::size_t tracks = 0;
  // Tracks that contradict it, wrong ones or of items that moved by themselves; in the workspace's memory.
  std::span<const PointTrack> strays;
  TableCameras camera_from_table;  // as given, the second one corrected by the tracks
};

// One view as the tracker sees it.
struct TrackedView {
  GrayPyramid gray;
  ImageView<const std::uint8_t> labels;  // of the stored picture; empty: everything is table
  LensModel lens;
};

struct PointTrackingWorkspace {
  CornerWorkspace corners;
  PatchSearchWorkspace search;
  std::span<std::uint8_t> hidden_cells;
  std::span<Corner> corner_storage;
  std::span<SeenPoint> seen_storage;
  std::span<PointTrack> track_storage;

  // The largest stored picture.
  template <class Allocator>
  constexpr void allocate(Allocator& arena, int max_width, int max_height,
                          const PointTrackingParams& params) {
    corners.allocate(arena, halved(max_width), halved(max_height), params.corners);
    hidden_cells = arena.template take<std::uint8_t>(
        CornerGrid(halved(max_width), halved(max_height), params.corners).cells());
    search.allocate(arena);
    const auto count = static_cast<std::size_t>(params.max_corners);
    corner_storage = arena.template take<Corner>(count);
    seen_storage = arena.template take<SeenPoint>(count);
    track_storage = arena.template take<PointTrack>(count);
  }
};

// Tracks from `first` to `second`, in the workspace's memory; `camera_from_table` may be wrong by about half
// a degree and 3 mm. too_few_features: hardly a corner; too_few_matches: fewer than kMinTracks.
Status track_points(const TrackedView& first, const TrackedView& second,
                    const TableCameras& camera_from_table, double card_thickness_mm,
                    const PointTrackingParams& params, Random& random, PointTrackingWorkspace& workspace,
                    std::span<const PointTrack>& tracks, PointTrackingReport& report);

}  // namespace traygauge
