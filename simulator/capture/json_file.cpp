#include "simulator/capture/json_file.hpp"

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "simulator/capture/input_bytes.hpp"
#include "simulator/capture/input_error.hpp"
#include "simulator/capture/json_flaw.hpp"

namespace traygauge {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20U;
constexpr int kMaxDepth = 32;
constexpr const char* kJson = "a JSON document";

}  // namespace

JsonDocument read_json(const std::filesystem::path& file) {
  const InputFile input{file, ""};
  const std::vector<std::uint8_t> bytes = read_bytes(input, kMaxBytes, kJson);
  const auto limit_depth = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    if (depth > kMaxDepth) throw InputError(input, kJson, "more than 32 levels of nesting", "store it flat");
    return true;
  };
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const auto refuse = [&](const JsonFlaw& flaw) {
    throw InputError(InputProblem{
        file, "", kJson,
        flaw.found + " in line " + std::to_string(flaw.line) + ", column " + std::to_string(flaw.column),
        flaw.hint, flaw.line});
  };
  nlohmann::json value;
  try {
    value = nlohmann::json::parse(bytes.begin(), bytes.end(), limit_depth);
  } catch (const nlohmann::json::parse_error& error) {
    refuse(describe_json_flaw(text, error.byte));
  } catch (const nlohmann::json::out_of_range&) {
    refuse(describe_number_overflow(text));
  }
  return {{file, {}}, std::move(value)};
}

}  // namespace traygauge
