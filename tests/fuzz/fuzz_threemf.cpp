// 3MF model parts, from XML to a picture. The input is the part "/m"; every other part of the package is an
// image of one byte.
#include <string>

#include "engine/program/import/threemf.h"
#include "tests/fuzz/read_model.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tessera::fuzz;
  constexpr const char* kRelationships =
      "<Relationships><Relationship Target=\"/m\" "
      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";
  const std::string part(reinterpret_cast<const char*>(data), size);
  const auto read = [&](ModelFile& file, ModelUse, const ReportProgress&) {
    try {
      return read_threemf_parts([&](const std::string& name) -> std::optional<std::string> {
        if (name == "/m") return part;
        return name == "_rels/.rels" ? kRelationships : "x";
      });
    } catch (const tessera::Error& error) {
      throw tessera::Error(file.path() + ": " + error.what());
    }
  };
  read_and_render("m.3mf", part, read);
  return 0;
}
