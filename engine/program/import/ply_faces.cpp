#include "engine/program/import/ply_faces.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "engine/program/import/polygon_split.h"

namespace tessera::program {
namespace {

constexpr std::size_t kMaxSplitCorners = 4096;  // splitting takes the square of their number

std::uint32_t hash_of(std::uint32_t vertex, const PlyLook& look) {
  std::uint64_t hash = vertex;
  for (const float x : look.color) hash = mixed(hash, std::bit_cast<std::uint32_t>(x));
  for (const float x : look.texcoord) hash = mixed(hash, std::bit_cast<std::uint32_t>(x));
  return static_cast<std::uint32_t>(hash);
}

/// Copies the components of some vertices, in their order.
std::vector<float> picked(const std::vector<float>& from, std::size_t components,
                          const std::vector<std::uint32_t>& vertices) {
  std::vector<float> to;
  to.reserve(from.empty() ? 0 : components * vertices.size());
  for (const std::uint32_t vertex : vertices)
    if (!from.empty())
      to.insert(to.end(), &from[components * vertex], &from[components * vertex] + components);
  return to;
}

}  // namespace

PlyFaces::PlyFaces(const PlyHeader& header) {
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex" && vertex_count_ == 0) vertex_count_ = element.count;
    if (element.name != "face" || element.count == 0) continue;
    have_colors_ |= PlyColor::of(element).has_value();
    have_texcoords_ |= element.find({"texcoord"}, true) >= 0;
  }
}

std::uint32_t PlyFaces::index(PlyValues& values, PlyType type) const {
  const std::int64_t index = values.integer(type);
  if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count_)
    values.fail("found vertex " + std::to_string(index) + ", the file has " + std::to_string(vertex_count_));
  return static_cast<std::uint32_t>(index);
}

void PlyFaces::read_polygons(const PlyElement& element, PlyValues& values) {
  const int list = element.find({"vertex_indices", "vertex_index"}, true);
  if (list < 0) values.fail("the element \"face\" has no list vertex_indices");
  const int texcoords = element.find({"texcoord"}, true);
  std::optional<PlyColor> color = PlyColor::of(element);
  triangles_.reserve(3 * static_cast<std::size_t>(values.plausible(element)));
  Polygon polygon;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (int p = 0; p < static_cast<int>(element.properties.size()); ++p) {
      const PlyProperty& property = element.properties[static_cast<std::size_t>(p)];
      if (p == list) {
        polygon.corners.resize(values.list_length(property));
        for (std::uint32_t& corner : polygon.corners) corner = index(values, property.type);
      } else if (p == texcoords) {
        polygon.texcoords.resize(values.list_length(property));
        for (float& x : polygon.texcoords) x = static_cast<float>(values.number(property.type));
      } else if (property.is_list || !color) {
        values.skip(property);
      } else {
        color->take(p, values.number(property.type));
      }
    }
    if (color) polygon.color = color->rgba();
    add(polygon);
  }
}

void PlyFaces::add(const Polygon& polygon) {
  const auto corners = static_cast<std::uint32_t>(polygon.corners.size());
  if (corners <= 3 || corners > kMaxSplitCorners || vertices_ == nullptr) {
    for (std::uint32_t i = 1; i + 1 < corners; ++i) add_triangle(polygon, {0, i, i + 1});
    return;
  }
  std::vector<std::array<float, 3>> points;
  const Position origin = vertices_->positions[polygon.corners[0]];
  for (const std::uint32_t corner : polygon.corners) {
    const Position p = vertices_->positions[corner];
    points.push_back({static_cast<float>(p.x - origin.x), static_cast<float>(p.y - origin.y),
                      static_cast<float>(p.z - origin.z)});
  }
  for (const auto& triangle : split_polygon(points)) add_triangle(polygon, triangle);
}

void PlyFaces::add_triangle(const Polygon& polygon, const std::array<std::uint32_t, 3>& numbers) {
  for (const std::uint32_t number : numbers) {
    std::uint32_t corner = polygon.corners[number];
    if (have_colors_ || have_texcoords_) {
      PlyLook look{.color = polygon.color};
      if (2 * std::size_t{number} + 1 < polygon.texcoords.size())
        look.texcoord = {polygon.texcoords[2 * number], polygon.texcoords[2 * number + 1]};
      corner = corner_of(corner, look);
    }
    triangles_.push_back(corner);
  }
}

