#include "firmware/support/archive.hpp"

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <array>
#include <memory>
#include <set>

namespace traygauge {
namespace {

using Writer = std::unique_ptr<archive, decltype(&archive_write_free)>;
using Reader = std::unique_ptr<archive, decltype(&archive_read_free)>;
using Entry = std::unique_ptr<archive_entry, decltype(&archive_entry_free)>;

constexpr std::size_t kGzipHeadBytes = 10;
constexpr std::size_t kGzipTailBytes = 8;

Failure archive_failure(archive* of, const char* otherwise) {
  const char* const text = archive_error_string(of);
  return Failure{text != nullptr ? text : otherwise};
}

la_ssize_t append_packed(archive* /*of*/, void* packed, const void* bytes, std::size_t count) {
  static_cast<std::string*>(packed)->append(static_cast<const char*>(bytes), count);
  return static_cast<la_ssize_t>(count);
}

bool write_entry(archive* writer, const ArchivedFile& file, std::int64_t unix_s) {
  const Entry entry(archive_entry_new(), archive_entry_free);
  archive_entry_set_pathname(entry.get(), file.name.c_str());
  archive_entry_set_size(entry.get(), static_cast<la_int64_t>(file.content.size()));
  archive_entry_set_filetype(entry.get(), AE_IFREG);
  archive_entry_set_perm(entry.get(), file.mode);
  archive_entry_set_mtime(entry.get(), unix_s, 0);
  if (archive_write_header(writer, entry.get()) != ARCHIVE_OK) return false;
  return archive_write_data(writer, file.content.data(), file.content.size()) ==
         static_cast<la_ssize_t>(file.content.size());
}

// Of gzip (RFC 1952), which libarchive does not check.
std::uint32_t gzip_crc32(std::string_view bytes) {
  static const auto table_of_bytes = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < table.size(); ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 8; ++bit) value = (value >> 1U) ^ ((value & 1U) != 0 ? 0xedb88320U : 0U);
      table[i] = value;
    }
    return table;
  }();
  std::uint32_t crc = 0xffffffffU;
  for (const char byte : bytes)
    crc = table_of_bytes[(crc ^ static_cast<std::uint8_t>(byte)) & 0xffU] ^ (crc >> 8U);
  return ~crc;
}

std::uint32_t little_endian_32(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = (value << 8U) | static_cast<std::uint8_t>(bytes[i]);
  return value;
}

// The tar, so that its sum is known before anything of it is looked at.
Expected<std::string> gunzip(std::string_view bytes) {
  // Each file has a head of 512 bytes and is filled up to the next 512; long names need more.
  constexpr std::size_t kMaxTarBytes = kMaxArchiveBytes + kMaxArchiveFiles * 4096;
  constexpr std::string_view kGzipWithoutExtras("\x1f\x8b\x08\x00", 4);
  if (!bytes.starts_with(kGzipWithoutExtras) || bytes.size() < kGzipHeadBytes + kGzipTailBytes)
    return Failure{"it is no tar.gz of this program's"};
  const Reader reader(archive_read_new(), archive_read_free);
  archive_read_support_filter_gzip(reader.get());
  archive_read_support_format_raw(reader.get());
  archive_entry* entry = nullptr;
  if (archive_read_open_memory(reader.get(), bytes.data(), bytes.size()) != ARCHIVE_OK ||
      archive_read_next_header(reader.get(), &entry) != ARCHIVE_OK) {
    return archive_failure(reader.get(), "it is damaged");
  }
  std::string tar;
  std::array<char, 65536> part{};
  for (;;) {
    const la_ssize_t count = archive_read_data(reader.get(), part.data(), part.size());
    if (count == 0) break;
    if (count < 0) return archive_failure(reader.get(), "it is damaged");
    tar.append(part.data(), static_cast<std::size_t>(count));
    if (tar.size() > kMaxTarBytes) return Failure{"it holds more than 64 MiB"};
  }
  const std::string_view tail = bytes.substr(bytes.size() - kGzipTailBytes);
  const bool is_whole =
      little_endian_32(tail) == gzip_crc32(tar) && little_endian_32(tail.substr(4)) == tar.size();
  if (!is_whole) return Failure{"it is damaged: its sum is wrong"};
  return tar;
}

