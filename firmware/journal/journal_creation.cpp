#include "firmware/journal/journal_creation.hpp"

#include <algorithm>
#include <memory>
#include <span>
#include <tuple>
#include <utility>

#include "firmware/base/text.hpp"
#include "firmware/journal/io_failure.hpp"

namespace traygauge {
namespace {

std::error_code fill_with_zeros(File& file, std::uint64_t bytes) {
  if (const std::error_code error = file.reserve(bytes);
      error && error != std::errc::operation_not_supported) {
    return error;
  }
  // Reserved blocks that were never written cost a write of the file system's own at each first use.
  constexpr std::uint64_t kBytesAtOnce = 65536;
  const std::vector<std::byte> zeros(kBytesAtOnce);
  for (std::uint64_t offset = 0; offset < bytes; offset += kBytesAtOnce) {
    const auto piece = std::span(zeros).first(std::min(kBytesAtOnce, bytes - offset));
    if (const std::error_code error = file.write_at(offset, piece)) return error;
  }
  return {};
}

class Creation {
 public:
  Creation(std::string path, const NewJournal& journal) : path_(std::move(path)), journal_(journal) {}

  Expected<void> write(FileSystem& file_system) {
    auto opened = file_system.open(path_, OpenMode::emptied);
    if (!opened.ok()) return failure(opened.error);
    const auto id = file_system.unique_number();
    if (!id.ok()) return failure(id.error);
    if (const auto error = fill_with_zeros(*opened.value, journal_.file_bytes)) return failure(error);
    JournalRing ring(std::move(opened.value), id.value, journal_.file_bytes);
    const OldestRecord oldest{
        journal_.records.empty() ? journal_.next_sequence : journal_.records.front().sequence, 0};
    std::uint64_t position = 0;
    for (const RecordEntry& record : journal_.records) {
      RecordEntry moved = record;
      moved.position = position;
      position += moved.blocks();
      const auto payload = journal_.read_payload(record);
      if (!payload.ok()) return Failure{payload.failure()};
      if (const auto error = ring.write_record(moved, oldest, *payload)) return failure(error);
    }
    return write_heads(
        ring, {id.value, journal_.file_bytes, 0, oldest, journal_.next_sequence, ring.block_at(position)});
  }

 private:
  Expected<void> write_heads(JournalRing& ring, JournalHead head) const {
    for (std::uint64_t generation = 0; generation < kHeadsInFile; ++generation) {
      head.generation = generation;
      if (const auto error = ring.write_head(head)) return failure(error);
    }
    if (const auto error = ring.sync()) return failure(error);
    return {};
  }

  Failure failure(std::error_code error) const {
    return io_failure(path_,
                      "the journal of " + mebibytes(static_cast<std::size_t>(journal_.file_bytes)) +
                          " MiB could not be made",
                      error);
  }

  std::string path_;
  const NewJournal& journal_;
};

}  // namespace

std::string unfinished_path(const std::string& path) {
  return path + ".new";
}

Expected<void> create_journal(FileSystem& file_system, const std::string& path, const NewJournal& journal) {
  const std::string unfinished = unfinished_path(path);
  Expected<void> written = Creation(unfinished, journal).write(file_system);
  if (written.ok()) {
    const std::error_code error = file_system.rename(unfinished, path);
    if (!error) return {};
    written = io_failure(path, "the new journal could not take this name", error);
  }
  std::ignore = file_system.remove(unfinished);  // else the next attempt empties it
  return written;
}

}  // namespace traygauge
