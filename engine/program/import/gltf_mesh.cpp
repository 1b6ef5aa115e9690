#include "engine/program/import/gltf_mesh.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <string>

#include "engine/program/import/gltf_draco.h"

namespace tessera::program {
namespace {

/// Attributes by name: from accessors, or from a compressed primitive.
class Attributes {
 public:
  Attributes(const GltfFile& file, const tinygltf::Model& gltf, const tinygltf::Primitive& primitive)
      : file_(file), gltf_(gltf), primitive_(primitive), compressed_(decode_draco(file, primitive)) {}

  /// @return no elements if there is no such attribute
  GltfValues values(const std::string& name) const {
    if (compressed_)
      if (const auto found = compressed_->attributes.find(name); found != compressed_->attributes.end())
        return found->second;
    const auto found = primitive_.attributes.find(name);
    return found == primitive_.attributes.end() ? GltfValues{} : read_accessor(file_, gltf_, found->second);
  }

  std::optional<std::vector<std::uint32_t>> indices() const {
    if (compressed_) return compressed_->indices;
    if (primitive_.indices < 0) return std::nullopt;
    return read_indices(file_, gltf_, primitive_.indices);
  }

 private:
  const GltfFile& file_;
  const tinygltf::Model& gltf_;
  const tinygltf::Primitive& primitive_;
  std::optional<DracoPrimitive> compressed_;
};

/// Copies up to N components of each element; missing ones keep the fallback.
template <std::size_t N>
std::vector<std::array<double, N>> elements(const GltfValues& values, const std::array<double, N>& fallback) {
  std::vector<std::array<double, N>> list(values.count(), fallback);
  for (std::size_t i = 0; i < list.size(); ++i)
    std::copy_n(values.element(i), std::min(N, values.components), list[i].begin());
  return list;
}

void add_targets(const GltfFile& file, const tinygltf::Model& gltf, const tinygltf::Primitive& from,
                 const std::vector<double>& weights, const char* attribute,
                 std::vector<std::array<double, 3>>& base) {
  for (std::size_t t = 0; t < from.targets.size() && t < weights.size(); ++t) {
    const auto found = from.targets[t].find(attribute);
    if (weights[t] == 0 || found == from.targets[t].end()) continue;
    const auto offsets = elements<3>(read_accessor(file, gltf, found->second), {0, 0, 0});
    for (std::size_t i = 0; i < std::min(base.size(), offsets.size()); ++i)
      for (std::size_t k = 0; k < 3; ++k) base[i][k] += weights[t] * offsets[i][k];
  }
}

/// Splits strips, fans and loops into lists. Triangles of a strip keep their orientation.
std::vector<std::uint32_t> as_list(const std::vector<std::uint32_t>& from, int mode, Primitive& primitive) {
  std::vector<std::uint32_t> list;
  const std::size_t n = from.size();
  const auto add = [&](std::initializer_list<std::size_t> corners) {
    for (const std::size_t corner : corners) list.push_back(from[corner]);
  };
  switch (mode) {
    case TINYGLTF_MODE_POINTS: primitive = Primitive::points; return from;
    case TINYGLTF_MODE_LINE:
      primitive = Primitive::lines;
      for (std::size_t i = 0; i + 1 < n; i += 2) add({i, i + 1});
      return list;
    case TINYGLTF_MODE_LINE_LOOP:
    case TINYGLTF_MODE_LINE_STRIP:
      primitive = Primitive::lines;
      for (std::size_t i = 0; i + 1 < n; ++i) add({i, i + 1});
      if (mode == TINYGLTF_MODE_LINE_LOOP && n > 2) add({n - 1, 0});
      return list;
    case TINYGLTF_MODE_TRIANGLE_STRIP:
      for (std::size_t i = 0; i + 2 < n; ++i) add({i, i + 1 + i % 2, i + 2 - i % 2});
      return list;
    case TINYGLTF_MODE_TRIANGLE_FAN:
      for (std::size_t i = 1; i + 1 < n; ++i) add({i, i + 1, 0});
      return list;
    default:
      for (std::size_t i = 0; i + 2 < n; i += 3) add({i, i + 1, i + 2});
      return list;
  }
}

/// Attributes with fewer elements than positions are an error; with more, the rest is ignored.
template <class List>
void fit(const char* name, std::size_t vertices, List& list) {
  if (list.empty()) return;
  if (list.size() < vertices)
    throw Error(std::string("a primitive has ") + std::to_string(vertices) + " positions and " +
                std::to_string(list.size()) + " values of " + name);
  list.resize(vertices);
}

}  // namespace

GltfPrimitive read_primitive(const GltfFile& file, const tinygltf::Model& gltf,
                             const tinygltf::Primitive& from, const std::vector<double>& weights,
                             const GltfMaterial& material) {
  const Attributes attributes(file, gltf, from);
  GltfPrimitive to;
  to.positions = elements<3>(attributes.values("POSITION"), {0, 0, 0});
  to.normals = elements<3>(attributes.values("NORMAL"), {0, 0, 0});
  to.colors = elements<4>(attributes.values("COLOR_0"), {1, 1, 1, 1});
  if (material.texture)
    to.texcoords =
        elements<2>(attributes.values("TEXCOORD_" + std::to_string(material.texture->coordinates)), {0, 0});
  to.joints = attributes.values("JOINTS_0");
  to.weights = attributes.values("WEIGHTS_0");
  const std::size_t vertices = to.positions.size();
  fit("NORMAL", vertices, to.normals);
  fit("COLOR_0", vertices, to.colors);
  fit("TEXCOORD", vertices, to.texcoords);
  if (to.joints.count() < vertices || to.weights.count() < vertices) to.joints = to.weights = {};
  add_targets(file, gltf, from, weights, "POSITION", to.positions);
  add_targets(file, gltf, from, weights, "NORMAL", to.normals);

  std::vector<std::uint32_t> indices(vertices);
  if (auto given = attributes.indices()) indices = std::move(*given);
  else std::iota(indices.begin(), indices.end(), 0u);
  for (const std::uint32_t index : indices)
    if (index >= vertices)
      throw Error("a primitive refers to vertex " + std::to_string(index) + ", there are " +
                  std::to_string(vertices));
  to.indices = as_list(indices, from.mode, to.primitive);
  return to;
}

}  // namespace tessera::program
