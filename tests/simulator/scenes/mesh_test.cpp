#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "simulator/scenes/mesh_columns.hpp"
#include "simulator/scenes/mesh_reader.hpp"
#include "simulator/scenes/mesh_tools.hpp"
#include "simulator/scenes/scanned_food.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

// A tetrahedron with legs of 2, 3 and 4: volume 4.
constexpr const char* kObj =
    "# comment\nv 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 4\nvn 0 0 1\nf 1//1 3//1 2//1\nf 1 2 4\nf 1 4 3\nf -3 -2 "
    "-1\n";
constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty "
    "uchar red\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0 9\n2 0 0 9\n0 3 0 9\n0 0 4 9\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

std::string binary_ply(bool is_big_endian = false) {
  std::string text = std::string("ply\nformat binary_") + (is_big_endian ? "big" : "little") +
                     "_endian 1.0\nelement vertex 4\nproperty double x\nproperty double "
                     "y\nproperty double z\n"
                     "element face 4\nproperty list uchar uint vertex_index\nend_header\n";
  const auto put = [&](auto value) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    if (is_big_endian) std::reverse(bytes.begin(), bytes.end());
    text += bytes;
  };
  for (const double coordinate : {0., 0., 0., 2., 0., 0., 0., 3., 0., 0., 0., 4.}) put(coordinate);
  for (const auto& face : {std::vector<std::uint32_t>{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    put(std::uint8_t{3});
    for (const std::uint32_t index : face) put(index);
  }
  return text;
}

std::string error_of(const std::filesystem::path& file) {
  try {
    read_mesh({file, ""});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MeshReader, ReadsTheSameTetrahedronFromEachFormat) {
  const TemporaryFolder folder;
  for (const auto& [name, text] : {std::pair{"a.obj", std::string(kObj)},
                                   {"a.ply", std::string(kPly)},
                                   {"b.ply", binary_ply()},
                                   {"c.ply", binary_ply(true)},
                                   {"d.OBJ", std::string(kObj)},
                                   {"e.Ply", binary_ply()}}) {
    write_text(folder.path() / name, text);
    const TriangleMesh mesh = read_mesh({folder.path() / name, ""});
    EXPECT_EQ(mesh.triangles.size(), 4U) << name;
    EXPECT_TRUE(is_closed(mesh)) << name;
    EXPECT_NEAR(enclosed_volume_mm3(mesh), 4.0, 1e-6) << name;
  }
}

TEST(MeshReader, NamesFileAndWhatWasExpected) {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, std::string>> damaged = {
      {"a.stl", "solid"},
      {"b.obj", "v 0 0\nf 1 2 3\n"},
      {"c.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"},
      {"d.obj", "v 0 0 x\n"},
      {"e.obj", "v 0 0 0\n"},
      {"f.ply", "plx\n"},
      {"g.ply", std::string(kPly).substr(0, std::strlen(kPly) - 12)},
      {"h.ply", binary_ply().substr(0, binary_ply().size() - 1)},
      {"k.ply", "ply\nformat binary_middle_endian 1.0\nend_header\n"},
      {"i.ply", "ply\nformat ascii 1.0\nelement vertex 99999999\nend_header\n"},
      {"j.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n"},
  };
  for (const auto& [name, text] : damaged) {
    write_text(folder.path() / name, text);
    const std::string error = error_of(folder.path() / name);
    EXPECT_NE(error.find(name), std::string::npos) << name << ": " << error;
    EXPECT_NE(error.find("expected"), std::string::npos) << name << ": " << error;
  }
}

TEST(ScannedFood, MustBeClosedAndNotInsideOut) {
  const TemporaryFolder folder;
  const std::string obj = kObj;
  write_text(folder.path() / "open.obj", obj.substr(0, obj.rfind("f -3")));
  write_text(folder.path() / "inside_out.obj",
             "v 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 0 4\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  for (const char* name : {"open.obj", "inside_out.obj"}) {
    ScannedFood scan;
    scan.file = folder.path() / name;
    EXPECT_THROW(load_scan(scan), InputError) << name;
  }
}

TEST(ScannedFood, ScalesItsVolumeByTheCubeAndStandsOnTheGround) {
  const TemporaryFolder folder;
  write_text(folder.path() / "a.obj", kObj);
  TriangleMesh mesh = load_scan({folder.path() / "a.obj", 10.0, {30.0, -20.0, 70.0}});
  EXPECT_NEAR(enclosed_volume_mm3(mesh), 4000.0, 0.1);
  set_down(mesh, [](double, double) { return 4.5; });
  float lowest = 1e9F;
  for (const Eigen::Vector3f& vertex : mesh.vertices) lowest = std::min(lowest, vertex.z());
  EXPECT_NEAR(lowest, 4.5F, 1e-5F);
}

TEST(MeshColumns, AgreeWithABallOnALevelGround) {
  constexpr double kRadiusMm = 20.0;
  std::vector<std::vector<Eigen::Vector3f>> loops;
  for (int i = 1; i < 200; ++i) {
    const double polar = std::numbers::pi * i / 200.0;
    auto& loop = loops.emplace_back();
    for (int k = 0; k < 200; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / 200.0;
      loop.push_back(Eigen::Vector3d(kRadiusMm * std::sin(polar) * std::cos(angle),
                                     kRadiusMm * std::sin(polar) * std::sin(angle),
                                     kRadiusMm * (1.0 + std::cos(polar)))
                         .cast<float>());
    }
  }
  const TriangleMesh ball = skin_of_loops(loops);
  ASSERT_TRUE(is_closed(ball));
  const double cube = kRadiusMm * kRadiusMm * kRadiusMm;
  const double ball_mm3 = 4.0 / 3.0 * std::numbers::pi * cube;
  EXPECT_NEAR(enclosed_volume_mm3(ball), ball_mm3, 1e-3 * ball_mm3);
  EXPECT_NEAR(solid_columns_mm3(ball, 0.2), ball_mm3, 2e-3 * ball_mm3);
  // Under its upper half: half the ball on a cylinder as high as its middle.
  const double under_mm3 = std::numbers::pi * cube + 0.5 * ball_mm3;
  const Columns columns = columns_above(ball, 0.2, [](double, double) { return 0.0; });
  EXPECT_NEAR(columns.volume_mm3, under_mm3, 3e-3 * under_mm3);
  EXPECT_NEAR(columns.area_mm2, std::numbers::pi * kRadiusMm * kRadiusMm, 3.0);
}

TEST(MeshColumns, ShareWhatLiesInBothMeshes) {
  const TriangleMesh box = box_mesh({0.0, 0.0, 0.0}, {10.0, 10.0, 10.0});
  EXPECT_NEAR(shared_columns_mm3(box, box_mesh({6.0, 5.0, 8.0}, {20.0, 20.0, 20.0}), 0.1), 40.0, 1.0);
  EXPECT_NEAR(shared_columns_mm3(box, box_mesh({2.0, 2.0, 2.0}, {5.0, 5.0, 5.0}), 0.1), 125.0, 2.0);
  EXPECT_NEAR(shared_columns_mm3(box, box_mesh({0.0, 0.0, 10.0}, {5.0, 5.0, 5.0}), 0.1), 0.0, 1e-3)
      << "on it";
  EXPECT_EQ(shared_columns_mm3(box, box_mesh({0.0, 20.0, 0.0}, {5.0, 5.0, 5.0}), 0.1), 0.0);
}

TEST(MeshTools, BoxIsClosed) {
  const TriangleMesh box = box_mesh({-1.0, 2.0, 3.0}, {4.0, 5.0, 6.0});
  EXPECT_TRUE(is_closed(box));
  EXPECT_NEAR(enclosed_volume_mm3(box), 120.0, 1e-9);
}

}  // namespace
}  // namespace traygauge
