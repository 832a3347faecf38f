// Scenes rendered into capture folders.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "simulator/render/render_settings.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

enum class CaptureState : std::uint8_t {
  absent,    // or damaged, or without files that are asked for
  stale,     // made from another description, with other settings or by another generator
  complete,  // all files of this scene
};

// What a capture's folder holds beside capture.json, truth.json and what they name.
struct CaptureExtras {
  bool has_kinds = false;  // kinds_N.png, 8-bit: what each pixel of view N shows, a TruthKind
};

// Of what lies in `folder`, by the digest in its truth.json. Throws InputError for a mesh of the scene that
// cannot be read.
CaptureState state_of_capture(const std::filesystem::path& folder, const SceneDescription& scene,
                              const RenderSettings& settings, const CaptureExtras& extras = {});

// Writes capture.json of a complete capture anew where this program writes the same description otherwise
// than the one that rendered it, or the arm's angles have changed. Throws OutputError.
void update_description(const std::filesystem::path& folder, const SceneDescription& scene);

// Renders every view of the scene and stores them with capture.json and truth.json in `folder`, which appears
// only when it is complete. `progress` is called with the share that is done. Throws InputError, OutputError,
// and std::invalid_argument for a scene that makes no sense.
void render_capture(const SceneDescription& scene, const std::filesystem::path& folder,
                    const RenderSettings& settings, const std::function<void(double share)>& progress,
                    const CaptureExtras& extras = {});

}  // namespace traygauge
