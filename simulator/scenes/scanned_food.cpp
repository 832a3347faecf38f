#include "simulator/scenes/scanned_food.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "simulator/scenes/mesh_reader.hpp"
#include "simulator/scenes/mesh_tools.hpp"
#include "simulator/scenes/scene_poses.hpp"

namespace traygauge {

TriangleMesh load_scan(const ScannedFood& scan) {
  const InputFile file{scan.file, ""};
  TriangleMesh mesh = read_mesh(file);
  if (!is_closed(mesh))
    throw InputError(file, "a closed mesh: its volume is the truth", "edges that do not join two faces",
                     "close its holes and merge its vertices");
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(radians(scan.turn_deg[2]), Eigen::Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(radians(scan.turn_deg[1]), Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(radians(scan.turn_deg[0]), Eigen::Vector3d::UnitX()))
                                   .toRotationMatrix();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector3d high = -low;
  for (Eigen::Vector3f& vertex : mesh.vertices) {
    const Eigen::Vector3d place = scan.scale_mm * (turn * vertex.cast<double>());
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
    vertex = place.cast<float>();
  }
  const Eigen::Vector3f middle = (0.5 * (low + high)).cast<float>();
  for (Eigen::Vector3f& vertex : mesh.vertices) vertex -= middle;
  if (enclosed_volume_mm3(mesh) <= 0.0)
    throw InputError(file, "faces counter-clockwise seen from outside", "a mesh that is inside out",
                     "flip its faces");
  add_smooth_normals(mesh);
  return mesh;
}

void set_down(TriangleMesh& mesh, const std::function<double(double x_mm, double y_mm)>& ground_mm) {
  double gap_mm = std::numeric_limits<double>::max();
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    const Eigen::Vector3d at = vertex.cast<double>();
    gap_mm = std::min(gap_mm, at.z() - ground_mm(at.x(), at.y()));
  }
  for (Eigen::Vector3f& vertex : mesh.vertices) vertex.z() -= static_cast<float>(gap_mm);
}

}  // namespace traygauge
