#include "simulator/scenes/tray_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "simulator/scenes/scene_poses.hpp"
#include "simulator/scenes/tableware.hpp"

namespace traygauge {
namespace {

constexpr double kLipMm = 19.0;   // of the tray's border that is not flat
constexpr double kGapMm = 6.0;    // between things
constexpr int kPlaceTries = 400;  // for one thing
constexpr int kRestarts = 400;

bool contains(const Footprint& footprint, const Eigen::Vector2d& at_mm, double gap_mm) {
  const Eigen::Rotation2Dd turn(-radians(footprint.rotation_deg));
  const Eigen::Vector2d at = turn * (at_mm - footprint.centre_mm);
  const double x = at.x() / (footprint.half_x_mm + gap_mm);
  const double y = at.y() / (footprint.half_y_mm + gap_mm);
  return footprint.is_ellipse ? x * x + y * y < 1.0 : std::abs(x) < 1.0 && std::abs(y) < 1.0;
}

// Evenly around the border.
std::vector<Eigen::Vector2d> border(const Footprint& footprint) {
  constexpr int kPoints = 48;
  const Eigen::Rotation2Dd turn(radians(footprint.rotation_deg));
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPoints;
    Eigen::Vector2d at(std::cos(angle), std::sin(angle));
    if (!footprint.is_ellipse) at /= at.cwiseAbs().maxCoeff();
    points.emplace_back(footprint.centre_mm +
                        turn * at.cwiseProduct(Eigen::Vector2d(footprint.half_x_mm, footprint.half_y_mm)));
  }
  return points;
}

// Moves it to a free place; false when none is found.
bool find_place(Footprint& footprint, const Tray& tray, const std::vector<Footprint>& taken,
                double largest_turn_deg, Draws& draws) {
  for (int tries = 0; tries < kPlaceTries; ++tries) {
    footprint.centre_mm = {draws.between(-0.5, 0.5) * tray.size_mm[0],
                           draws.between(-0.5, 0.5) * tray.size_mm[1]};
    footprint.rotation_deg = draws.between(-largest_turn_deg, largest_turn_deg);
    const auto is_in_the_way = [&](const Footprint& other) { return overlap(footprint, other, kGapMm); };
    if (is_on_tray(footprint, tray) && std::none_of(taken.begin(), taken.end(), is_in_the_way)) return true;
  }
  return false;
}

bool lay_dishes_and_card(SceneDescription& scene, std::vector<Footprint>& taken, Draws& draws) {
  taken.clear();
  for (LaidDish& dish : scene.dishes) {
    Footprint footprint{{}, 0.0, 0.5 * dish.dish.outer_size_mm[0], 0.5 * dish.dish.outer_size_mm[1], true};
    const bool is_round = footprint.half_x_mm == footprint.half_y_mm;
    if (!find_place(footprint, *scene.tray, taken, is_round ? 0.0 : 12.0, draws)) return false;
    dish.centre_mm = footprint.centre_mm;
    dish.rotation_deg = footprint.rotation_deg;
    taken.push_back(footprint);
  }
  Footprint card{{}, 0.0, 0.5 * scene.card.width_mm, 0.5 * scene.card.height_mm, false};
  if (!find_place(card, *scene.tray, taken, 180.0, draws)) return false;
  scene.card.centre_mm = card.centre_mm;
  scene.card.rotation_deg = card.rotation_deg;
  taken.push_back(card);
  return true;
}

// As much of a place setting as there is room for: on a napkin, else side by side, else one piece.
void lay_cutlery(SceneDescription& scene, const std::vector<Footprint>& taken, Draws& draws) {
  struct Setting {
    double half_width_mm;
    bool has_napkin;
    std::vector<UtensilKind> pieces;
  };
  const std::array<Setting, 3> settings = {
      Setting{58.0, true, {UtensilKind::fork, UtensilKind::knife, UtensilKind::spoon}},
      Setting{38.0, false, {UtensilKind::fork, UtensilKind::knife}},
      Setting{22.0, false, {UtensilKind::spoon}}};
  constexpr double kHalfLengthMm = 106.0;
  for (const Setting& setting : settings) {
    Footprint place{{}, 0.0, kHalfLengthMm, setting.half_width_mm, false};
    if (!find_place(place, *scene.tray, taken, 180.0, draws)) continue;
    if (setting.has_napkin) {
      scene.utensils.push_back({UtensilKind::napkin, place.centre_mm, place.rotation_deg, 0.0,
                                draws.pick(std::span<const std::uint32_t>(kNapkinPapers))});
    }
    const Eigen::Rotation2Dd turn(radians(place.rotation_deg));
    const auto count = static_cast<double>(setting.pieces.size());
    for (std::size_t i = 0; i < setting.pieces.size(); ++i) {
      const double across = 34.0 * (static_cast<double>(i) - 0.5 * (count - 1.0));
      scene.utensils.push_back(
          {setting.pieces[i], place.centre_mm + turn * Eigen::Vector2d(draws.between(-3.0, 3.0), across),
           place.rotation_deg + draws.between(-3.0, 3.0), setting.has_napkin ? kNapkinMm : 0.0, 0xC8C8C8});
    }
    return;
  }
}

}  // namespace

bool is_on_tray(const Footprint& footprint, const Tray& tray) {
  const Footprint floor{
      {0.0, 0.0}, 0.0, 0.5 * tray.size_mm[0] - kLipMm, 0.5 * tray.size_mm[1] - kLipMm, false};
  const std::vector<Eigen::Vector2d> points = border(footprint);
  return std::all_of(points.begin(), points.end(),
                     [&](const Eigen::Vector2d& at) { return contains(floor, at, 0.0); });
}

bool overlap(const Footprint& a, const Footprint& b, double gap_mm) {
  const auto enters = [&](const Footprint& one, const Footprint& other) {
    const std::vector<Eigen::Vector2d> points = border(one);
    return contains(other, one.centre_mm, gap_mm) ||
           std::any_of(points.begin(), points.end(),
                       [&](const Eigen::Vector2d& at) { return contains(other, at, gap_mm); });
  };
  return enters(a, b) || enters(b, a);
}

void lay_out_tray(SceneDescription& scene, Draws& draws) {
  std::vector<Footprint> taken;
  for (int restart = 0; restart < kRestarts; ++restart) {
    if (!lay_dishes_and_card(scene, taken, draws)) continue;
    lay_cutlery(scene, taken, draws);
    return;
  }
  throw std::invalid_argument(scene.name + ": dishes and card do not fit on the tray");
}

}  // namespace traygauge
