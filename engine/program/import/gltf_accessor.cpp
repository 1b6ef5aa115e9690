#include "engine/program/import/gltf_accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

namespace tessera::program {
namespace {

std::string name_of(int accessor) { return "accessor " + std::to_string(accessor); }

template <class T>
double value_of(const char* bytes, bool is_normalized) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  const auto number = static_cast<double>(value);
  if (!is_normalized || std::is_floating_point_v<T>) return number;
  return std::max(number / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

using ValueFn = double(const char* bytes, bool is_normalized);

struct Component {
  std::size_t bytes;
  ValueFn* value;
};
Component component_of(int type, const std::string& name) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return {1, &value_of<std::int8_t>};
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return {1, &value_of<std::uint8_t>};
    case TINYGLTF_COMPONENT_TYPE_SHORT: return {2, &value_of<std::int16_t>};
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return {2, &value_of<std::uint16_t>};
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return {4, &value_of<std::uint32_t>};
    case TINYGLTF_COMPONENT_TYPE_FLOAT: return {4, &value_of<float>};
    default:
      throw Error(name + " has components of type " + std::to_string(type) + ", expected 5120 to 5126");
  }
}

/// Position of the components of an element: columns of matrices begin at multiples of 4 bytes.
std::size_t component_offset(int type, std::size_t component, std::size_t bytes) {
  std::size_t rows = 0;
  if (type == TINYGLTF_TYPE_MAT2) rows = 2;
  if (type == TINYGLTF_TYPE_MAT3) rows = 3;
  if (rows == 0) return component * bytes;
  const std::size_t column_bytes = (rows * bytes + 3) / 4 * 4;
  return component / rows * column_bytes + component % rows * bytes;
}

/// Elements in memory.
struct Elements {
  std::span<const char> bytes;  ///< from the first element on
  std::size_t stride;
  std::size_t count;
};

/// @throws Error if the last element ends beyond the bytes
Elements elements(std::span<const char> view, std::size_t offset, std::size_t stride,
                  std::size_t element_bytes, std::size_t count, const std::string& name) {
  const bool fits = offset <= view.size() && element_bytes <= view.size() - offset &&
                    (count <= 1 || (view.size() - offset - element_bytes) / stride >= count - 1);
  if (count > 0 && !fits)
    throw Error(name + " reads " + std::to_string(count) + " elements beyond its buffer view of " +
                std::to_string(view.size()) + " bytes");
  return {view.subspan(std::min(offset, view.size())), stride, count};
}

std::size_t index_of(int number, const std::string& name) {
  if (number < 0) throw Error(name + " refers to buffer view " + std::to_string(number));
  return static_cast<std::size_t>(number);
}

void replace_sparse(const GltfFile& file, const tinygltf::Accessor& accessor, const Component& component,
                    const std::string& name, GltfValues& result) {
  const auto& sparse = accessor.sparse;
  const Component index = component_of(sparse.indices.componentType, name);
  const auto count = static_cast<std::size_t>(std::max(sparse.count, 0));
  const std::size_t element_bytes = result.components * component.bytes;
  const Elements indices =
      elements(file.view(index_of(sparse.indices.bufferView, name)),
               static_cast<std::size_t>(sparse.indices.byteOffset), index.bytes, index.bytes, count, name);
  const Elements values =
      elements(file.view(index_of(sparse.values.bufferView, name)),
               static_cast<std::size_t>(sparse.values.byteOffset), element_bytes, element_bytes, count, name);
  for (std::size_t i = 0; i < count; ++i) {
    const double at = index.value(&indices.bytes[i * index.bytes], false);
    if (!(at >= 0 && at < static_cast<double>(result.count())))
      throw Error(name + " replaces an element that it does not have");
    for (std::size_t k = 0; k < result.components; ++k)
      result.values[static_cast<std::size_t>(at) * result.components + k] =
          component.value(&values.bytes[i * element_bytes + k * component.bytes], accessor.normalized);
  }
}

const tinygltf::Accessor& accessor_of(const tinygltf::Model& gltf, int number) {
  if (number < 0 || static_cast<std::size_t>(number) >= gltf.accessors.size())
    throw Error("found a reference to accessor " + std::to_string(number) + ", there are " +
                std::to_string(gltf.accessors.size()));
  return gltf.accessors[static_cast<std::size_t>(number)];
}

}  // namespace

GltfValues read_accessor(const GltfFile& file, const tinygltf::Model& gltf, int number) {
  const std::string name = name_of(number);
  const tinygltf::Accessor& accessor = accessor_of(gltf, number);
  const Component component = component_of(accessor.componentType, name);
  const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  if (components < 1) throw Error(name + " has an unknown type");
  GltfValues result{.components = static_cast<std::size_t>(components), .values = {}};
  if (accessor.bufferView >= 0) {
    const std::size_t last = component_offset(accessor.type, result.components - 1, component.bytes);
    const std::size_t element_bytes = last + component.bytes;
    const auto view = static_cast<std::size_t>(accessor.bufferView);
    const std::size_t packed = component_offset(accessor.type, result.components, component.bytes);
    const std::size_t given = view < gltf.bufferViews.size() ? gltf.bufferViews[view].byteStride : 0;
    const Elements from = elements(file.view(view), accessor.byteOffset, given > 0 ? given : packed,
                                   element_bytes, accessor.count, name);
    result.values.reserve(from.count * result.components);
    for (std::size_t i = 0; i < from.count; ++i)
      for (std::size_t k = 0; k < result.components; ++k)
        result.values.push_back(component.value(
            &from.bytes[i * from.stride + component_offset(accessor.type, k, component.bytes)],
            accessor.normalized));
  } else {
    result.values.assign(accessor.count * result.components, 0.0);
  }
  if (accessor.sparse.isSparse) replace_sparse(file, accessor, component, name, result);
  return result;
}

std::vector<std::uint32_t> read_indices(const GltfFile& file, const tinygltf::Model& gltf, int number) {
  const tinygltf::Accessor& accessor = accessor_of(gltf, number);
  const bool is_unsigned = accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                           accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                           accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (!is_unsigned || accessor.type != TINYGLTF_TYPE_SCALAR)
    throw Error(name_of(number) + " holds indices of vertices, expected unsigned integers");
  const GltfValues values = read_accessor(file, gltf, number);
  return {values.values.begin(), values.values.end()};
}

}  // namespace tessera::program
