// What a backup holds, as it says itself.
#pragma once

#include <string>
#include <vector>

#include "firmware/base/expected.hpp"
#include "firmware/support/archive.hpp"

namespace traygauge {

struct BackupManifest {
  std::string program;  // the version that made it
  std::string made_at;  // UTC
  std::string station;  // the station file's name in the archive
  // Files of secrets that the station file names and that are not in the archive.
  std::vector<std::string> left_out;
};

// The archive's first file, with the sum of each of `files`.
ArchivedFile compose_manifest(const BackupManifest& manifest, const std::vector<ArchivedFile>& files);

// Takes the manifest out of what was unpacked. The failure says which file is damaged, missing or too many.
Expected<BackupManifest> take_manifest(std::vector<ArchivedFile>& files);

}  // namespace traygauge
