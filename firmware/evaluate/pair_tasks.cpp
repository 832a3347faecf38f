#include "firmware/evaluate/pair_tasks.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "simulator/capture/capture.hpp"
#include "simulator/capture/truth.hpp"

namespace traygauge {
namespace {

// A set may be a capture itself: then the folder's own name.
std::string name_below(const std::filesystem::path& set, const std::filesystem::path& folder) {
  std::string name = folder.lexically_relative(set).string();
  if (name != ".") return name;
  const std::filesystem::path path = std::filesystem::absolute(folder).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

// The folders in `folder`: those that lie there, and those that links lead to.
std::error_code list_folders(const std::filesystem::path& folder, std::vector<std::filesystem::path>& own,
                             std::vector<std::filesystem::path>& linked) {
  std::error_code problem;
  for (std::filesystem::directory_iterator entry(folder, problem), end; !problem && entry != end;
       entry.increment(problem)) {
    std::error_code ignored;  // a link that leads nowhere
    if (entry->is_directory(ignored)) (entry->is_symlink(ignored) ? linked : own).push_back(entry->path());
  }
  std::sort(linked.rbegin(), linked.rend());  // taken from the end: of two links the same one counts always
  return problem;
}

// Folders with capture.json at or below `set`, sorted. Links are followed, each folder counts once: under its
// own name where it has one in the set.
std::vector<std::filesystem::path> find_captures(const std::filesystem::path& set) {
  std::vector<std::filesystem::path> folders;
  std::set<std::filesystem::path> seen;
  std::vector<std::filesystem::path> own = {set};
  std::vector<std::filesystem::path> linked;
  std::error_code problem;
  while (!problem && !(own.empty() && linked.empty())) {
    std::vector<std::filesystem::path>& next = own.empty() ? linked : own;
    const std::filesystem::path folder = next.back();
    next.pop_back();
    const std::filesystem::path place = std::filesystem::canonical(folder, problem);
    if (problem || !seen.insert(place).second) continue;
    std::error_code ignored;
    if (std::filesystem::exists(folder / "capture.json", ignored)) folders.push_back(folder);
    problem = list_folders(folder, own, linked);
  }
  if (problem || folders.empty()) {
    throw InputError({set, ""}, "a folder with captures below it", problem ? problem.message() : "none",
                     "name a capture or a folder of captures");
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

// Why a capture cannot be evaluated; nothing when it can.
std::optional<std::string> reason_to_skip(const std::filesystem::path& folder, const Capture& capture,
                                          const ProfileAbilities& profile) {
  if (capture.dishes.size() > 1 && !profile.measures_several_dishes)
    return "several dishes; profile " + std::string(profile.name) + " measures one";
  if (!read_truth(folder)) return "no truth.json";
  if (capture.views.size() < 2) return "one view; two are needed";
  return {};
}

}  // namespace

std::vector<PairTask> plan_tasks(const std::filesystem::path& set, const ProfileAbilities& profile,
                                 std::vector<std::string>& skipped) {
  std::vector<PairTask> tasks;
  for (const std::filesystem::path& folder : find_captures(set)) {
    const Capture capture = read_capture(folder);
    if (const auto reason = reason_to_skip(folder, capture, profile)) {
      skipped.push_back(name_below(set, folder) + ": " + *reason);
      continue;
    }
    const auto pairs = capture.pairs.empty() ? std::vector<std::array<int, 2>>{{0, 1}} : capture.pairs;
    for (const auto& pair : pairs) tasks.push_back({folder, name_below(set, folder), pair});
  }
  return tasks;
}

void for_each_task(std::size_t tasks, int jobs, std::size_t steps_per_task, const ShowProgress& progress,
                   const std::function<void(std::size_t, const StepDone&)>& work) {
  const std::size_t steps = tasks * steps_per_task;
  std::atomic<std::size_t> next{0};
  std::size_t done = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const StepDone count = [&] {
    const std::lock_guard lock(mutex);
    progress(++done, steps);
  };
  const auto take = [&] {
    for (std::size_t i = next++; i < tasks; i = next++) {
      try {
        work(i, count);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = tasks;
        return;
      }
    }
  };
  {
    std::vector<std::jthread> workers;
    workers.reserve(static_cast<std::size_t>(jobs));
    for (int job = 0; job < jobs; ++job) workers.emplace_back(take);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace traygauge
