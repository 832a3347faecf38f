#include "simulator/devices/fault_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "simulator/capture/json_node.hpp"
#include "simulator/capture/toml_file.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kMaxScriptBytes = std::size_t{1} << 16U;
constexpr std::size_t kMaxFaults = 1000;
constexpr int kMaxCalls = 1'000'000'000;
constexpr double kMaxSeconds = 1e6;  // eleven days
constexpr const char* kForever = "forever";

template <class Range>
std::string list_names(const Range& range) {
  std::string list;
  for (const auto item : range) list += (list.empty() ? "one of " : ", ") + std::string(name(item));
  return list;
}

// The one of `range` whose name stands there.
template <class Range>
auto choose(const JsonNode& node, const Range& range, const std::string& hint) {
  const std::string text = node.text();
  const auto found = std::find_if(range.begin(), range.end(), [&](auto item) { return text == name(item); });
  if (found == range.end()) node.fail(list_names(range), hint);
  return *found;
}

SimulatedDevice read_device(const JsonNode& node) {
  std::array<SimulatedDevice, kSimulatedDeviceCount> devices{};
  for (std::size_t i = 0; i < devices.size(); ++i) devices[i] = static_cast<SimulatedDevice>(i);
  return choose(node, devices, "correct the device");
}

FaultAction read_action(const JsonNode& table, SimulatedDevice device) {
  const FaultKind kind = choose(table.member("what"), kinds_of(device),
                                std::string("that is what the ") + name(device) + " can do");
  const FaultAmount* const amount = amount_of(kind);
  if (amount == nullptr) return kind;
  const JsonNode node = table.member(amount->key);
  return kind == FaultKind::bounce
             ? FaultAction(kind, node.integer(static_cast<int>(amount->min), static_cast<int>(amount->max)))
             : FaultAction(kind, node.number({amount->min, amount->max}));
}

int read_times(const JsonNode& node) {
  const bool is_text = node.is_text();
  if (is_text && node.text() != kForever) node.fail("a whole number, or \"forever\"", "correct the value");
  return is_text ? Fault::kForever : node.integer(1, kMaxCalls);
}

void require_one_start(const JsonNode& table) {
  if (table.find("after_calls") && table.find("after_s")) {
    table.member("after_s").fail("either after_calls or after_s", "remove one of them");
  }
}

Fault read_fault(const JsonNode& table, SimulatedDevice device) {
  Fault fault;
  fault.action = read_action(table, device);
  std::vector<std::string_view> keys = {"device", "what", "after_calls", "after_s", "times", "share"};
  if (const FaultAmount* const amount = amount_of(fault.action.kind))
    keys.insert(keys.begin() + 2, amount->key);
  expect_keys(table, keys);
  require_one_start(table);
  if (const auto calls = table.find("after_calls")) fault.after_calls = calls->integer(0, kMaxCalls);
  if (const auto seconds = table.find("after_s")) {
    fault.after_time =
        std::chrono::round<Nanoseconds>(std::chrono::duration<double>(seconds->number({0.0, kMaxSeconds})));
  }
  if (const auto share = table.find("share")) {
    fault.share = share->positive_number(1.0);
    fault.times = Fault::kForever;
  }
  if (const auto times = table.find("times")) fault.times = read_times(*times);
  return fault;
}

}  // namespace

// Each fault draws for itself; the golden ratio keeps the seeds of neighbours apart.
void FaultPlan::apply(SimulatedDevice device, FaultScript& script) const {
  constexpr std::uint64_t kGoldenRatio = 0x9e3779b97f4a7c15U;
  std::uint64_t stream = seed + (static_cast<std::uint64_t>(device) + 1) * 1'000'003U;
  for (const Fault& fault : of(device)) script.add(fault, stream += kGoldenRatio);
}

FaultPlan read_fault_file(const std::filesystem::path& file) {
  const JsonDocument document = read_toml(file, kMaxScriptBytes, "a fault script in TOML");
  const JsonNode root = document.root();
  expect_keys(root, std::to_array<std::string_view>({"seed", "fault"}));
  FaultPlan plan;
  if (const auto seed = root.find("seed")) {
    plan.seed = static_cast<std::uint64_t>(seed->integer(0, std::numeric_limits<int>::max()));
  }
  for (const JsonNode& table : root.member("fault").elements(1, kMaxFaults)) {
    const SimulatedDevice device = read_device(table.member("device"));
    plan.faults[static_cast<std::size_t>(device)].push_back(read_fault(table, device));
  }
  return plan;
}

}  // namespace traygauge
