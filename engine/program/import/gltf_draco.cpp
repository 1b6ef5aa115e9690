#include "engine/program/import/gltf_draco.h"

#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

namespace tessera::program {
namespace {

GltfValues values_of(const draco::PointAttribute& attribute, std::uint32_t points) {
  GltfValues values{.components = static_cast<std::size_t>(attribute.num_components()), .values = {}};
  values.values.resize(points * values.components);
  std::vector<double> element(values.components);
  for (std::uint32_t point = 0; point < points; ++point) {
    const draco::AttributeValueIndex at = attribute.mapped_index(draco::PointIndex(point));
    if (!attribute.ConvertValue<double>(at, static_cast<std::int8_t>(values.components), element.data()))
      throw Error("an attribute of a Draco primitive cannot be converted");
    std::ranges::copy(element,
                      values.values.begin() + static_cast<std::ptrdiff_t>(point * values.components));
  }
  return values;
}

}  // namespace

std::optional<DracoPrimitive> decode_draco(const GltfFile& file, const tinygltf::Primitive& primitive) {
  const auto extension = primitive.extensions.find("KHR_draco_mesh_compression");
  if (extension == primitive.extensions.end()) return std::nullopt;
  const tinygltf::Value& draco_value = extension->second;
  if (!draco_value.Has("bufferView") || !draco_value.Has("attributes"))
    throw Error("a Draco primitive has no buffer view or no attributes");
  const auto bytes = file.view(static_cast<std::size_t>(draco_value.Get("bufferView").GetNumberAsInt()));
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok())
    throw Error("a Draco primitive cannot be decoded: " + decoded.status().error_msg_string());
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();

  DracoPrimitive result;
  for (std::uint32_t face = 0; face < mesh->num_faces(); ++face)
    for (int corner = 0; corner < 3; ++corner)
      result.indices.push_back(mesh->face(draco::FaceIndex(face))[static_cast<std::size_t>(corner)].value());
  const tinygltf::Value& attributes = draco_value.Get("attributes");
  for (const std::string& name : attributes.Keys()) {
    const auto* attribute =
        mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(attributes.Get(name).GetNumberAsInt()));
    if (attribute == nullptr) throw Error("a Draco primitive lacks its attribute " + name);
    result.attributes.emplace(name, values_of(*attribute, mesh->num_points()));
  }
  return result;
}

}  // namespace tessera::program
