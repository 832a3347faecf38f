// What the benchmarks measure: two views of a tray with everything that a measurement is given.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/pipeline/estimator.hpp"
#include "firmware/base/aligned_block.hpp"
#include "simulator/capture/picture.hpp"

namespace traygauge::bench {

struct Scene {
  std::string name;
  std::array<Picture, 2> frames;
  std::array<Picture, 2> labels;
  LensModel lens;
  Picture pattern;
  ReferenceCard card;  // without the pattern's pixels
  DishModel dish;
  std::map<int, double> truth_ml;  // by label; empty when it is not known

  // Points into the scene.
  Configuration configuration(Profile profile) const;
  ViewInput view(std::size_t i) const;
  // Mean of |measured − true| / true, in %; NaN without truth.
  double error_percent(const std::map<int, double>& volumes_ml) const;
};

// Of the folder that TRAYGAUGE_CAPTURES names; nothing when it is not set or has no such capture.
std::optional<Scene> load_capture_scene(const std::string& capture);

// The same size in closed form: a cosine hill on a flat dish, and a card with random spots.
Scene render_scene();

inline const char* name_of(Profile profile) {
  return profile == Profile::best ? "best" : "paper";
}

// An estimator and its memory for a scene, which outlives it.
struct Session {
  Session(const Scene& scene, Profile profile);
  const Measurement& measure();

  const Scene& scene;
  Configuration configuration;
  AlignedBlock block;
  Estimator estimator;
};

}  // namespace traygauge::bench
