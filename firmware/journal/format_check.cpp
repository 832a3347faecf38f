#include "firmware/journal/format_check.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <span>

#include "firmware/journal/journal_block.hpp"
#include "firmware/journal/scan_counter.hpp"

namespace traygauge {
namespace {

using Block = std::array<std::byte, kBlockBytes>;

// The block at the beginning or, from the end, the last one; none where there is no such block.
Expected<std::optional<Block>> read_block(const std::filesystem::path& file, bool is_last) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    if (errno == ENOENT) return std::optional<Block>();
    return Failure{file.string() + ": cannot be opened: " + std::strerror(errno)};
  }
  if (is_last) stream.seekg(-static_cast<std::streamoff>(kBlockBytes), std::ios::end);
  Block block{};
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): bytes of a file
  stream.read(reinterpret_cast<char*>(block.data()), kBlockBytes);
  if (!stream) return std::optional<Block>();
  return std::optional(block);
}

template <class IsNewer>
Expected<void> check_both(const std::filesystem::path& file, const char* what, const IsNewer& is_newer) {
  for (const bool is_last : {false, true}) {
    const Expected<std::optional<Block>> block = read_block(file, is_last);
    if (!block.ok()) return Failure{block.failure()};
    if (*block && is_newer(**block))
      return Failure{file.string() + ": a newer program wrote this " + what +
                     ". Install that program again."};
  }
  return {};
}

}  // namespace

Expected<void> check_journal_format(const std::filesystem::path& file) {
  return check_both(file, "journal", [](const Block& block) {
    JournalHead head;
    return decode_head(block, head) == HeadState::newer_version;
  });
}

Expected<void> check_counter_format(const std::filesystem::path& file) {
  return check_both(file, "counter of scans",
                    [](const Block& block) { return ScanCounter::is_newer(block); });
}

}  // namespace traygauge
