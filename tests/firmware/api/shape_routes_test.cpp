#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/firmware/api/hub_rig.hpp"
#include "tests/firmware/store/sample_shape.hpp"

namespace traygauge::test {
namespace {

void tell_shape(HubRig& rig, const ScanId& id) {
  const nlohmann::json text = {{"id", scan_id_text(id)}};
  rig.station().tell({MessageType::shape, text.dump(), sample_shape(id).dump()}, Milliseconds(1000));
}

TEST(ShapeRoutes, AnswerWhatTheStationTold) {
  HubRig rig;
  rig.store(1, 100.0);
  tell_shape(rig, {"kitchen", 1});
  rig.store(2, 100.0);  // everything before it has arrived
  const Answer shape = rig.get("/api/v1/scans/kitchen-1/shape");
  ASSERT_EQ(shape.status, 200) << shape.body;
  EXPECT_EQ(shape.json(), sample_shape({"kitchen", 1}));
  const Answer none = rig.get("/api/v1/scans/kitchen-2/shape");
  EXPECT_EQ(none.status, 404);
  EXPECT_EQ(none.json()["error"]["code"], "no_shape");
  EXPECT_EQ(rig.get("/api/v1/scans/kitchen-3/shape").json()["error"]["code"], "no_such_scan");
}

TEST(ShapeRoutes, AnswerAMeshOfWhatIsKnown) {
  HubRig rig;
  rig.store(1, 100.0);
  tell_shape(rig, {"kitchen", 1});
  rig.store(2, 100.0);
  const Answer mesh = rig.get("/api/v1/scans/kitchen-1/mesh");
  ASSERT_EQ(mesh.status, 200);
  const std::size_t header = mesh.body.find("end_header\n") + 11;
  EXPECT_EQ(mesh.body.rfind("ply\n", 0), 0U);
  EXPECT_NE(mesh.body.find("element vertex 5\n"), std::string::npos) << mesh.body.substr(0, header);
  EXPECT_NE(mesh.body.find("element face 3\n"), std::string::npos) << mesh.body.substr(0, header);
  // A vertex is three floats and a label; a face a count and three numbers.
  EXPECT_EQ(mesh.body.size(), header + 5 * 13 + 3 * 13);
}

TEST(ShapeRoutes, ShowAPictureWhereTheStationSentOne) {
  HubRig rig;
  rig.store(1, 100.0);
  const std::string jpeg = "\xFF\xD8\xFF and so on";
  rig.station().tell({MessageType::picture, R"({"id":"kitchen-1","keep":false})", jpeg}, Milliseconds(1000));
  rig.station().tell({MessageType::picture, R"({"id":"canteen-1","keep":true})", jpeg}, Milliseconds(1000));
  rig.store(2, 100.0);
  const Answer picture = rig.get("/api/v1/scans/kitchen-1/picture");
  ASSERT_EQ(picture.status, 200) << picture.body;
  EXPECT_EQ(picture.body, jpeg);
  EXPECT_EQ(picture.header("Content-Type"), "image/jpeg");
  EXPECT_EQ(rig.get("/api/v1/scans/kitchen-2/picture").json()["error"]["code"], "no_picture");
}

TEST(ShapeRoutes, TakeNoShapeOfAnotherStation) {
  HubRig rig;
  rig.store(1, 100.0);
  const nlohmann::json text = {{"id", "canteen-1"}};
  rig.station().tell({MessageType::shape, text.dump(), sample_shape({"canteen", 1}).dump()},
                     Milliseconds(1000));
  rig.station().tell({MessageType::shape, R"({"id":"kitchen-1"})", "nonsense"}, Milliseconds(1000));
  rig.store(2, 100.0);
  EXPECT_EQ(rig.get("/api/v1/scans/kitchen-1/shape").status, 404);
}

}  // namespace
}  // namespace traygauge::test
