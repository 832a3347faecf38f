#include "tests/evaluation/tables/pair_method.hpp"

#include <optional>

#include "core/paper/pipeline/estimator.hpp"
#include "firmware/base/exit_status.hpp"
#include "firmware/config/dish_choice.hpp"
#include "firmware/measure/capture_session.hpp"
#include "tests/evaluation/methods/dense_views.hpp"
#include "tests/evaluation/methods/given_measurement.hpp"
#include "tests/evaluation/methods/pair_features.hpp"
#include "tests/evaluation/methods/presac.hpp"
#include "tests/evaluation/methods/single_view.hpp"
#include "tests/evaluation/methods/sparse_views.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge::tables {
namespace {

struct OpenPair {
  OpenPair(const PairTask& task, const Variant& variant, const std::string& config)
      : capture(open_capture(task, variant.pictures)),
        session(capture, task.pair, choose_dishes(capture, config), configure(variant)) {}

  std::optional<TemporaryFolder> scratch;  // of changed pictures
  Capture capture;
  CaptureSession session;

 private:
  Capture open_capture(const PairTask& task, const PictureChange& change) {
    Capture own = read_capture(task.folder);
    if (change.is_none()) return own;
    scratch.emplace();
    return change_views(std::move(own), task.pair, change, scratch->path());
  }
};

void search_with(paper::MotionSearch& search, CaptureSession& session) {
  if (session.pictures() == nullptr || !session.paper_estimator().set_motion_search(&search).ok())
    throw UsageError("another search for the motion needs profile paper");
}

class OurMethod final : public PairMethod {
 public:
  OurMethod(const PairTask& task, const Variant& variant, const std::string& config)
      : pair_(task, variant, config) {}
  Run measure(std::uint64_t seed) override { return record_run(pair_.session.measure(seed), seed); }

 private:
  OpenPair pair_;
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
    search_with(search_, pair_.session);
    return record_run(pair_.session.measure(seed), seed);
  }

 private:
  OpenPair pair_;
  Presac search_;
};

class SingleViewMethod final : public PairMethod {
 public:
  SingleViewMethod(const PairTask& task, const Variant& variant, const std::string& config)
      : pair_(task, variant, config) {}
  Run measure(std::uint64_t seed) override { return measure_single_view(pair_.session, seed); }

 private:
  OpenPair pair_;
};

class SparseViewsMethod final : public PairMethod {
 public:
  SparseViewsMethod(const PairTask& task, const Variant& variant, const std::string& config)
      : pair_(task, variant, config), matches_(match_pair(pair_.session, Detector::sift)) {}
  Run measure(std::uint64_t seed) override { return measure_sparse_views(pair_.session, matches_, seed); }

 private:
  OpenPair pair_;
  PairMatches matches_;
};

class DenseViewsMethod final : public PairMethod {
 public:
  DenseViewsMethod(const PairTask& task, const Variant& variant, const std::string& config)
      : pair_(task, variant, config),
        tracks_(track_corners(pair_.session, match_pair(pair_.session, Detector::sift))) {}

  Run measure(std::uint64_t seed) override {
    search_with(search_, pair_.session);
    return measure_dense_views(pair_.session, tracks_, seed);
  }

 private:
  OpenPair pair_;
  PairMatches tracks_;
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
    case Method::single_view:
      return std::make_unique<SingleViewMethod>(task, variant, config);
    case Method::sparse_views:
      return std::make_unique<SparseViewsMethod>(task, variant, config);
    case Method::dense_views:
      return std::make_unique<DenseViewsMethod>(task, variant, config);
    case Method::ours:
      break;
  }
  return std::make_unique<OurMethod>(task, variant, config);
}

}  // namespace traygauge::tables
