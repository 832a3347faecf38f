// The sets of scenes that stand for the paper's (section IV-A), and some of our own.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "simulator/render/render_settings.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

struct SceneSet {
  std::string_view name;
  std::string_view what;  // for people
};

std::span<const SceneSet> scene_sets();

enum class SetSize : std::uint8_t {
  full,
  reduced,  // a few scenes of the set, pictures of a quarter of the size, for continuous integration
  quick,    // all scenes, pictures of 320 x 240, foods on a coarser grid: for networks that take no more
};

// Throws std::invalid_argument for a set that does not exist.
std::vector<SceneDescription> make_scenes(std::string_view set, std::uint64_t seed, SetSize size);

// As few rays as pictures of SetSize::quick need to look sound.
RenderSettings quick_settings();

}  // namespace traygauge
