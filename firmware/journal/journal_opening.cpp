#include "firmware/journal/journal_opening.hpp"

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include "core/base/crc32c.hpp"
#include "firmware/base/text.hpp"
#include "firmware/journal/io_failure.hpp"
#include "firmware/journal/journal_block.hpp"
#include "firmware/journal/journal_creation.hpp"
#include "firmware/journal/kept_aside.hpp"

namespace traygauge {
namespace {

using Kind = JournalNotice::Kind;

JournalNotice notice_of(Kind kind, std::string text) {
  JournalNotice notice;
  notice.kind = kind;
  notice.text = std::move(text);
  return notice;
}

std::string in_mebibytes(std::uint64_t bytes) {
  return mebibytes(static_cast<std::size_t>(bytes)) + " MiB";
}

// The state of one head; one that cannot be read counts as damaged.
struct FoundHead {
  HeadState state = HeadState::damaged;
  JournalHead head;
};

bool is_usable(const JournalHead& head) {
  const std::uint64_t blocks = head.file_bytes / kBlockBytes;
  return head.file_bytes % kBlockBytes == 0 && blocks > kHeadsInFile && head.file_bytes <= kMaxJournalBytes &&
         head.oldest.block < blocks - kHeadsInFile && head.next_block < blocks - kHeadsInFile &&
         head.oldest.sequence > 0 && head.oldest.sequence <= head.next_sequence;
}

FoundHead read_head(File& file, std::uint64_t offset_bytes) {
  std::array<std::byte, kBlockBytes> block{};
  FoundHead found;
  const auto read = file.read_at(offset_bytes, block);
  if (!read.ok()) return found;
  found.state = decode_head(block, found.head);
  if (found.state == HeadState::intact && !is_usable(found.head)) found.state = HeadState::damaged;
  return found;
}

class Opening {
 public:
  Opening(FileSystem& file_system, std::string path, std::uint64_t file_bytes,
          std::vector<JournalNotice>& notices)
      : file_system_(file_system), path_(std::move(path)), file_bytes_(file_bytes), notices_(notices) {}

  Expected<OpenedJournal> run() {
    if (auto made = make_where_absent(); !made.ok()) return Failure{made.failure()};
    auto opened = load_and_resize();
    if (!opened.ok()) return opened;
    // The name itself may be new: of this program, or of one that was killed before it came to this.
    if (const auto error = file_system_.sync_folder_of(path_)) {
      return io_failure(path_, "the folder of the journal could not be written", error);
    }
    return opened;
  }

 private:
  Expected<void> make_where_absent() {
    std::ignore =
        file_system_.remove(unfinished_path(path_));  // of a program that was killed while it made one
    const auto opened = file_system_.open(path_, OpenMode::existing);
    std::string why = ": a new journal was made here.";
    if (opened.ok()) {
      const auto size = opened.value->size_bytes();
      if (!size.ok()) return io_failure(path_, "the journal could not be read", size.error);
      if (size.value != 0) return {};
      why = ": the file was empty. A new journal was made here; results that waited before are lost.";
    } else if (opened.error != std::errc::no_such_file_or_directory) {
      return io_failure(path_, "the journal could not be opened", opened.error);
    }
    NewJournal empty;
    empty.file_bytes = file_bytes_;
    auto created = create_journal(file_system_, path_, empty);
    if (created.ok()) notices_.push_back(notice_of(Kind::created, path_ + why));
    return created;
  }

  Expected<OpenedJournal> load_and_resize() {
    auto opened = load(notices_);
    if (!opened.ok()) return opened;
    const bool is_all_kept = keep_damage_aside(*opened);
    const bool is_of_size = opened->ring->file_bytes() == file_bytes_ && !is_cut_off_;
    // What could not be kept aside lies in this file alone: it stays until a start at which it can.
    if (is_of_size || !is_all_kept) return opened;
    resize(*opened);
    // By its name: only so it is sure which of two files was opened.
    std::vector<JournalNotice> told_already;
    return load(told_already);
  }

