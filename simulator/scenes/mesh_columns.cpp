#include "simulator/scenes/mesh_columns.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace traygauge {
namespace {

// Columns through the middles of squares that cover the mesh.
class ColumnGrid {
 public:
  ColumnGrid(const TriangleMesh& mesh, double step_mm) : step_mm_(step_mm) {
    Eigen::Vector3d high = Eigen::Vector3d::Constant(std::numeric_limits<double>::lowest());
    low_ = -high;
    for (const Eigen::Vector3f& vertex : mesh.vertices) {
      low_ = low_.cwiseMin(vertex.cast<double>());
      high = high.cwiseMax(vertex.cast<double>());
    }
    // Not where vertices of a regular mesh are: a column through an edge would meet two triangles.
    low_ -= step_mm * Eigen::Vector3d(0.3183098862, 0.3678794412, 0.0);
    columns_ = static_cast<int>(std::ceil((high.x() - low_.x()) / step_mm));
    rows_ = static_cast<int>(std::ceil((high.y() - low_.y()) / step_mm));
  }

  std::size_t size() const { return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_); }
  double x_mm(std::size_t cell) const { return middle(cell % static_cast<std::size_t>(columns_), low_.x()); }
  double y_mm(std::size_t cell) const { return middle(cell / static_cast<std::size_t>(columns_), low_.y()); }

  // hit(cell, z, looks_up) wherever a column passes a triangle of `mesh`.
  template <class Hit>
  void pass(const TriangleMesh& mesh, const Hit& hit) const {
    const auto vertex = [&](std::uint32_t index) -> Eigen::Vector3d {
      return mesh.vertices[index].cast<double>();
    };
    for (const auto& [ia, ib, ic] : mesh.triangles) {
      const Eigen::Vector3d a = vertex(ia);
      const Eigen::Vector3d ab = vertex(ib) - a;
      const Eigen::Vector3d ac = vertex(ic) - a;
      const double area = ab.x() * ac.y() - ab.y() * ac.x();
      if (area == 0.0) continue;
      const double x_span[2] = {std::min({0.0, ab.x(), ac.x()}), std::max({0.0, ab.x(), ac.x()})};
      const double y_span[2] = {std::min({0.0, ab.y(), ac.y()}), std::max({0.0, ab.y(), ac.y()})};
      const int column_end = last(a.x() + x_span[1] - low_.x(), columns_);
      const int row_end = last(a.y() + y_span[1] - low_.y(), rows_);
      for (int row = first(a.y() + y_span[0] - low_.y()); row <= row_end; ++row) {
        for (int column = first(a.x() + x_span[0] - low_.x()); column <= column_end; ++column) {
          const double x = low_.x() + (column + 0.5) * step_mm_ - a.x();
          const double y = low_.y() + (row + 0.5) * step_mm_ - a.y();
          const double v = (x * ac.y() - y * ac.x()) / area;
          const double w = (ab.x() * y - ab.y() * x) / area;
          if (v < 0.0 || w < 0.0 || v + w > 1.0) continue;
          const auto cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                            static_cast<std::size_t>(column);
          hit(cell, a.z() + v * ab.z() + w * ac.z(), area > 0.0);
        }
      }
    }
  }

 private:
  double middle(std::size_t index, double low_mm) const {
    return low_mm + (static_cast<double>(index) + 0.5) * step_mm_;
  }
  int first(double offset_mm) const {
    return std::max(0, static_cast<int>(std::ceil(offset_mm / step_mm_ - 0.5)));
  }
  int last(double offset_mm, int count) const {
    return std::min(count - 1, static_cast<int>(std::floor(offset_mm / step_mm_ - 0.5)));
  }

  double step_mm_;
  Eigen::Vector3d low_;
  int columns_ = 0;
  int rows_ = 0;
};

// Where a column enters (+1) or leaves (-1) one of two solids, from below.
struct Crossing {
  double z = 0.0;
  int into_first = 0;
  int into_second = 0;
};

double shared_length(std::vector<Crossing>& crossings) {
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& a, const Crossing& b) { return a.z < b.z; });
  double length = 0.0;
  int in_first = 0;
  int in_second = 0;
  double last_z = 0.0;
  for (const Crossing& crossing : crossings) {
    if (in_first > 0 && in_second > 0) length += crossing.z - last_z;
    in_first += crossing.into_first;
    in_second += crossing.into_second;
    last_z = crossing.z;
  }
  return length;
}

}  // namespace

Columns columns_above(const TriangleMesh& mesh, double step_mm,
                      const std::function<double(double x_mm, double y_mm)>& ground_mm) {
  const ColumnGrid grid(mesh, step_mm);
  constexpr double kNothing = std::numeric_limits<double>::lowest();
  std::vector<double> top(grid.size(), kNothing);
  grid.pass(mesh, [&](std::size_t cell, double z, bool) { top[cell] = std::max(top[cell], z); });
  Columns columns;
  for (std::size_t cell = 0; cell < top.size(); ++cell) {
    if (top[cell] == kNothing) continue;
    columns.area_mm2 += step_mm * step_mm;
    columns.volume_mm3 +=
        step_mm * step_mm * std::max(0.0, top[cell] - ground_mm(grid.x_mm(cell), grid.y_mm(cell)));
  }
  return columns;
}

double solid_columns_mm3(const TriangleMesh& mesh, double step_mm) {
  const ColumnGrid grid(mesh, step_mm);
  double sum = 0.0;
  grid.pass(mesh, [&](std::size_t, double z, bool looks_up) { sum += looks_up ? z : -z; });
  return sum * step_mm * step_mm;
}

double shared_columns_mm3(const TriangleMesh& first, const TriangleMesh& second, double step_mm) {
  const ColumnGrid grid(first, step_mm);
  std::vector<std::vector<Crossing>> crossings(grid.size());
  grid.pass(first, [&](std::size_t cell, double z, bool looks_up) {
    crossings[cell].push_back({z, looks_up ? -1 : 1, 0});
  });
  grid.pass(second, [&](std::size_t cell, double z, bool looks_up) {
    if (!crossings[cell].empty()) crossings[cell].push_back({z, 0, looks_up ? -1 : 1});
  });
  double sum = 0.0;
  for (std::vector<Crossing>& own : crossings) sum += shared_length(own);
  return sum * step_mm * step_mm;
}

}  // namespace traygauge
