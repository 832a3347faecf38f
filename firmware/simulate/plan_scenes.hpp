// The protocol of an acceptance test as scenes to render.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "firmware/verify/verify_plan.hpp"
#include "simulator/scenes/scene_description.hpp"

namespace traygauge {

struct PlanSceneOptions {
  std::uint64_t seed = 1;            // of how exactly a person lays things
  bool is_reduced = false;           // pictures of a quarter of the size
  std::string config;                // folder with dishes/; empty: the usual one
  std::filesystem::path card_print;  // a picture of the card's printed side
};

// A scene a step, called by its id, under an arm that turns by 18 degrees. As by hand, dish, body and card
// lie some millimetres and degrees from where the plan wants them. Throws UsageError for the tester's own
// bodies and a dish that is not known, InputError.
std::vector<SceneDescription> scenes_of_plan(const VerifyPlan& plan, const PlanSceneOptions& options);

}  // namespace traygauge
