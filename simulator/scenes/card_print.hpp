// A card as shops and banks give out: a printed side full of detail.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <memory>

#include "simulator/capture/picture.hpp"
#include "simulator/render/material.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

inline constexpr double kCardPrintPxPerMm = 20.0;

// RGB, kCardPrintPxPerMm; the seed chooses the design.
Picture print_card(double width_mm, double height_mm, std::uint64_t seed);

// RGB, from a file; it fills the card. Throws InputError.
Picture read_print(const std::filesystem::path& file);

// The print on the upper side of `card`, white elsewhere. Card coordinates: origin at the top left corner of
// the print, x along its width, y along its height downwards, z down into the card.
std::shared_ptr<const Material> make_card_material(std::shared_ptr<const Picture> print,
                                                   const Eigen::Vector2d& px_per_mm, LaidCard card,
                                                   const Eigen::Isometry3d& card_from_world);

}  // namespace traygauge
