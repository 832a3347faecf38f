#include "firmware/evaluate/protocol.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "firmware/config/dish_choice.hpp"
#include "firmware/measure/capture_session.hpp"
#include "simulator/capture/capture.hpp"

namespace traygauge {
namespace {

struct Task {
  std::filesystem::path folder;
  std::array<int, 2> pair{};
};

// A set may be a capture itself: then the folder's own name.
std::string name_below(const std::filesystem::path& set, const std::filesystem::path& folder) {
  std::string name = folder.lexically_relative(set).string();
  if (name != ".") return name;
  const std::filesystem::path path = std::filesystem::absolute(folder).lexically_normal();
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

Pose pose_of(const WorldToCamera& matrix) {
  Pose pose;
  for (int row = 0; row < 3; ++row) {
    const auto& values = matrix[static_cast<std::size_t>(row)];
    for (int column = 0; column < 3; ++column)
      pose.rotation(row, column) = values[static_cast<std::size_t>(column)];
    pose.translation[row] = values[3];
  }
  return pose;
}

// Without the bottom, which depends on the dish.
std::optional<PairTruth> truth_of(const Truth& truth, const Task& task) {
  const auto first = static_cast<std::size_t>(task.pair[0]);
  const auto second = static_cast<std::size_t>(task.pair[1]);
  if (std::max(first, second) >= truth.poses.size()) return {};
  return PairTruth{pose_of(truth.poses[first]), pose_of(truth.poses[second]), 0.0};
}

Run record(const Measurement& measurement, std::uint64_t seed, std::optional<PairTruth> truth,
           const std::vector<DishDescription>& dishes) {
  Run run;
  run.seed = seed;
  run.status = measurement.status.code();
  run.relative_angle_deg = measurement.relative_angle_deg;
  run.total_ms = measurement.total_ms;
  run.warnings = measurement.warnings;
  run.report = measurement.report;
  for (const ItemResult& item : measurement.items)
    run.items.push_back({item.label, item.status, item.volume_ml, item.column_volume_ml, item.sigma_ml});
  if (truth && !measurement.items.empty() && run.report.dish_index >= 0) {
    truth->bottom_height_mm = dishes.at(static_cast<std::size_t>(run.report.dish_index)).bottom_height_mm;
    run.errors = stage_errors(measurement, *truth);
  }
  return run;
}

PairRuns run_pair(const std::filesystem::path& set, const Task& task, const ProtocolOptions& options,
                  const std::function<void()>& measured) {
  const Capture capture = read_capture(task.folder);
  PairRuns result;
  result.capture = name_below(set, task.folder);
  result.pair = task.pair;
  result.truth = read_truth(task.folder).value();
  const auto truth = truth_of(result.truth, task);
  if (truth) result.true_angle_deg = truth->relative_angle_deg();
  const std::vector<DishDescription> dishes = choose_dishes(capture, options.config);
  CaptureSession session(capture, task.pair, dishes, options.parameters);
  for (int run = 1; run <= options.runs; ++run) {
    const auto seed = static_cast<std::uint64_t>(run);
    result.runs.push_back(record(session.measure(seed), seed, truth, dishes));
    measured();
  }
  return result;
}

// Why a capture cannot be evaluated; nothing when it can.
std::optional<std::string> reason_to_skip(const std::filesystem::path& folder, const Capture& capture,
                                          const ProfileAbilities& profile) {
  if (capture.dishes.size() > 1 && !profile.measures_several_dishes)
    return "several dishes; profile " + std::string(profile.name) + " measures one";
  if (!read_truth(folder)) return "no truth.json";
  return {};
}

std::vector<Task> plan_tasks(const std::filesystem::path& set, const ProtocolOptions& options,
                             std::vector<std::string>& skipped) {
  std::vector<Task> tasks;
  for (const std::filesystem::path& folder : find_captures(set)) {
    const Capture capture = read_capture(folder);
    if (const auto reason = reason_to_skip(folder, capture, options.profile)) {
      skipped.push_back(name_below(set, folder) + ": " + *reason);
      continue;
    }
    const auto pairs = capture.pairs.empty() ? std::vector<std::array<int, 2>>{{0, 1}} : capture.pairs;
    for (const auto& pair : pairs) tasks.push_back({folder, pair});
  }
  return tasks;
}

}  // namespace

const ItemEstimate* estimate_of(const Run& run, int label) {
  for (const ItemEstimate& item : run.items) {
    if (item.label == label && item.status == StatusCode::ok) return &item;
  }
  return nullptr;
}

bool is_warned(const Run& run) {
  return std::find(run.warnings.begin(), run.warnings.end(), true) != run.warnings.end();
}

std::vector<std::filesystem::path> find_captures(const std::filesystem::path& set) {
  std::vector<std::filesystem::path> folders;
  std::error_code problem;
  if (std::filesystem::exists(set / "capture.json", problem)) folders.push_back(set);
  for (std::filesystem::recursive_directory_iterator entry(set, problem), end; !problem && entry != end;
       entry.increment(problem)) {
    if (entry->is_directory() && std::filesystem::exists(entry->path() / "capture.json")) {
      folders.push_back(entry->path());
    }
  }
  if (problem || folders.empty()) {
    throw InputError({set, ""}, "a folder with captures below it", problem ? problem.message() : "none",
                     "name a capture or a folder of captures");
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

std::vector<PairRuns> run_protocol(const std::filesystem::path& set, const ProtocolOptions& options,
                                   std::vector<std::string>& skipped,
                                   const std::function<void(std::size_t, std::size_t)>& progress) {
  const std::vector<Task> tasks = plan_tasks(set, options, skipped);
  const std::size_t measurements = tasks.size() * static_cast<std::size_t>(options.runs);
  std::vector<PairRuns> results(tasks.size());
  std::atomic<std::size_t> next{0};
  std::size_t done = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto measured = [&] {
    const std::lock_guard lock(mutex);
    progress(++done, measurements);
  };
  const auto work = [&] {
    for (std::size_t i = next++; i < tasks.size(); i = next++) {
      try {
        results[i] = run_pair(set, tasks[i], options, measured);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        next = tasks.size();
        return;
      }
    }
  };
  {
    std::vector<std::jthread> workers;
    workers.reserve(static_cast<std::size_t>(options.jobs));
    for (int job = 0; job < options.jobs; ++job) workers.emplace_back(work);
  }
  if (failure) std::rethrow_exception(failure);
  return results;
}

}  // namespace traygauge
