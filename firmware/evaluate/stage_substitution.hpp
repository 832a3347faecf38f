// Truth in the place of what a stage found, while it measures.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "core/pipeline/stage_observer.hpp"
#include "firmware/evaluate/stage_errors.hpp"
#include "firmware/evaluate/true_scene.hpp"

namespace traygauge {

// What may be replaced by the truth.
enum class TrueStage : std::uint8_t {
  pose,     // the second camera's rotation and direction from the first
  scale,    // the length of the baseline
  table,    // the first camera's tilt and height over the table
  place,    // where dishes stand and how they are turned
  surface,  // of what view 0 of the capture sees, in both views' grids
};
inline constexpr std::size_t kTrueStages = 5;
using TrueStages = std::array<bool, kTrueStages>;

// Heights found on lines of sight against the truth, for one label.
struct HeightErrors {
  std::vector<double> errors_mm;  // positive: too high; matched samples whose truth is known
  std::size_t samples = 0;        // all
  std::size_t matched = 0;
};
using HeightErrorsByLabel = std::map<int, HeightErrors>;

// `truth`'s poses are in the order of the pair. The references outlive it.
class StageSubstitution final : public StageObserver {
 public:
  StageSubstitution(const PairTruth& pair, const Truth& truth, const std::optional<TrueSurface>& surface,
                    TrueStages replaced)
      : pair_(pair), truth_(truth), surface_(surface), replaced_(replaced) {}

  void on_order(int first_view) override;
  void on_geometry(BundleResult& bundle, std::span<const DishOnTray> dishes) override;
  void on_surfaces(const TableCameras& camera_from_table, std::array<SurfaceGrid, 2>& grids) override;

  // Of the surfaces as found; empty where a stage is replaced.
  const HeightErrorsByLabel& height_errors() const { return height_errors_; }

 private:
  struct ReplacedGrid {
    std::vector<SurfacePoint> points;
    std::vector<SurfaceEvidence> evidence;
  };

  bool is_replaced(TrueStage stage) const { return replaced_[static_cast<std::size_t>(stage)]; }
  void compare_surface(const Pose& world_from_table, const SurfaceGrid& grid);
  void replace_surface(const Pose& world_from_table, SurfaceGrid& grid, ReplacedGrid& kept) const;
  std::optional<SurfacePoint> true_point(const Pose& world_from_table, const Vec3& camera_mm,
                                         const SurfacePoint& found) const;

  const PairTruth& pair_;
  const Truth& truth_;
  const std::optional<TrueSurface>& surface_;
  TrueStages replaced_;
  std::array<Pose, 2> camera_from_world_;  // in the order of the work
  std::array<ReplacedGrid, 2> kept_;
  HeightErrorsByLabel height_errors_;
};

}  // namespace traygauge
