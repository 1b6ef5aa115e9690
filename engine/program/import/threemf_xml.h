// Elements and attributes of 3MF's XML, whatever prefixes a file gives the namespaces.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include <pugixml.hpp>

namespace tessera::program::threemf {

/// Returns a name without its prefix: "color" for "m:color".
std::string_view local_name(std::string_view name);

/// Returns the value of the attribute with a local name; empty: the element lacks it.
std::optional<std::string> find_attribute(const pugi::xml_node& element, std::string_view name);
/// @throws Error if the element lacks the attribute
std::string required_attribute(const pugi::xml_node& element, std::string_view name);
/// @throws Error for anything but a finite number
double number_attribute(const pugi::xml_node& element, std::string_view name);
/// @throws Error for anything but an integer of 0 or more
std::size_t index_attribute(const pugi::xml_node& element, std::string_view name);

/// Returns the first child with a local name, or a null node.
pugi::xml_node child(const pugi::xml_node& element, std::string_view name);
/// Calls act() with each child that has a local name.
template <class Act>
void for_each_child(const pugi::xml_node& element, std::string_view name, const Act& act) {
  for (const pugi::xml_node& node : element.children())
    if (local_name(node.name()) == name) act(node);
}

/// An affine transform as 3MF writes it: four rows of three numbers, multiplied by row vectors from the left.
struct Affine {
  std::array<double, 12> m{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

  std::array<double, 3> operator()(const std::array<double, 3>& p) const;
  bool mirrors() const;  ///< the determinant is negative
};
/// Returns the transform that applies `first`, and then `second`.
Affine concatenated(const Affine& first, const Affine& second);
/// Returns the attribute "transform", or the identity if the element lacks it.
/// @throws Error for anything but twelve finite numbers
Affine transform(const pugi::xml_node& element);

}  // namespace tessera::program::threemf
