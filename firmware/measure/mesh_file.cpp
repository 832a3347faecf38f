#include "firmware/measure/mesh_file.hpp"

#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "core/labels/label_regions.hpp"
#include "simulator/capture/png_writer.hpp"

namespace traygauge {
namespace {

using Colour = std::array<std::uint8_t, 3>;

// From the reference camera to a frame whose z is the height over the bottom of the dish and whose origin
// lies under the middle of the food.
Pose dish_from_camera(const paper::FoodMesh& mesh, const Plane& bottom) {
  const Vec3 up = bottom.normal;
  const Vec3 right = (Vec3::UnitX() - up.x() * up).normalized();  // the camera never looks along the table
  Pose pose;
  pose.rotation.row(0) = right.transpose();
  pose.rotation.row(1) = up.cross(right).transpose();
  pose.rotation.row(2) = up.transpose();
  Vec3 middle = Vec3::Zero();
  for (const paper::MeshPoint& point : mesh.points) middle += point.position_mm;
  middle /= static_cast<double>(mesh.points.size());
  pose.translation = -(pose.rotation * middle);
  pose.translation.z() = -bottom.offset;
  return pose;
}

// The picture's nearest pixel where the lens shows the point.
Colour colour_at(const Vec3& point, const Picture& picture, const LensModel& lens) {
  if (point.z() <= 0.0) return {};
  const Vec2 pixel = lens.pixel({point.x() / point.z(), point.y() / point.z()});
  const Vec2 nearest(std::round(pixel.x()), std::round(pixel.y()));
  if (!(nearest.x() >= 0.0 && nearest.y() >= 0.0 && nearest.x() < picture.size.width &&
        nearest.y() < picture.size.height)) {
    return {};
  }
  const auto channels = static_cast<std::size_t>(bytes_per_pixel(picture.format));
  const std::size_t index =
      static_cast<std::size_t>(nearest.y()) * static_cast<std::size_t>(picture.size.width) +
      static_cast<std::size_t>(nearest.x());
  const std::uint8_t* value = &picture.pixels[index * channels];
  if (channels == 1) return {value[0], value[0], value[0]};
  if (picture.format == PixelFormat::bgr8) return {value[2], value[1], value[0]};
  return {value[0], value[1], value[2]};
}

void append_uint32(std::string& bytes, std::uint32_t value) {
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((value >> shift) & 0xFFU);
}

void append_float(std::string& bytes, double value) {
  append_uint32(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

std::string compose_header(const paper::FoodMesh& mesh) {
  return "ply\nformat binary_little_endian 1.0\n"
         "comment Traygauge: mm, z up from the bottom of the dish\n"
         "element vertex " +
         std::to_string(mesh.points.size()) +
         "\nproperty float x\nproperty float y\nproperty float z\n"
         "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar label\n"
         "element face " +
         std::to_string(mesh.triangles.size()) +
         "\nproperty list uchar int vertex_indices\nproperty uchar label\nend_header\n";
}

void append_vertex(std::string& bytes, const Vec3& position_mm, const Colour& colour, std::uint8_t label) {
  for (int i = 0; i < 3; ++i) append_float(bytes, position_mm[i]);
  for (const std::uint8_t channel : colour) bytes += static_cast<char>(channel);
  bytes += static_cast<char>(label);
}

void append_face(std::string& bytes, const paper::FoodMesh& mesh, const paper::MeshTriangle& triangle,
                 const Vec3& up) {
  std::array<std::int32_t, 3> corners = triangle.corners;
  const auto position = [&](std::int32_t i) { return mesh.points[static_cast<std::size_t>(i)].position_mm; };
  const Vec3 first = position(corners[0]);
  const Vec3 normal = (position(corners[1]) - first).cross(position(corners[2]) - first);
  if (normal.dot(up) < 0.0) std::swap(corners[1], corners[2]);
  bytes += static_cast<char>(3);
  for (const std::int32_t corner : corners) append_uint32(bytes, static_cast<std::uint32_t>(corner));
  bytes += static_cast<char>(triangle.label);
}

// The food cells of all height maps as a mesh in the reference camera.
class CellMesh {
 public:
  explicit CellMesh(const MeasurementViews& views)
      : camera_from_table_(views.camera_from_table[static_cast<std::size_t>(views.reference_view)]) {
    for (const MeasuredSurface& surface : views.surfaces) add(surface);
    if (!views.surfaces.empty()) {
      const Vec3 up = camera_from_table_.rotation.col(2);
      const double height_mm = views.surfaces.front().inner.profile.bottom_height_mm();
      bottom_ = {up, up.dot(camera_from_table_ * Vec3(0.0, 0.0, height_mm))};
    }
  }

  paper::FoodMesh mesh() const {
    paper::FoodMesh mesh;
    mesh.points = points_;
    mesh.triangles = triangles_;
    return mesh;
  }
  const Plane& bottom() const { return bottom_; }

 private:
  void add(const MeasuredSurface& surface) {
    const HeightMap& map = surface.heights;
    std::vector<std::int32_t> index(
        static_cast<std::size_t>(map.cells.width) * static_cast<std::size_t>(map.cells.height), -1);
    const auto at = [&](int x, int y) -> std::int32_t& {
      return index[static_cast<std::size_t>(y) * static_cast<std::size_t>(map.cells.width) +
                   static_cast<std::size_t>(x)];
    };
    for (int y = 0; y < map.cells.height; ++y) {
      for (int x = 0; x < map.cells.width; ++x) {
        const HeightCell& cell = map.cells.at(x, y);
        if (!is_item(cell.label)) continue;
        at(x, y) = static_cast<std::int32_t>(points_.size());
        const Vec2 place = map.centre_mm(x, y);
        paper::MeshPoint point;
        point.position_mm = camera_from_table_ * Vec3(place.x(), place.y(), cell.z_mm);
        point.label = cell.label;
        points_.push_back(point);
      }
    }
    for (int y = 0; y + 1 < map.cells.height; ++y) {
      for (int x = 0; x + 1 < map.cells.width; ++x) {
        add_triangle({at(x, y), at(x + 1, y), at(x, y + 1)});
        add_triangle({at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
      }
    }
  }

  void add_triangle(const std::array<std::int32_t, 3>& corners) {
    for (const std::int32_t corner : corners) {
      if (corner < 0) return;
    }
    paper::MeshTriangle triangle;
    triangle.corners = corners;
    triangle.label = points_[static_cast<std::size_t>(corners[0])].label;
    triangles_.push_back(triangle);
  }

  Pose camera_from_table_;
  Plane bottom_;
  std::vector<paper::MeshPoint> points_;
  std::vector<paper::MeshTriangle> triangles_;
};

}  // namespace

bool has_surface(const Measurement& measurement, const paper::WorkingPictures* pictures) {
  const MeasurementViews& views = measurement.views;
  if (!views.surfaces.empty()) return true;
  // A plane through the camera itself is the one that was never set.
  return pictures != nullptr && !pictures->mesh.points.empty() && !pictures->mesh.triangles.empty() &&
         views.dish_bottom.offset != 0.0;
}

std::string compose_mesh(const Measurement& measurement, const paper::WorkingPictures* pictures,
                         const Picture& picture, const LensModel& lens) {
  const MeasurementViews& views = measurement.views;
  const CellMesh cells(views);
  const paper::FoodMesh mesh = views.surfaces.empty() ? pictures->mesh : cells.mesh();
  const Plane bottom = views.surfaces.empty() ? views.dish_bottom : cells.bottom();
  const Pose pose = dish_from_camera(mesh, bottom);
  std::string bytes = compose_header(mesh);
  for (const paper::MeshPoint& point : mesh.points) {
    append_vertex(bytes, pose * point.position_mm, colour_at(point.position_mm, picture, lens), point.label);
  }
  for (const paper::MeshTriangle& triangle : mesh.triangles)
    append_face(bytes, mesh, triangle, bottom.normal);
  return bytes;
}

void write_mesh(const std::filesystem::path& file, const std::string& mesh) {
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  if (!stream) throw OutputError(file, std::generic_category().message(errno));
  stream.write(mesh.data(), static_cast<std::streamsize>(mesh.size()));
  stream.close();
  if (stream) return;
  const int reason = errno;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) std::filesystem::remove(file, ignored);
  throw OutputError(file, std::generic_category().message(reason));
}

}  // namespace traygauge
