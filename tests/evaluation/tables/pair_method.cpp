#include "tests/evaluation/tables/pair_method.hpp"

#include "firmware/config/dish_choice.hpp"
#include "firmware/measure/capture_session.hpp"
#include "tests/evaluation/methods/given_measurement.hpp"
#include "tests/evaluation/methods/pair_features.hpp"
#include "tests/evaluation/methods/presac.hpp"

namespace traygauge::tables {
namespace {

struct OpenPair {
  OpenPair(const PairTask& task, const Variant& variant, const std::string& config)
      : capture(read_capture(task.folder)),
        session(capture, task.pair, choose_dishes(capture, config), configure(variant)) {}

  Capture capture;
  CaptureSession session;
};

class OurMethod final : public PairMethod {
 public:
  OurMethod(const PairTask& task, const Variant& variant, const std::string& config)
      : runner_(task, options_of(variant, config)) {}
  Run measure(std::uint64_t seed) override { return runner_.measure(seed); }

 private:
  static ProtocolOptions options_of(const Variant& variant, const std::string& config) {
    ProtocolOptions options;
    options.parameters = configure(variant);
    options.profile = abilities_of(variant.profile);
    options.config = config;
    return options;
  }

  PairRunner runner_;
};

// Another detector in the place of SURF.
class DetectorMethod final : public PairMethod {
 public:
  DetectorMethod(const PairTask& task, const Variant& variant, const std::string& config, Detector detector)
      : pair_(task, variant, config), matches_(match_pair(pair_.session, detector)) {}

  Run measure(std::uint64_t seed) override {
    Run run = record_run(measure_given(pair_.session, matches_, seed), seed);
    run.total_ms += matches_.time_ms;
    return run;
  }

 private:
  OpenPair pair_;
  PairMatches matches_;
};

class PresacMethod final : public PairMethod {
 public:
  PresacMethod(const PairTask& task, const Variant& variant, const std::string& config)
      : pair_(task, variant, config) {}

  Run measure(std::uint64_t seed) override {
    const Status status = pair_.session.estimator().set_motion_search(&search_);
    static_cast<void>(status);  // estimate() reports it, too
    return record_run(pair_.session.measure(seed), seed);
  }

 private:
  OpenPair pair_;
  Presac search_;
};

}  // namespace

std::unique_ptr<PairMethod> open_pair(const PairTask& task, const Variant& variant,
                                      const std::string& config) {
  switch (variant.method) {
    case Method::sift:
      return std::make_unique<DetectorMethod>(task, variant, config, Detector::sift);
    case Method::orb:
      return std::make_unique<DetectorMethod>(task, variant, config, Detector::orb);
    case Method::presac:
      return std::make_unique<PresacMethod>(task, variant, config);
    default:
      return std::make_unique<OurMethod>(task, variant, config);
  }
}

}  // namespace traygauge::tables
