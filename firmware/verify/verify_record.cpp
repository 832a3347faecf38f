#include "firmware/verify/verify_record.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <utility>

#include "firmware/base/exit_status.hpp"
#include "simulator/capture/input_bytes.hpp"
#include "simulator/capture/json_node.hpp"
#include "simulator/capture/output_file.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kRecordVersion = 1;
constexpr std::size_t kMaxRecordBytes = std::size_t{16} << 20U;
constexpr std::size_t kMaxLines = 100'000;
constexpr const char* kBeginning = R"({"traygauge_verify":)";

std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json compose_body(const VerifyBody& body) {
  return {{"id", body.id},
          {"proof", body.proof},
          {"origin", body.origin},
          {"volume_ml", body.volume_ml},
          {"volume_sigma_ml", body.volume_sigma_ml}};
}

// All that two runs of one test have in common.
Json compose_test(const VerifyHeader& header) {
  const VerifyPlan& plan = header.plan;
  Json json = {
      {"program", header.program}, {"plan", plan.name}, {"dish", plan.dish}, {"attempts", plan.attempts}};
  json["conditions"] = Json::array();
  for (const VerifyCondition& condition : header.conditions)
    json["conditions"].push_back({{"name", condition.name}, {"value", condition.value}});
  for (const VerifyBody& body : plan.bodies) json["bodies"].push_back(compose_body(body));
  for (const VerifyPlace& place : plan.places)
    json["places"].push_back({{"name", place.name}, {"shift_mm", place.shift_mm}});
  for (const VerifyStep& step : plan.steps) {
    json["steps"].push_back({{"id", step.id},
                             {"body", step.body},
                             {"place", step.place},
                             {"angle_deg", step.angle_deg},
                             {"is_repeat", step.is_repeat}});
  }
  return json;
}

std::string compose_first_line(const VerifyHeader& header) {
  Json json = {{"traygauge_verify", kRecordVersion}, {"started", header.started}};
  json.update(compose_test(header));
  return dump(json);
}

std::string compose_scan(const VerifyScan& scan) {
  Json json = {{"step", scan.step}, {"attempt", scan.attempt}, {"time", scan.time}, {"status", scan.status}};
  if (!scan.message.empty()) json["message"] = scan.message;
  if (scan.is_measured) {
    json["volume_ml"] = scan.volume_ml;
    json["sigma_ml"] = scan.sigma_ml;
  }
  if (scan.is_last) json["is_last"] = true;
  json["warnings"] = scan.warnings;
  return dump(json);
}

std::string text_or_none(const JsonNode& node, const char* key) {
  const auto found = node.find(key);
  return found && found->is_text() ? found->text() : std::string();
}

// A member that may be an empty text.
std::string optional_text(const nlohmann::json& value, const char* key) {
  const auto found = value.find(key);
  return found != value.end() && found->is_string() ? found->get<std::string>() : std::string();
}

VerifyPlan read_plan(const JsonNode& node, const nlohmann::json& value) {
  constexpr NumberRange kVolumeMl{0.001, 1e6};
  VerifyPlan plan;
  plan.name = node.member("plan").text();
  plan.dish = node.member("dish").text();
  plan.attempts = node.member("attempts").integer(1, 20);
  const std::vector<JsonNode> bodies = node.member("bodies").elements(1, 1000);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    plan.bodies.push_back({bodies[i].member("id").text(), optional_text(value["bodies"][i], "proof"),
                           bodies[i].member("origin").text(), bodies[i].member("volume_ml").number(kVolumeMl),
                           bodies[i].member("volume_sigma_ml").number({0.0, 1e6})});
  }
  for (const JsonNode& place : node.member("places").elements(1, 1000)) {
    const std::vector<double> shift_mm = place.member("shift_mm").numbers(2, {-1e4, 1e4});
    plan.places.push_back({place.member("name").text(), {shift_mm[0], shift_mm[1]}});
  }
  for (const JsonNode& step : node.member("steps").elements(1, kMaxLines)) {
    plan.steps.push_back(
        {step.member("id").text(),
         static_cast<std::size_t>(step.member("body").integer(0, static_cast<int>(plan.bodies.size()) - 1)),
         static_cast<std::size_t>(step.member("place").integer(0, static_cast<int>(plan.places.size()) - 1)),
         step.member("angle_deg").number({0.0, 360.0}), step.member("is_repeat").truth()});
  }
  return plan;
}

VerifyHeader read_header(const JsonNode& node, const nlohmann::json& value) {
  node.member("traygauge_verify").integer(kRecordVersion, kRecordVersion);
  VerifyHeader header;
  header.program = node.member("program").text();
  header.started = node.member("started").text();
  const std::vector<JsonNode> conditions = node.member("conditions").elements(0, 100);
  for (std::size_t i = 0; i < conditions.size(); ++i)
    header.conditions.push_back(
        {conditions[i].member("name").text(), optional_text(value["conditions"][i], "value")});
  header.plan = read_plan(node, value);
  return header;
}

