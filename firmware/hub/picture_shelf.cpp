#include "firmware/hub/picture_shelf.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

namespace traygauge {
namespace {

namespace fs = std::filesystem;

bool is_jpeg(const std::string& bytes) {
  return bytes.starts_with("\xFF\xD8\xFF");
}

fs::path file_name(const ScanId& id) {
  return scan_id_text(id) + ".jpg";
}

struct KeptFile {
  fs::path path;
  fs::file_time_type written_at;
  std::uint64_t bytes = 0;
};

}  // namespace

Expected<void> PictureShelf::show(const ScanId& id, std::string jpeg) {
  if (!is_jpeg(jpeg)) return Failure{"the picture of scan " + scan_id_text(id) + ": expected a JPEG"};
  pictures_.put(id, std::move(jpeg));
  return {};
}

Expected<void> PictureShelf::keep(const ScanId& id, const std::string& jpeg) {
  if (Expected<void> shown = show(id, jpeg); !shown.ok()) return shown;
  std::error_code error;
  fs::create_directories(params_.folder, error);
  // The owner's and the hub's alone.
  if (!error)
    fs::permissions(params_.folder, fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec,
                    error);
  const fs::path path = params_.folder / file_name(id);
  std::ofstream file(path, std::ios::binary);
  file << jpeg;
  file.close();
  if (file.good()) return {};
  fs::remove(path, error);
  return Failure{path.string() + ": a picture could not be kept; look at the disk"};
}

std::shared_ptr<const std::string> PictureShelf::find(const ScanId& id) const {
  if (std::shared_ptr<const std::string> shown = pictures_.find(id)) return shown;
  std::ifstream file(params_.folder / file_name(id), std::ios::binary);
  if (!file) return nullptr;
  std::string jpeg{std::istreambuf_iterator<char>(file), {}};
  return is_jpeg(jpeg) ? std::make_shared<const std::string>(std::move(jpeg)) : nullptr;
}

void PictureShelf::tidy(const std::function<bool(const ScanId&)>& is_stored) const {
  std::vector<KeptFile> files;
  std::uint64_t bytes = 0;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(params_.folder, error)) {
    std::error_code ignored;
    const std::optional<ScanId> id = parse_scan_id(entry.path().stem().string());
    if (entry.path().extension() != ".jpg" || !id) continue;
    if (!is_stored(*id)) {
      fs::remove(entry.path(), ignored);
      continue;
    }
    files.push_back({entry.path(), entry.last_write_time(ignored), entry.file_size(ignored)});
    bytes += files.back().bytes;
  }
  std::sort(files.begin(), files.end(),
            [](const KeptFile& a, const KeptFile& b) { return a.written_at < b.written_at; });
  for (const KeptFile& file : files) {
    if (bytes <= params_.max_bytes_on_disk) return;
    fs::remove(file.path, error);
    bytes -= file.bytes;
  }
}

}  // namespace traygauge
