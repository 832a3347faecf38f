// Triangle meshes from files.
#pragma once

#include "simulator/capture/input_error.hpp"
#include "simulator/render/mesh.hpp"

namespace traygauge {

// Wavefront OBJ (.obj) or PLY (.ply: ASCII or binary little-endian); polygons become fans of triangles. Only
// places and faces are read. Throws InputError: another format, a damaged file, a face without its vertices,
// more than 4 million vertices or faces.
TriangleMesh read_mesh(const InputFile& file);

}  // namespace traygauge
