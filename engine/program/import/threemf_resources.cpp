#include "engine/program/import/threemf_resources.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>
#include <utility>

#include "engine/program/import/threemf_xml.h"

namespace tessera::program::threemf {
namespace {

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// #RRGGBB or #RRGGBBAA, display-referred like the engine's colours.
Color color_attribute(const pugi::xml_node& element, std::string_view name) {
  const std::string text = required_attribute(element, name);
  const bool is_color =
      (text.size() == 7 || text.size() == 9) && text[0] == '#' &&
      std::all_of(text.begin() + 1, text.end(), [](unsigned char c) { return std::isxdigit(c) != 0; });
  if (!is_color)
    throw Error("<" + std::string(element.name()) + "> has the " + std::string(name) + " \"" +
                text.substr(0, 40) + "\", expected #RRGGBB or #RRGGBBAA");
  const auto level = [&](std::size_t at) {
    return at < text.size() ? static_cast<float>(std::stoi(text.substr(at, 2), nullptr, 16)) / 255 : 1.0f;
  };
  return {level(1), level(3), level(5), level(7)};
}

template <class Map>
const auto& find(const Map& map, const std::string& id, const char* what) {
  const auto found = map.find(id);
  if (found == map.end()) throw Error(std::string("there is no ") + what + " with the id \"" + id + "\"");
  return found->second;
}

Properties base_materials(const pugi::xml_node& group) {
  Properties properties;
  for_each_child(group, "base", [&](const pugi::xml_node& base) {
    properties.names.push_back(find_attribute(base, "name").value_or(""));
    properties.colors.push_back(color_attribute(base, "displaycolor"));
  });
  return properties;
}

Properties color_group(const pugi::xml_node& group) {
  Properties properties{.kind = Properties::Kind::colors};
  for_each_child(group, "color", [&](const pugi::xml_node& node) {
    properties.colors.push_back(color_attribute(node, "color"));
  });
  return properties;
}

Properties texture_group(const pugi::xml_node& group) {
  Properties properties{.kind = Properties::Kind::texcoords, .texture = required_attribute(group, "texid")};
  for_each_child(group, "tex2coord", [&](const pugi::xml_node& node) {
    properties.texcoords.push_back(
        {static_cast<float>(number_attribute(node, "u")), static_cast<float>(number_attribute(node, "v"))});
  });
  return properties;
}

/// Mixtures of base materials: the means of their colours, weighted by their shares.
Properties composite_materials(const pugi::xml_node& group, const Resources& known) {
  const Properties& base = find(known.properties, required_attribute(group, "matid"), "base material");
  std::vector<Color> mixed;
  for (const std::string& word : words_of(required_attribute(group, "matindices"))) {
    const std::size_t at = std::strtoul(word.c_str(), nullptr, 10);
    if (at >= base.colors.size())
      throw Error("a composite refers to material " + word + ", there are " +
                  std::to_string(base.colors.size()));
    mixed.push_back(base.colors[at]);
  }
  Properties properties{.kind = Properties::Kind::colors};
  for_each_child(group, "composite", [&](const pugi::xml_node& node) {
    const std::vector<std::string> shares = words_of(required_attribute(node, "values"));
    Color sum{0, 0, 0, 0};
    float total = 0;
    for (std::size_t i = 0; i < std::min(shares.size(), mixed.size()); ++i) {
      const float share = std::clamp(std::strtof(shares[i].c_str(), nullptr), 0.0f, 1.0f);
      sum = {sum.r + share * mixed[i].r, sum.g + share * mixed[i].g, sum.b + share * mixed[i].b,
             sum.a + share * mixed[i].a};
      total += share;
    }
    if (!(total > 0)) throw Error("a composite has no share above 0");
    properties.colors.push_back({sum.r / total, sum.g / total, sum.b / total, sum.a / total});
  });
  return properties;
}

/// Layers of properties: the first one is drawn.
Properties multi_properties(const pugi::xml_node& group, const Resources& known) {
  const std::vector<std::string> layers = words_of(required_attribute(group, "pids"));
  if (layers.empty()) throw Error("<multiproperties> names no layer");
  const Properties& layer = find(known.properties, layers[0], "group of properties");
  Properties properties{.kind = layer.kind, .texture = layer.texture};
  for_each_child(group, "multi", [&](const pugi::xml_node& node) {
    const std::vector<std::string> indices = words_of(required_attribute(node, "pindices"));
    const std::size_t at = indices.empty() ? 0 : std::strtoul(indices[0].c_str(), nullptr, 10);
    if (at >= layer.size())
      throw Error("a layer refers to property " + std::to_string(at) + ", there are " +
                  std::to_string(layer.size()));
    if (at < layer.names.size()) properties.names.push_back(layer.names[at]);
    if (at < layer.colors.size()) properties.colors.push_back(layer.colors[at]);
    if (at < layer.texcoords.size()) properties.texcoords.push_back(layer.texcoords[at]);
  });
  return properties;
}

TextureWrap wrap(const pugi::xml_node& texture, std::string_view name) {
  const std::string style = find_attribute(texture, name).value_or("wrap");
  if (style == "mirror") return TextureWrap::mirrored_repeat;
  return style == "wrap" ? TextureWrap::repeat : TextureWrap::clamp_to_edge;
}

Texture2d texture_2d(const pugi::xml_node& node) {
  Texture2d texture{.part = required_attribute(node, "path"), .sampler = {}};
  texture.sampler.wrap_s = wrap(node, "tilestyleu");
  texture.sampler.wrap_t = wrap(node, "tilestylev");
  if (find_attribute(node, "filter") == "nearest")
    texture.sampler.min = texture.sampler.mag = TextureFilter::nearest;
  return texture;
}

}  // namespace

Resources read_resources(const pugi::xml_node& model) {
  Resources resources;
  for (const pugi::xml_node& node : child(model, "resources").children()) {
    const std::string_view name = local_name(node.name());
    const auto add = [&](Properties properties) {
      resources.properties.insert_or_assign(required_attribute(node, "id"), std::move(properties));
    };
    if (name == "object") resources.objects.insert_or_assign(required_attribute(node, "id"), node);
    else if (name == "basematerials") add(base_materials(node));
    else if (name == "colorgroup") add(color_group(node));
    else if (name == "texture2d")
      resources.textures.insert_or_assign(required_attribute(node, "id"), texture_2d(node));
    else if (name == "texture2dgroup") add(texture_group(node));
    else if (name == "compositematerials") add(composite_materials(node, resources));
    else if (name == "multiproperties") add(multi_properties(node, resources));
  }
  return resources;
}

std::vector<std::string> unread_extensions(const pugi::xml_node& model) {
  constexpr std::string_view kRead[] = {"http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
                                        "http://schemas.microsoft.com/3dmanufacturing/production/2015/06"};
  std::vector<std::string> warnings;
  for (const std::string& prefix : words_of(find_attribute(model, "requiredextensions").value_or(""))) {
    const std::string name = model.attribute(("xmlns:" + prefix).c_str()).value();
    if (std::ranges::find(kRead, name) == std::end(kRead))
      warnings.push_back("requires the extension " + (name.empty() ? "\"" + prefix + "\"" : name) +
                         ", which is not read");
  }
  return warnings;
}

}  // namespace tessera::program::threemf
