// Triangle meshes from files.
#pragma once

#include <cstdint>
#include <vector>

#include "simulator/capture/input_error.hpp"
#include "simulator/render/mesh.hpp"

namespace traygauge {

// Wavefront OBJ (.obj) or PLY (.ply: ASCII or binary of either byte order), in letters of any case; polygons
// become fans of triangles. Only places and faces are read. Throws InputError: another format, a damaged
// file, a face without its vertices, more than 4 million vertices or faces.
TriangleMesh read_mesh(const InputFile& file);

// The file as it is. Throws InputError.
std::vector<std::uint8_t> read_mesh_bytes(const InputFile& file);

}  // namespace traygauge
