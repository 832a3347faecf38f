#include "firmware/verify/verify_plan.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "simulator/bodies/proof_body.hpp"
#include "simulator/capture/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace traygauge {
namespace {

class VerifyPlanFile : public testing::Test {
 protected:
  VerifyPlan read(const std::string& text) {
    std::ofstream(file()) << text;
    return read_verify_plan(file());
  }
  std::string fault_of(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  std::filesystem::path file() const { return folder_.path() / "plan.toml"; }

  TemporaryFolder folder_;
};

constexpr const char* kSmall = R"(version = 1
name = "small"
dish = "oval"
angles_deg = [0.0, 22.5]
[[bodies]]
proof = "C50"
[[bodies]]
name = "stone"
volume_ml = 211.0
volume_sigma_ml = 1.5
[[places]]
name = "middle"
shift_mm = [0.0, 0.0]
[repeats]
body = "stone"
count = 2
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST_F(VerifyPlanFile, TheDefaultIsHalfAnHoursWork) {
  const VerifyPlan plan = read(compose_default_plan("dinner", kFoldedSigmaMm));
  EXPECT_EQ(plan.dish, "dinner");
  EXPECT_EQ(plan.attempts, 3);
  ASSERT_EQ(plan.bodies.size(), proof_bodies().size());
  EXPECT_EQ(plan.steps.size(), 5U * 3U * 2U + 10U);
  for (std::size_t i = 0; i < plan.bodies.size(); ++i) {
    const ProofBody& proof = proof_bodies()[i];
    EXPECT_EQ(plan.bodies[i].id, proof.id);
    EXPECT_EQ(plan.bodies[i].volume_ml, body_volume_ml(proof.kind, proof.size_mm));
    EXPECT_EQ(plan.bodies[i].volume_sigma_ml, body_volume_sigma_ml(proof.kind, proof.size_mm, 0.3));
  }
  EXPECT_EQ(plan.steps.front().id, "C50-middle-0");
  EXPECT_EQ(plan.steps.back().id, "R180-repeat-10");
  const VerifyPlan exact = read(compose_default_plan("a \"dish\"", 0.0));
  EXPECT_EQ(exact.dish, "a \"dish\"");
  EXPECT_EQ(exact.bodies[2].volume_sigma_ml, 0.0);
}

TEST_F(VerifyPlanFile, StepsAreBodiesAtPlacesAndAnglesThenRepeats) {
  const VerifyPlan plan = read(kSmall);
  std::vector<std::string> ids;
  for (const VerifyStep& step : plan.steps) ids.push_back(step.id);
  EXPECT_EQ(ids, (std::vector<std::string>{"C50-middle-0", "C50-middle-22.5", "stone-middle-0",
                                           "stone-middle-22.5", "stone-repeat-01", "stone-repeat-02"}));
  EXPECT_EQ(plan.steps[5].body, 1U);
  EXPECT_TRUE(plan.steps[5].is_repeat);
  EXPECT_EQ(plan.bodies[1].volume_ml, 211.0);
  EXPECT_EQ(plan.bodies[1].volume_sigma_ml, 1.5);
  EXPECT_EQ(plan.bodies[1].proof, "");
}

TEST_F(VerifyPlanFile, ACalipersLengthsCountInsteadOfTheDrawnOnes) {
  const VerifyPlan plan = read(replaced(
      kSmall, "proof = \"C50\"", "proof = \"C50\"\nname = \"mine\"\nmeasured_mm = [50.4, 40.2, 25.3]"));
  EXPECT_EQ(plan.bodies[0].id, "mine");
  EXPECT_NEAR(plan.bodies[0].volume_ml, 50.4 * 40.2 * 25.3 / 1000.0, 1e-9);
  EXPECT_NEAR(plan.bodies[0].volume_sigma_ml,
              body_volume_sigma_ml(BodyKind::cuboid, {50.4, 40.2, 25.3}, kCaliperSigmaMm), 1e-9);
}

TEST_F(VerifyPlanFile, MistakesAreNamed) {
  ASSERT_EQ(fault_of(kSmall), "");
  const std::vector<std::array<std::string, 3>> mistakes = {
      {"version = 1", "version = 2", "version"},
      {"dish =", "dsh =", "dsh"},
      {"\"C50\"", "\"C51\"", "C400"},
      {"name = \"stone\"", "name = \"a/b\"", "bodies[1].name"},
      {"name = \"stone\"", "name = \"C50\"", "names that differ"},
      {"volume_ml = 211.0", "volume_ml = -1.0", "volume_ml"},
      {"volume_sigma_ml = 1.5", "", "volume_sigma_ml"},
      {"angles_deg = [0.0, 22.5]", "angles_deg = []", "angles_deg"},
      {"angles_deg = [0.0, 22.5]", "angles_deg = [0.0, 0.0]", "names that differ"},
      {"shift_mm = [0.0, 0.0]", "shift_mm = [0.0]", "shift_mm"},
      {"body = \"stone\"", "body = \"brick\"", "repeats.body"},
      {"count = 2", "count = 1", "count"},
      {"proof = \"C50\"", "proof = \"C50\"\nmeasured_mm = [50.0, 40.0, 2.5]", "measured_mm"},
      {"proof = \"C50\"", "proof = \"C50\"\nvolume_ml = 50.0", "volume_ml"},
      {"version = 1", "version = ", "plan.toml"},
  };
  for (const auto& [from, to, named] : mistakes) {
    const std::string fault = fault_of(replaced(kSmall, from, to));
    EXPECT_NE(fault.find(named), std::string::npos) << from << " -> " << to << ": " << fault;
    EXPECT_EQ(fault.find('\n'), std::string::npos);
  }
  EXPECT_THROW(read_verify_plan(folder_.path() / "none.toml"), InputError);
}

}  // namespace
}  // namespace traygauge
