#include "firmware/web/static_files.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.hpp"

namespace traygauge::test {
namespace {

HttpRequest request_for(std::vector<std::string> segments, bool is_folder = false, NamedTexts headers = {}) {
  HttpRequest request;
  request.method = "GET";
  request.segments = std::move(segments);
  request.is_folder = is_folder;
  request.headers = std::move(headers);
  return request;
}

std::string body_of(const HttpResponse& response) {
  const auto* const text = std::get_if<std::shared_ptr<const std::string>>(&response.body);
  return text == nullptr ? std::get<std::string>(response.body) : **text;
}

TEST(PageFiles, AreServedWithTheirTypes) {
  StaticFiles files;
  ASSERT_TRUE(files.add("index.html", "<p>").ok());
  ASSERT_TRUE(files.add("page.js", "let a;").ok());
  ASSERT_TRUE(files.add("help/index.html", "help").ok());
  EXPECT_EQ(files.answer(request_for({"page.js"})).content_type, "text/javascript; charset=utf-8");
  EXPECT_EQ(body_of(files.answer(request_for({}))), "<p>");
  EXPECT_EQ(body_of(files.answer(request_for({"help"}, true))), "help");
  EXPECT_FALSE(files.holds(request_for({"help"})));
  EXPECT_FALSE(files.holds(request_for({"page.js"}, true)));
  EXPECT_EQ(files.answer(request_for({"absent.js"})).status, 404);
}

TEST(PageFiles, AreSentOnceToWhoHasThem) {
  StaticFiles files;
  ASSERT_TRUE(files.add("a.css", "one").ok());
  ASSERT_TRUE(files.add("b.css", "two").ok());
  const HttpResponse first = files.answer(request_for({"a.css"}));
  const std::string tag = *find_text(first.headers, "ETag");
  EXPECT_NE(tag, *find_text(files.answer(request_for({"b.css"})).headers, "ETag"));
  EXPECT_EQ(*find_text(first.headers, "Cache-Control"), "no-cache");
  for (const std::string& known : {tag, "W/" + tag, "\"x\", " + tag + " ", std::string("*")})
    EXPECT_EQ(files.answer(request_for({"a.css"}, false, {{"if-none-match", known}})).status, 304) << known;
  for (const std::string& other :
       {std::string(), std::string("\"x\""), std::string(",,, ,W/"), tag.substr(1)})
    EXPECT_EQ(files.answer(request_for({"a.css"}, false, {{"if-none-match", other}})).status, 200) << other;
}

TEST(PageFiles, AreReadAtTheStartAndNotLater) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "index.html") << "page";
  std::ofstream(folder.path() / "secret.txt") << "secret";
  StaticFiles files;
  ASSERT_TRUE(files.read(folder.path(), {"index.html"}).ok());
  std::ofstream(folder.path() / "index.html") << "changed";
  EXPECT_EQ(body_of(files.answer(request_for({"index.html"}))), "page");
  EXPECT_FALSE(files.holds(request_for({"secret.txt"}))) << "not on the list";
  const auto absent = StaticFiles().read(folder.path(), {"absent.js"});
  ASSERT_FALSE(absent.ok());
  EXPECT_NE(absent.failure().find("absent.js"), std::string::npos);
}

TEST(PageFiles, AreLimited) {
  StaticFiles files;
  EXPECT_FALSE(files.add("program.exe", "x").ok());
  EXPECT_FALSE(files.add("big.js", std::string(StaticFiles::kMaxBytes + 1, 'x')).ok());
  EXPECT_TRUE(files.add("a.js", "x").ok());
  EXPECT_FALSE(files.add("a.js", "y").ok());
}

}  // namespace
}  // namespace traygauge::test