VerifyScan read_scan(const JsonNode& node, const VerifyPlan& plan) {
  VerifyScan scan;
  const JsonNode step = node.member("step");
  scan.step = step.text();
  if (std::ranges::find(plan.steps, scan.step, &VerifyStep::id) == plan.steps.end())
    step.fail("a step of the first line's plan", "remove the line, or begin another file");
  scan.attempt = node.member("attempt").integer(1, 1000);
  scan.time = node.member("time").text();
  scan.status = node.member("status").text();
  scan.message = text_or_none(node, "message");
  if (const auto volume = node.find("volume_ml")) {
    scan.is_measured = true;
    scan.volume_ml = volume->number({0.0, 1e6});
    scan.sigma_ml = node.member("sigma_ml").number({0.0, 1e6});
  }
  if (const auto last = node.find("is_last")) scan.is_last = last->truth();
  for (const JsonNode& warning : node.member("warnings").elements(0, 1000))
    scan.warnings.push_back(warning.text());
  return scan;
}

// What a file holds, and how many bytes of it are whole lines.
struct Content {
  VerifyRecord record;
  std::size_t whole_bytes = 0;
};

Content read_content(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes =
      read_bytes({file, ""}, kMaxRecordBytes, "results of traygauge verify run");
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  Content content;
  const std::string_view beginning = kBeginning;
  if (text.substr(0, beginning.size()) != beginning.substr(0, text.size())) {
    throw InputError({file, ""}, "results of traygauge verify run", "another file",
                     "name the file that --out named then");
  }
  const JsonOrigin origin{file, {}};
  for (std::size_t number = 1; content.whole_bytes < text.size(); ++number) {
    const std::size_t end = text.find('\n', content.whole_bytes);
    if (end == std::string_view::npos) {
      content.record.was_torn = true;
      break;
    }
    const std::string key = "line " + std::to_string(number);
    const auto value =
        nlohmann::json::parse(text.substr(content.whole_bytes, end - content.whole_bytes), nullptr, false);
    if (!value.is_object())
      throw InputError({file, key}, "a JSON object", "a damaged line",
                       "take the file from a backup, or begin another one");
    const JsonNode node(value, origin, key);
    if (number == 1) {
      content.record.header = read_header(node, value);
    } else {
      content.record.scans.push_back(read_scan(node, content.record.header.plan));
    }
    content.whole_bytes = end + 1;
  }
  return content;
}

}  // namespace

int VerifyRecord::attempts_at(const std::string& step) const {
  return static_cast<int>(std::ranges::count(scans, step, &VerifyScan::step));
}

const VerifyScan* VerifyRecord::measured(const std::string& step) const {
  const auto found = std::ranges::find_if(
      scans, [&](const VerifyScan& scan) { return scan.is_measured && scan.step == step; });
  return found == scans.end() ? nullptr : &*found;
}

bool VerifyRecord::is_done(const VerifyStep& step) const {
  const bool is_given_up = std::ranges::any_of(
      scans, [&](const VerifyScan& scan) { return scan.is_last && scan.step == step.id; });
  return is_given_up || measured(step.id) != nullptr || attempts_at(step.id) >= header.plan.attempts;
}

VerifyRecord read_verify_record(const std::filesystem::path& file) {
  Content content = read_content(file);
  if (content.whole_bytes == 0)
    throw InputError({file, ""}, "results of traygauge verify run", "no whole line",
                     "run traygauge verify run again");
  return std::move(content.record);
}

VerifyLog::VerifyLog(std::filesystem::path file, const VerifyHeader& header) : file_(std::move(file)) {
  descriptor_ = FileDescriptor(::open(file_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
  if (!descriptor_.is_open()) throw OutputError(file_, std::strerror(errno));
  if (::flock(descriptor_.number(), LOCK_EX | LOCK_NB) != 0) {
    throw UsageError(printable(file_.string()) +
                     ": another traygauge verify run writes into it; end that one, or name another file");
  }
  std::error_code ignored;
  Content content;
  if (std::filesystem::file_size(file_, ignored) > 0) content = read_content(file_);
  if (content.record.was_torn &&
      ::ftruncate(descriptor_.number(), static_cast<off_t>(content.whole_bytes)) != 0)
    throw OutputError(file_, std::strerror(errno));
  record_ = std::move(content.record);
  if (content.whole_bytes == 0) {
    record_.header = header;
    write_line(compose_first_line(header));
    return;
  }
  const Json before = compose_test(record_.header);
  const Json now = compose_test(header);
  for (const auto& [key, value] : now.items()) {
    if (before.contains(key) && before[key] == value) continue;
    throw UsageError(printable(file_.string()) + ": belongs to a test with another " +
                     (key == "conditions" ? "camera, card, dish, tester or temperature" : key) +
                     "; name another file, so that the certificate speaks of one test");
  }
}

const VerifyStep* VerifyLog::next() const {
  const auto& steps = record_.header.plan.steps;
  const auto found =
      std::ranges::find_if(steps, [&](const VerifyStep& step) { return !record_.is_done(step); });
  return found == steps.end() ? nullptr : &*found;
}

void VerifyLog::append(const VerifyScan& scan) {
  write_line(compose_scan(scan));
  record_.scans.push_back(scan);
}

void VerifyLog::write_line(const std::string& line) {
  if (!write_all(descriptor_.number(), line + "\n") || ::fdatasync(descriptor_.number()) != 0)
    throw OutputError(file_, std::strerror(errno));
}

}  // namespace traygauge
