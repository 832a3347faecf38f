// Every answer that openapi.yaml describes is provoked; HubRig holds each against it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "tests/firmware/api/hub_rig.hpp"
#include "tests/firmware/api/token_files.hpp"
#include "tests/firmware/store/sample_shape.hpp"

namespace traygauge::test {
namespace {

const std::string kJsonBody = "Content-Type: application/json\r\n";
const std::string kRename = R"({"action":"rename","item":2,"food":"peas","author":"ann"})";

struct Operation {
  std::string method;
  std::string path;  // as described, with {id}
  std::string role;

  bool is(const std::string& wanted) const { return method + " " + path == wanted; }
  bool is_login() const { return path == "/api/v1/login"; }
  bool is_described_with(int status) const {
    std::string answer = method;
    answer += " " + path + " " + std::to_string(status);
    return ApiDescription::own().answers().contains(answer);
  }
  std::string target(const std::string& id = "kitchen-1") const {
    const std::size_t at = path.find("{id}");
    return at == std::string::npos ? path : std::string(path).replace(at, 4, id);
  }
  std::string body() const {
    if (is_login()) return std::string(R"({"token":")") + TokenFiles::kManage + "\"}";
    if (is("POST /api/v1/next-tray")) return R"({"foods":3})";
    return is("POST /api/v1/scans/{id}/corrections") ? kRename : std::string();
  }
  std::string type() const { return is_login() ? kJsonBody : std::string(); }
};

std::vector<Operation> all_operations() {
  std::vector<Operation> operations;
  for (const auto& [name, role] : ApiDescription::own().operations()) {
    const std::size_t space = name.find(' ');
    operations.push_back({name.substr(0, space), name.substr(space + 1), role});
  }
  return operations;
}

// Sends the operation to all who are described to answer it so.
template <class Send>
void expect_each(int status, Send send) {
  for (const Operation& operation : all_operations()) {
    if (!operation.is_described_with(status)) continue;
    EXPECT_EQ(send(operation).status, status) << operation.method << " " << operation.path;
  }
}

void expect_success(const HubRig& rig) {
  for (const Operation& operation : all_operations()) {
    if (operation.is_login()) continue;  // here is no token
    const bool is_endless = operation.is("GET /api/v1/events");
    const Answer answer = is_endless
                              ? rig.listen("heartbeat").answer
                              : rig.request(operation.method, operation.target(), {}, operation.body());
    EXPECT_LT(answer.status, 300) << operation.path << answer.body;
  }
}

void expect_refusals(const HubRig& rig) {
  const auto with_header = [&rig](const std::string& header) {
    return [&rig, header](const Operation& operation) {
      return rig.request(operation.method, operation.target(), operation.type() + header, operation.body());
    };
  };
  expect_each(400, [&rig](const Operation& operation) {
    return rig.request(operation.method, operation.target() + "?limit=%zz", {}, operation.body());
  });
  expect_each(403, with_header("Sec-Fetch-Site: cross-site\r\n"));
  expect_each(421, with_header("Host: elsewhere.example\r\n"));
  expect_each(413, [&rig](const Operation& operation) {
    return rig.request(operation.method, operation.target(), operation.type(), std::string(20'000, 'x'));
  });
  expect_each(415, [&rig](const Operation& operation) {
    return rig.request(operation.method, operation.target(), {}, operation.body());
  });
  EXPECT_EQ(
      rig.post("/api/v1/scans/kitchen-1/corrections", R"({"action":"item_wrong","item":99,"author":"ann"})")
          .status,
      409);
}

void expect_absence_told(HubRig& rig) {
  rig.lose_station();
  EXPECT_EQ(rig.post("/api/v1/next-tray", R"({"foods":3})").status, 409);
  EXPECT_EQ(rig.request("DELETE", "/api/v1/next-tray", {}, {}).status, 409);
}

void expect_nothing_found(const HubRig& empty) {
  expect_each(404, [&empty](const Operation& operation) {
    return empty.request(operation.method, operation.target(), {}, operation.body());
  });
}

void expect_tokens_asked_for(const HubRig& rig) {
  expect_each(401, [&rig](const Operation& operation) {
    return rig.request(operation.method, operation.target(), operation.type(),
                       operation.is_login() ? R"({"token":"wrong"})" : operation.body());
  });
  const Operation login{"POST", "/api/v1/login", "none"};
  const Answer answer = rig.request(login.method, login.path, login.type(), login.body());
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.json(), nlohmann::json({{"role", "manage"}, {"name", "ann"}}));
  const std::string cookie = answer.header("Set-Cookie").value_or("");
  const std::string session = "Cookie: " + cookie.substr(0, cookie.find(';')) + "\r\n";
  EXPECT_EQ(rig.get("/api/v1/session", session).json()["name"], "ann");
}

// The last of a rig: from then on it refuses right tokens, too.
void expect_patience_to_end(const HubRig& rig) {
  for (int i = 0; i < 10; ++i) rig.get("/api/v1/session", TokenFiles::bearer("wrong"));
  expect_each(429, [&rig](const Operation& operation) {
    return rig.request(operation.method, operation.target(),
                       operation.type() + TokenFiles::bearer(TokenFiles::kManage), operation.body());
  });
}

void expect_failing_store(HubRig& rig) {
  rig.lose_store();
  std::array<Listening, 128> all;
  for (Listening& one : all) one = rig.listen("heartbeat");
  expect_each(503, [&rig](const Operation& operation) {
    return rig.request(operation.method, operation.target(), {}, operation.body());
  });
}

void expect_same(const std::set<std::string>& described, const std::set<std::string>& given) {
  std::vector<std::string> missing;
  std::set_difference(described.begin(), described.end(), given.begin(), given.end(),
                      std::back_inserter(missing));
  for (const std::string& answer : missing) ADD_FAILURE() << "described, but not given here: " << answer;
}

TEST(ApiAnswers, EachThatIsDescribedIsGiven) {
  const TokenFiles tokens;
  HubRig open;
  const HubRig empty;
  const HubRig guarded(tokens.config());
  HubRig lost;
  open.station().tell({MessageType::shape, R"({"id":"kitchen-1"})", sample_shape({"kitchen", 1}).dump()},
                      Milliseconds(1000));
  open.station().tell({MessageType::picture, R"({"id":"kitchen-1"})", "\xFF\xD8\xFF"}, Milliseconds(1000));
  open.store(1, 100.0);
  expect_success(open);
  expect_refusals(open);
  expect_absence_told(open);
  expect_nothing_found(empty);
  expect_tokens_asked_for(guarded);
  expect_patience_to_end(guarded);
  expect_failing_store(lost);
  std::set<std::string> given;
  for (const HubRig* const rig : std::initializer_list<const HubRig*>{&open, &empty, &guarded, &lost})
    given.insert(rig->answers().begin(), rig->answers().end());
  expect_same(ApiDescription::own().answers(), given);
}

TEST(ApiAnswers, EachOperationAsksForTheRoleDescribed) {
  const TokenFiles tokens;
  HubRig rig(tokens.config());
  rig.store(1, 100.0);
  for (const Operation& operation : all_operations()) {
    if (operation.role != "manage") continue;
    const Answer answer = rig.request(operation.method, operation.target(),
                                      TokenFiles::bearer(TokenFiles::kView), operation.body());
    EXPECT_EQ(answer.status, 403) << operation.path;
    EXPECT_EQ(answer.json()["error"]["code"], "role_too_low") << operation.path;
  }
  EXPECT_EQ(ApiDescription::own().operations(), rig.routes());
}

// What is not in the description is refused, as it says.
TEST(ApiAnswers, WhatIsNotDescribedIsRefused) {
  HubRig rig;
  EXPECT_EQ(rig.get("/api/v1/nothing").status, 404);
  const Answer answer = rig.request("DELETE", "/api/v1/scans", {}, {});
  EXPECT_EQ(answer.status, 405);
  EXPECT_EQ(answer.header("Allow"), "GET, HEAD");
}

TEST(ApiAnswers, AHeadIsAnsweredLikeAGetAndASlashAtTheEndDoesNotMatter) {
  HubRig rig;
  rig.store(1, 100.0);
  for (const Operation& operation : all_operations()) {
    if (operation.method != "GET" || operation.is("GET /api/v1/events")) continue;
    const Answer got = rig.get(operation.target());
    EXPECT_EQ(rig.request("HEAD", operation.target(), {}, {}).status, got.status) << operation.path;
    EXPECT_EQ(rig.get(operation.target() + "/").status, got.status) << operation.path;
  }
}

}  // namespace
}  // namespace traygauge::test
