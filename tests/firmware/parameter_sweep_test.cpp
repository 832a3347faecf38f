// Whatever value a parameter of profile paper may have, a measurement ends: with numbers or with a status.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "core/base/random.hpp"
#include "core/paper/pipeline/estimator.hpp"
#include "core/paper/pipeline/parameters.hpp"
#include "firmware/base/aligned_block.hpp"
#include "firmware/measure/pair_setup.hpp"
#include "simulator/capture/capture.hpp"
#include "tests/support/random_seed.hpp"

namespace traygauge {
namespace {

// A parameter as a number; its type holds whole or real numbers from `least` to `most`.
struct Slot {
  std::string name;
  double value = 0.0;
  ParameterRange range;
  bool is_whole = true;
  double least = 0.0;
  double most = 1.0;
};

// Gives every parameter the value that `change` returns for it.
template <class Change>
class Changer {
 public:
  explicit Changer(Change change) : change_(change) {}

  template <class Number>
  void operator()(const char* name, Number& field, const ParameterRange& range) {
    using Limits = std::numeric_limits<Number>;
    field = static_cast<Number>(
        change_(Slot{name, static_cast<double>(field), range, Limits::is_integer,
                     static_cast<double>(Limits::lowest()), static_cast<double>(Limits::max())}));
  }
  template <class Enum>
  void operator()(const char* name, Enum& field, const ParameterChoices& choices) {
    const ParameterRange range{0.0, static_cast<double>(choices.count() - 1)};
    field = static_cast<Enum>(change_(Slot{name, static_cast<double>(field), range, true, 0.0, 255.0}));
  }
  void operator()(const char* name, bool& field) {
    field = change_(Slot{name, field ? 1.0 : 0.0, {0.0, 1.0}}) > 0.5;
  }

 private:
  Change change_;
};

template <class Change>
void change_parameters(paper::Configuration& configuration, Change change) {
  Changer<Change> changer(change);
  paper::visit_parameters(configuration, changer);
}

int count_parameters(paper::Configuration configuration) {
  int count = 0;
  change_parameters(configuration, [&](const Slot& slot) {
    ++count;
    return slot.value;
  });
  return count;
}

double whole(double value, const ParameterRange& range) {
  return range.step > 0.0 ? std::floor(value / range.step) * range.step : std::floor(value);
}

// Either end, or any value between; large ranges by their ratio.
double draw(const Slot& slot, Random& random) {
  const ParameterRange& range = slot.range;
  switch (random.below(3)) {
    case 0:
      return range.low;
    case 1:
      return range.high;
    default:
      break;
  }
  const bool by_ratio = range.low > 0.0 && range.high > 100.0 * range.low;
  const double value = by_ratio ? range.low * std::pow(range.high / range.low, random.uniform())
                                : range.low + random.uniform() * (range.high - range.low);
  return slot.is_whole ? std::max(whole(value, range), range.low) : value;
}

class ParameterSweep : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const std::string folder = TRAYGAUGE_SOURCE_DIR "/simulator/demo/fish_and_potatoes";
    capture_ = new Capture(read_capture(folder));
    setup_ = new PairSetup(set_up_pair(*capture_, {0, 1}, capture_->dishes));
    views_ = new std::array<LoadedView, 2>{load_view(capture_->views[0]), load_view(capture_->views[1])};
  }
  static void TearDownTestSuite() {
    delete views_;
    delete setup_;
    delete capture_;
  }

  void SetUp() override {
    if (const char* given = std::getenv("TRAYGAUGE_SWEEP_SHARE")) share_ = std::strtod(given, nullptr);
    std::cout << "TRAYGAUGE_SWEEP_SHARE=" << share_ << std::endl;
  }

  static paper::Configuration configuration() { return configure<paper::Configuration>(*setup_); }

  // Measures, and looks at what is said to be measured.
  void measure(const paper::Configuration& configuration, const std::string& what) {
    SCOPED_TRACE(what);
    ASSERT_TRUE(paper::validate(configuration).ok());
    const std::size_t bytes = required_bytes(configuration);
    ASSERT_LT(bytes, std::size_t{4} << 30U);
    const AlignedBlock block(bytes);
    paper::Estimator estimator(block.bytes(), configuration);
    for (const LoadedView& view : *views_) {
      ViewInput input;
      input.frame = view.picture.frame();
      input.labels = view.labels.gray();
      if (!estimator.add_view(input).ok()) break;
    }
    const Measurement& measurement = estimator.estimate(1);
    for (const ItemResult& item : measurement.items) {
      if (item.status != StatusCode::ok) continue;
      ++volumes_;
      EXPECT_TRUE(std::isfinite(item.volume_ml) && std::isfinite(item.sigma_ml));
      EXPECT_LT(std::abs(item.volume_ml), 20'000.0);
    }
  }

  const std::uint64_t seed_ = test::random_seed();
  double share_ = 1.0;  // of what is tried: a part where sanitizers take ten times as long
  int volumes_ = 0;

  static inline Capture* capture_ = nullptr;
  static inline PairSetup* setup_ = nullptr;
  static inline std::array<LoadedView, 2>* views_ = nullptr;
};

TEST_F(ParameterSweep, OneAtATime) {
  Random random(seed_);
  const int count = count_parameters(configuration());
  int tried = 0;
  for (int i = 0; i < count; ++i) {
    if (random.uniform() >= share_) continue;
    ++tried;
    paper::Configuration changed = configuration();
    int at = 0;
    std::string what;
    change_parameters(changed, [&](const Slot& slot) {
      if (at++ != i) return slot.value;
      const double drawn = draw(slot, random);
      what = slot.name + "=" + std::to_string(drawn);
      return drawn;
    });
    measure(changed, what);
  }
  EXPECT_GT(volumes_, tried);  // two items; most parameters alone spoil neither
}

TEST_F(ParameterSweep, SeveralAtOnce) {
  constexpr int kDraws = 40;
  constexpr double kShare = 0.04;
  Random random(seed_);
  for (int i = 0; i < kDraws * share_; ++i) {
    paper::Configuration changed = configuration();
    std::string what;
    change_parameters(changed, [&](const Slot& slot) {
      if (random.uniform() > kShare) return slot.value;
      const double drawn = draw(slot, random);
      what += slot.name + "=" + std::to_string(drawn) + " ";
      return drawn;
    });
    measure(changed, what);
  }
}

TEST_F(ParameterSweep, BeyondTheRangeNothingIsMeasured) {
  const int count = count_parameters(configuration());
  for (int i = 0; i < count; ++i) {
    for (const int which : {0, 1, 2, 3}) {
      paper::Configuration changed = configuration();
      int at = 0;
      std::string what;
      change_parameters(changed, [&](const Slot& slot) {
        if (at++ != i) return slot.value;
        const double wrong = which == 0   ? slot.range.low - 1.0
                             : which == 1 ? slot.range.high + 1.0
                             : which == 2 ? 1e9
                                          : std::numeric_limits<double>::quiet_NaN();
        const bool fits = which == 3 ? !slot.is_whole : wrong >= slot.least && wrong <= slot.most;
        if (!fits || slot.range.contains(wrong)) return slot.value;
        what = slot.name + "=" + std::to_string(wrong);
        return wrong;
      });
      if (what.empty()) continue;
      EXPECT_EQ(paper::validate(changed).code(), StatusCode::invalid_configuration) << what;
    }
  }
}

}  // namespace
}  // namespace traygauge
