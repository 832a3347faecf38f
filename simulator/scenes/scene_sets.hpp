// The sets of scenes that stand for the paper's (section IV-A), and two of our own.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

struct SceneSet {
  std::string_view name;
  std::string_view what;  // for people
};

std::span<const SceneSet> scene_sets();

// Reduced: a few scenes of the set, pictures of a quarter of the size, for continuous integration. Throws
// std::invalid_argument for a set that does not exist.
std::vector<SceneDescription> make_scenes(std::string_view set, std::uint64_t seed, bool is_reduced);

}  // namespace traygauge
