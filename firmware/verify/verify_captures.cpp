#include "firmware/verify/verify_captures.hpp"

#include <nlohmann/json.hpp>
#include <ostream>
#include <utility>

#include "firmware/base/exit_status.hpp"
#include "firmware/base/text.hpp"
#include "firmware/config/dish_choice.hpp"
#include "firmware/measure/capture_session.hpp"
#include "firmware/measure/measure_choices.hpp"
#include "firmware/verify/verify_command.hpp"
#include "firmware/verify/verify_conditions.hpp"
#include "firmware/verify/verify_guide.hpp"
#include "simulator/capture/capture.hpp"
#include "simulator/capture/content_hash.hpp"
#include "simulator/capture/json_file.hpp"

namespace traygauge {
namespace {

namespace fs = std::filesystem;

fs::path folder_of_attempt(const fs::path& folder, const std::string& step, int attempt) {
  return folder / (attempt == 1 ? step : step + "." + std::to_string(attempt));
}

bool has_capture(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(folder / "capture.json", ignored);
}

// Of all that captures of one test have in common: camera, card and dish.
std::string digest_of_setup(const fs::path& capture) {
  nlohmann::json value = read_json(capture / "capture.json").value();
  for (const char* own : {"views", "pairs"}) value.erase(own);
  return content_hash(value.dump());
}

std::vector<DishDescription> dishes_of(const Capture& capture, const VerifyPlan& plan,
                                       const std::string& config) {
  if (!capture.dishes.empty()) return capture.dishes;
  auto found = find_dishes({plan.dish}, choose_dishes(capture, config));
  if (found.ok()) return *found;
  throw UsageError("the plan's dish: config/dishes has no style " + printable(plan.dish) +
                   "; describe it there");
}

VerifyHeader header_of_captures(const VerifyRunOptions& options, const VerifyPlan& plan,
                                const fs::path& first) {
  const Capture capture = read_capture(first);
  VerifyHeader header = begin_verify_header(options, plan);
  header.conditions.push_back({"pictures", "captures"});
  const LabelSource labels = choose_labels(options.labels, capture, choose_pair("", capture));
  header.conditions.push_back({"outlines", labels == LabelSource::automatic ? "found" : "given"});
  const CameraDescription& camera = capture.views.front().camera;
  header.conditions.push_back({"camera", describe_camera(camera)});
  header.conditions.push_back({"card", describe_card(capture.card)});
  header.conditions.push_back({"configuration", digest_of_setup(first)});
  return header;
}

VerifyScan measure_capture(const fs::path& folder, const VerifyRunOptions& options, const VerifyPlan& plan) {
  const Capture capture = read_capture(folder);
  const std::array<int, 2> pair = choose_pair("", capture);
  const LabelSource labels = choose_labels(options.labels, capture, pair);
  ProfileParameters parameters;
  if (labels == LabelSource::automatic) parameters.best.segmentation.items = 1;
  CaptureSession session(capture, pair, dishes_of(capture, plan, options.config), parameters, labels);
  return scan_of(session.measure(0));
}

}  // namespace

VerifyRecord run_verify_captures(const VerifyRunOptions& options, const VerifyPlan& plan,
                                 const std::atomic<bool>& stop, std::ostream& out) {
  const fs::path folder = options.captures;
  for (const VerifyStep& step : plan.steps) {
    if (has_capture(folder / step.id)) continue;
    throw InputError({folder / step.id / "capture.json", ""}, "a capture of each step of the plan", "none",
                     "render them with traygauge-simulate verify, or take them with traygauge record");
  }
  VerifyLog log(options.out, header_of_captures(options, plan, folder / plan.steps.front().id));
  const std::string digest = log.record().header.conditions.back().value;
  VerifyGuide guide(log, out);
  while (const VerifyStep* const step = guide.next()) {
    if (stop) break;
    const int attempt = log.record().attempts_at(step->id) + 1;
    const fs::path own = folder_of_attempt(folder, step->id, attempt);
    if (digest_of_setup(own) != digest) {
      throw InputError({own / "capture.json", ""}, "the camera, card and dish of the first step's capture",
                       "another one", "take the captures of one test with one setup");
    }
    VerifyScan scan = measure_capture(own, options, plan);
    scan.is_last = !has_capture(folder_of_attempt(folder, step->id, attempt + 1));
    guide.take(std::move(scan));
  }
  return log.record();
}

}  // namespace traygauge
