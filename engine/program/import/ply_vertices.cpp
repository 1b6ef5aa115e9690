#include "engine/program/import/ply_vertices.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera::program {
namespace {

/// The value of a color component that means full intensity. Integers of 32 bits hold levels of 255.
double full_intensity(PlyType type) {
  switch (type) {
    case PlyType::int8: return 127;
    case PlyType::int16: return 32767;
    case PlyType::uint16: return 65535;
    case PlyType::float32:
    case PlyType::float64: return 1;
    default: return 255;
  }
}

float finite(double value) {
  const auto rounded = static_cast<float>(value);
  return std::isfinite(rounded) ? rounded : 0;
}

/// Numbers of the properties of x, y and z, or of other components that belong together; absent unless all
/// exist.
template <std::size_t N>
using Components = std::optional<std::array<int, N>>;

template <std::size_t N>
Components<N> components(const PlyElement& element,
                         const std::array<std::initializer_list<std::string_view>, N>& names) {
  std::array<int, N> found{};
  for (std::size_t k = 0; k < N; ++k) {
    found[k] = element.find(names[k]);
    if (found[k] < 0) return std::nullopt;
  }
  return found;
}

template <std::size_t N>
void append(const Components<N>& components, const std::vector<double>& values, std::vector<float>& to) {
  if (!components) return;
  for (const int property : *components) to.push_back(finite(values[static_cast<std::size_t>(property)]));
}

/// Whether floats hold the positions exactly. Text may have more digits than its type.
bool are_floats(const PlyElement& element, const std::array<int, 3>& xyz, PlyFormat format) {
  return format != PlyFormat::ascii && std::ranges::all_of(xyz, [&](int property) {
           const PlyType type = element.properties[static_cast<std::size_t>(property)].type;
           return type == PlyType::float32 || size_of(type) < 4;
         });
}

}  // namespace

std::optional<PlyColor> PlyColor::of(const PlyElement& element) {
  PlyColor color;
  color.property_ = {element.find({"red", "r", "diffuse_red"}), element.find({"green", "g", "diffuse_green"}),
                     element.find({"blue", "b", "diffuse_blue"}),
                     element.find({"alpha", "a", "diffuse_alpha"})};
  for (std::size_t k = 0; k < 4; ++k) {
    if (color.property_[k] >= 0)
      color.full_[k] = full_intensity(element.properties[static_cast<std::size_t>(color.property_[k])].type);
    else if (k < 3) return std::nullopt;
  }
  return color;
}

void PlyColor::take(int property, double value) {
  for (std::size_t k = 0; k < 4; ++k)
    if (property_[k] == property) rgba_[k] = finite(value / full_[k]);
}

PlyVertices read_ply_vertices(const PlyElement& element, PlyFormat format, PlyValues& values) {
  const auto xyz = components<3>(element, {{{"x"}, {"y"}, {"z"}}});
  if (!xyz) values.fail("the element \"vertex\" has no properties x, y and z");
  if (element.count > std::numeric_limits<std::uint32_t>::max() - 1)
    values.fail(std::to_string(element.count) + " vertices, must be at most 4294967294");
  const auto normal = components<3>(element, {{{"nx"}, {"ny"}, {"nz"}}});
  const auto texcoord = components<2>(element, {{{"s", "u", "texture_u"}, {"t", "v", "texture_v"}}});
  std::optional<PlyColor> color = PlyColor::of(element);

  PlyVertices vertices{.positions = ModelPositions(are_floats(element, *xyz, format))};
  const auto plausible = static_cast<std::size_t>(values.plausible(element));
  vertices.positions.reserve(plausible);
  if (normal) vertices.normals.reserve(3 * plausible);
  if (color) vertices.colors.reserve(4 * plausible);
  if (texcoord) vertices.texcoords.reserve(2 * plausible);

  const std::size_t properties = element.properties.size();
  std::vector<double> of_vertex(properties);
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (std::size_t p = 0; p < properties; ++p) {
      const PlyProperty& property = element.properties[p];
      if (property.is_list) values.skip(property);
      else of_vertex[p] = values.number(property.type);
      if (color) color->take(static_cast<int>(p), of_vertex[p]);
    }
    const auto at = [&](std::size_t k) { return of_vertex[static_cast<std::size_t>((*xyz)[k])]; };
    vertices.positions.add({at(0), at(1), at(2)});
    append(normal, of_vertex, vertices.normals);
    append(texcoord, of_vertex, vertices.texcoords);
    if (color) vertices.colors.insert(vertices.colors.end(), color->rgba().begin(), color->rgba().end());
  }
  return vertices;
}

}  // namespace tessera::program
