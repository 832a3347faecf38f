// Follows corners of the first view into the second: where they are sought, and when one counts as found.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/tracking/height_transfer.hpp"
#include "core/tracking/point_tracking.hpp"

namespace traygauge {

inline constexpr std::size_t kCornerLevel = 1;  // half size: as many good corners, a quarter of the time

class PointTracker {
 public:
  PointTracker(const TrackedView& first, const TrackedView& second, const TableCameras& cameras,
               double card_thickness_mm, const PointTrackingParams& params, PointTrackingWorkspace& workspace,
               PointTrackingReport& report)
      : first_(first),
        second_(second),
        params_(params),
        workspace_(workspace),
        report_(report),
        card_mm_(card_thickness_mm),
        cameras_(cameras),
        transfer_(first.lens, second.lens, cameras) {}

  // Cells of the first view that the second does not see.
  std::span<const std::uint8_t> find_occluded_cells();
  // Corrects the second pose from the strongest corners.
  void look_first(std::span<const Corner> corners);
  // False where the corner is not found, or not well enough to be sure; the report counts why.
  bool track(const Corner& corner, PointTrack& track);
  // The same, sought far off its line.
  bool track_lost(const Corner& corner, PointTrack& track);
  // Moves those to the end of the list that lie off the motion on which the others agree.
  void drop_contradicting(BoundedList<PointTrack>& tracks);
  const TableCameras& cameras() const { return cameras_; }

 private:
  struct HeightRange {
    double low_mm = 0.0;
    double high_mm = 0.0;
  };
  // Where to look for a corner, and how.
  struct Look {
    std::size_t level = 0;
    double margin_px = 0.0;  // of the stored picture
  };
  using FirstLooks = std::array<const Corner*, kGrounds * kFirstLookCells * kFirstLookCells>;

  double focal_px() const { return second_.lens.pinhole.mean_focal_px(); }
  HeightRange all_heights() const { return {params_.min_height_mm, params_.max_height_mm}; }
  // The height of table or card; false on other ground.
  bool known_height(std::uint8_t label, double& height_mm) const;
  bool search(const Vec2& pixel, const TableRay& ray, const HeightRange& range, const Look& look,
              FoundPatch& found);
  bool look_closer(const Vec2& pixel, const TableRay& ray, std::uint8_t label, FoundPatch& found);
  bool finish(const Corner& corner, const TableRay& ray, const FoundPatch& found, PointTrack& track);
  bool align(const Vec2& pixel, const TableRay& ray, std::uint8_t label, const FoundPatch& found,
             PatchAlignment& alignment);
  bool returns(const Vec2& pixel, const PatchAlignment& alignment) const;
  bool same_ground(std::uint8_t label, const Vec2& pixel) const;
  void choose_strongest(std::span<const Corner> corners, FirstLooks& strongest) const;

  const TrackedView& first_;
  const TrackedView& second_;
  const PointTrackingParams& params_;
  PointTrackingWorkspace& workspace_;
  PointTrackingReport& report_;
  double card_mm_;
  TableCameras cameras_;
  HeightTransfer transfer_;
};

}  // namespace traygauge
