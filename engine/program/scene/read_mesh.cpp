// Reads meshes: built in, from a model file, or written in the scene.
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/program/scene/builtin_mesh.h"
#include "engine/program/scene/read_scene.h"
#include "engine/program/scene/state_names.h"

namespace tessera::program {
namespace {

using json::Json;
using json::Object;
using json::Value;

MeshData read_builtin(const Value& value) {
  const Object object(value, {"builtin", "detail"});
  const std::string name = object.require("builtin").choice<std::string>({{"teapot", "teapot"},
                                                                          {"sphere", "sphere"},
                                                                          {"torus", "torus"},
                                                                          {"cube", "cube"},
                                                                          {"cylinder", "cylinder"},
                                                                          {"cone", "cone"},
                                                                          {"quad", "quad"},
                                                                          {"grid", "grid"}});
  const auto detail = object.find("detail");
  return builtin_mesh(name, detail ? static_cast<int>(detail->integer(min_mesh_detail(name), kMaxMeshDetail))
                                   : kDefaultMeshDetail);
}

/// A mesh whose file's parts are still to be added to the scene.
struct OpenFile {
  std::size_t mesh;
  const FileModel* model;
};

/// Adds the meshes and textures of a model. Draws of the mesh become the draws of its parts.
void add_parts(const OpenFile& file, FileDraws& file_draws, Scene& scene) {
  const FileModel& model = *file.model;
  scene.textures.insert(scene.textures.end(), model.textures.begin(), model.textures.end());
  const std::string name = scene.meshes[file.mesh].name;
  std::vector<DrawCommand> draws = model.draws;
  for (DrawCommand& draw : draws) {
    scene.meshes.push_back(model.meshes[draw.mesh]);
    scene.meshes.back().name = name + ": " + scene.meshes.back().name;
    draw.mesh = scene.meshes.size() - 1;
  }
  file_draws.emplace(file.mesh, std::move(draws));
}

void add_warnings(const std::vector<std::string>& warnings, Scene& scene) {
  for (const std::string& warning : warnings)
    if (std::ranges::find(scene.warnings, warning) == scene.warnings.end()) scene.warnings.push_back(warning);
}

// Reads a list of vectors into a flat array. JSON pointers are built for errors only, which keeps long lists
// fast.
std::vector<float> read_vectors(const Value& list, std::size_t components) {
  std::vector<float> numbers;
  numbers.reserve(list.size() * components);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Json& vector = list.json()[i];
    if (!vector.is_array() || vector.size() != components)
      list.element(i).fail("an array of " + std::to_string(components) + " numbers");
    for (std::size_t k = 0; k < components; ++k) {
      const Json& number = vector[k];
      const double x = number.is_number() ? number.get<double>() : std::numeric_limits<double>::infinity();
      numbers.push_back(std::abs(x) <= std::numeric_limits<float>::max() ? static_cast<float>(x)
                                                                         : list.element(i).element(k).real());
    }
  }
  return numbers;
}

std::vector<float> read_per_vertex(const Object& object, const char* key, std::size_t components,
                                   std::size_t vertices) {
  const auto list = object.find(key);
  if (!list) return {};
  if (list->size() != vertices) list->fail("one for each of the " + std::to_string(vertices) + " positions");
  return read_vectors(*list, components);
}

std::vector<float> read_color_indices(const Value& list, std::size_t vertices) {
  if (list.size() != vertices) list.fail("one for each of the " + std::to_string(vertices) + " positions");
  std::vector<float> indices;
  indices.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) indices.push_back(list.element(i).real());
  return indices;
}

// Checks that the list makes whole primitives.
void require_whole_primitives(const Value& list, Primitive primitive, const char* corners) {
  if (list.size() != 0 && makes_whole_primitives(primitive, list.size())) return;
  list.fail(std::string(corners_needed(primitive)) + " " + corners + ", for " +
            std::string(name_of_mesh(primitive)));
}

std::vector<std::uint32_t> read_indices(const Value& list, std::size_t vertices, Primitive primitive) {
  require_whole_primitives(list, primitive, "indices");
  std::vector<std::uint32_t> indices;
  indices.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Json& index = list.json()[i];
    const bool fits = index.is_number_unsigned() && index.get<std::uint64_t>() < vertices;
    indices.push_back(static_cast<std::uint32_t>(
        fits ? index.get<std::uint64_t>()
             : list.element(i).integer(0, static_cast<std::int64_t>(vertices) - 1)));
  }
  return indices;
}

int min_vertices(Primitive primitive) {
  switch (primitive) {
    case Primitive::points: return 1;
    case Primitive::lines:
    case Primitive::line_strip:
    case Primitive::line_loop: return 2;
    default: return 3;
  }
}

MeshData read_inline(const Value& value) {
  const Object object(
      value, {"primitive", "positions", "normals", "colors", "color_indices", "texcoords", "indices"});
  const Value positions = object.require("positions");
  const std::size_t vertices = positions.size();
  MeshData mesh;
  if (const auto primitive = object.find("primitive")) mesh.primitive = primitive->choice(kPrimitives);
  if (vertices == 0) {
    const int min_count = min_vertices(mesh.primitive);
    positions.fail("at least " + std::to_string(min_count) + (min_count == 1 ? " position" : " positions"));
  }
  mesh.position_components = positions.json()[0].is_array() && positions.json()[0].size() == 4 ? 4 : 3;
  mesh.positions = read_vectors(positions, static_cast<std::size_t>(mesh.position_components));
  mesh.normals = read_per_vertex(object, "normals", 3, vertices);
  mesh.colors = read_per_vertex(object, "colors", 4, vertices);
  mesh.texcoords = read_per_vertex(object, "texcoords", 2, vertices);
  if (const auto indices = object.find("color_indices"))
    mesh.color_indices = read_color_indices(*indices, vertices);
  if (const auto indices = object.find("indices"))
    mesh.indices = read_indices(*indices, vertices, mesh.primitive);
  else require_whole_primitives(positions, mesh.primitive, "positions, or \"indices\"");
  return mesh;
}

}  // namespace

FileDraws read_meshes(const Value& value, const MeshUses& uses, const std::string& base_folder,
                      FileCache& cache, Scene& scene) {
  std::vector<OpenFile> files;
  value.for_each_member([&](const std::string& name, const Value& member) {
    const Object object(member, {"builtin", "detail", "file", "primitive", "positions", "normals", "colors",
                                 "color_indices", "texcoords", "indices"});
    MeshData mesh;
    if (object.has("builtin")) {
      mesh = read_builtin(member);
    } else if (object.has("file")) {
      const Value file = Object(member, {"file"}).require("file");
      const bool has_materials = uses.with_materials.contains(name);
      if (has_materials) {
        files.push_back({scene.meshes.size(), &file_model(file, base_folder, cache)});
        add_warnings(files.back().model->model.warnings, scene);
      }
      if (!has_materials || uses.alone.contains(name)) {
        const FileMesh& alone = file_mesh(file, base_folder, cache);
        mesh = alone.mesh;
        add_warnings(alone.warnings, scene);
      }
    } else {
      mesh = read_inline(member);
    }
    mesh.name = name;
    scene.meshes.push_back(std::move(mesh));
  });
  FileDraws file_draws;
  for (const OpenFile& file : files) add_parts(file, file_draws, scene);
  return file_draws;
}

}  // namespace tessera::program
