// The PLY file, parsed back by a reader of the test's own.
#include "firmware/measure/mesh_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/firmware/fake/synthetic_scene.hpp"
#include "tests/simulator/capture/temporary_capture.hpp"

namespace traygauge {
namespace {

struct PlyVertex {
  std::array<float, 3> position{};
  std::array<std::uint8_t, 3> colour{};
  std::uint8_t label = 0;
};

struct PlyFace {
  std::array<std::int32_t, 3> corners{};
  std::uint8_t label = 0;
};

struct Ply {
  std::vector<PlyVertex> vertices;
  std::vector<PlyFace> faces;
};

template <class T>
T take(std::istream& stream) {
  T value{};
  stream.read(reinterpret_cast<char*>(&value), sizeof value);  // the tests run on little-endian machines
  return value;
}

Ply parse(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  Ply ply;
  std::string line;
  std::getline(stream, line);
  EXPECT_EQ(line, "ply");
  while (std::getline(stream, line) && line != "end_header") {
    std::istringstream words(line);
    std::string keyword;
    std::string name;
    std::size_t count = 0;
    words >> keyword >> name >> count;
    if (keyword == "element" && name == "vertex") ply.vertices.resize(count);
    if (keyword == "element" && name == "face") ply.faces.resize(count);
  }
  for (PlyVertex& vertex : ply.vertices) {
    for (float& coordinate : vertex.position) coordinate = take<float>(stream);
    for (std::uint8_t& channel : vertex.colour) channel = take<std::uint8_t>(stream);
    vertex.label = take<std::uint8_t>(stream);
  }
  for (PlyFace& face : ply.faces) {
    EXPECT_EQ(take<std::uint8_t>(stream), 3);
    for (std::int32_t& corner : face.corners) corner = take<std::int32_t>(stream);
    face.label = take<std::uint8_t>(stream);
  }
  EXPECT_TRUE(stream);
  EXPECT_EQ(stream.peek(), std::ifstream::traits_type::eof());
  return ply;
}

class MeshFile : public testing::Test {
 protected:
  MeshFile()
      : scene_(320, 240),
        measurement_(scene_.measurement()),
        pictures_(scene_.pictures()),
        picture_({320, 240}, PixelFormat::rgb8) {
    lens_.pinhole = pictures_.cameras[0];
    for (std::size_t i = 0; i < picture_.pixels.size(); i += 3) {  // the colour tells the pixel
      const std::size_t x = i / 3 % 320;
      picture_.pixels[i] = static_cast<std::uint8_t>(x % 256);
      picture_.pixels[i + 1] = static_cast<std::uint8_t>(i / 3 / 320);
      picture_.pixels[i + 2] = static_cast<std::uint8_t>(x / 256);
    }
  }

  Ply written() {
    write_mesh(folder_.path() / "out.ply", compose_mesh(measurement_, &pictures_, picture_, lens_));
    return parse(folder_.path() / "out.ply");
  }

  TemporaryFolder folder_;
  SyntheticScene scene_;
  Measurement measurement_;
  paper::WorkingPictures pictures_;
  Picture picture_;
  LensModel lens_;
};

TEST_F(MeshFile, HeightsStandOverTheBottomOfTheDish) {
  ASSERT_TRUE(has_surface(measurement_, &pictures_));
  const Ply ply = written();
  ASSERT_EQ(ply.vertices.size(), pictures_.mesh.points.size());
  ASSERT_GT(ply.vertices.size(), 50U);
  for (const PlyVertex& vertex : ply.vertices) {
    const double height = vertex.label == 2 ? SyntheticScene::kHeight2Mm : SyntheticScene::kHeight3Mm;
    EXPECT_NEAR(vertex.position[2], height, 1e-3);
  }
}

TEST_F(MeshFile, TheFrameIsRigidAndCentred) {
  const Ply ply = written();
  const auto& points = pictures_.mesh.points;
  double sum_x = 0.0;
  double sum_y = 0.0;
  const auto distance = [](const auto& a, const auto& b) {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
      sum += difference * difference;
    }
    return std::sqrt(sum);
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    sum_x += static_cast<double>(ply.vertices[i].position[0]);
    sum_y += static_cast<double>(ply.vertices[i].position[1]);
    const std::size_t j = (i * 7 + 3) % points.size();
    const float* a = ply.vertices[i].position.data();
    const float* b = ply.vertices[j].position.data();
    EXPECT_NEAR(distance(a, b), distance(points[i].position_mm, points[j].position_mm), 1e-3);
  }
  EXPECT_NEAR(sum_x / static_cast<double>(points.size()), 0.0, 1e-3);
  EXPECT_NEAR(sum_y / static_cast<double>(points.size()), 0.0, 1e-3);
}

TEST_F(MeshFile, ColoursComeFromThePicture) {
  const Ply ply = written();
  for (std::size_t i = 0; i < ply.vertices.size(); ++i) {
    const Vec3& point = pictures_.mesh.points[i].position_mm;
    const Vec2 pixel = lens_.pinhole.pixel({point.x() / point.z(), point.y() / point.z()});
    EXPECT_NEAR(ply.vertices[i].colour[0] + 256.0 * ply.vertices[i].colour[2], pixel.x(), 0.51);
    EXPECT_NEAR(ply.vertices[i].colour[1], pixel.y(), 0.51);
  }
}

TEST_F(MeshFile, FacesLookUpAndKeepTheirLabel) {
  const Ply ply = written();
  ASSERT_EQ(ply.faces.size(), pictures_.mesh.triangles.size());
  for (std::size_t i = 0; i < ply.faces.size(); ++i) {
    const auto& c = ply.faces[i].corners;
    const auto& a = ply.vertices[static_cast<std::size_t>(c[0])].position;
    const auto& b = ply.vertices[static_cast<std::size_t>(c[1])].position;
    const auto& d = ply.vertices[static_cast<std::size_t>(c[2])].position;
    EXPECT_GT((b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]), 0.0F);
    EXPECT_EQ(ply.faces[i].label, pictures_.mesh.triangles[i].label);
  }
}

TEST_F(MeshFile, NoSurfaceWithoutMeshOrPlane) {
  Measurement without_plane = measurement_;
  without_plane.views.dish_bottom = Plane{};
  EXPECT_FALSE(has_surface(without_plane, &pictures_));
  EXPECT_FALSE(has_surface(measurement_, nullptr));
}

}  // namespace
}  // namespace traygauge
