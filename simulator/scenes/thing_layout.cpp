#include "simulator/scenes/thing_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

#include "simulator/scenes/scene_poses.hpp"
#include "simulator/scenes/tableware.hpp"
#include "simulator/scenes/things.hpp"
#include "simulator/scenes/tray_layout.hpp"

namespace traygauge {
namespace {

constexpr double kBesideGapMm = 6.0;
constexpr int kBesideTries = 300;
constexpr double kTrayLipMm = 12.0;  // of a tray: an arm passes above

std::vector<Footprint> taken_places(const SceneDescription& scene) {
  std::vector<Footprint> taken;
  for (const LaidDish& dish : scene.dishes) {
    taken.push_back({dish.centre_mm, dish.rotation_deg, 0.5 * dish.dish.outer_size_mm[0],
                     0.5 * dish.dish.outer_size_mm[1], true});
  }
  for (const Utensil& utensil : scene.utensils) {
    const bool is_napkin = utensil.kind == UtensilKind::napkin;
    taken.push_back(
        {utensil.centre_mm, utensil.rotation_deg, is_napkin ? 82.0 : 106.0, is_napkin ? 80.0 : 22.0, false});
  }
  return taken;
}

Footprint card_place(const LaidCard& card) {
  return {card.centre_mm, card.rotation_deg, 0.5 * card.width_mm, 0.5 * card.height_mm, false};
}

bool is_free(const Footprint& place, const std::vector<Footprint>& taken) {
  return std::none_of(taken.begin(), taken.end(),
                      [&](const Footprint& other) { return overlap(place, other, kBesideGapMm); });
}

// How far the dishes reach from the middle of the world.
double reach_mm(const SceneDescription& scene) {
  double reach = 0.0;
  for (const LaidDish& dish : scene.dishes)
    reach = std::max(reach, dish.centre_mm.norm() + 0.5 * dish.dish.outer_size_mm[0]);
  return reach;
}

std::uint32_t pick_colour(Draws& draws, ThingKind kind) {
  constexpr std::array<std::uint32_t, 6> kSkins = {0xE0B090, 0xD09A76, 0xB87C58,
                                                   0x8E5A3C, 0x5E3A26, 0xEAC4A8};
  constexpr std::array<std::uint32_t, 5> kCrusts = {0xC68A48, 0xB87A3C, 0xD8A862, 0xE0BC84, 0x9A6230};
  constexpr std::array<std::uint32_t, 4> kPhones = {0x141416, 0x2A2C30, 0xB8BABE, 0x3A4A6A};
  constexpr std::array<std::uint32_t, 4> kLeathers = {0x4A2A18, 0x1C1A1A, 0x7A4A28, 0x6A1E1E};
  constexpr std::array<std::uint32_t, 10> kPaints = {0xE6E4DE, 0xDA3A2A, 0xF0C020, 0x2A6AB0, 0x3A8A4A,
                                                     0xF08A20, 0x202224, 0xC8B48C, 0xD870A0, 0x88B8D0};
  switch (kind) {
    case ThingKind::hand:
      return draws.pick(std::span<const std::uint32_t>(kSkins));
    case ThingKind::napkin_with_roll:
      return draws.pick(std::span<const std::uint32_t>(kCrusts));
    case ThingKind::phone:
      return draws.pick(std::span<const std::uint32_t>(kPhones));
    case ThingKind::wallet:
      return draws.pick(std::span<const std::uint32_t>(kLeathers));
    case ThingKind::cup:
    case ThingKind::keys:
    case ThingKind::packet:
      break;
  }
  return draws.pick(std::span<const std::uint32_t>(kPaints));
}

// A drink, a sleeve, a screen, a napkin, a print.
std::uint32_t pick_second_colour(Draws& draws, ThingKind kind) {
  constexpr std::array<std::uint32_t, 6> kDrinks = {0x2A160C, 0xA8744A, 0x8A4A10,
                                                    0xE8A020, 0xEDE6D8, 0xC03018};
  constexpr std::array<std::uint32_t, 6> kPapers = {0xE8E6E0, 0xD8D4CC, 0x6A8A4A,
                                                    0x9A3428, 0x3C5A8A, 0xE0C890};
  constexpr std::array<std::uint32_t, 8> kOthers = {0x0A0B0D, 0xE8EAEC, 0x3C4A5A, 0x8A2A2A,
                                                    0x2A5A9A, 0xD8C8A0, 0x4A6A4A, 0xE8D040};
  if (kind == ThingKind::cup) return draws.pick(std::span<const std::uint32_t>(kDrinks));
  if (kind == ThingKind::napkin_with_roll) return draws.pick(std::span<const std::uint32_t>(kPapers));
  return draws.pick(std::span<const std::uint32_t>(kOthers));
}

Footprint place_of(const Thing& thing) {
  const Eigen::Vector2d half_mm = half_size_mm(thing.kind);
  return {thing.centre_mm, thing.rotation_deg, half_mm.x(), half_mm.y(), false};
}

Footprint arm_of(const Thing& hand) {
  const Eigen::Vector2d along = Eigen::Rotation2Dd(radians(hand.rotation_deg)) * Eigen::Vector2d::UnitX();
  return {hand.centre_mm - 230.0 * along, hand.rotation_deg, 160.0, 90.0, false};
}

// Its palm near the dishes, its arm away from them.
bool place_hand(Thing& hand, const SceneDescription& scene, const std::vector<Footprint>& taken,
                Draws& draws) {
  for (int tries = 0; tries < kBesideTries; ++tries) {
    const double angle = draws.angle_rad();
    const Eigen::Vector2d out(std::cos(angle), std::sin(angle));
    hand.centre_mm = draws.between(120.0, reach_mm(scene) + 180.0) * out;
    hand.rotation_deg = 180.0 + angle * 180.0 / std::numbers::pi + draws.between(-15.0, 15.0);
    if (is_free(place_of(hand), taken) && is_free(arm_of(hand), taken)) {
      hand.base_mm = scene.tray ? kTrayLipMm : 0.0;
      return true;
    }
  }
  return false;
}

// On the tray, or on the table.
bool place_thing(Thing& thing, const SceneDescription& scene, const std::vector<Footprint>& taken,
                 Draws& draws) {
  const double farthest_mm = reach_mm(scene) + 130.0;
  for (int tries = 0; tries < kBesideTries; ++tries) {
    thing.centre_mm = {draws.between(-farthest_mm, farthest_mm), draws.between(-farthest_mm, farthest_mm)};
    thing.rotation_deg = draws.between(0.0, 360.0);
    const Footprint place = place_of(thing);
    if (!is_free(place, taken)) continue;
    thing.base_mm = 0.0;
    if (!scene.tray || is_on_tray(place, *scene.tray)) return true;
    const Footprint tray{{0.0, 0.0}, 0.0, 0.5 * scene.tray->size_mm[0], 0.5 * scene.tray->size_mm[1], false};
    thing.base_mm = -kTrayFloorMm;
    if (!overlap(place, tray, kBesideGapMm)) return true;
  }
  return false;
}

}  // namespace

void lay_card_beside(SceneDescription& scene, Draws& draws) {
  LaidCard& card = scene.card;
  card.thickness_mm = draws.chance(0.5) ? 0.8 : 0.2;
  card.design = draws.seed();
  const std::vector<Footprint> taken = taken_places(scene);
  const double farthest_mm = reach_mm(scene) + 70.0;
  for (int tries = 0; tries < kBesideTries; ++tries) {
    card.centre_mm = {draws.between(-farthest_mm, farthest_mm), draws.between(-farthest_mm, farthest_mm)};
    card.rotation_deg = draws.between(0.0, 360.0);
    if (is_free(card_place(card), taken)) return;
  }
  throw std::invalid_argument(scene.name + ": no room for the card");
}

void lay_things(SceneDescription& scene, Draws& draws, int count) {
  constexpr std::array kKinds = {ThingKind::cup,
                                 ThingKind::cup,
                                 ThingKind::hand,
                                 ThingKind::hand,
                                 ThingKind::phone,
                                 ThingKind::keys,
                                 ThingKind::wallet,
                                 ThingKind::packet,
                                 ThingKind::packet,
                                 ThingKind::napkin_with_roll,
                                 ThingKind::napkin_with_roll};
  std::vector<Footprint> taken = taken_places(scene);
  taken.push_back(card_place(scene.card));
  bool has_hand = false;
  for (int i = 0; i < count; ++i) {
    Thing thing;
    thing.kind = draws.pick(std::span<const ThingKind>(kKinds));
    thing.seed = draws.seed();
    thing.srgb = pick_colour(draws, thing.kind);
    thing.second_srgb = pick_second_colour(draws, thing.kind);
    const bool is_hand = thing.kind == ThingKind::hand;
    if (is_hand && has_hand) continue;
    if (!(is_hand ? place_hand(thing, scene, taken, draws) : place_thing(thing, scene, taken, draws)))
      continue;
    has_hand = has_hand || is_hand;
    taken.push_back(place_of(thing));
    if (is_hand) taken.push_back(arm_of(thing));
    scene.things.push_back(thing);
  }
}

}  // namespace traygauge
