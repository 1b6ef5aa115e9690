#include "engine/record/mesh_arrays.h"

#include <algorithm>
#include <atomic>
#include <span>
#include <string>

#include "engine/record/checks.h"
#include "engine/runtime/worker_pool.h"
#include "raster/binning.h"
#include "raster/largest_index.h"

namespace tessera::detail {
namespace {

constexpr std::size_t kIndicesPerTask = 4096;
/// Fewer indices are validated before other workers could have started.
constexpr std::size_t kMinIndicesForWorkers = 65536;

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::invalid_argument, "Frame::draw: the mesh " + message);
}

/// An array is packed (number of floats or bytes) or strided (number of vertices), not both.
void require_one_form(const char* what, std::size_t packed, const char* unit, std::size_t vertices,
                      std::size_t stride_bytes) {
  if (packed != 0 && (vertices != 0 || stride_bytes != 0))
    fail("has " + std::to_string(packed) + " packed " + unit + " of " + what + " and also " +
         std::to_string(vertices) + " vertices with a stride of " + std::to_string(stride_bytes) +
         " bytes, must have one or the other");
}

std::size_t vertices_of(const FloatArray& positions, std::size_t components) {
  require_one_form("positions", positions.float_count, "floats", positions.vertices, positions.stride_bytes);
  if (positions.float_count == 0) return positions.vertices;
  if (positions.float_count % components != 0)
    fail("has " + std::to_string(positions.float_count) + " floats of positions, must be a multiple of " +
         std::to_string(components));
  return positions.float_count / components;
}

void require_all(const char* what, std::size_t given, std::size_t vertices) {
  if (given != vertices)
    fail(std::string("has ") + what + " of " + std::to_string(given) + " vertices, but " +
         std::to_string(vertices) + " vertices");
}

void require_stride(const char* what, std::size_t stride_bytes, std::size_t multiple, std::size_t min_bytes) {
  if (stride_bytes % multiple != 0 || stride_bytes < min_bytes)
    fail("has a stride of " + std::to_string(stride_bytes) + " bytes for " + what + ", must be " +
         (multiple > 1 ? "a multiple of " + std::to_string(multiple) + " and " : "") + "at least " +
         std::to_string(min_bytes));
}

void require_address(const char* what, const void* data, std::size_t multiple) {
  if (data == nullptr) fail(std::string("has no address for ") + what);
  if (reinterpret_cast<std::uintptr_t>(data) % multiple != 0)
    fail(std::string("has ") + what + " at an address that is no multiple of " + std::to_string(multiple));
}

StridedFloats strided(const FloatArray& array, const char* what, std::size_t components,
                      std::size_t vertices) {
  if (array.empty()) return {};
  require_one_form(what, array.float_count, "floats", array.vertices, array.stride_bytes);
  require_address(what, array.data, alignof(float));
  if (array.float_count != 0) {
    if (array.float_count != vertices * components)
      fail("has " + std::to_string(array.float_count) + " floats of " + what + ", its " +
           std::to_string(vertices) + " vertices need " + std::to_string(vertices * components));
    return {array.data, components};
  }
  require_all(what, array.vertices, vertices);
  if (array.stride_bytes == 0) return {array.data, components};
  require_stride(what, array.stride_bytes, sizeof(float), components * sizeof(float));
  return {array.data, array.stride_bytes / sizeof(float)};
}

void add_colors(const ColorArray& colors, MeshArrays& mesh) {
  if (colors.byte_count == 0 && colors.vertices == 0) {
    if (colors.stride_bytes != 0)
      fail("has a stride of " + std::to_string(colors.stride_bytes) +
           " bytes for colors, but no bytes of colors; for floats, set the stride of colors.floats");
    mesh.colors = strided(colors.floats, "colors", 4, mesh.vertices);
    return;
  }
  if (!colors.floats.empty()) fail("has colors twice, as floats and as bytes");
  require_one_form("colors", colors.byte_count, "bytes", colors.vertices, colors.stride_bytes);
  require_address("colors", colors.bytes, 1);
  mesh.color_bytes = colors.bytes;
  mesh.color_stride = colors.stride_bytes == 0 ? 4 : colors.stride_bytes;
  if (colors.byte_count != 0 && colors.byte_count != 4 * mesh.vertices)
    fail("has " + std::to_string(colors.byte_count) + " bytes of colors, its " +
         std::to_string(mesh.vertices) + " vertices need " + std::to_string(4 * mesh.vertices));
  if (colors.byte_count == 0) require_all("colors", colors.vertices, mesh.vertices);
  require_stride("colors", mesh.color_stride, 1, 4);
}

