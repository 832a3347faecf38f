#include "firmware/hub/page_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <variant>

#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

void write(const std::filesystem::path& file, const std::string& content) {
  std::ofstream(file) << content;
}

std::string body_of(const StaticFiles& files, const HttpRequest& request) {
  return *std::get<std::shared_ptr<const std::string>>(files.answer(request).body);
}

HttpRequest request_of(std::vector<std::string> segments) {
  HttpRequest request;
  request.method = "GET";
  request.segments = std::move(segments);
  return request;
}

TEST(PageFiles, OfAFolderAreServedAndNothingElse) {
  const TemporaryFolder folder;
  write(folder.path() / "index.html", "<!doctype html>");
  write(folder.path() / "page.js", "export {};");
  write(folder.path() / "README.md", "For who edits the page.");
  std::filesystem::create_directory(folder.path() / "pictures");
  write(folder.path() / "pictures" / "live.png", "png");
  StaticFiles files;
  ASSERT_TRUE(read_page(folder.path(), files).ok());
  EXPECT_EQ(body_of(files, request_of({})), "<!doctype html>");
  EXPECT_EQ(body_of(files, request_of({"page.js"})), "export {};");
  EXPECT_FALSE(files.holds(request_of({"README.md"})));
  EXPECT_FALSE(files.holds(request_of({"pictures", "live.png"})));
}

TEST(PageFiles, WithoutContentAreRefusedByName) {
  const TemporaryFolder folder;
  write(folder.path() / "index.html", "");
  StaticFiles files;
  const Expected<void> read = read_page(folder.path(), files);
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.failure().find("index.html"), std::string::npos) << read.failure();
}

TEST(PageFiles, OfNoFolderAreRefused) {
  StaticFiles files;
  EXPECT_FALSE(read_page("/no/such/folder", files).ok());
}

}  // namespace
}  // namespace traygauge::test
