#include "simulator/capture/json_file.hpp"

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "simulator/capture/input_bytes.hpp"
#include "simulator/capture/input_error.hpp"

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
  try {
    return {{file, {}}, nlohmann::json::parse(bytes.begin(), bytes.end(), limit_depth)};
  } catch (const nlohmann::json::parse_error& error) {
    throw InputError(input, kJson, "an error at byte " + std::to_string(error.byte),
                     bytes.empty() ? "the file is empty" : "check commas, quotes and brackets there");
  } catch (const nlohmann::json::out_of_range&) {
    throw InputError(input, kJson, "a number that is too large", "numbers must be finite");
  }
}

}  // namespace traygauge
