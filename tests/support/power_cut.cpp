#include "tests/support/power_cut.hpp"

#include <algorithm>
#include <cstdlib>

namespace traygauge::test {
namespace {

using Operation = RecordedOperation;
constexpr std::size_t kSectorBytes = 512;

bool is_in_folder(const Operation& operation, const std::string& folder) {
  return std::any_of(operation.names.begin(), operation.names.end(),
                     [&](const auto& name) { return folder_of_path(name.first) == folder; });
}

bool is_settled_by(const Operation& operation, const Operation& sync) {
  if (sync.kind == Operation::Kind::sync_folder) {
    return operation.kind == Operation::Kind::set_names && is_in_folder(operation, sync.folder);
  }
  return (operation.kind == Operation::Kind::write || operation.kind == Operation::Kind::resize) &&
         operation.file == sync.file;
}

bool is_sync(const Operation& operation) {
  return operation.kind == Operation::Kind::sync_file || operation.kind == Operation::Kind::sync_folder;
}

std::size_t sectors_of(const Operation& write) {
  if (write.bytes.empty()) return 0;
  const std::uint64_t first = write.offset_bytes / kSectorBytes;
  const std::uint64_t last = (write.offset_bytes + write.bytes.size() - 1) / kSectorBytes;
  return static_cast<std::size_t>(last - first + 1);
}

void apply_names(const Operation& operation, DiskContents& contents) {
  for (const auto& [name, file] : operation.names) {
    if (file) {
      contents.names[name] = *file;
    } else {
      contents.names.erase(name);
    }
  }
}

// Sectors past the file's end are lost with the size that did not reach the disk.
void apply_sector(const Operation& write, std::size_t sector, Bytes& bytes) {
  const std::uint64_t sector_begin = (write.offset_bytes / kSectorBytes + sector) * kSectorBytes;
  const std::uint64_t begin = std::max(write.offset_bytes, sector_begin);
  const std::uint64_t end = std::min<std::uint64_t>(
      {write.offset_bytes + write.bytes.size(), sector_begin + kSectorBytes, bytes.size()});
  if (begin >= end) return;
  const auto from = write.bytes.begin() + static_cast<std::ptrdiff_t>(begin - write.offset_bytes);
  std::copy_n(from, end - begin, bytes.begin() + static_cast<std::ptrdiff_t>(begin));
}

}  // namespace

PowerCut::PowerCut(const RecordedFileSystem& recorded, std::size_t moment)
    : recorded_(recorded), fates_(moment, Fate::open) {
  const auto& operations = recorded.operations();
  std::vector<bool> is_in_doubt(moment, false);  // for good, after a sync that failed
  for (std::size_t i = 0; i < moment; ++i) {
    if (!is_sync(operations[i])) continue;
    fates_[i] = Fate::certain;
    for (std::size_t before = 0; before < i; ++before) {
      if (!is_settled_by(operations[before], operations[i])) continue;
      if (operations[i].failed) {
        // The kernel drops what it could not write of a file; names are in the file system's own journal,
        // which either goes on or stops the disk.
        if (fates_[before] == Fate::open && operations[i].kind == Operation::Kind::sync_file) {
          is_in_doubt[before] = true;
        }
      } else if (!is_in_doubt[before]) {
        fates_[before] = Fate::certain;
      }
    }
  }
  std::vector<std::size_t> sizes;
  for (const Bytes& file : recorded.initial_contents().files) sizes.push_back(file.size());
  for (std::size_t i = 0; i < moment; ++i) {
    const Operation& operation = operations[i];
    if (operation.file >= sizes.size()) sizes.resize(operation.file + 1, 0);
    sizes_before_.push_back(sizes[operation.file]);
    if (operation.kind == Operation::Kind::write || operation.kind == Operation::Kind::resize) {
      sizes[operation.file] = static_cast<std::size_t>(operation.size_bytes);
    }
    if (fates_[i] == Fate::open) choice_count_ += choices_of(operation);
  }
}

std::size_t PowerCut::choices_of(const RecordedOperation& operation) const {
  // Of a write: its sectors, then the size, which matters where the file grew.
  return operation.kind == Operation::Kind::write ? sectors_of(operation) + 1 : 1;
}

DiskImage PowerCut::state(const std::function<bool(std::size_t choice)>& is_kept) const {
  DiskContents contents = recorded_.initial_contents();
  std::size_t choice = 0;
  const auto decide = [&](std::size_t index) { return fates_[index] == Fate::certain || is_kept(choice++); };
  for (std::size_t i = 0; i < fates_.size(); ++i) {
    const Operation& operation = recorded_.operations()[i];
    if (is_sync(operation)) continue;
    if (operation.kind == Operation::Kind::set_names) {
      if (decide(i)) apply_names(operation, contents);
      for (const auto& [name, file] : operation.names) {
        if (file && *file >= contents.files.size()) contents.files.resize(*file + 1);
      }
      continue;
    }
    if (operation.file >= contents.files.size()) contents.files.resize(operation.file + 1);
    Bytes& bytes = contents.files[operation.file];
    if (operation.kind == Operation::Kind::resize) {
      if (decide(i)) bytes.resize(static_cast<std::size_t>(operation.size_bytes));
      continue;
    }
    if (decide(i) && operation.size_bytes > sizes_before_[i]) {
      bytes.resize(std::max(bytes.size(), static_cast<std::size_t>(operation.size_bytes)));
    }
    for (std::size_t sector = 0; sector < sectors_of(operation); ++sector) {
      if (decide(i)) apply_sector(operation, sector, bytes);
    }
  }
  return contents.image();
}

DiskImage PowerCut::sample(std::mt19937& random) const {
  const auto below = [&](std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end == 0 ? 0 : end - 1)(random);
  };
  const std::size_t one = below(choice_count_);
  constexpr std::size_t kPatterns = 9;
  switch (below(kPatterns)) {
    case 0:
      return state([](std::size_t) { return false; });
    case 1:
      return state([](std::size_t) { return true; });
    case 2:
      return state([&](std::size_t choice) { return choice < one; });
    case 3:
      return state([&](std::size_t choice) { return choice >= one; });
    case 4:
      return state([&](std::size_t choice) { return choice != one; });
    case 5:
      return state([&](std::size_t choice) { return choice == one; });
    case 6:
      return state([&](std::size_t choice) { return choice != one && choice != one + 1; });
    case 7: {  // neighbours share a fate, as the pages of one write do
      bool kept = false;
      return state([&](std::size_t choice) {
        if (choice == 0 || below(8) == 0) kept = below(2) == 0;
        return kept;
      });
    }
    default:
      return state([&](std::size_t) { return below(2) == 0; });
  }
}

std::size_t crash_points(std::size_t usual) {
  const char* const given = std::getenv("TRAYGAUGE_CRASH_POINTS");
  return given == nullptr ? usual : static_cast<std::size_t>(std::strtoull(given, nullptr, 10));
}

}  // namespace traygauge::test
