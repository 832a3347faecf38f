#include "tests/evaluation/tables/result_cache.hpp"

#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "simulator/capture/content_hash.hpp"
#include "simulator/capture/output_file.hpp"

namespace traygauge::tables {
namespace {

using Json = nlohmann::json;

StatusCode status_named(const std::string& text) {
  for (std::size_t code = 0; code < kStatusCodeCount; ++code) {
    if (text == name(static_cast<StatusCode>(code))) return static_cast<StatusCode>(code);
  }
  throw std::invalid_argument("no status " + text);
}

Json warnings_json(const WarningSet& warnings) {
  Json list = Json::array();
  warnings.for_each([&](Warning warning, std::uint8_t label) { list.push_back({name(warning), label}); });
  return list;
}

void read_warnings(const Json& list, WarningSet& warnings) {
  for (const Json& entry : list) {
    for (std::size_t i = 0; i < kWarningCount; ++i) {
      const auto warning = static_cast<Warning>(i);
      if (entry.at(0) == name(warning)) warnings.raise(warning, entry.at(1));
    }
  }
}

Json as_json(const Run& run) {
  Json items = Json::array();
  for (const ItemEstimate& item : run.items) {
    items.push_back({{"label", item.label},
                     {"status", name(item.status)},
                     {"volume_ml", item.volume_ml},
                     {"column_volume_ml", item.column_volume_ml},
                     {"sigma_ml", item.sigma_ml}});
  }
  return {{"seed", run.seed},
          {"status", name(run.status)},
          {"angle_deg", run.relative_angle_deg},
          {"total_ms", run.total_ms},
          {"warnings", warnings_json(run.warnings)},
          {"items", items}};
}

Run as_run(const Json& json) {
  Run run;
  run.seed = json.at("seed");
  run.status = status_named(json.at("status"));
  run.relative_angle_deg = json.at("angle_deg");
  run.total_ms = json.at("total_ms");
  read_warnings(json.at("warnings"), run.warnings);
  for (const Json& item : json.at("items")) {
    run.items.push_back({item.at("label"), status_named(item.at("status")), item.at("volume_ml"),
                         item.at("column_volume_ml"), item.at("sigma_ml")});
  }
  return run;
}

}  // namespace

ResultCache::ResultCache(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::error_code problem;
  std::filesystem::create_directories(folder_, problem);
  if (!std::filesystem::is_directory(folder_)) throw OutputError(folder_, "it is no folder");
}

std::filesystem::path ResultCache::file_of(const std::string& key) const {
  return folder_ / (content_hash(key) + ".json");
}

std::vector<Run> ResultCache::read(const std::string& key) const {
  std::ifstream stream(file_of(key));
  if (!stream) return {};
  try {
    const Json stored = Json::parse(stream);
    if (stored.at("key") != key) return {};
    std::vector<Run> runs;
    for (const Json& run : stored.at("runs")) {
      runs.push_back(as_run(run));
      if (runs.back().seed != runs.size()) return {};
    }
    return runs;
  } catch (const Json::exception&) {
    return {};
  } catch (const std::invalid_argument&) {  // a status that this program does not know
    return {};
  }
}

void ResultCache::write(const std::string& key, const std::vector<Run>& runs) const {
  Json list = Json::array();
  for (const Run& run : runs) list.push_back(as_json(run));
  const std::filesystem::path file = file_of(key);
  const std::filesystem::path temporary = file.string() + "." + std::to_string(getpid());
  std::ofstream stream(temporary, std::ios::binary);
  stream << Json{{"key", key}, {"runs", list}}.dump() << "\n";
  stream.close();
  std::error_code problem;
  if (stream) std::filesystem::rename(temporary, file, problem);
  if (stream && !problem) return;
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  throw OutputError(file, "it could not be written");
}

}  // namespace traygauge::tables
