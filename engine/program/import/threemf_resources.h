// Resources of a 3MF model part: objects, and properties that corners of triangles refer to.
//
// Source: 3MF core specification 1.3; materials and properties extension 1.2.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include <pugixml.hpp>

#include "engine/program/import/model.h"

namespace tessera::program::threemf {

/// A group of properties. Corners of triangles select one by its index.
struct Properties {
  enum class Kind { materials, colors, texcoords };
  Kind kind = Kind::materials;
  std::vector<std::string> names;               ///< names of materials
  std::vector<Color> colors;                    ///< colours of materials, or of corners
  std::vector<std::array<float, 2>> texcoords;  ///< t grows upwards
  std::string texture;                          ///< id of the texture of texcoords

  std::size_t size() const { return kind == Kind::texcoords ? texcoords.size() : colors.size(); }
};

struct Texture2d {
  std::string part;  ///< name of the image within the package
  TextureSampler sampler;
};

/// Definitions of a model part, by id.
struct Resources {
  std::map<std::string, pugi::xml_node> objects;  ///< point into the part's document
  std::map<std::string, Properties> properties;
  std::map<std::string, Texture2d> textures;
};

/// @param model  the element <model>, which must outlive the result
/// @throws Error for colours and numbers that cannot be read, and references to undefined ids
Resources read_resources(const pugi::xml_node& model);

/// Returns a warning for each extension that the part requires and that is not read.
std::vector<std::string> unread_extensions(const pugi::xml_node& model);

}  // namespace tessera::program::threemf
