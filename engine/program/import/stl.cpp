#include "engine/program/import/stl.h"

#include <algorithm>
#include <cstring>
#include <string_view>

#include "engine/program/import/model_normals.h"
#include "engine/program/import/stl_formats.h"

namespace tessera::program {
namespace {

/// Whether the file is text. Binary files may begin with "solid", too; but their size is that of the facets
/// they count, or one of the first facets has bytes that no text has.
bool is_text(ModelFile& file) {
  constexpr std::size_t kHeaderBytes = 84, kFacetBytes = 50, kTestedBytes = 1024;
  const std::string_view begin = file.peek(kTestedBytes);
  if (begin.size() >= kHeaderBytes) {
    std::uint32_t count = 0;
    std::memcpy(&count, &begin[kHeaderBytes - sizeof count], sizeof count);
    if (file.size() == kHeaderBytes + std::uint64_t{count} * kFacetBytes) return false;
  }
  return std::ranges::none_of(begin, [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < '\t' || (byte > '\r' && byte < ' ') || byte == 0x7f;
  });
}

}  // namespace

Model read_stl(ModelFile& file, ModelUse use, const ReportProgress& progress) {
  if (file.size() == 0) throw Error(file.path() + ": the file is empty");
  StlContent content = is_text(file) ? read_stl_text(file) : read_stl_binary(file);
  if (content.facets.count() == 0)
    throw Error(file.path() + ": holds no triangle: expected facets after \"solid\"");
  Model model;
  const bool is_flat = content.facets.have_normals() && content.facets.count() <= kMaxFlatFacets;
  content.facets.move_to(model, use, content.object_color);
  add_creased_normals(model.mesh, is_flat ? 0 : kCreaseDegrees, {}, progress);
  for (const std::string& warning : content.warnings) model.warnings.push_back(file.path() + ": " + warning);
  return model;
}

Model import_stl(const std::string& path, ModelUse use, const ReportProgress& progress) {
  ModelFile file(path, part_of(progress, 0, 0.7));
  return read_stl(file, use, part_of(progress, 0.7, 1));
}

}  // namespace tessera::program
