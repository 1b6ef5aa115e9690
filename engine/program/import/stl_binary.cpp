#include <bit>
#include <cmath>
#include <cstring>

#include "engine/program/import/stl_formats.h"

namespace tessera::program {
namespace {

constexpr std::size_t kHeaderBytes = 80, kCountBytes = 4, kFacetBytes = 50;
static_assert(std::endian::native == std::endian::little, "STL files hold little-endian numbers");

Position position_at(const char* bytes) {
  float xyz[3];
  std::memcpy(xyz, bytes, sizeof xyz);
  return {xyz[0], xyz[1], xyz[2]};
}

/// The color that Magics gives the whole object.
bool find_object_color(std::string_view header, Color& color) {
  constexpr std::string_view kKey = "COLOR=";
  const std::size_t at = header.find(kKey);
  if (at == header.npos || at + kKey.size() + 4 > header.size()) return false;
  float rgba[4];
  for (std::size_t k = 0; k < 4; ++k)
    rgba[k] = static_cast<float>(static_cast<unsigned char>(header[at + kKey.size() + k])) / 255;
  color = {rgba[0], rgba[1], rgba[2], rgba[3] > 0 ? rgba[3] : 1};  // alpha 0 is not meant
  return true;
}

StlColor color_of_facet(std::uint16_t attribute, bool is_magics) {
  const bool is_set = (attribute & 0x8000) != 0;
  if (is_set == is_magics) return 0;
  const unsigned low = attribute & 31, middle = attribute >> 5 & 31, high = attribute >> 10 & 31;
  const unsigned red = is_magics ? low : high, blue = is_magics ? high : low;
  return static_cast<StlColor>(0x8000 | red << 10 | middle << 5 | blue);
}

/// How many facets to read, with a warning if the file and its count disagree.
std::uint64_t facet_count(std::uint64_t counted, std::uint64_t bytes, std::vector<std::string>& warnings) {
  const std::uint64_t complete = bytes / kFacetBytes;
  const auto facets = [](std::uint64_t count) {
    return std::to_string(count) + (count == 1 ? " facet" : " facets");
  };
  if (counted > complete || (counted == 0 && complete > 0)) {
    warnings.push_back("counts " + facets(counted) + " and holds " + facets(complete) + ", which are drawn");
    return complete;
  }
  if (bytes > counted * kFacetBytes)
    warnings.push_back(std::to_string(bytes - counted * kFacetBytes) + " bytes after " + facets(counted) +
                       " are left out");
  return counted;
}

}  // namespace

StlContent read_stl_binary(ModelFile& file) {
  StlContent content{.facets = StlFacets(true)};
  const char* const header = file.take(kHeaderBytes + kCountBytes);
  if (header == nullptr)
    file.fail_at_byte("the file has " + std::to_string(file.size()) +
                      " bytes; expected \"solid\", or a header of 80 bytes and the number of facets");
  const bool is_magics = find_object_color({header, kHeaderBytes}, content.object_color);
  std::uint32_t counted = 0;
  std::memcpy(&counted, header + kHeaderBytes, sizeof counted);
  const std::uint64_t count = facet_count(counted, file.remaining(), content.warnings);
  for (std::uint64_t i = 0; i < count; ++i) {
    const char* const facet = file.take(kFacetBytes);
    if (facet == nullptr) file.fail_at_byte("the file became shorter while it was read");
    std::uint16_t attribute = 0;
    std::memcpy(&attribute, facet + 48, sizeof attribute);
    content.facets.add(position_at(facet),
                       {position_at(facet + 12), position_at(facet + 24), position_at(facet + 36)},
                       color_of_facet(attribute, is_magics));
  }
  return content;
}

}  // namespace tessera::program
