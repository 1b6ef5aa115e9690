// The named materials of the lighting tables.
#include <algorithm>
#include <array>

#include "engine/tessera/tessera.hpp"

namespace tessera {
using namespace detail;
namespace {

struct NamedMaterial {
  std::string_view name;
  float ambient[3];
  float diffuse[3];
  float specular[3];
  float alpha;
  float shininess;
};

constexpr NamedMaterial kMaterials[] = {
    {"emerald",
     {0.0215f, 0.1745f, 0.0215f},
     {0.07568f, 0.61424f, 0.07568f},
     {0.633f, 0.727811f, 0.633f},
     0.55f,
     76.8f},
    {"jade",
     {0.135f, 0.2225f, 0.1575f},
     {0.54f, 0.89f, 0.63f},
     {0.316228f, 0.316228f, 0.316228f},
     0.95f,
     12.8f},
    {"obsidian",
     {0.05375f, 0.05f, 0.06625f},
     {0.18275f, 0.17f, 0.22525f},
     {0.332741f, 0.328634f, 0.346435f},
     0.82f,
     38.4f},
    {"pearl",
     {0.25f, 0.20725f, 0.20725f},
     {1, 0.829f, 0.829f},
     {0.296648f, 0.296648f, 0.296648f},
     0.922f,
     11.264f},
    {"ruby",
     {0.1745f, 0.01175f, 0.01175f},
     {0.61424f, 0.04136f, 0.04136f},
     {0.727811f, 0.626959f, 0.626959f},
     0.55f,
     76.8f},
    {"turquoise",
     {0.1f, 0.18725f, 0.1745f},
     {0.396f, 0.74151f, 0.69102f},
     {0.297254f, 0.30829f, 0.306678f},
     0.8f,
     12.8f},
    {"black_plastic", {0, 0, 0}, {0.01f, 0.01f, 0.01f}, {0.5f, 0.5f, 0.5f}, 1, 32},
    {"black_rubber", {0.02f, 0.02f, 0.02f}, {0.01f, 0.01f, 0.01f}, {0.4f, 0.4f, 0.4f}, 1, 10},
    {"brass",
     {0.329412f, 0.223529f, 0.027451f},
     {0.780392f, 0.568627f, 0.113725f},
     {0.992157f, 0.941176f, 0.807843f},
     1,
     27.8974f},
    {"bronze",
     {0.2125f, 0.1275f, 0.054f},
     {0.714f, 0.4284f, 0.18144f},
     {0.393548f, 0.271906f, 0.166721f},
     1,
     25.6f},
    {"polished_bronze",
     {0.25f, 0.148f, 0.06475f},
     {0.4f, 0.2368f, 0.1036f},
     {0.774597f, 0.458561f, 0.200621f},
     1,
     76.8f},
    {"chrome", {0.25f, 0.25f, 0.25f}, {0.4f, 0.4f, 0.4f}, {0.774597f, 0.774597f, 0.774597f}, 1, 76.8f},
    {"copper",
     {0.19125f, 0.0735f, 0.0225f},
     {0.7038f, 0.27048f, 0.0828f},
     {0.256777f, 0.137622f, 0.086014f},
     1,
     12.8f},
    {"polished_copper",
     {0.2295f, 0.08825f, 0.0275f},
     {0.5508f, 0.2118f, 0.066f},
     {0.580594f, 0.223257f, 0.0695701f},
     1,
     51.2f},
    {"gold",
     {0.24725f, 0.1995f, 0.0745f},
     {0.75164f, 0.60648f, 0.22648f},
     {0.628281f, 0.555802f, 0.366065f},
     1,
     51.2f},
    {"polished_gold",
     {0.24725f, 0.2245f, 0.0645f},
     {0.34615f, 0.3143f, 0.0903f},
     {0.797357f, 0.723991f, 0.208006f},
     1,
     83.2f},
    {"pewter",
     {0.105882f, 0.058824f, 0.113725f},
     {0.427451f, 0.470588f, 0.541176f},
     {0.333333f, 0.333333f, 0.521569f},
     1,
     9.84615f},
    {"silver",
     {0.19225f, 0.19225f, 0.19225f},
     {0.50754f, 0.50754f, 0.50754f},
     {0.508273f, 0.508273f, 0.508273f},
     1,
     51.2f},
    {"polished_silver",
     {0.23125f, 0.23125f, 0.23125f},
     {0.2775f, 0.2775f, 0.2775f},
     {0.773911f, 0.773911f, 0.773911f},
     1,
     89.6f},
};

}  // namespace

std::optional<Material> named_material(std::string_view name) {
  const auto* found = std::find_if(std::begin(kMaterials), std::end(kMaterials),
                                   [&](const NamedMaterial& m) { return m.name == name; });
  if (found == std::end(kMaterials)) return std::nullopt;
  const auto color = [&](const float(&c)[3]) { return Color{c[0], c[1], c[2], found->alpha}; };
  Material material;
  material.ambient = color(found->ambient);
  material.diffuse = color(found->diffuse);
  material.specular = color(found->specular);
  material.shininess = found->shininess;
  return material;
}

std::vector<std::string_view> material_names() {
  std::vector<std::string_view> names;
  for (const NamedMaterial& m : kMaterials) names.push_back(m.name);
  return names;
}

}  // namespace tessera
