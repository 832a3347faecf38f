#include "core/tracking/point_tracking.hpp"

#include <algorithm>
#include <array>

#include "core/labels/label_regions.hpp"
#include "core/tracking/point_tracker.hpp"

namespace traygauge {
namespace {

void leave_out_table(BoundedList<Corner>& corners) {
  const auto is_table = [](const Corner& corner) {
    const Ground ground = ground_of(corner.label);
    return ground == Ground::table || ground == Ground::card;
  };
  corners.truncate(
      static_cast<std::size_t>(std::remove_if(corners.begin(), corners.end(), is_table) - corners.begin()));
}

// Corners of items of which hardly one was found.
void find_lost(std::span<const Corner> corners, const PointTrackingParams& params, PointTracker& tracker,
               BoundedList<PointTrack>& tracks) {
  std::array<int, 256> sought{};
  std::array<int, 256> followed{};
  std::array<int, 256> looked_for{};
  for (const Corner& corner : corners) ++sought[corner.label];
  for (const PointTrack& track : tracks) ++followed[track.label];
  for (const Corner& corner : corners) {
    const std::uint8_t label = corner.label;
    if (!is_item(label) || sought[label] < params.min_item_corners ||
        followed[label] > params.min_followed_fraction * sought[label] ||
        looked_for[label]++ >= params.max_lost_corners)
      continue;
    PointTrack track;
    if (tracker.track_lost(corner, track)) tracks.push_back(track);
  }
}

bool is_usable(const TrackedView& view) {
  const ImageView<const std::uint8_t>& gray = view.gray.levels[0];
  if (gray.empty() || gray.width != view.lens.width || gray.height != view.lens.height) return false;
  return view.labels.empty() || (view.labels.width == gray.width && view.labels.height == gray.height);
}

}  // namespace

Status track_points(const TrackedView& first, const TrackedView& second,
                    const TableCameras& camera_from_table, double card_thickness_mm,
                    const PointTrackingParams& params, Random& random, PointTrackingWorkspace& workspace,
                    std::span<const PointTrack>& tracks, PointTrackingReport& report) {
  report = {};
  report.camera_from_table = camera_from_table;
  tracks = {};
  if (!is_usable(first) || !is_usable(second)) return StatusCode::frame_size_mismatch;
  PointTracker tracker(first, second, camera_from_table, card_thickness_mm, params, workspace, report);
  BoundedList<Corner> corners(workspace.corner_storage);
  find_corners(
      {first.gray.levels[kCornerLevel], first.labels, 1 << kCornerLevel, tracker.find_occluded_cells()},
      params.corners, random, workspace.corners, corners);
  if (!params.follows_table) leave_out_table(corners);
  report.corners = corners.size();
  if (corners.size() < std::size_t{kMinTracks}) return StatusCode::too_few_features;

  tracker.look_first(corners.items());
  BoundedList<PointTrack> found(workspace.track_storage);
  for (const Corner& corner : corners) {
    PointTrack track;
    if (tracker.track(corner, track)) found.push_back(track);
  }
  tracker.drop_contradicting(found);
  find_lost(corners.items(), params, tracker, found);
  report.camera_from_table = tracker.cameras();
  tracks = found.items().first(report.tracks);
  report.strays = found.items().subspan(report.tracks);
  return report.tracks < std::size_t{kMinTracks} ? StatusCode::too_few_matches : StatusCode::ok;
}

}  // namespace traygauge
