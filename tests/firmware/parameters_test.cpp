// `--set NAME=VALUE` and `--parameters`: every parameter of both profiles can be set and read back, nothing
// absurd gets through.
#include "firmware/config/parameters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/pipeline/parameters.hpp"
#include "firmware/base/exit_status.hpp"
#include "tests/firmware/command_runner.hpp"

namespace traygauge {
namespace {

struct Listed {
  std::string value;
  std::string domain;
};

// What --parameters prints, by profile and name.
std::map<std::string, std::map<std::string, Listed>> read_list(const Configuration& configuration) {
  std::map<std::string, std::map<std::string, Listed>> groups;
  std::string group;
  for (const std::string& line : list_parameters(configuration)) {
    if (line.starts_with("# ")) {
      group = line.substr(2);
      continue;
    }
    const std::size_t equals = line.find('=');
    const std::size_t space = line.find(' ');
    const std::size_t open = line.find('(');
    EXPECT_TRUE(equals < space && space < open && line.ends_with(")")) << line;
    const Listed listed{line.substr(equals + 1, space - equals - 1),
                        line.substr(open + 1, line.size() - open - 2)};
    EXPECT_TRUE(groups[group].emplace(line.substr(0, equals), listed).second) << "twice: " << line;
  }
  return groups;
}

Configuration of_profile(Profile profile) {
  Configuration configuration;
  configuration.profile = profile;
  return configuration;
}

// Another value than `listed`, out of its domain.
std::string other_value(const Listed& listed) {
  if (listed.value == "true") return "false";
  if (listed.value == "false") return "true";
  const std::size_t to = listed.domain.find(" to ");
  if (to == std::string::npos) {  // one of several names
    const std::string first = listed.domain.substr(0, listed.domain.find(' '));
    return first != listed.value ? first : listed.domain.substr(listed.domain.rfind(' ') + 1);
  }
  const std::string high = listed.domain.substr(to + 4);
  const std::size_t begin = listed.domain.rfind(' ', to - 1);
  const std::string low = listed.domain.substr(begin == std::string::npos ? 0 : begin + 1, to - begin - 1);
  return high != listed.value ? high : low;
}

TEST(Parameters, EachCanBeSetAndReadBackAndChangesNoOther) {
  for (const Profile profile : {Profile::best, Profile::paper}) {
    const auto before = read_list(of_profile(profile));
    const std::string own = profile == Profile::best ? "profile best" : "profile paper";
    ASSERT_EQ(before.size(), 4U);
    for (const std::string& group : {std::string("both profiles"), std::string("labels auto"), own}) {
      for (const auto& [name, listed] : before.at(group)) {
        const std::string wanted = other_value(listed);
        Configuration configuration = of_profile(profile);
        ASSERT_NO_THROW(set_parameter(configuration, name + "=" + wanted)) << name << "=" << wanted;
        auto after = read_list(configuration);
        EXPECT_EQ(after[group][name].value, wanted) << name;
        EXPECT_NE(wanted, listed.value) << name;
        int changed = 0;
        for (const auto& [title, parameters] : before) {
          for (const auto& [other, value] : parameters) changed += after[title][other].value != value.value;
        }
        EXPECT_EQ(changed, 1) << name;
        ASSERT_NO_THROW(set_parameter(configuration, name + "=" + listed.value));
        EXPECT_EQ(read_list(configuration)[group][name].value, listed.value) << name;
      }
    }
  }
}

// Aggregates of as many fields as can be initialised.
struct AnyValue {
  template <class T>
  constexpr operator T() const;  // NOLINT(google-explicit-constructor)
};
template <class T, std::size_t... I>
constexpr bool takes(std::index_sequence<I...> /*count*/) {
  return requires {
    T{(static_cast<void>(I), AnyValue{})...};
  };
}
template <class T, std::size_t N = 0>
constexpr int field_count() {
  if constexpr (takes<T>(std::make_index_sequence<N + 1>())) {
    return field_count<T, N + 1>();
  } else {
    return static_cast<int>(N);
  }
}

// Names right below a prefix, and the structures below it that have names of their own.
auto counter_of(const std::string& group) {
  return [list = read_list({}).at(group)](const std::string& prefix) {
    std::set<std::string> fields;
    for (const auto& [name, listed] : list) {
      if (name.starts_with(prefix))
        fields.insert(name.substr(prefix.size(), name.find('.', prefix.size()) - prefix.size()));
    }
    return static_cast<int>(fields.size());
  };
}

TEST(Parameters, EveryFieldOfTheSegmentationHasAName) {
  const auto count = counter_of("labels auto");
  EXPECT_EQ(count("segmentation."), field_count<SegmenterParams>());
  EXPECT_EQ(count("segmentation.card."), field_count<CardSearchParams>());
  EXPECT_EQ(count("segmentation.card.corners."), field_count<CornerParams>() - 1);  // there are no labels yet
  EXPECT_EQ(count("segmentation.dish."), field_count<DishSearchParams>());
  EXPECT_EQ(count("segmentation.dish.edges."), field_count<RimEdgeParams>());
  EXPECT_EQ(count("segmentation.relief."), field_count<DishReliefParams>());
  EXPECT_EQ(count("segmentation.relief.surface."), field_count<TwoViewSurfaceParams>());
  EXPECT_EQ(count("segmentation.food."), field_count<FoodOutlineParams>());
  EXPECT_EQ(count("segmentation.food.raster."), field_count<DishRasterParams>());
  EXPECT_EQ(count("segmentation.food.glaze."), field_count<GlazeParams>());
  EXPECT_EQ(count("segmentation.food.geodesic."), field_count<GeodesicParams>());
  EXPECT_EQ(count("segmentation.food.field."), field_count<FoodFieldParams>());
  EXPECT_EQ(count("segmentation.food.split."), field_count<ItemSplitParams>());
}

TEST(Parameters, EveryFieldOfProfileBestHasAName) {
  const auto count = counter_of("profile best");
  EXPECT_EQ(count("best."), field_count<BestParams>());
  EXPECT_EQ(count("best.card."), field_count<CardAlignmentParams>());
  EXPECT_EQ(count("best.card.pattern."), field_count<CardPatternParams>());
  EXPECT_EQ(count("best.card.outline."), field_count<CardOutlineParams>());
  EXPECT_EQ(count("best.card.picture."), field_count<CardPictureParams>());
  EXPECT_EQ(count("best.card.refinement."), field_count<CardRefinementParams>());
  EXPECT_EQ(count("best.tracking."), field_count<PointTrackingParams>());
  EXPECT_EQ(count("best.tracking.corners."), field_count<CornerParams>());
  EXPECT_EQ(count("best.tracking.alignment."), field_count<PatchAlignmentParams>());
  EXPECT_EQ(count("best.tracking.correction."), field_count<PoseCorrectionParams>());
  EXPECT_EQ(count("best.membership."), field_count<DishMembershipParams>());
  EXPECT_EQ(count("best.outline."), field_count<DishOutlineParams>());
  EXPECT_EQ(count("best.joint."), field_count<JointParams>());
  EXPECT_EQ(count("best.joint.table."), field_count<TableConsensusParams>());
  EXPECT_EQ(count("best.joint.placement."), field_count<DishPlacementParams>() + 2);  // three first scales
  EXPECT_EQ(count("best.joint.placement.choice."), field_count<DishChoiceParams>());
  EXPECT_EQ(count("best.surface."), field_count<TwoViewSurfaceParams>());
  EXPECT_EQ(count("best.surface.rectification."), field_count<PlaneRectificationParams>());
  EXPECT_EQ(count("best.surface.semi_global."), field_count<SemiGlobalParams>());
  EXPECT_EQ(count("best.surface.consistency."), field_count<ConsistencyParams>());
  EXPECT_EQ(count("best.surface.gaps."), field_count<GapParams>());
  EXPECT_EQ(count("best.surface.refinement."), field_count<SurfaceRefinementParams>());
  EXPECT_EQ(count("best.height_map."), field_count<HeightMapParams>());
  EXPECT_EQ(count("best.round_body."), field_count<RoundBodyParams>());
  EXPECT_EQ(count("best.liquid."), field_count<LevelLiquidParams>());
  EXPECT_EQ(count("best.volume."), field_count<HeightVolumeParams>());
  EXPECT_EQ(count("best.overhang."), field_count<OverhangParams>());
  EXPECT_EQ(count("best.agreement."), field_count<FoodAgreementParams>());
  EXPECT_EQ(count("best.uncertainty."), field_count<UncertaintyParams>());
  EXPECT_EQ(count("best.pipeline."), field_count<BestPipelineParams>());
}

// What a person types, and a part of the one line that answers.
void expect_refused(std::vector<std::string> options, const std::string& answer) {
  options.insert(options.begin(), {"evaluate", "--parameters"});
  const CommandResult result = run(options);
  EXPECT_EQ(result.status, kExitWrongUse) << answer;
  EXPECT_EQ(result.out, "") << answer;
  EXPECT_NE(result.error.find(answer), std::string::npos) << result.error;
  EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
}

TEST(Parameters, WhatCannotBeMeantIsRefusedInOneLine) {
  expect_refused({"--set", "best.surface.level=2"}, "no parameter best.surface.level;");
  expect_refused({"--set", "best.surface.levels"}, "found");
  expect_refused({"--set", "=2"}, "no parameter");
  expect_refused({"--set", "best.surface.levels=two"}, "expected a whole number from 1 to 4, found two");
  expect_refused({"--set", "best.surface.levels=2.5"}, "found 2.5");
  expect_refused({"--set", "best.surface.levels=2 "}, "expected");
  expect_refused({"--set", "best.surface.band_lanes=24"}, "a multiple of 16 from 16 to 64, found 24");
  expect_refused({"--set", "best.joint.use_rims=yes"}, "expected true or false");
  expect_refused({"--set", "stereo.levels=2"}, "profile best does not read it; add --profile paper");
  expect_refused({"--profile", "paper", "--set", "best.surface.levels=2"}, "profile paper does not read it");
  expect_refused({"--profile", "paper", "--set", "stereo.cost=ssd"}, "expected census or sad or zncc");
  const CommandResult both = run(
      {"evaluate", "--parameters", "--set", "best.surface.levels=2", "--set", "geometry.max_angle_deg=4e1"});
  EXPECT_EQ(both.status, kExitMeasured) << both.error;
  EXPECT_NE(both.out.find("best.surface.levels=2 "), std::string::npos);
  EXPECT_NE(both.out.find("geometry.max_angle_deg=40 "), std::string::npos);
}

TEST(Parameters, NoNumberTakesNanOrTheHuge) {
  for (const Profile profile : {Profile::best, Profile::paper}) {
    const auto groups = read_list(of_profile(profile));
    for (const auto& [name, listed] :
         groups.at(profile == Profile::best ? "profile best" : "profile paper")) {
      for (const char* value : {"nan", "inf", "-inf", "1e12", "-1e12", "1e400", ""}) {
        Configuration configuration = of_profile(profile);
        EXPECT_THROW(set_parameter(configuration, name + "=" + value), UsageError) << name << "=" << value;
      }
    }
  }
}

}  // namespace
}  // namespace traygauge