std::uint32_t PlyFaces::corner_of(std::uint32_t vertex, const PlyLook& look) {
  const auto is_corner = [&](std::uint32_t other) {
    const PlyLook& its = corner_looks_[other];
    return corner_vertices_[other] == vertex && its.color == look.color && its.texcoord == look.texcoord;
  };
  const auto next = static_cast<std::uint32_t>(corner_vertices_.size());
  const std::uint32_t corner = corners_.find_or_add(hash_of(vertex, look), next, is_corner);
  if (corner == next) {
    corner_vertices_.push_back(vertex);
    corner_looks_.push_back(look);
  }
  return corner;
}

void PlyFaces::read_strips(const PlyElement& element, PlyValues& values) {
  const int list = element.find({"vertex_indices", "vertex_index"}, true);
  if (list < 0) values.fail("the element \"" + element.name + "\" has no list vertex_indices");
  Polygon triangle{.corners = {0, 0, 0}};
  for (std::uint64_t i = 0; i < element.count; ++i)
    for (const PlyProperty& property : element.properties) {
      if (&property != &element.properties[static_cast<std::size_t>(list)]) {
        values.skip(property);
        continue;
      }
      std::uint64_t in_strip = 0;
      for (std::uint64_t left = values.list_length(property); left > 0; --left) {
        const std::int64_t found = values.integer(property.type);
        in_strip = found == -1 ? 0 : in_strip + 1;
        if (found == -1) continue;
        if (found < 0 || static_cast<std::uint64_t>(found) >= vertex_count_)
          values.fail("found vertex " + std::to_string(found) + ", the file has " +
                      std::to_string(vertex_count_));
        std::vector<std::uint32_t>& last = triangle.corners;
        last = {last[1], last[2], static_cast<std::uint32_t>(found)};
        if (in_strip < 3 || last[0] == last[1] || last[1] == last[2] || last[2] == last[0]) continue;
        if (in_strip % 2 == 1) add_triangle(triangle, {0, 1, 2});
        else add_triangle(triangle, {1, 0, 2});
      }
    }
}

void PlyFaces::read_edges(const PlyElement& element, PlyValues& values) {
  const int ends[] = {element.find({"vertex1"}), element.find({"vertex2"})};
  if (ends[0] < 0 || ends[1] < 0) values.fail("the element \"edge\" has no properties vertex1 and vertex2");
  edges_.reserve(2 * static_cast<std::size_t>(values.plausible(element)));
  for (std::uint64_t i = 0; i < element.count; ++i) {
    std::array<std::uint32_t, 2> edge{};
    for (int p = 0; p < static_cast<int>(element.properties.size()); ++p) {
      const PlyProperty& property = element.properties[static_cast<std::size_t>(p)];
      if (p == ends[0]) edge[0] = index(values, property.type);
      else if (p == ends[1]) edge[1] = index(values, property.type);
      else values.skip(property);
    }
    edges_.insert(edges_.end(), edge.begin(), edge.end());
  }
}

void PlyFaces::apply_looks(PlyVertices& vertices) {
  if (!have_colors_ && !have_texcoords_) return;
  corners_ = {};
  ModelPositions positions = vertices.positions.without_positions();
  positions.reserve(corner_vertices_.size());
  for (const std::uint32_t vertex : corner_vertices_) positions.add(vertices.positions[vertex]);
  vertices.positions = std::move(positions);
  vertices.normals = picked(vertices.normals, 3, corner_vertices_);
  vertices.colors = picked(vertices.colors, 4, corner_vertices_);
  vertices.texcoords = picked(vertices.texcoords, 2, corner_vertices_);
  if (have_colors_) {
    vertices.colors.clear();
    for (const PlyLook& look : corner_looks_)
      vertices.colors.insert(vertices.colors.end(), look.color.begin(), look.color.end());
  }
  if (have_texcoords_) {
    vertices.texcoords.clear();
    for (const PlyLook& look : corner_looks_)
      vertices.texcoords.insert(vertices.texcoords.end(), look.texcoord.begin(), look.texcoord.end());
  }
}

}  // namespace tessera::program
