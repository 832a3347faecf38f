// openapi.yaml tells the truth, and what holds answers against it bites.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "tests/firmware/api/hub_rig.hpp"

namespace traygauge::test {
namespace {

using Json = nlohmann::json;

const ApiDescription& description() {
  return ApiDescription::own();
}

const Json& example_scan() {
  return description()
      .document()["components"]["responses"]["Scan"]["content"]["application/json"]["example"];
}

Exchange scan_exchange(const Json& scan) {
  return {"GET",
          "/api/v1/scans/kitchen-17",
          {},
          {200, "HTTP/1.1 200 OK\r\nContent-Type: application/json", scan.dump()}};
}

std::string joined(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += sentence + "\n";
  return text;
}

TEST(ApiDescription, NamesEveryRouteAndNoOther) {
  const HubRig rig;
  EXPECT_GT(rig.routes().size(), 10U);
  EXPECT_EQ(rig.routes(), description().operations());
}

TEST(ApiDescription, IsServedAsItStandsInTheFile) {
  const HubRig rig;
  std::ifstream file(ApiDescription::own_file(), std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  ASSERT_GT(text.size(), 1000U);
  const Answer answer = rig.get("/api/v1/openapi.yaml");
  EXPECT_EQ(answer.header("Content-Type"), "application/yaml");
  EXPECT_EQ(answer.body, text);
}

// Calls `see` with every value that the description holds, and where.
void visit(const Json& value, const std::string& place,
           const std::function<void(const Json& value, const std::string& place)>& see) {
  see(value, place);
  if (!value.is_structured()) return;
  for (const auto& entry : value.items()) {
    std::string inside = place;
    inside += "/";
    inside += entry.key();
    visit(entry.value(), inside, see);
  }
}

TEST(ApiDescription, ItsExamplesFitTheirSchemas) {
  int examples = 0;
  const auto check = [&](const Json& schema, const Json& example, const std::string& place) {
    ++examples;
    EXPECT_EQ(joined(description().misfits(schema, example)), "") << place;
  };
  visit(description().document(), "", [&](const Json& value, const std::string& place) {
    if (!value.is_object() || !value.contains("schema")) return;
    if (value.contains("example")) check(value["schema"], value["example"], place);
    const Json named = value.value("examples", Json::object());
    for (const auto& [name, example] : named.items())
      check(value["schema"], example["value"], place + "/" + name);
  });
  EXPECT_GT(examples, 20);
}

TEST(ApiDescription, ItsReferencesLeadSomewhereAndAllPartsAreUsed) {
  std::set<std::string> referred;
  visit(description().document(), "", [&](const Json& value, const std::string&) {
    if (!value.is_object() || !value.contains("$ref")) return;
    referred.insert(value["$ref"]);
    EXPECT_NO_THROW(description().resolved(value)) << value;
  });
  for (const auto& [kind, parts] : description().document()["components"].items()) {
    if (kind == "securitySchemes") continue;
    for (const auto& part : parts.items()) {
      std::string reference = "#/components/";
      reference += kind + "/" + part.key();
      EXPECT_EQ(referred.count(reference), 1U) << reference << " is not used";
    }
  }
}

TEST(ApiDescription, AsksForNoTokenWhereTheHubAsksForNone) {
  for (const auto& [path, item] : description().document()["paths"].items()) {
    for (const auto& [method, operation] : item.items()) {
      if (method == "parameters") continue;
      const bool is_open = operation.contains("security") && operation["security"].empty();
      EXPECT_EQ(is_open, operation["x-role"] == "none") << method << " " << path;
    }
  }
}

TEST(ApiDescription, ItsParametersAreTakenAndNoOthers) {
  HubRig rig;
  rig.store(1, 100.0);
  for (const std::string path : {"/api/v1/scans", "/api/v1/export.csv", "/api/v1/export.json"}) {
    for (const Json& parameter : description().parameters(path, "get")) {
      std::string target = path;
      target += "?" + parameter["name"].get<std::string>() + "=";
      if (!parameter.contains("example")) continue;
      const Json& example = parameter["example"];
      EXPECT_EQ(rig.get(target + (example.is_string() ? example.get<std::string>() : example.dump())).status,
                200)
          << target;
    }
    EXPECT_EQ(rig.get(path + "?stationn=kitchen").status, 400) << path;
    EXPECT_EQ(rig.get(path + "?station=" + std::string(200, 'x')).status, 200) << path;
    EXPECT_EQ(rig.get(path + "?station=" + std::string(201, 'x')).status, 400) << path;
  }
  const Json limit = description().document()["components"]["parameters"]["Limit"]["schema"];
  const auto with_limit = [&rig](int number) {
    return rig.get("/api/v1/scans?limit=" + std::to_string(number)).status;
  };
  EXPECT_EQ(with_limit(limit["minimum"]), 200);
  EXPECT_EQ(with_limit(limit["maximum"]), 200);
  EXPECT_EQ(with_limit(limit["minimum"].get<int>() - 1), 400);
  EXPECT_EQ(with_limit(limit["maximum"].get<int>() + 1), 400);
}

// In their order they make sense together: the merge takes back the part that the split made.
TEST(ApiDescription, ItsCorrectionsAreTaken) {
  HubRig rig;
  rig.store(1, 100.0);
  const Json post = description().document()["paths"]["/api/v1/scans/{id}/corrections"]["post"];
  const Json examples = post["requestBody"]["content"]["application/json"]["examples"];
  EXPECT_EQ(examples.size(), 6U);
  for (const std::string name : {"rename", "split", "merge", "item_wrong", "scan_wrong", "undo"}) {
    const Answer answer = rig.post("/api/v1/scans/kitchen-1/corrections", examples[name]["value"].dump());
    EXPECT_EQ(answer.status, 201) << name << answer.body;
  }
  EXPECT_EQ(rig.get("/api/v1/scans/kitchen-1/corrections").json()["corrections"].size(), 6U);
}

TEST(ApiDescription, AdmitsWhatFits) {
  EXPECT_EQ(joined(description().objections(scan_exchange(example_scan()))), "");
}

TEST(ApiDescription, RefusesAnyKeyThatIsMissing) {
  for (const auto& entry : example_scan().items()) {
    Json scan = example_scan();
    scan.erase(entry.key());
    const std::string objections = joined(description().objections(scan_exchange(scan)));
    EXPECT_NE(objections.find("GET /api/v1/scans/kitchen-17, 200: "), std::string::npos) << entry.key();
    EXPECT_NE(objections.find(entry.key()), std::string::npos) << objections;
  }
  Json scan = example_scan();
  scan["items"][0].erase("sigma_ml");
  EXPECT_NE(joined(description().objections(scan_exchange(scan))).find("sigma_ml"), std::string::npos);
}

TEST(ApiDescription, RefusesAnyKeyOfAnotherType) {
  for (const auto& entry : example_scan().items()) {
    Json scan = example_scan();
    scan[entry.key()] = entry.value().is_boolean() ? Json("true") : Json(true);
    EXPECT_FALSE(description().objections(scan_exchange(scan)).empty()) << entry.key();
  }
  Json scan = example_scan();
  scan["items"][0]["volume_ml"] = "183.2";
  EXPECT_FALSE(description().objections(scan_exchange(scan)).empty());
  scan = example_scan();
  scan["taken_at"] = "2026-11-27 07:40";
  EXPECT_FALSE(description().objections(scan_exchange(scan)).empty());
}

TEST(ApiDescription, RefusesAKeyThatIsNotDescribed) {
  Json scan = example_scan();
  scan["mood"] = "good";
  EXPECT_NE(joined(description().objections(scan_exchange(scan))).find("mood"), std::string::npos);
  scan = example_scan();
  scan["items"][0]["mood"] = nullptr;
  EXPECT_FALSE(description().objections(scan_exchange(scan)).empty());
}

TEST(ApiDescription, RefusesAnswersThatAreNotDescribed) {
  const auto objections = [](const std::function<void(Exchange&)>& change) {
    Exchange exchange = scan_exchange(example_scan());
    change(exchange);
    return joined(description().objections(exchange));
  };
  EXPECT_NE(objections([](Exchange& e) { e.answer.status = 418; }).find("status"), std::string::npos);
  EXPECT_NE(objections([](Exchange& e) { e.answer.status = 401; }).find("WWW-Authenticate"),
            std::string::npos);
  EXPECT_NE(objections([](Exchange& e) { e.target = "/api/v1/scan"; }).find("not described"),
            std::string::npos);
  EXPECT_NE(objections([](Exchange& e) { e.method = "PUT"; }).find("not described"), std::string::npos);
  EXPECT_NE(objections([](Exchange& e) { e.target += "?mood=good"; }).find("parameter mood"),
            std::string::npos);
  EXPECT_NE(objections([](Exchange& e) { e.answer.body += "}"; }).find("no JSON"), std::string::npos);
  EXPECT_NE(objections([](Exchange& e) {
              e.answer.head = "HTTP/1.1 200 OK\r\nContent-Type: text/html";
            }).find("text/html"),
            std::string::npos);
}

}  // namespace
}  // namespace traygauge::test
