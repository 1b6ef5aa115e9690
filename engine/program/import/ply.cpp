#include "engine/program/import/ply.h"

#include <cmath>
#include <optional>
#include <utility>

#include "engine/program/import/model_file.h"
#include "engine/program/import/model_normals.h"
#include "engine/program/import/ply_faces.h"
#include "engine/program/import/vertex_alpha.h"

namespace tessera::program {
namespace {

struct PlyContent {
  PlyVertices vertices;
  PlyFaces faces;
};

void skip(const PlyElement& element, PlyValues& values) {
  for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i)
    for (const PlyProperty& property : element.properties) values.skip(property);
}

PlyContent read_elements(ModelFile& file, const PlyHeader& header) {
  std::optional<PlyVertices> vertices;
  PlyValues values(file, header.format);
  PlyContent content{.vertices = {}, .faces = PlyFaces(header)};
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex" && element.count > 0 && !vertices) {
      vertices = read_ply_vertices(element, header.format, values);
      content.faces.set_vertices(&*vertices);
    } else if (element.name == "face" && element.count > 0) {
      content.faces.read_polygons(element, values);
    } else if (element.name == "tristrips" && element.count > 0) {
      content.faces.read_strips(element, values);
    } else if (element.name == "edge" && element.count > 0) {
      content.faces.read_edges(element, values);
    } else {
      skip(element, values);
    }
  }
  if (!vertices) throw Error(file.path() + ": holds no vertex");
  content.faces.set_vertices(nullptr);
  content.vertices = std::move(*vertices);
  return content;
}

/// Indices of the vertices whose positions are finite: clouds of scanners mark missing points with NaN.
std::vector<std::uint32_t> finite_points(const std::vector<float>& positions) {
  std::vector<std::uint32_t> points;
  points.reserve(positions.size() / 3);
  for (std::size_t i = 0; i < positions.size(); i += 3)
    if (std::isfinite(positions[i] + positions[i + 1] + positions[i + 2]))
      points.push_back(static_cast<std::uint32_t>(i / 3));
  return points;
}

void add_part(PlyContent& content, const PlyHeader& header, Model& model) {
  MeshData& mesh = model.mesh;
  ModelPart part;
  if (content.faces.has_triangles()) {
    mesh.indices = std::move(content.faces.triangles());
  } else if (!content.faces.edges().empty()) {
    part.primitive = Primitive::lines;
    mesh.indices = std::move(content.faces.edges());
  } else {
    part.primitive = Primitive::points;
    mesh.indices = finite_points(mesh.positions);
  }
  part.index_count = mesh.indices.size();
  part.material.ambient = part.material.diffuse = {1, 1, 1, 1};
  part.uses_colors = !mesh.colors.empty();
  if (part.uses_colors) part.alpha = alpha_of_colors(mesh.colors);
  part.is_unlit = part.primitive != Primitive::triangles && mesh.normals.empty();
  if (!header.texture.empty() && !mesh.texcoords.empty()) {
    model.images.push_back({.name = header.texture});
    model.textures.push_back({});
    part.texture = 0;
  }
  model.parts.push_back(std::move(part));
}

}  // namespace

Model read_ply(ModelFile& file, ModelUse use, const ReportProgress& progress) {
  if (file.size() == 0) throw Error(file.path() + ": the file is empty");
  const PlyHeader header = read_ply_header(file);
  PlyContent content = read_elements(file, header);
  if (content.faces.has_triangles()) content.faces.apply_looks(content.vertices);
  Model model;
  model.mesh.positions = content.vertices.positions.take_floats(use, model.origin);
  model.mesh.normals = std::move(content.vertices.normals);
  model.mesh.colors = std::move(content.vertices.colors);
  model.mesh.texcoords = std::move(content.vertices.texcoords);
  add_part(content, header, model);
  if (model.mesh.indices.empty()) throw Error(file.path() + ": holds no vertex with a finite position");
  if (use == ModelUse::mesh && model.parts[0].primitive == Primitive::triangles)
    add_creased_normals(model.mesh, kCreaseDegrees, {}, progress);
  for (const std::string& warning : header.warnings) model.warnings.push_back(file.path() + ": " + warning);
  return model;
}

Model import_ply(const std::string& path, ModelUse use, const ReportProgress& progress) {
  ModelFile file(path, part_of(progress, 0, use == ModelUse::mesh ? 0.7 : 1));
  return read_ply(file, use, part_of(progress, 0.7, 1));
}

}  // namespace tessera::program