  Expected<OpenedJournal> load(std::vector<JournalNotice>& notices) {
    auto opened = file_system_.open(path_, OpenMode::existing);
    if (!opened.ok()) return io_failure(path_, "the journal could not be opened", opened.error);
    const auto size = opened.value->size_bytes();
    if (!size.ok()) return io_failure(path_, "the journal could not be read", size.error);
    auto head = choose_head(*opened.value, size.value, notices);
    if (!head.ok()) return Failure{head.failure()};
    is_cut_off_ = size.value < head->file_bytes;
    if (is_cut_off_) {
      notices.push_back(notice_of(Kind::cut_off, path_ + ": the file has " + in_mebibytes(size.value) +
                                                     " instead of " + in_mebibytes(head->file_bytes) +
                                                     ". What is left of it is used. Check the disk."));
    }
    OpenedJournal journal;
    journal.ring = std::make_unique<JournalRing>(std::move(opened.value), head->journal_id, head->file_bytes);
    journal.content = scan_ring(*journal.ring, *head);
    journal.head = *head;
    return journal;
  }

  // The newer intact one.
  Expected<JournalHead> choose_head(File& file, std::uint64_t size_bytes,
                                    std::vector<JournalNotice>& notices) const {
    const FoundHead first = read_head(file, 0);
    // Where the first head is lost, the last one stands at the end of the file.
    const std::uint64_t bytes =
        first.state == HeadState::intact ? first.head.file_bytes : size_bytes / kBlockBytes * kBlockBytes;
    const FoundHead last = bytes < 2 * kBlockBytes ? FoundHead{} : read_head(file, bytes - kBlockBytes);
    const bool has_first = first.state == HeadState::intact;
    const bool has_last = last.state == HeadState::intact && last.head.file_bytes == bytes;
    if (!has_first && !has_last) return refusal(first.state, last.state);
    if (!has_first || !has_last) {
      notices.push_back(notice_of(Kind::head_repaired,
                                  path_ + ": the " + (has_first ? "last" : "first") +
                                      " block was not whole, after a power cut or by damage. The journal was "
                                      "opened by its twin."));
    }
    if (!has_last) return first.head;
    if (!has_first) return last.head;
    return first.head.generation > last.head.generation ? first.head : last.head;
  }

  Failure refusal(HeadState first, HeadState last) const {
    if (first == HeadState::newer_version || last == HeadState::newer_version) {
      return {path_ +
              ": a newer program wrote this journal. Install that program again, or move the file away; "
              "results that wait in it then stay there."};
    }
    if (first == HeadState::foreign) {
      return {path_ +
              ": this file is not a journal of Traygauge. Correct the path, or move the file away; it was "
              "not changed."};
    }
    return {path_ +
            ": the first and the last block of this journal are damaged. Check the disk, and move the file "
            "away; a new one is then made. It was not changed."};
  }

  // Whether all of it is in files of its own now.
  bool keep_damage_aside(OpenedJournal& journal) {
    bool is_all_kept = true;
    for (const MissingRecords& missing : journal.content.missing) {
      notices_.push_back(keep_remains(file_system_, path_, *journal.ring, Kind::damaged, missing));
      if (notices_.back().kept_in.empty()) is_all_kept = false;
    }
    if (!journal.content.interrupted) return is_all_kept;
    const MissingRecords& remains = *journal.content.interrupted;
    notices_.push_back(keep_remains(file_system_, path_, *journal.ring, Kind::interrupted, remains));
    if (notices_.back().kept_in.empty()) return false;
    std::ignore = journal.ring->erase_block(remains.position);  // told once; else again at the next start
    return is_all_kept;
  }

