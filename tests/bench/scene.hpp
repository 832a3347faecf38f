// What the benchmarks measure: two views of a tray with everything that a measurement is given.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/paper/pipeline/estimator.hpp"
#include "core/pipeline/tray_estimator.hpp"
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
  TraySetup setup() const;
  // As an estimator of either profile takes it.
  template <class Config>
  Config configuration() const {
    Config configuration;
    static_cast<TraySetup&>(configuration) = setup();
    return configuration;
  }
  ViewInput view(std::size_t i) const;
  // Mean of |measured − true| / true, in %; NaN without truth.
  double error_percent(const std::map<int, double>& volumes_ml) const;
};

// Of the folder that TRAYGAUGE_CAPTURES names; nothing when it is not set or has no such capture.
std::optional<Scene> load_capture_scene(const std::string& capture);

// The same size in closed form: a cosine hill on a flat dish, and a card with random spots.
Scene render_scene();

// An estimator and its memory for a scene, which outlives it.
template <class Estimator, class Config>
struct SessionOf {
  explicit SessionOf(const Scene& scene_)
      : scene(scene_),
        configuration(scene_.configuration<Config>()),
        block(required_bytes(configuration)),
        estimator(block.bytes(), configuration) {}

  const Measurement& measure() {
    estimator.reset();
    for (std::size_t i = 0; i < 2; ++i) {
      if (!estimator.add_view(scene.view(i)).ok()) break;
    }
    return estimator.estimate(1);
  }

  const Scene& scene;
  Config configuration;
  AlignedBlock block;
  Estimator estimator;
};

using Session = SessionOf<TrayEstimator, Configuration>;
using PaperSession = SessionOf<paper::Estimator, paper::Configuration>;

template <class AnySession>
const char* name_of() {
  return std::is_same_v<AnySession, Session> ? "best" : "paper";
}

}  // namespace traygauge::bench
