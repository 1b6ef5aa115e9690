#include "engine/program/import/gltf_pose.h"

#include <algorithm>
#include <string>

namespace tessera::program {
namespace {

constexpr GltfMatrix kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// Translation, rotation by a quaternion x y z w, scale.
GltfMatrix local_matrix(const tinygltf::Node& node) {
  GltfMatrix m = kIdentity;
  if (node.matrix.size() == 16) {
    std::ranges::copy(node.matrix, m.begin());
    return m;
  }
  if (node.rotation.size() == 4) {
    const double x = node.rotation[0], y = node.rotation[1], z = node.rotation[2], w = node.rotation[3];
    m = {1 - 2 * (y * y + z * z),
         2 * (x * y + z * w),
         2 * (x * z - y * w),
         0,
         2 * (x * y - z * w),
         1 - 2 * (x * x + z * z),
         2 * (y * z + x * w),
         0,
         2 * (x * z + y * w),
         2 * (y * z - x * w),
         1 - 2 * (x * x + y * y),
         0,
         0,
         0,
         0,
         1};
  }
  for (std::size_t column = 0; column < 3; ++column)
    for (std::size_t row = 0; row < 3; ++row)
      if (node.scale.size() == 3) m[4 * column + row] *= node.scale[column];
  for (std::size_t row = 0; row < 3; ++row)
    if (node.translation.size() == 3) m[12 + row] = node.translation[row];
  return m;
}

class WorldReader {
 public:
  explicit WorldReader(const tinygltf::Model& gltf) : gltf_(gltf), is_reached_(gltf.nodes.size()) {
    world_.matrices.assign(gltf.nodes.size(), kIdentity);
  }

  GltfWorld read() {
    for (const int root : roots()) visit(root, kIdentity, 0);
    return std::move(world_);
  }

 private:
  std::vector<int> roots() const {
    if (!gltf_.scenes.empty()) {
      const int number = std::max(gltf_.defaultScene, 0);
      if (static_cast<std::size_t>(number) >= gltf_.scenes.size())
        throw Error("the default scene is " + std::to_string(number) + ", there are " +
                    std::to_string(gltf_.scenes.size()));
      return gltf_.scenes[static_cast<std::size_t>(number)].nodes;
    }
    std::vector<bool> is_child(gltf_.nodes.size());
    for (const tinygltf::Node& node : gltf_.nodes)
      for (const int child : node.children)
        if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
          is_child[static_cast<std::size_t>(child)] = true;
    std::vector<int> list;
    for (std::size_t i = 0; i < is_child.size(); ++i)
      if (!is_child[i]) list.push_back(static_cast<int>(i));
    return list;
  }

  void visit(int number, const GltfMatrix& parent, int depth) {
    if (number < 0 || static_cast<std::size_t>(number) >= gltf_.nodes.size())
      throw Error("found a reference to node " + std::to_string(number) + ", there are " +
                  std::to_string(gltf_.nodes.size()));
    if (depth > kMaxNodeDepth)
      throw Error("its nodes are nested deeper than " + std::to_string(kMaxNodeDepth) + " levels");
    const auto node = static_cast<std::size_t>(number);
    if (is_reached_[node]) throw Error("node " + std::to_string(number) + " has two parents");
    is_reached_[node] = true;
    world_.matrices[node] = product(parent, local_matrix(gltf_.nodes[node]));
    world_.nodes.push_back(node);
    for (const int child : gltf_.nodes[node].children) visit(child, world_.matrices[node], depth + 1);
  }

  const tinygltf::Model& gltf_;
  std::vector<bool> is_reached_;
  GltfWorld world_;
};

}  // namespace

GltfMatrix product(const GltfMatrix& left, const GltfMatrix& right) {
  GltfMatrix m{};
  for (std::size_t column = 0; column < 4; ++column)
    for (std::size_t row = 0; row < 4; ++row)
      for (std::size_t k = 0; k < 4; ++k) m[4 * column + row] += left[4 * k + row] * right[4 * column + k];
  return m;
}

std::array<double, 3> transformed_point(const GltfMatrix& m, const double* p) {
  std::array<double, 3> result{};
  for (std::size_t row = 0; row < 3; ++row)
    result[row] = m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row];
  return result;
}

std::array<double, 3> transformed_normal(const GltfMatrix& m, const double* n) {
  // Rows of the cofactor matrix are cross products of columns.
  const auto cross = [&](std::size_t a, std::size_t b) -> std::array<double, 3> {
    const double *u = &m[4 * a], *v = &m[4 * b];
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  };
  const std::array<double, 3> x = cross(1, 2), y = cross(2, 0), z = cross(0, 1);
  // Mirrors turn normals as they turn the surface.
  const double sign = determinant(m) < 0 ? -1 : 1;
  std::array<double, 3> result{};
  for (std::size_t k = 0; k < 3; ++k) result[k] = sign * (x[k] * n[0] + y[k] * n[1] + z[k] * n[2]);
  return result;
}

double determinant(const GltfMatrix& m) {
  return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) +
         m[8] * (m[1] * m[6] - m[2] * m[5]);
}

GltfWorld gltf_world(const tinygltf::Model& gltf) { return WorldReader(gltf).read(); }

std::vector<GltfMatrix> joint_matrices(const GltfFile& file, const tinygltf::Model& gltf,
                                       const GltfWorld& world, int number) {
  if (number < 0 || static_cast<std::size_t>(number) >= gltf.skins.size())
    throw Error("found a reference to skin " + std::to_string(number) + ", there are " +
                std::to_string(gltf.skins.size()));
  const tinygltf::Skin& skin = gltf.skins[static_cast<std::size_t>(number)];
  GltfValues inverse_bind;
  if (skin.inverseBindMatrices >= 0) inverse_bind = read_accessor(file, gltf, skin.inverseBindMatrices);
  const bool has_matrices = skin.inverseBindMatrices >= 0;
  if (has_matrices && (inverse_bind.components != 16 || inverse_bind.count() < skin.joints.size()))
    throw Error("skin " + std::to_string(number) + " has " + std::to_string(skin.joints.size()) +
                " joints and " + std::to_string(inverse_bind.count()) + " inverse bind matrices");
  std::vector<GltfMatrix> matrices;
  for (std::size_t i = 0; i < skin.joints.size(); ++i) {
    const int joint = skin.joints[i];
    if (joint < 0 || static_cast<std::size_t>(joint) >= world.matrices.size())
      throw Error("a skin refers to node " + std::to_string(joint) + ", there are " +
                  std::to_string(world.matrices.size()));
    GltfMatrix bind = kIdentity;
    if (has_matrices) std::copy_n(inverse_bind.element(i), 16, bind.begin());
    matrices.push_back(product(world.matrices[static_cast<std::size_t>(joint)], bind));
  }
  return matrices;
}

}  // namespace tessera::program
