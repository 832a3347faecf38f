// Every method measures a rendered capture, each within what such a method can be held to.
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/capture/truth.hpp"
#include "tests/evaluation/tables/pair_method.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge::tables {
namespace {

struct Expectation {
  Method method;
  double tolerance;  // of each item's volume
};

TEST(MethodsOnCaptures, MeasureAMeal) {
  if (captures_folder().empty()) GTEST_SKIP() << "TRAYGAUGE_CAPTURES names no captures";
  const PairTask task{captures_folder() / "meals/m08", "m08", {0, 1}};
  const Truth truth = read_truth(task.folder).value();
  for (const auto& [method, tolerance] :
       {Expectation{Method::ours, 0.1}, Expectation{Method::sift, 0.1}, Expectation{Method::orb, 0.15},
        Expectation{Method::presac, 0.15}, Expectation{Method::single_view, 0.6},
        Expectation{Method::sparse_views, 0.4}, Expectation{Method::dense_views, 0.2}}) {
    Variant variant;
    variant.method = method;
    const traygauge::Run run = open_pair(task, variant, "")->measure(1);
    EXPECT_EQ(run.status, StatusCode::ok) << name(method) << ": " << name(run.status);
    EXPECT_GT(run.total_ms, 1.0) << name(method);
    for (const TruthItem& item : truth.items) {
      const ItemEstimate* found = estimate_of(run, item.label);
      ASSERT_NE(found, nullptr) << name(method) << ", " << item.name;
      const double truth_ml = item.volume_above_bottom_plane_ml.value();
      EXPECT_NEAR(found->volume_ml, truth_ml, tolerance * truth_ml) << name(method) << ", " << item.name;
    }
  }
}

}  // namespace
}  // namespace traygauge::tables
