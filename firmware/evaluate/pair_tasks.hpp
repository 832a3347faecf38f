// The pairs of a set of captures, and the work on all of them.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "firmware/evaluate/profile_abilities.hpp"

namespace traygauge {

struct PairTask {
  std::filesystem::path folder;
  std::string capture;  // path below the set
  std::array<int, 2> pair{};
};

// Every pair, ordered by capture. Captures without truth, and those that the profile cannot measure, are
// named in `skipped` with the reason. Throws InputError, also when there are none.
std::vector<PairTask> plan_tasks(const std::filesystem::path& set, const ProfileAbilities& profile,
                                 std::vector<std::string>& skipped);

// Counts finished steps of work, from any thread.
using StepDone = std::function<void()>;
// Told how many of how many steps are done, never by two threads at once.
using ShowProgress = std::function<void(std::size_t, std::size_t)>;

// Calls `work` with the index of every task and a counter of its `steps_per_task` steps, `jobs` at a time.
// The first exception ends it and is thrown again.
void for_each_task(std::size_t tasks, int jobs, std::size_t steps_per_task, const ShowProgress& progress,
                   const std::function<void(std::size_t, const StepDone&)>& work);

}  // namespace traygauge