  void resize(const OpenedJournal& journal) {
    const auto& records = journal.content.records;
    std::uint64_t blocks = kHeadsInFile;
    for (const RecordEntry& record : records) blocks += record.blocks();
    const std::string sizes = in_mebibytes(journal.ring->file_bytes());
    if (blocks * kBlockBytes > file_bytes_) {
      notices_.push_back(notice_of(Kind::size_kept, path_ + ": what waits does not fit into the configured " +
                                                        in_mebibytes(file_bytes_) +
                                                        ". The journal keeps its " + sizes +
                                                        " until a start at which it fits."));
      return;
    }
    NewJournal wanted{file_bytes_, journal.content.next_sequence, {records.begin(), records.end()}, {}};
    wanted.read_payload = [&](const RecordEntry& record) -> Expected<std::string> {
      ReadRecord read = journal.ring->read_record(record);
      if (read.error) return io_failure(path_, "a record could not be read", read.error);
      if (!read.payload) return Failure{path_ + ": a record is damaged. Check the disk."};
      return *std::move(read.payload);
    };
    const auto created = create_journal(file_system_, path_, wanted);
    notices_.push_back(
        created.ok()
            ? notice_of(Kind::resized, path_ + ": the journal was changed from " + sizes + " to " +
                                           in_mebibytes(file_bytes_) + ".")
            : notice_of(Kind::size_kept, created.failure() + " The journal keeps its " + sizes + "."));
  }

  FileSystem& file_system_;
  std::string path_;
  std::uint64_t file_bytes_ = 0;
  std::vector<JournalNotice>& notices_;
  bool is_cut_off_ = false;
};

std::string hexadecimal(std::uint32_t number) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (int shift = 28; shift >= 0; shift -= 4) text.push_back(kDigits[(number >> shift) & 0xf]);
  return text;
}

// One name for the same bytes, so that no start writes them again.
std::string aside_path(const std::string& path, Kind kind, const MissingRecords& remains,
                       std::span<const std::byte> bytes) {
  // Power cuts come often in some kitchens: one file is enough for what they interrupt.
  if (kind == Kind::interrupted) return path + ".interrupted";
  return path + ".damaged-" + std::to_string(remains.first_sequence) + "-" + hexadecimal(crc32c(bytes));
}

std::string remains_text(const std::string& path, const JournalNotice& notice) {
  std::string text = path + ": ";
  if (notice.kind == Kind::interrupted) {
    text += "the newest record, number " + std::to_string(notice.first_sequence) +
            ", is not whole: a power cut interrupted its append, or the disk damaged it since.";
  } else if (notice.first_sequence == notice.last_sequence) {
    text += "record " + std::to_string(notice.first_sequence) + " is damaged.";
  } else {
    text += "records " + std::to_string(notice.first_sequence) + " to " +
            std::to_string(notice.last_sequence) + " are damaged.";
  }
  return text;
}

}  // namespace

JournalNotice keep_remains(FileSystem& file_system, const std::string& path, JournalRing& ring, Kind kind,
                           const MissingRecords& remains) {
  JournalNotice notice;
  notice.kind = kind;
  notice.first_sequence = remains.first_sequence;
  notice.last_sequence = remains.last_sequence;
  notice.bytes = std::uint64_t{remains.blocks} * kBlockBytes;
  notice.text = remains_text(path, notice);
  bool unreadable = false;
  const std::vector<std::byte> bytes = ring.read_blocks(remains.position, remains.blocks, unreadable);
  std::string aside = aside_path(path, kind, remains, bytes);
  const auto kept = keep_aside(file_system, aside, bytes);
  if (kept.ok()) {
    notice.text += " The " + std::to_string(notice.bytes) + " bytes are kept in " + aside + ".";
    notice.kept_in = std::move(aside);
  } else {
    notice.text += " " + kept.failure();
  }
  if (kind == Kind::damaged) notice.text += " Check the disk or card.";
  return notice;
}

Expected<OpenedJournal> open_journal_file(FileSystem& file_system, const std::string& path,
                                          std::uint64_t file_bytes, std::vector<JournalNotice>& notices) {
  return Opening(file_system, path, file_bytes, notices).run();
}

}  // namespace traygauge