template <class Index>
const Index* indices_of(const IndexArray& array) {
  require_address("indices", array.data, alignof(Index));
  return static_cast<const Index*>(array.data);
}

void add_indices(const IndexArray& array, MeshArrays& mesh) {
  if (array.empty()) return;
  if (mesh.vertices == 0) fail("has " + std::to_string(array.count) + " indices, but no vertices");
  if (array.bits == 32) mesh.indices = indices_of<std::uint32_t>(array);
  else if (array.bits == 16) mesh.indices16 = indices_of<std::uint16_t>(array);
  else fail("has indices of " + std::to_string(array.bits) + " bits, must be 16 or 32");
}

/// Whether indices [first, last) are below the number of vertices.
bool are_in_bounds(const MeshArrays& mesh, std::size_t first, std::size_t last) {
  const std::size_t count = last - first;
  const std::size_t largest = mesh.indices ? largest_index(std::span(mesh.indices + first, count))
                                           : largest_index(std::span(mesh.indices16 + first, count));
  return largest < mesh.vertices;
}

bool are_in_bounds(const MeshArrays& mesh, WorkerPool* workers) {
  if (workers == nullptr || mesh.corners < kMinIndicesForWorkers) return are_in_bounds(mesh, 0, mesh.corners);
  std::atomic<bool> all_in_bounds = true;
  workers->for_each((mesh.corners + kIndicesPerTask - 1) / kIndicesPerTask, [&](std::size_t i, int) {
    const std::size_t first = i * kIndicesPerTask;
    if (!are_in_bounds(mesh, first, std::min(first + kIndicesPerTask, mesh.corners))) all_in_bounds = false;
  });
  return all_in_bounds;
}

void require_whole_primitives(const Mesh& mesh, std::size_t corners) {
  if (makes_whole_primitives(mesh.primitive, corners)) return;
  const std::string mesh_name(name_of_mesh(mesh.primitive));
  fail("has " + std::to_string(corners) + (mesh.indices.empty() ? " vertices, " : " indices, ") + mesh_name +
       (mesh_name.starts_with("a ") ? " needs " : " need ") + std::string(corners_needed(mesh.primitive)));
}

const char* plural_of(Topology topology) {
  switch (topology) {
    case Topology::points: return "points";
    case Topology::lines: return "lines";
    case Topology::triangles: break;
  }
  return "triangles";
}

}  // namespace

MeshArrays check_mesh(const Mesh& mesh) {
  if (mesh.position_components != 3 && mesh.position_components != 4)
    throw Error(ErrorCode::invalid_argument, "Frame::draw: the mesh's position_components is " +
                                                 std::to_string(mesh.position_components) +
                                                 ", must be 3 or 4");
  require_enum({"Frame::draw: the mesh's primitive"}, mesh.primitive, Primitive::polygon);
  const auto components = static_cast<std::size_t>(mesh.position_components);
  MeshArrays arrays;
  arrays.components = mesh.position_components;
  arrays.vertices = vertices_of(mesh.positions, components);
  if (arrays.vertices > 0xffffffffu)
    fail("has " + std::to_string(arrays.vertices) + " vertices, at most 4294967295 are possible");
  arrays.positions = strided(mesh.positions, "positions", components, arrays.vertices);
  arrays.normals = strided(mesh.normals, "normals", 3, arrays.vertices);
  add_colors(mesh.colors, arrays);
  arrays.color_indices = strided(mesh.color_indices, "color_indices", 1, arrays.vertices);
  arrays.texcoords = strided(mesh.texcoords, "texcoords", 2, arrays.vertices);
  arrays.primitive = mesh.primitive;
  arrays.corners = mesh.indices.empty() ? arrays.vertices : mesh.indices.count;
  require_whole_primitives(mesh, arrays.corners);
  arrays.elements = element_count(mesh.primitive, arrays.corners);
  if (arrays.elements > kMaxTriangles)
    fail("has " + std::to_string(arrays.elements) + " " + plural_of(arrays.topology()) + ", at most " +
         std::to_string(kMaxTriangles) + " are possible in one draw");
  add_indices(mesh.indices, arrays);
  return arrays;
}

void check_indices(const MeshArrays& mesh, WorkerPool* workers) {
  if (!mesh.indexed() || are_in_bounds(mesh, workers)) return;
  std::size_t wrong = 0;
  while (wrong + 1 < mesh.corners && mesh.vertex_at(wrong) < mesh.vertices) ++wrong;
  throw Error(ErrorCode::invalid_argument, "Frame::draw: index " + std::to_string(wrong) +
                                               " of the mesh is " + std::to_string(mesh.vertex_at(wrong)) +
                                               ", must be below the number of vertices, " +
                                               std::to_string(mesh.vertices));
}

}  // namespace tessera::detail
