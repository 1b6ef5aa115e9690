// The table in section 6 of the specification. Numbers count from 0 here, so its vertex 2i - 1 is 2i.
#include "primitives.h"

namespace tessera::reference {
namespace {

struct Pattern {
  std::vector<std::size_t> places;  // positions in Mesh::indices
  std::size_t last, first;          // provoking vertex under each convention, an index into `places`
};

Pattern pattern(PrimitiveType type, std::size_t i, std::size_t count) {
  switch (type) {
    case PrimitiveType::kPoints: return {{i}, 0, 0};
    case PrimitiveType::kLines: return {{2 * i, 2 * i + 1}, 1, 0};
    case PrimitiveType::kLineStrip: return {{i, i + 1}, 1, 0};
    case PrimitiveType::kLineLoop:
      return {{i, (i + 1) % count}, 1, 0};  // the closing segment ends at the loop's first vertex
    case PrimitiveType::kTriangles: return {{3 * i, 3 * i + 1, 3 * i + 2}, 2, 0};
    // Every other triangle reversed, so that all have the winding of the first.
    case PrimitiveType::kTriangleStrip:
      if (i % 2 == 0) return {{i, i + 1, i + 2}, 2, 0};
      return {{i + 1, i, i + 2}, 2, 1};
    case PrimitiveType::kTriangleFan: return {{0, i + 1, i + 2}, 2, 1};
    case PrimitiveType::kQuads: return {{4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3}, 3, 0};
    case PrimitiveType::kQuadStrip: return {{2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2}, 2, 0};
    case PrimitiveType::kPolygon: break;
  }
  Pattern whole{{}, 0, 0};
  for (std::size_t place = 0; place < count; ++place) whole.places.push_back(place);
  return whole;
}

}  // namespace

std::string wrong_vertex_count(PrimitiveType type, std::size_t vertices) {
  const auto multiple_of = [&](std::size_t n) {
    return vertices % n == 0 ? std::string() : "a multiple of " + std::to_string(n) + " vertices";
  };
  const auto at_least = [&](std::size_t n) {
    return vertices == 0 || vertices >= n ? std::string() : "at least " + std::to_string(n) + " vertices";
  };
  switch (type) {
    case PrimitiveType::kPoints: return {};
    case PrimitiveType::kLines: return multiple_of(2);
    case PrimitiveType::kLineStrip:
    case PrimitiveType::kLineLoop: return at_least(2);
    case PrimitiveType::kTriangles: return multiple_of(3);
    case PrimitiveType::kTriangleStrip:
    case PrimitiveType::kTriangleFan:
    case PrimitiveType::kPolygon: return at_least(3);
    case PrimitiveType::kQuads: return multiple_of(4);
    case PrimitiveType::kQuadStrip:
      return vertices % 2 != 0 || vertices == 2 ? "an even number of vertices, at least 4" : "";
  }
  return {};
}

std::size_t primitive_count(const Mesh& mesh) {
  const std::size_t vertices = mesh.indices.size();
  if (vertices == 0) return 0;
  switch (mesh.primitive) {
    case PrimitiveType::kPoints:
    case PrimitiveType::kLineLoop: return vertices;
    case PrimitiveType::kLines: return vertices / 2;
    case PrimitiveType::kLineStrip: return vertices - 1;
    case PrimitiveType::kTriangles: return vertices / 3;
    case PrimitiveType::kTriangleStrip:
    case PrimitiveType::kTriangleFan: return vertices - 2;
    case PrimitiveType::kQuads: return vertices / 4;
    case PrimitiveType::kQuadStrip: return vertices / 2 - 1;
    case PrimitiveType::kPolygon: return 1;
  }
  return 0;
}

Primitive primitive(const Mesh& mesh, std::size_t index, ProvokingVertex convention) {
  const Pattern pattern = reference::pattern(mesh.primitive, index, mesh.indices.size());
  Primitive primitive;
  for (const std::size_t place : pattern.places) primitive.vertices.push_back(mesh.indices[place]);
  primitive.provoking = convention == ProvokingVertex::kFirst ? pattern.first : pattern.last;
  return primitive;
}

}  // namespace tessera::reference
