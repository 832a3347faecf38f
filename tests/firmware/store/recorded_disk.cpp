#include "tests/firmware/store/recorded_disk.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace traygauge::test {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kSectorBytes = 512;

bool is_of_store(const fs::path& path) {
  return path.extension() != ".lock";
}

std::int64_t size_of(const FileBytes& bytes) {
  return static_cast<std::int64_t>(bytes.size());
}

void grow(FileBytes& bytes, std::int64_t size) {
  if (size > size_of(bytes)) bytes.resize(static_cast<std::size_t>(size));
}

void overwrite(FileBytes& file, std::int64_t offset, const std::byte* bytes, std::int64_t count) {
  grow(file, offset + count);
  std::copy_n(bytes, count, file.begin() + offset);
}

// How much of what was not synced reaches the platter in one power cut.
struct Luck {
  double written = 0.5;
  bool leaves_garbage = false;  // where a file grew and nothing was written yet
};

Luck draw_luck(std::mt19937_64& random) {
  constexpr double kLittle = 0.1;
  constexpr double kMuch = 0.9;
  switch (random() % 6) {
    case 0:
      return {0.0, false};
    case 1:
      return {1.0, false};
    case 2:
      return {kLittle, random() % 2 == 0};
    case 3:
      return {kMuch, random() % 2 == 0};
    default:
      return {0.5, random() % 2 == 0};
  }
}

bool happens(double probability, std::mt19937_64& random) {
  return std::bernoulli_distribution(probability)(random);
}

}  // namespace

DiskFiles read_files(const fs::path& folder) {
  DiskFiles files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!is_of_store(entry.path())) continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    const auto* const bytes = reinterpret_cast<const std::byte*>(text.data());
    files[entry.path().filename()] = FileBytes(bytes, bytes + text.size());
  }
  return files;
}

void write_files(const fs::path& folder, const DiskFiles& files) {
  for (const auto& entry : fs::directory_iterator(folder)) fs::remove_all(entry.path());
  for (const auto& [name, bytes] : files) {
    std::ofstream stream(folder / name, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
}

int RecordedDisk::before(const DiskOperation& operation) {
  const std::size_t index = asked_++;
  const int verdict = fail_ ? fail_(index, operation) : 0;
  if (verdict != 0 && operation.action != DiskAction::sync) return verdict;
  operations_.push_back({operation.action, fs::path(operation.path).filename().string(), operation.offset,
                         FileBytes(operation.bytes.begin(), operation.bytes.end()), operation.size,
                         operation.syncs_folder, verdict != 0});
  return verdict;
}

UncertainDisk::UncertainDisk(const DiskFiles& synced) {
  for (const auto& [name, bytes] : synced) {
    names_[name] = {std::make_shared<Inode>(Inode{bytes, bytes, {}, false})};
  }
}

void UncertainDisk::apply(const RecordedOperation& operation) {
  auto& versions = names_.try_emplace(operation.name, std::vector<Entry>{nullptr}).first->second;
  const Entry inode = versions.back();
  switch (operation.action) {
    case DiskAction::create:
      versions.push_back(std::make_shared<Inode>());
      versions.back()->syncs_folder = operation.name.ends_with("-journal");
      break;
    case DiskAction::remove:
      versions.push_back(nullptr);
      if (operation.syncs_folder) sync_folder();
      break;
    case DiskAction::write:
    case DiskAction::truncate: {
      const bool truncates = operation.action == DiskAction::truncate;
      inode->unsynced.push_back({truncates, truncates ? operation.size : operation.offset, operation.bytes});
      change(inode->memory, inode->unsynced.back());
      break;
    }
    case DiskAction::sync:
      if (!operation.failed) inode->synced = apply_all(*inode);
      inode->unsynced.clear();
      if (inode->syncs_folder && !operation.failed) {
        sync_folder();
        inode->syncs_folder = false;
      }
      break;
  }
}

void UncertainDisk::sync_folder() {
  for (auto& [name, versions] : names_) versions = {versions.back()};
}

void UncertainDisk::change(FileBytes& file, const Change& change) {
  if (change.is_truncation) {
    file.resize(static_cast<std::size_t>(change.offset));
  } else {
    overwrite(file, change.offset, change.bytes.data(), size_of(change.bytes));
  }
}

FileBytes UncertainDisk::apply_all(const Inode& inode) {
  FileBytes file = inode.synced;
  for (const Change& unsynced : inode.unsynced) change(file, unsynced);
  return file;
}

FileBytes UncertainDisk::apply_some(const Inode& inode, std::mt19937_64& random) {
  const Luck luck = draw_luck(random);
  FileBytes file = inode.synced;
  std::vector<std::int64_t> sizes = {size_of(file)};
  if (luck.leaves_garbage) {
    const std::int64_t end = size_of(apply_all(inode));
    while (size_of(file) < end) file.push_back(static_cast<std::byte>(random()));
  }
  for (const Change& change : inode.unsynced) {
    if (change.is_truncation) {
      sizes.push_back(change.offset);
      if (happens(luck.written, random) && change.offset < size_of(file)) {
        std::fill(file.begin() + change.offset, file.end(), std::byte{0});
      }
      continue;
    }
    const std::int64_t end = change.offset + size_of(change.bytes);
    sizes.push_back(std::max(sizes.back(), end));
    for (std::int64_t at = change.offset; at < end;) {
      const std::int64_t next = std::min(end, (at / kSectorBytes + 1) * kSectorBytes);
      if (happens(luck.written, random)) {
        overwrite(file, at, change.bytes.data() + (at - change.offset), next - at);
      }
      at = next;
    }
  }
  const bool is_extreme = luck.written == 0.0 || luck.written == 1.0;
  const std::size_t chosen =
      is_extreme ? (luck.written == 0.0 ? 0 : sizes.size() - 1) : random() % sizes.size();
  file.resize(static_cast<std::size_t>(sizes[chosen]));
  return file;
}

DiskFiles UncertainDisk::in_memory() const {
  DiskFiles files;
  for (const auto& [name, versions] : names_) {
    if (versions.back() != nullptr) files[name] = versions.back()->memory;
  }
  return files;
}

DiskFiles UncertainDisk::after_power_cut(std::mt19937_64& random) const {
  DiskFiles files;
  for (const auto& [name, versions] : names_) {
    const Entry& inode = versions[random() % versions.size()];
    if (inode != nullptr) files[name] = apply_some(*inode, random);
  }
  return files;
}

}  // namespace traygauge::test
