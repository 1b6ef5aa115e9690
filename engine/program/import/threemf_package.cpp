#include "engine/program/import/threemf_package.h"

#include <array>

#include <unzip.h>

#include "engine/program/import/threemf_xml.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program::threemf {

void Package::Close::operator()(void* archive) const { unzClose(archive); }

Package::Package(const std::string& path) : archive_(unzOpen64(path.c_str())) {
  if (!archive_)
    throw Error("is not a ZIP archive, as 3MF files are, or the directory at its end is damaged");
}

std::optional<std::string> Package::read(const std::string& name) const {
  constexpr int kIgnoreCase = 2;
  const std::string entry = name.starts_with('/') ? name.substr(1) : name;
  if (unzLocateFile(archive_.get(), entry.c_str(), kIgnoreCase) != UNZ_OK) return std::nullopt;
  if (unzOpenCurrentFile(archive_.get()) != UNZ_OK)
    throw Error("\"" + entry + "\" is damaged, encrypted, or compressed by an unknown method");
  std::string bytes;
  std::array<char, 1 << 16> buffer;
  int count = 0;
  while ((count = unzReadCurrentFile(archive_.get(), buffer.data(), buffer.size())) > 0)
    bytes.append(buffer.data(), static_cast<std::size_t>(count));
  const bool is_whole = unzCloseCurrentFile(archive_.get()) == UNZ_OK && count == 0;
  if (!is_whole) throw Error("\"" + entry + "\" is damaged: its checksum does not match");
  return bytes;
}

std::string model_part_name(const ReadPart& read) {
  constexpr std::string_view kModelType = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
  const std::optional<std::string> text = read("_rels/.rels");
  if (!text) throw Error("the archive lacks \"_rels/.rels\", expected a 3MF package");
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(text->data(), text->size());
  if (!result) throw Error(std::string("\"_rels/.rels\" is not XML: ") + result.description());
  std::optional<std::string> name;
  for_each_child(child(document, "Relationships"), "Relationship", [&](const pugi::xml_node& relationship) {
    if (!name && find_attribute(relationship, "Type") == kModelType)
      name = required_attribute(relationship, "Target");
  });
  if (!name) throw Error("the package names no 3D model: \"_rels/.rels\" has no relationship of that type");
  return *name;
}

}  // namespace tessera::program::threemf
