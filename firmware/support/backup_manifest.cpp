#include "firmware/support/backup_manifest.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "core/base/crc32c.hpp"
#include "simulator/capture/input_error.hpp"

namespace traygauge {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kManifestName = "manifest.json";
constexpr const char* kFormat = "traygauge backup";
constexpr int kManifestVersion = 1;

std::uint32_t sum_of(const ArchivedFile& file) {
  return crc32c(std::as_bytes(std::span(file.content)));
}

// Throws Json::exception for what is no manifest.
Expected<BackupManifest> check_manifest(const Json& json, const std::vector<ArchivedFile>& files) {
  if (json.at("format").get<std::string>() != kFormat) return Failure{"it is no backup of a station"};
  if (json.at("version").get<int>() != kManifestVersion)
    return Failure{"it was made by another version of this program, " +
                   printable(json.at("program").get<std::string>()) + "; restore it with that one"};
  const Json& entries = json.at("files");
  if (entries.size() != files.size()) return Failure{"it does not hold the files that its manifest lists"};
  for (std::size_t i = 0; i < files.size(); ++i) {
    const bool is_same = entries[i].at("name").get<std::string>() == files[i].name &&
                         entries[i].at("bytes").get<std::size_t>() == files[i].content.size() &&
                         entries[i].at("crc32c").get<std::uint32_t>() == sum_of(files[i]);
    if (!is_same) return Failure{printable(files[i].name) + " is not what the manifest says: it is damaged"};
  }
  return BackupManifest{json.at("program").get<std::string>(), json.at("made_at").get<std::string>(),
                        json.at("station").get<std::string>(),
                        json.at("left_out").get<std::vector<std::string>>()};
}

}  // namespace

ArchivedFile compose_manifest(const BackupManifest& manifest, const std::vector<ArchivedFile>& files) {
  Json entries = Json::array();
  for (const ArchivedFile& file : files)
    entries.push_back({{"name", file.name}, {"bytes", file.content.size()}, {"crc32c", sum_of(file)}});
  const Json json = {{"format", kFormat},           {"version", kManifestVersion},
                     {"program", manifest.program}, {"made_at", manifest.made_at},
                     {"station", manifest.station}, {"left_out", manifest.left_out},
                     {"files", std::move(entries)}};
  return {kManifestName, json.dump(2, ' ', true, Json::error_handler_t::replace) + "\n", 0644};
}

Expected<BackupManifest> take_manifest(std::vector<ArchivedFile>& files) {
  if (files.empty() || files.front().name != kManifestName) return Failure{"it is no backup of a station"};
  const ArchivedFile manifest = std::move(files.front());
  files.erase(files.begin());
  try {
    Expected<BackupManifest> checked = check_manifest(Json::parse(manifest.content), files);
    const auto is_station = [&](const ArchivedFile& file) { return file.name == checked->station; };
    if (checked.ok() && std::none_of(files.begin(), files.end(), is_station))
      return Failure{"it does not hold the station file that its manifest names"};
    return checked;
  } catch (const Json::exception&) {
    return Failure{"its manifest cannot be read"};
  }
}

}  // namespace traygauge
