#include "firmware/evaluate/pair_tasks.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "simulator/capture/input_error.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

constexpr const char* kTruth =
    R"({"items": [{"label": 2, "name": "rice", "volume_ml": 100.0}], "poses": []})";

// Captures with two pairs each, in folders of a set.
class PairTasks : public testing::Test {
 protected:
  std::filesystem::path add(const std::string& name) const {
    const std::filesystem::path folder = set_.path() / name;
    std::filesystem::create_directories(folder);
    std::filesystem::copy(capture_.folder(), folder, std::filesystem::copy_options::recursive);
    write_text(folder / "truth.json", kTruth);
    return folder;
  }
  std::vector<PairTask> plan(Profile profile = Profile::best) {
    skipped_.clear();
    return plan_tasks(set_.path(), abilities_of(profile), skipped_);
  }

  TemporaryCapture capture_;
  TemporaryFolder set_;
  std::vector<std::string> skipped_;
};

TEST_F(PairTasks, AreOrderedByCapture) {
  add("plates/b");
  add("meals/z");
  add("plates/a");
  const std::vector<PairTask> tasks = plan();
  ASSERT_EQ(tasks.size(), 6U);
  EXPECT_TRUE(skipped_.empty());
  const std::array<const char*, 3> names = {"meals/z", "plates/a", "plates/b"};
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    EXPECT_EQ(tasks[i].capture, names[i / 2]);
    EXPECT_EQ(tasks[i].folder, set_.path() / names[i / 2]);
    const auto pairs = capture_.document["pairs"].get<std::vector<std::array<int, 2>>>();
    EXPECT_EQ(tasks[i].pair, pairs.at(i % 2));
  }
}

TEST_F(PairTasks, ACaptureIsASetOfItself) {
  const std::filesystem::path folder = add("lunch");
  for (const std::filesystem::path& path : {folder, folder / ""}) {
    const auto tasks = plan_tasks(path, abilities_of(Profile::best), skipped_);
    ASSERT_EQ(tasks.size(), 2U);
    EXPECT_EQ(tasks[0].capture, "lunch");
  }
}

TEST_F(PairTasks, LinksAreFollowedAndNoFolderCountsTwice) {
  TemporaryFolder elsewhere;
  const std::filesystem::path lunch = add("lunch");
  std::filesystem::create_directories(elsewhere.path() / "more");
  std::filesystem::copy(lunch, elsewhere.path() / "more/dinner");
  std::filesystem::create_directory_symlink(elsewhere.path() / "more", set_.path() / "far");
  std::filesystem::create_directory_symlink(lunch, set_.path() / "again");
  std::filesystem::create_directory_symlink(set_.path(), elsewhere.path() / "more/loop");
  std::filesystem::create_symlink("nowhere", set_.path() / "broken");
  const std::vector<PairTask> tasks = plan();
  ASSERT_EQ(tasks.size(), 4U);
  EXPECT_EQ(tasks[0].capture, "far/dinner");
  EXPECT_EQ(tasks[2].capture, "lunch");
  const auto linked = plan_tasks(set_.path() / "again", abilities_of(Profile::best), skipped_);
  EXPECT_EQ(linked.size(), 2U);
}

TEST_F(PairTasks, WithoutPairsTheFirstTwoViewsAreOne) {
  capture_.document.erase("pairs");
  capture_.store();
  add("a");
  const std::vector<PairTask> tasks = plan();
  ASSERT_EQ(tasks.size(), 1U);
  EXPECT_EQ(tasks[0].pair, (std::array<int, 2>{0, 1}));
}

TEST_F(PairTasks, WhatIsSkippedIsNamedWithTheReason) {
  std::filesystem::remove(add("a") / "truth.json");
  nlohmann::json dish = capture_.document["dish"];
  capture_.document.erase("dish");
  dish["label"] = 1;
  nlohmann::json other = dish;
  other["label"] = 201;
  capture_.document["dishes"] = {dish, other};
  capture_.store();
  add("b");
  EXPECT_EQ(plan(Profile::best).size(), 2U);
  EXPECT_EQ(skipped_, (std::vector<std::string>{"a: no truth.json"}));
  EXPECT_TRUE(plan(Profile::paper).empty());
  EXPECT_EQ(skipped_,
            (std::vector<std::string>{"a: no truth.json", "b: several dishes; profile paper measures one"}));
}

TEST_F(PairTasks, ASingleViewIsSkipped) {
  capture_.document.erase("pairs");
  auto& views = capture_.document["views"];
  views.erase(views.begin() + 1, views.end());
  capture_.store();
  add("a");
  EXPECT_TRUE(plan().empty());
  EXPECT_EQ(skipped_, (std::vector<std::string>{"a: one view; two are needed"}));
}

TEST_F(PairTasks, AFolderWithoutCapturesIsRefused) {
  EXPECT_THROW(plan(), InputError);
  EXPECT_THROW(plan_tasks(set_.path() / "none", abilities_of(Profile::best), skipped_), InputError);
}

TEST(ForEachTask, WorksOnEveryTaskOnceAndCountsItsSteps) {
  constexpr std::size_t kTasks = 40;
  constexpr std::size_t kSteps = 3;
  for (const int jobs : {1, 4}) {
    std::array<std::atomic<int>, kTasks> worked{};
    std::vector<std::size_t> shown;
    for_each_task(
        kTasks, jobs, kSteps,
        [&](std::size_t done, std::size_t all) {
          EXPECT_EQ(all, kTasks * kSteps);
          shown.push_back(done);
        },
        [&](std::size_t i, const StepDone& done) {
          ++worked.at(i);
          for (std::size_t step = 0; step < kSteps; ++step) done();
        });
    for (const std::atomic<int>& count : worked) EXPECT_EQ(count, 1);
    ASSERT_EQ(shown.size(), kTasks * kSteps);
    for (std::size_t k = 0; k < shown.size(); ++k) EXPECT_EQ(shown[k], k + 1);
  }
}

TEST(ForEachTask, TheFirstFailureEndsIt) {
  constexpr std::size_t kTasks = 2000;
  for (const int jobs : {1, 3}) {
    std::atomic<int> begun = 0;
    const auto work = [&](std::size_t i, const StepDone& done) {
      ++begun;
      if (i == 5) throw std::runtime_error("task 5");
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      done();
    };
    try {
      for_each_task(
          kTasks, jobs, 1, [](std::size_t, std::size_t) {}, work);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& problem) {
      EXPECT_STREQ(problem.what(), "task 5");
    }
    EXPECT_GE(begun, 6);
    EXPECT_LT(begun, jobs == 1 ? 7 : static_cast<int>(kTasks));
  }
}

TEST(ForEachTask, NothingToDoIsDone) {
  for_each_task(
      0, 2, 1, [](std::size_t, std::size_t) { ADD_FAILURE(); },
      [](std::size_t, const StepDone&) { ADD_FAILURE(); });
}

}  // namespace
}  // namespace traygauge
