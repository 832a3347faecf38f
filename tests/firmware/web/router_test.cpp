#include "firmware/web/router.hpp"

#include <gtest/gtest.h>

namespace traygauge::test {
namespace {

Route route(const char* method, const char* pattern) {
  return {method, pattern, Role::view, 0, [](const HttpRequest&) { return json_response("{}"); }};
}

TEST(Routes, AreFoundByMethodAndPath) {
  Router router;
  router.add(route("GET", "/api/v1/scans"));
  router.add(route("GET", "/api/v1/scans/latest"));
  router.add(route("GET", "/api/v1/scans/{id}"));
  router.add(route("DELETE", "/api/v1/scans/{id}"));
  router.add(route("GET", "/api/v1/scans/{id}/maps/{kind}"));

  EXPECT_EQ(router.find("GET", {"api", "v1", "scans"}).route->pattern, "/api/v1/scans");
  EXPECT_EQ(router.find("GET", {"api", "v1", "scans", "latest"}).route->pattern, "/api/v1/scans/latest");
  const FoundRoute map = router.find("HEAD", {"api", "v1", "scans", "hall-7", "maps", "height"});
  ASSERT_NE(map.route, nullptr);
  EXPECT_EQ(map.parameters, (NamedTexts{{"id", "hall-7"}, {"kind", "height"}}));

  const FoundRoute wrong_method = router.find("POST", {"api", "v1", "scans", "hall-7"});
  EXPECT_EQ(wrong_method.route, nullptr);
  EXPECT_EQ(wrong_method.methods, (std::vector<std::string>{"GET", "HEAD", "DELETE"}));
  for (const std::vector<std::string>& path :
       {std::vector<std::string>{}, {"api"}, {"api", "v1", "scans", "a", "b"}, {"API", "v1", "scans"}}) {
    EXPECT_TRUE(router.find("GET", path).methods.empty());
  }
}

TEST(Routes, MayStandAtTheRoot) {
  Router router;
  router.add(route("GET", "/"));
  EXPECT_NE(router.find("GET", {}).route, nullptr);
  EXPECT_EQ(router.find("GET", {"a"}).route, nullptr);
}

TEST(Roles, MayDoWhatThoseBelowMay) {
  EXPECT_TRUE(is_enough(Role::kiosk, Role::view));
  EXPECT_TRUE(is_enough(Role::manage, Role::view));
  EXPECT_TRUE(is_enough(Role::view, Role::view));
  EXPECT_FALSE(is_enough(Role::none, Role::view));
  EXPECT_FALSE(is_enough(Role::view, Role::manage));
  EXPECT_FALSE(is_enough(Role::kiosk, Role::manage));
}

}  // namespace
}  // namespace traygauge::test
