// Photographs of trays, where the owner allowed them: in memory, or in a folder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "firmware/base/expected.hpp"
#include "firmware/base/scan_id.hpp"
#include "firmware/hub/recent_bodies.hpp"

namespace traygauge {

struct PictureShelfParams {
  std::filesystem::path folder;  // of pictures that are kept; made when the first comes
  std::size_t max_in_memory = 20;
  std::size_t max_bytes_in_memory = 2UL * 1024 * 1024;
  // Some 15,000 pictures.
  std::uint64_t max_bytes_on_disk = 1024UL * 1024 * 1024;
};

// Used by one thread.
class PictureShelf {
 public:
  explicit PictureShelf(PictureShelfParams params)
      : params_(std::move(params)), pictures_({params_.max_in_memory, params_.max_bytes_in_memory}) {}

  // Refuses what is no JPEG.
  Expected<void> show(const ScanId& id, std::string jpeg);
  // On disk, too, as ID.jpg.
  Expected<void> keep(const ScanId& id, const std::string& jpeg);
  // Null where none is shown or kept.
  std::shared_ptr<const std::string> find(const ScanId& id) const;
  // Deletes the files of scans that are not stored any more, and the oldest where there is too much.
  void tidy(const std::function<bool(const ScanId&)>& is_stored) const;

 private:
  PictureShelfParams params_;
  RecentBodies pictures_;
};

}  // namespace traygauge
