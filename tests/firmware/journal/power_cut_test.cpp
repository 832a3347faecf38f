// The model of a power cut itself: what it may lose, and what not.
#include "tests/support/power_cut.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <span>
#include <string>

namespace traygauge::test {
namespace {

std::string text_on(const DiskImage& image, const std::string& path) {
  const auto found = image.find(path);
  if (found == image.end()) return "absent";
  std::string text;
  for (const std::byte byte : found->second) text.push_back(std::to_integer<char>(byte));
  return text;
}

// A file with `text` that outlasts everything.
DiskImage disk_with(const std::string& path, const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {{path, Bytes(bytes.begin(), bytes.end())}};
}

void write_text(File& file, std::uint64_t offset_bytes, const std::string& text) {
  EXPECT_FALSE(file.write_at(offset_bytes, std::as_bytes(std::span(text))));
}

std::unique_ptr<File> opened(RecordedFileSystem& disk, const std::string& path,
                             OpenMode mode = OpenMode::existing) {
  auto result = disk.open(path, mode);
  EXPECT_TRUE(result.ok());
  return std::move(result.value);
}

// Of all choices now; at most 2^16 states.
std::set<std::string> texts_after_cut(const RecordedFileSystem& disk, const std::string& path) {
  const PowerCut cut(disk, disk.operations().size());
  EXPECT_LE(cut.choice_count(), 16U);
  std::set<std::string> texts;
  for (std::uint32_t state = 0; state < 1U << cut.choice_count(); ++state) {
    texts.insert(text_on(cut.state([&](std::size_t choice) { return (state >> choice & 1) != 0; }), path));
  }
  return texts;
}

TEST(PowerCut, LosesOrKeepsASectorUntilItIsSynced) {
  RecordedFileSystem disk(disk_with("a", "old"));
  const auto file = opened(disk, "a");
  write_text(*file, 0, "new");
  EXPECT_EQ(texts_after_cut(disk, "a"), (std::set<std::string>{"old", "new"}));
  EXPECT_FALSE(file->sync_data());
  EXPECT_EQ(texts_after_cut(disk, "a"), (std::set<std::string>{"new"}));
  write_text(*file, 0, "NEW");
  EXPECT_EQ(texts_after_cut(disk, "a"), (std::set<std::string>{"new", "NEW"}));
}

TEST(PowerCut, TearsAWriteBetweenSectorsInAnyOrder) {
  RecordedFileSystem disk(disk_with("a", std::string(1024, 'o')));
  const auto file = opened(disk, "a");
  write_text(*file, 510, "nnnn");
  const std::string left(510, 'o');
  const std::string right(510, 'o');
  EXPECT_EQ(texts_after_cut(disk, "a"),
            (std::set<std::string>{left + "oooo" + right, left + "nnoo" + right, left + "oonn" + right,
                                   left + "nnnn" + right}));
}

TEST(PowerCut, MayKeepALaterWriteAndLoseAnEarlierOne) {
  RecordedFileSystem disk(disk_with("a", std::string(1024, 'o')));
  const auto file = opened(disk, "a");
  write_text(*file, 0, "1");
  write_text(*file, 600, "2");
  const auto texts = texts_after_cut(disk, "a");
  EXPECT_EQ(texts.size(), 4U);
  std::string later_alone(1024, 'o');
  later_alone[600] = '2';
  EXPECT_TRUE(texts.contains(later_alone));
}

TEST(PowerCut, LosesANewNameUntilItsFolderIsSynced) {
  RecordedFileSystem disk;
  const auto file = opened(disk, "folder/a", OpenMode::emptied);
  write_text(*file, 0, "x");
  EXPECT_FALSE(file->sync_data());
  EXPECT_EQ(texts_after_cut(disk, "folder/a"), (std::set<std::string>{"absent", "x"}));
  EXPECT_FALSE(disk.sync_folder_of("other/a"));
  EXPECT_EQ(texts_after_cut(disk, "folder/a"), (std::set<std::string>{"absent", "x"}));
  EXPECT_FALSE(disk.sync_folder_of("folder/a"));
  EXPECT_EQ(texts_after_cut(disk, "folder/a"), (std::set<std::string>{"x"}));
}

TEST(PowerCut, RenamesInOneStepAndMayUncoverAFileThatWasNotSynced) {
  RecordedFileSystem disk(disk_with("a", "old"));
  const auto file = opened(disk, "b", OpenMode::emptied);
  write_text(*file, 0, "new");
  EXPECT_FALSE(disk.rename("b", "a"));
  EXPECT_EQ(texts_after_cut(disk, "a"), (std::set<std::string>{"old", "", std::string(3, '\0'), "new"}));
  EXPECT_FALSE(file->sync_data());
  EXPECT_EQ(texts_after_cut(disk, "a"), (std::set<std::string>{"old", "new"}));
}

TEST(PowerCut, MayLoseARemovalAndANewSize) {
  RecordedFileSystem disk(disk_with("a", "old"));
  EXPECT_FALSE(opened(disk, "a")->reserve(5));
  EXPECT_EQ(texts_after_cut(disk, "a"), (std::set<std::string>{"old", std::string("old\0\0", 5)}));
  EXPECT_FALSE(disk.remove("a"));
  EXPECT_EQ(texts_after_cut(disk, "a"), (std::set<std::string>{"old", std::string("old\0\0", 5), "absent"}));
}

TEST(PowerCut, DoubtsForGoodWhatASyncFailedOn) {
  RecordedFileSystem disk(disk_with("a", "old"));
  const auto file = opened(disk, "a");
  write_text(*file, 0, "new");
  disk.set_fault(Fault{});
  EXPECT_EQ(file->sync_data(), std::errc::io_error);
  EXPECT_FALSE(file->sync_data());
  EXPECT_EQ(texts_after_cut(disk, "a"), (std::set<std::string>{"old", "new"}));
  write_text(*file, 0, "NEW");
  EXPECT_FALSE(file->sync_data());
  EXPECT_EQ(texts_after_cut(disk, "a"), (std::set<std::string>{"NEW"}));
}

TEST(PowerCut, LooksAtAnyMoment) {
  RecordedFileSystem disk(disk_with("a", "0"));
  const auto file = opened(disk, "a");
  write_text(*file, 0, "1");
  EXPECT_FALSE(file->sync_data());
  write_text(*file, 0, "2");
  const auto all = [](std::size_t) { return true; };
  EXPECT_EQ(text_on(PowerCut(disk, 0).state(all), "a"), "0");
  EXPECT_EQ(text_on(PowerCut(disk, 1).state(all), "a"), "1");
  EXPECT_EQ(PowerCut(disk, 2).choice_count(), 0U);
  EXPECT_EQ(text_on(PowerCut(disk, 3).state(all), "a"), "2");
}

TEST(PowerCut, SamplesEveryStateOfAFewSectors) {
  RecordedFileSystem disk(disk_with("a", std::string(2048, 'o')));
  write_text(*opened(disk, "a"), 0, std::string(2048, 'n'));
  const PowerCut cut(disk, 1);
  std::mt19937 random(1);
  std::set<std::string> texts;
  for (int i = 0; i < 2000; ++i) texts.insert(text_on(cut.sample(random), "a"));
  EXPECT_EQ(texts.size(), 16U);
}

TEST(RecordedFileSystem, AKilledProcessChangesNothingMore) {
  RecordedFileSystem disk(disk_with("a", "old"));
  const auto file = opened(disk, "a");
  EXPECT_FALSE(file->try_lock());
  Fault fault;
  fault.kills_process = true;
  disk.set_fault(fault);
  EXPECT_TRUE(file->write_at(0, std::as_bytes(std::span(std::string_view("nn")))));
  EXPECT_EQ(text_on(disk.image(), "a"), "nld") << "half of the write";
  disk.set_fault(std::nullopt);
  EXPECT_EQ(file->write_at(0, std::as_bytes(std::span(std::string_view("zz")))),
            std::errc::bad_file_descriptor);
  EXPECT_EQ(text_on(disk.image(), "a"), "nld");
  EXPECT_FALSE(opened(disk, "a")->try_lock());
}

}  // namespace
}  // namespace traygauge::test