Expected<void> check_entry(archive_entry* entry, std::size_t bytes_before, std::size_t files_before) {
  const char* const name = archive_entry_pathname(entry);
  if (name == nullptr || !is_archive_name(name))
    return Failure{"it holds a file whose path leads elsewhere, or is no path"};
  if (archive_entry_filetype(entry) != AE_IFREG || archive_entry_hardlink(entry) != nullptr)
    return Failure{std::string(name).append(" is a link, a folder or a device")};
  const la_int64_t bytes = archive_entry_size(entry);
  if (bytes < 0 || static_cast<std::uint64_t>(bytes) > kMaxArchiveBytes - bytes_before)
    return Failure{"it holds more than 64 MiB"};
  if (files_before >= kMaxArchiveFiles) return Failure{"it holds more than 1,000 files"};
  return {};
}

}  // namespace

bool is_archive_name(std::string_view name) {
  constexpr std::size_t kMaxNameBytes = 255;
  if (name.empty() || name.size() > kMaxNameBytes) return false;
  const auto is_control = [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return code < 0x20 || code == 0x7F;
  };
  if (std::any_of(name.begin(), name.end(), is_control)) return false;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    const std::string_view part = name.substr(begin, end - begin);
    if (part.empty() || part == "." || part == "..") return false;
    begin = end + 1;
  }
  return true;
}

Expected<std::string> pack_files(const std::vector<ArchivedFile>& files, std::int64_t unix_s) {
  std::string packed;
  const Writer writer(archive_write_new(), archive_write_free);
  archive_write_add_filter_gzip(writer.get());
  archive_write_set_filter_option(writer.get(), "gzip", "timestamp", nullptr);
  archive_write_set_format_gnutar(writer.get());
  archive_write_set_bytes_in_last_block(writer.get(), 1);  // the file ends where gzip's sum ends
  if (archive_write_open2(writer.get(), &packed, nullptr, append_packed, nullptr, nullptr) != ARCHIVE_OK)
    return archive_failure(writer.get(), "it cannot be packed");
  for (const ArchivedFile& file : files) {
    if (!write_entry(writer.get(), file, unix_s)) return archive_failure(writer.get(), "it cannot be packed");
  }
  if (archive_write_close(writer.get()) != ARCHIVE_OK)
    return archive_failure(writer.get(), "it cannot be packed");
  return packed;
}

Expected<std::vector<ArchivedFile>> unpack_files(std::string_view bytes) {
  const Expected<std::string> tar = gunzip(bytes);
  if (!tar.ok()) return Failure{tar.failure()};
  const Reader reader(archive_read_new(), archive_read_free);
  archive_read_support_format_tar(reader.get());
  if (archive_read_open_memory(reader.get(), tar->data(), tar->size()) != ARCHIVE_OK)
    return archive_failure(reader.get(), "it is no tar.gz");
  std::vector<ArchivedFile> files;
  std::set<std::string> names;
  std::size_t total_bytes = 0;
  archive_entry* entry = nullptr;
  int result = ARCHIVE_OK;
  while ((result = archive_read_next_header(reader.get(), &entry)) == ARCHIVE_OK) {
    if (const Expected<void> good = check_entry(entry, total_bytes, files.size()); !good.ok())
      return Failure{good.failure()};
    ArchivedFile file{archive_entry_pathname(entry), {}, archive_entry_perm(entry)};
    file.content.resize(static_cast<std::size_t>(archive_entry_size(entry)));
    total_bytes += file.content.size();
    const la_ssize_t count = archive_read_data(reader.get(), file.content.data(), file.content.size());
    if (count != static_cast<la_ssize_t>(file.content.size()))
      return archive_failure(reader.get(), "it is damaged: a file is too short");
    if (!names.insert(file.name).second) return Failure{"it holds " + file.name + " twice"};
    files.push_back(std::move(file));
  }
  if (result != ARCHIVE_EOF) return archive_failure(reader.get(), "it is damaged");
  for (const std::string& name : names) {
    for (std::size_t slash = name.find('/'); slash != std::string::npos; slash = name.find('/', slash + 1)) {
      if (names.contains(name.substr(0, slash))) return Failure{name + " lies in what is a file"};
    }
  }
  return files;
}

}  // namespace traygauge
