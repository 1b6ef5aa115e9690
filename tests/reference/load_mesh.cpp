// Meshes: built in, listed in the scene, or from an OBJ file. The header-only OBJ loader is compiled here
// with doubles and under its own namespace, so that it cannot clash with another copy in the same program.
#define tinyobj tessera_reference_tinyobj
#define TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include "builtin_meshes.h"
#include "primitives.h"
#include "scene_parts.h"

namespace tessera::reference {
namespace {

const std::vector<std::pair<const char*, PrimitiveType>> kPrimitives{
    {"points", PrimitiveType::kPoints},
    {"lines", PrimitiveType::kLines},
    {"line_strip", PrimitiveType::kLineStrip},
    {"line_loop", PrimitiveType::kLineLoop},
    {"triangles", PrimitiveType::kTriangles},
    {"triangle_strip", PrimitiveType::kTriangleStrip},
    {"triangle_fan", PrimitiveType::kTriangleFan},
    {"quads", PrimitiveType::kQuads},
    {"quad_strip", PrimitiveType::kQuadStrip},
    {"polygon", PrimitiveType::kPolygon}};

Mesh parse_inline(ObjectReader& reader) {
  Mesh mesh;
  if (const Value primitive = reader.find("primitive")) mesh.primitive = choice(primitive, kPrimitives);
  const Value positions = reader.require("positions");
  for (std::size_t i = 0; i < array_size(positions); ++i) {
    if (array_size(positions[i]) == 4) {
      mesh.positions.push_back(vec4(positions[i]));
    } else {
      const Vec3 p = vec3(positions[i]);
      mesh.positions.push_back({p.x, p.y, p.z, 1});
    }
  }
  const auto for_each_vertex = [&](const char* key, const auto& take) {
    const Value list = reader.find(key);
    if (!list) return;
    if (array_size(list) != mesh.positions.size()) fail(list.pointer, "one for each position");
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) take(list[i]);
  };
  for_each_vertex("normals", [&](const Value& v) { mesh.normals.push_back(vec3(v)); });
  for_each_vertex("colors", [&](const Value& v) { mesh.colors.push_back(vec4(v)); });
  for_each_vertex("color_indices", [&](const Value& v) { mesh.color_indices.push_back(number(v)); });
  for_each_vertex("texcoords", [&](const Value& v) { mesh.texcoords.push_back(numbers<2>(v)); });

  const Value indices = reader.find("indices");
  if (indices) {
    for (std::size_t i = 0; i < array_size(indices); ++i)
      mesh.indices.push_back(static_cast<std::uint32_t>(
          integer(indices[i], 0, static_cast<std::int64_t>(mesh.positions.size()) - 1)));
  } else {
    for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) mesh.indices.push_back(i);
  }
  if (const std::string expected = wrong_vertex_count(mesh.primitive, mesh.indices.size()); !expected.empty())
    fail(indices ? indices.pointer : positions.pointer, expected, std::to_string(mesh.indices.size()));
  return mesh;
}

// Every corner becomes a separate vertex; polygons are split into fans around their first corner. Normals,
// colours and texture coordinates are used only if every corner of the file has them. The file's materials
// are ignored: a draw names its material.
Mesh load_obj(const std::string& path) {
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning;
  std::string error;
  const std::string directory = path.substr(0, path.find_last_of('/') + 1);
  constexpr bool kTriangulate = false;
  constexpr bool kWhiteIfUncolored = false;
  if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, path.c_str(), directory.c_str(),
                        kTriangulate, kWhiteIfUncolored))
    throw std::runtime_error("cannot read " + path + ": " + error);

  Mesh mesh;
  bool has_normals = true;
  bool has_texcoords = true;
  const bool has_colors = attributes.colors.size() == attributes.vertices.size();
  const auto triple = [](const std::vector<tinyobj::real_t>& list, int index) {
    const auto at = 3 * static_cast<std::size_t>(index);
    return Vec3{list[at], list[at + 1], list[at + 2]};
  };
  const auto append_corner = [&](tinyobj::index_t corner) {
    const Vec3 p = triple(attributes.vertices, corner.vertex_index);
    mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.push_back({p.x, p.y, p.z, 1});
    if (corner.normal_index < 0) has_normals = false;
    mesh.normals.push_back(corner.normal_index < 0 ? Vec3{}
                                                   : triple(attributes.normals, corner.normal_index));
    if (corner.texcoord_index < 0) has_texcoords = false;
    const auto texcoord = 2 * static_cast<std::size_t>(std::max(corner.texcoord_index, 0));
    mesh.texcoords.push_back({});
    if (has_texcoords)
      mesh.texcoords.back() = {attributes.texcoords[texcoord], attributes.texcoords[texcoord + 1]};
    if (has_colors) {
      const Vec3 c = triple(attributes.colors, corner.vertex_index);
      mesh.colors.push_back({c.x, c.y, c.z, 1});
    }
  };
  for (const tinyobj::shape_t& shape : shapes) {
    std::size_t first = 0;
    for (const std::size_t corners : shape.mesh.num_face_vertices) {
      for (std::size_t i = 2; i < corners; ++i)
        for (const std::size_t corner : {std::size_t{0}, i - 1, i})
          append_corner(shape.mesh.indices[first + corner]);
      first += corners;
    }
  }
  if (!has_normals) mesh.normals.clear();
  if (!has_texcoords) mesh.texcoords.clear();
  return mesh;
}

}  // namespace

Mesh parse_mesh(const Value& v, const std::string& name, const std::string& directory) {
  ObjectReader reader(v);
  Mesh mesh;
  if (const Value builtin = reader.find("builtin")) {
    const Value detail = reader.find("detail");
    mesh = builtin_mesh(text(builtin), detail ? static_cast<int>(integer(detail, 1, 1024)) : 16);
  } else if (const Value file = reader.find("file")) {
    const std::string path = text(file);
    if (!path.ends_with(".obj")) fail(file.pointer, "an .obj file (all that the reference covers)");
    mesh = load_obj(path_in(directory, path));
  } else {
    mesh = parse_inline(reader);
  }
  reader.finish();
  mesh.name = name;
  return mesh;
}

}  // namespace tessera::reference
