#include "tests/support/recorded_file_system.hpp"

#include <algorithm>

namespace traygauge::test {

// Refers to the file system, which lives longer.
class RecordedFile : public File {
 public:
  RecordedFile(RecordedFileSystem& disk, std::size_t file)
      : disk_(disk), file_(file), process_(disk.process_) {}
  RecordedFile(const RecordedFile&) = delete;
  RecordedFile& operator=(const RecordedFile&) = delete;
  ~RecordedFile() override {
    if (!is_dead() && node().lock_owner == this) node().lock_owner = nullptr;
  }

  IoResult<std::size_t> read_at(std::uint64_t offset_bytes, std::span<std::byte> into) override {
    if (const auto error = check(false)) return {0, error};
    const Bytes& bytes = node().bytes;
    if (offset_bytes >= bytes.size()) return {0, {}};
    const std::size_t count = std::min<std::size_t>(into.size(), bytes.size() - offset_bytes);
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(offset_bytes), count, into.begin());
    return {count, {}};
  }

  std::error_code write_at(std::uint64_t offset_bytes, std::span<const std::byte> bytes) override {
    if (is_dead()) return dead();
    if (disk_.is_read_only_) return std::make_error_code(std::errc::read_only_file_system);
    const bool tears_writes = disk_.fault_ && disk_.fault_->tears_writes;
    if (const auto error = disk_.strike(true)) {
      const std::size_t written = tears_writes ? bytes.size() / 2 : 0;
      if (written > 0 && offset_bytes + written <= node().bytes.size()) {
        disk_.store(file_, offset_bytes, bytes.first(written));
      }
      return error;
    }
    return disk_.write(file_, offset_bytes, bytes);
  }

  IoResult<std::uint64_t> size_bytes() override {
    if (const auto error = check(false)) return {0, error};
    return {node().bytes.size(), {}};
  }

  std::error_code reserve(std::uint64_t bytes) override {
    if (const auto error = check(true)) return error;
    return bytes <= node().bytes.size() ? std::error_code() : disk_.resize(file_, bytes);
  }

  std::error_code sync_data() override {
    if (is_dead()) return dead();
    const std::error_code error = disk_.strike(true);
    if (is_dead()) return error;
    RecordedOperation sync;
    sync.kind = RecordedOperation::Kind::sync_file;
    sync.file = file_;
    sync.failed = static_cast<bool>(error);
    disk_.operations_.push_back(std::move(sync));
    ++disk_.sync_count_;
    return error;
  }

  std::error_code try_lock() override {
    if (const auto error = check(false)) return error;
    if (node().lock_owner != nullptr && node().lock_owner != this) {
      return std::make_error_code(std::errc::resource_unavailable_try_again);
    }
    node().lock_owner = this;
    return {};
  }

 private:
  RecordedFileSystem::Node& node() { return disk_.nodes_[file_]; }
  bool is_dead() const { return process_ != disk_.process_; }
  static std::error_code dead() { return std::make_error_code(std::errc::bad_file_descriptor); }
  std::error_code check(bool is_change) {
    if (is_dead()) return dead();
    if (is_change && disk_.is_read_only_) return std::make_error_code(std::errc::read_only_file_system);
    return disk_.strike(is_change);
  }

  RecordedFileSystem& disk_;
  std::size_t file_ = 0;
  std::size_t process_ = 0;
};

DiskImage DiskContents::image() const {
  DiskImage image;
  for (const auto& [path, file] : names) image[path] = files[file];
  return image;
}

RecordedFileSystem::RecordedFileSystem(const DiskImage& image) {
  for (const auto& [path, bytes] : image) {
    names_[path] = nodes_.size();
    nodes_.push_back({bytes, nullptr});
  }
  initial_ = contents();
}

std::error_code RecordedFileSystem::strike(bool is_change) {
  if (!fault_ || (fault_->spares_reads && !is_change)) return {};
  if (fault_->calls_before > 0) {
    --fault_->calls_before;
    return {};
  }
  fault_has_struck_ = true;
  const std::error_code error = std::make_error_code(fault_->error);
  if (fault_->kills_process) {
    kill_process();
  } else if (!fault_->is_lasting) {
    fault_.reset();
  }
  return error;
}

IoResult<std::unique_ptr<File>> RecordedFileSystem::open(const std::string& path, OpenMode mode) {
  const auto found = names_.find(path);
  const bool is_change = mode != OpenMode::existing && (found == names_.end() || mode == OpenMode::emptied);
  if (const auto error = strike(is_change)) return {nullptr, error};
  if (found == names_.end() && mode == OpenMode::existing) {
    return {nullptr, std::make_error_code(std::errc::no_such_file_or_directory)};
  }
  if (is_read_only_) return {nullptr, std::make_error_code(std::errc::read_only_file_system)};
  std::size_t file = nodes_.size();
  if (found == names_.end()) {
    nodes_.emplace_back();
    set_names({{path, file}});
  } else {
    file = found->second;
    if (mode == OpenMode::emptied && !nodes_[file].bytes.empty()) {
      if (const auto error = resize(file, 0)) return {nullptr, error};
    }
  }
  return {std::make_unique<RecordedFile>(*this, file), {}};
}

