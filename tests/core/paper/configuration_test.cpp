#include "core/paper/pipeline/configuration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "tests/core/paper/paper_bench.hpp"

namespace traygauge::paper {
namespace {

struct Fault {
  std::string name;
  std::function<void(Configuration&)> spoil;
};

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

// Every number of the configuration that a person gives, out of its range.
std::vector<Fault> list_faults() {
  std::vector<Fault> faults;
  const auto add = [&](const std::string& name, std::initializer_list<double> values, auto set) {
    for (const double value : values) {
      faults.push_back({name + " = " + std::to_string(value), [=](Configuration& c) { set(c, value); }});
    }
  };
  add("lens.width", {0, -1}, [](Configuration& c, double v) { c.lens.width = static_cast<int>(v); });
  add("lens.height", {0, -1}, [](Configuration& c, double v) { c.lens.height = static_cast<int>(v); });
  add("fx", {0, -1, kNan, kInfinity}, [](Configuration& c, double v) { c.lens.pinhole.fx_px = v; });
  add("fy", {0, -1, kNan, kInfinity}, [](Configuration& c, double v) { c.lens.pinhole.fy_px = v; });
  add("cx", {-10, 5000, kNan}, [](Configuration& c, double v) { c.lens.pinhole.cx_px = v; });
  add("cy", {-10, 5000, kNan}, [](Configuration& c, double v) { c.lens.pinhole.cy_px = v; });
  add("k1", {-5, kNan, kInfinity}, [](Configuration& c, double v) { c.lens.k1 = v; });
  add("k2", {-20, kNan}, [](Configuration& c, double v) { c.lens.k2 = v; });
  add("p1", {kNan}, [](Configuration& c, double v) { c.lens.p1 = v; });
  add("p2", {kNan}, [](Configuration& c, double v) { c.lens.p2 = v; });
  add("k3", {-90, kNan}, [](Configuration& c, double v) { c.lens.k3 = v; });
  add("card.width", {0, -1, 9, 501, kNan}, [](Configuration& c, double v) { c.card.width_mm = v; });
  add("card.height", {0, -1, 9, 501, kNan}, [](Configuration& c, double v) { c.card.height_mm = v; });
  add("card.thickness", {-0.1, 11, kNan}, [](Configuration& c, double v) { c.card.thickness_mm = v; });
  add("pattern.width", {0, 63},
      [](Configuration& c, double v) { c.card.pattern.width = static_cast<int>(v); });
  add("pattern.height", {0, 63},
      [](Configuration& c, double v) { c.card.pattern.height = static_cast<int>(v); });
  add("max_frame_width", {0, 15, 8193},
      [](Configuration& c, double v) { c.limits.max_frame_width = static_cast<int>(v); });
  add("max_frame_height", {0, 15, 8193},
      [](Configuration& c, double v) { c.limits.max_frame_height = static_cast<int>(v); });
  add("max_keypoints", {-1, 0, 15, 65537},
      [](Configuration& c, double v) { c.caps.max_keypoints = static_cast<int>(v); });
  add("max_card_keypoints", {-1, 65537},
      [](Configuration& c, double v) { c.caps.max_card_keypoints = static_cast<int>(v); });
  add("max_pattern_keypoints", {-1, 0, 15, 65537},
      [](Configuration& c, double v) { c.caps.max_pattern_keypoints = static_cast<int>(v); });
  add("max_feature_px", {-1, 0, 1e9},
      [](Configuration& c, double v) { c.caps.max_feature_px = static_cast<int>(v); });
  add("max_working_px", {-1, 0, 1e9},
      [](Configuration& c, double v) { c.caps.max_working_px = static_cast<int>(v); });
  add("max_working_side_px", {-1, 0, 1e9},
      [](Configuration& c, double v) { c.caps.max_working_side_px = static_cast<int>(v); });
  faults.push_back({"no pattern", [](Configuration& c) { c.card.pattern = {}; }});
  faults.push_back({"no dish", [](Configuration& c) { c.dishes = {}; }});
  return faults;
}

TEST(ConfigurationCheck, TheTrayIsValid) {
  EXPECT_TRUE(validate(configuration_of(default_tray())).ok());
}

TEST(ConfigurationCheck, EveryFieldOutOfRangeIsRefused) {
  for (const Fault& fault : list_faults()) {
    Configuration configuration = configuration_of(default_tray());
    fault.spoil(configuration);
    EXPECT_EQ(validate(configuration).code(), StatusCode::invalid_configuration) << fault.name;
    const TestBlock block(std::size_t{1} << 16U);
    Estimator estimator(block.bytes(), configuration);  // refused before memory is looked at
    EXPECT_EQ(estimator.status().code(), StatusCode::invalid_configuration) << fault.name;
    EXPECT_EQ(estimator.add_view(default_tray().view(0)).code(), StatusCode::invalid_configuration);
    EXPECT_EQ(estimator.estimate(1).status.code(), StatusCode::invalid_configuration);
  }
}

TEST(ConfigurationCheck, EveryDishIsChecked) {
  const DishModel good{{160.0, 160.0}, 20.0, 5.0};
  std::vector<DishModel> bad(9, good);
  bad[0].outer_size_mm[0] = 19.0;
  bad[1].outer_size_mm[1] = 1001.0;
  bad[2].outer_size_mm[0] = kNan;
  bad[3].rim_height_mm = 201.0;
  bad[4].rim_height_mm = kNan;
  bad[5].rim_height_mm = 4.0;  // below the bottom
  bad[6].bottom_height_mm = -1.0;
  bad[7].bottom_height_mm = 201.0;
  bad[8].bottom_height_mm = kNan;
  for (std::size_t i = 0; i < bad.size(); ++i) {
    const std::array<DishModel, 2> dishes = {good, bad[i]};
    Configuration configuration = configuration_of(default_tray());
    configuration.dishes = dishes;
    EXPECT_EQ(validate(configuration).code(), StatusCode::invalid_configuration) << i;
  }
  DishModel further = good;
  further.label = 201;
  Configuration several = configuration_of(default_tray());
  for (const std::vector<DishModel>& dishes : {std::vector{further}, std::vector{good, further}}) {
    several.dishes = dishes;
    EXPECT_EQ(validate(several).code(), StatusCode::invalid_configuration) << "profile paper measures one";
  }
  const std::vector<DishModel> many(kMaxDishCandidates + 1, good);
  Configuration configuration = configuration_of(default_tray());
  configuration.dishes = many;
  EXPECT_EQ(validate(configuration).code(), StatusCode::invalid_configuration);
  configuration.dishes = std::span(many).first(kMaxDishCandidates);
  EXPECT_TRUE(validate(configuration).ok());
}

}  // namespace
}  // namespace traygauge::paper