std::error_code RecordedFileSystem::rename(const std::string& from, const std::string& to) {
  if (is_read_only_) return std::make_error_code(std::errc::read_only_file_system);
  if (const auto error = strike(true)) return error;
  const auto found = names_.find(from);
  if (found == names_.end()) return std::make_error_code(std::errc::no_such_file_or_directory);
  set_names({{from, std::nullopt}, {to, found->second}});
  return {};
}

std::error_code RecordedFileSystem::remove(const std::string& path) {
  if (is_read_only_) return std::make_error_code(std::errc::read_only_file_system);
  if (const auto error = strike(true)) return error;
  if (!names_.contains(path)) return std::make_error_code(std::errc::no_such_file_or_directory);
  set_names({{path, std::nullopt}});
  return {};
}

std::error_code RecordedFileSystem::sync_folder_of(const std::string& path) {
  const std::size_t process = process_;
  const std::error_code error = strike(true);
  if (process != process_) return error;
  RecordedOperation sync;
  sync.kind = RecordedOperation::Kind::sync_folder;
  sync.folder = folder_of_path(path);
  sync.failed = static_cast<bool>(error);
  operations_.push_back(std::move(sync));
  ++sync_count_;
  return error;
}

IoResult<std::uint64_t> RecordedFileSystem::unique_number() {
  if (const auto error = strike(false)) return {0, error};
  return {++last_number_ * 0x9e3779b97f4a7c15, {}};
}

DiskContents RecordedFileSystem::contents() const {
  DiskContents contents;
  for (const Node& node : nodes_) contents.files.push_back(node.bytes);
  contents.names = names_;
  return contents;
}

void RecordedFileSystem::overwrite(const std::string& path, Bytes bytes) {
  const auto [place, is_new] = names_.try_emplace(path, nodes_.size());
  if (is_new) nodes_.emplace_back();
  nodes_[place->second].bytes = std::move(bytes);
  initial_ = contents();
  operations_.clear();
}

void RecordedFileSystem::kill_process() {
  ++process_;
  for (Node& node : nodes_) node.lock_owner = nullptr;
}

std::error_code RecordedFileSystem::grow(std::size_t file, std::uint64_t size_bytes) {
  Bytes& bytes = nodes_[file].bytes;
  if (size_bytes <= bytes.size()) return {};
  const std::uint64_t more = size_bytes - bytes.size();
  if (more > free_bytes_) return std::make_error_code(std::errc::no_space_on_device);
  if (free_bytes_ != std::numeric_limits<std::uint64_t>::max()) free_bytes_ -= more;
  bytes.resize(static_cast<std::size_t>(size_bytes));
  return {};
}

std::error_code RecordedFileSystem::write(std::size_t file, std::uint64_t offset_bytes,
                                          std::span<const std::byte> bytes) {
  if (const auto error = grow(file, offset_bytes + bytes.size())) return error;
  store(file, offset_bytes, bytes);
  return {};
}

void RecordedFileSystem::store(std::size_t file, std::uint64_t offset_bytes,
                               std::span<const std::byte> bytes) {
  Bytes& content = nodes_[file].bytes;
  std::copy(bytes.begin(), bytes.end(), content.begin() + static_cast<std::ptrdiff_t>(offset_bytes));
  bytes_written_ += bytes.size();
  RecordedOperation write;
  write.file = file;
  write.offset_bytes = offset_bytes;
  write.bytes.assign(bytes.begin(), bytes.end());
  write.size_bytes = content.size();
  operations_.push_back(std::move(write));
}

std::error_code RecordedFileSystem::resize(std::size_t file, std::uint64_t size_bytes) {
  if (const auto error = grow(file, size_bytes)) return error;
  nodes_[file].bytes.resize(static_cast<std::size_t>(size_bytes));
  RecordedOperation change;
  change.kind = RecordedOperation::Kind::resize;
  change.file = file;
  change.size_bytes = size_bytes;
  operations_.push_back(std::move(change));
  return {};
}

void RecordedFileSystem::set_names(std::vector<std::pair<std::string, std::optional<std::size_t>>> names) {
  for (const auto& [name, file] : names) {
    if (file) {
      names_[name] = *file;
    } else {
      names_.erase(name);
    }
  }
  RecordedOperation change;
  change.kind = RecordedOperation::Kind::set_names;
  change.names = std::move(names);
  operations_.push_back(std::move(change));
}

std::string folder_of_path(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string_view::npos ? std::string() : std::string(path.substr(0, slash));
}

}  // namespace traygauge::test
