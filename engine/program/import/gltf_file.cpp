#include "engine/program/import/gltf_file.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <optional>
#include <set>
#include <string_view>

#include <meshoptimizer.h>

#include "engine/program/scene/text_file.h"

namespace tessera::program {
namespace {

using Json = nlohmann::json;

// Extensions that are read, or that change nothing that is drawn.
const std::set<std::string_view> kSupported = {"KHR_draco_mesh_compression",
                                               "KHR_lights_punctual",
                                               "KHR_materials_emissive_strength",
                                               "KHR_materials_pbrSpecularGlossiness",
                                               "KHR_materials_unlit",
                                               "KHR_mesh_quantization",
                                               "KHR_texture_transform",
                                               "EXT_meshopt_compression",
                                               "KHR_xmp",
                                               "KHR_xmp_json_ld",
                                               "KHR_materials_variants",
                                               "KHR_animation_pointer"};

std::uint32_t little_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k)
    value |= std::uint32_t{static_cast<unsigned char>(bytes.at(at + k))} << (8 * k);
  return value;
}

/// JSON and binary chunk of a file. Chunks of a .glb file may have any length and order; unknown ones are
/// skipped, and the last one may be cut off.
struct Chunks {
  std::string json;
  std::optional<std::string> binary;
};
Chunks split(const std::string& bytes) {
  if (!bytes.starts_with("glTF")) return {bytes, {}};
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  constexpr std::uint32_t kJson = 0x4e4f534a, kBinary = 0x004e4942;
  if (bytes.size() < kHeader) throw Error("the file ends within its header of 12 bytes");
  if (const std::uint32_t version = little_endian(bytes, 4); version != 2)
    throw Error("is binary glTF of version " + std::to_string(version) + ", expected 2");
  Chunks chunks;
  for (std::size_t at = kHeader; at + kChunkHeader <= bytes.size();) {
    const std::size_t length = little_endian(bytes, at);
    const std::uint32_t type = little_endian(bytes, at + 4);
    const std::string content = bytes.substr(at + kChunkHeader, length);
    if (type == kJson && chunks.json.empty()) chunks.json = content;
    if (type == kBinary && !chunks.binary) chunks.binary = content;
    at += kChunkHeader + length;
    at = (at + 3) / 4 * 4;  // chunks begin at multiples of 4, whatever their length says
  }
  if (chunks.json.empty()) throw Error("the file has no chunk of JSON");
  return chunks;
}

Json parse(const std::string& text) {
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    throw Error(std::string("is not JSON: ") + error.what());
  }
}

void check_version(const Json& json) {
  const auto place = "/asset/version"_json_pointer;
  const bool has_version = json.is_object() && json.contains(place) && json.at(place).is_string();
  if (!has_version) throw Error("has no asset.version: it is glTF 1 or no glTF, expected glTF 2");
  const auto& version = json.at(place).get_ref<const std::string&>();
  if (!version.starts_with("2")) throw Error("is glTF " + version + ", expected glTF 2");
}

void check_extensions(GltfFile& file) {
  const auto names = [&](const char* key) {
    std::vector<std::string> list;
    if (file.json.contains(key) && file.json.at(key).is_array())
      for (const Json& name : file.json.at(key))
        if (name.is_string()) list.push_back(name);
    return list;
  };
  const std::vector<std::string> required = names("extensionsRequired");
  for (const std::string& name : required)
    if (!kSupported.contains(name))
      throw Error("requires the extension " + name + ", which is not supported");
  for (const std::string& name : names("extensionsUsed"))
    if (!kSupported.contains(name))
      file.warnings.push_back("uses the extension " + name + ", which is not supported; it is left out");
}

/// Decodes %20 and the like. Malformed sequences stay.
std::string percent_decoded(const std::string& text) {
  const auto digit = [](char c) -> int {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
  };
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int high = i + 2 < text.size() ? digit(text[i + 1]) : -1, low = high >= 0 ? digit(text[i + 2]) : -1;
    if (text[i] == '%' && low >= 0) {
      decoded += static_cast<char>(16 * high + low);
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

std::string from_base64(std::string_view text) {
  static const std::array<int, 256> kDigits = [] {
    std::array<int, 256> digits;
    digits.fill(-1);
    constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < kAlphabet.size(); ++i)
      digits[static_cast<unsigned char>(kAlphabet[i])] = static_cast<int>(i);
    digits['-'] = 62;  // the alphabet for URLs [RFC 4648]
    digits['_'] = 63;
    return digits;
  }();
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : text) {
    const int digit = kDigits[static_cast<unsigned char>(c)];
    if (digit < 0) continue;  // padding and white space
    bits = bits << 6 | static_cast<unsigned>(digit);
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 255);
  }
  return bytes;
}

bool is_data_uri(const std::string& uri) { return uri.starts_with("data:"); }

std::string data_of_uri(const std::string& uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string::npos) throw Error("a data URI has no comma");
  const bool is_base64 = uri.substr(0, comma).ends_with(";base64");
  const std::string content = uri.substr(comma + 1);
  return is_base64 ? from_base64(content) : percent_decoded(content);
}

std::string read_beside(const std::string& model_path, const std::string& uri) {
  const std::string path = (std::filesystem::path(model_path).parent_path() / percent_decoded(uri)).string();
  refuse_device_or_pipe(path);
  return read_text_file(path);
}

bool is_fallback(const Json& buffer) {
  const auto place = "/extensions/EXT_meshopt_compression/fallback"_json_pointer;
  return buffer.contains(place) && buffer.at(place) == true;
}

std::string read_buffer(const GltfFile& file, std::size_t number, const std::optional<std::string>& binary) {
  const Json& buffer = file.json.at("buffers").at(number);
  const auto length = buffer.at("byteLength").get<std::size_t>();
  std::string bytes;
  if (buffer.contains("uri")) {
    const auto& uri = buffer.at("uri").get_ref<const std::string&>();
    bytes = is_data_uri(uri) ? data_of_uri(uri) : read_beside(file.path, uri);
  } else if (is_fallback(buffer)) {
    return {};  // only for readers without decompression
  } else if (number == 0 && binary) {
    bytes = *binary;
  } else {
    throw Error("buffer " + std::to_string(number) + " has neither a uri nor a binary chunk");
  }
  if (bytes.size() < length)
    throw Error("buffer " + std::to_string(number) + " has " + std::to_string(bytes.size()) +
                " bytes, expected " + std::to_string(length));
  bytes.resize(length);
  return bytes;
}

std::span<const char> range(const std::string& bytes, std::size_t offset, std::size_t length,
                            const std::string& name) {
  if (offset > bytes.size() || length > bytes.size() - offset)
    throw Error(name + " ends at byte " + std::to_string(offset + length) + ", its buffer has " +
                std::to_string(bytes.size()));
  return {bytes.data() + offset, length};
}

const std::string& buffer_of(const GltfFile& file, const Json& view) {
  const auto number = view.at("buffer").get<std::size_t>();
  if (number >= file.buffers.size())
    throw Error("a buffer view refers to buffer " + std::to_string(number) + ", there are " +
                std::to_string(file.buffers.size()));
  return file.buffers[number];
}

/// Decodes a view that EXT_meshopt_compression has compressed.
std::string decompressed(const GltfFile& file, const Json& extension) {
  const auto offset = extension.value("byteOffset", std::size_t{0}),
             length = extension.at("byteLength").get<std::size_t>();
  const auto stride = extension.at("byteStride").get<std::size_t>(),
             count = extension.at("count").get<std::size_t>();
  const auto source = range(buffer_of(file, extension), offset, length, "a compressed buffer view");
  const std::string mode = extension.at("mode"), filter = extension.value("filter", "NONE");
  constexpr std::size_t kMaxStride = 256;
  if (stride == 0 || stride > kMaxStride || count > (std::size_t{1} << 31) / stride)
    throw Error("a compressed buffer view has " + std::to_string(count) + " elements of " +
                std::to_string(stride) + " bytes, expected 1 to 256 bytes and at most 2 GiB");
  std::string bytes(count * stride, '\0');
  const auto* from = reinterpret_cast<const unsigned char*>(source.data());
  int failure = -1;
  if (mode == "ATTRIBUTES" && stride % 4 == 0)
    failure = meshopt_decodeVertexBuffer(bytes.data(), count, stride, from, length);
  if (mode == "TRIANGLES" && (stride == 2 || stride == 4) && count % 3 == 0)
    failure = meshopt_decodeIndexBuffer(bytes.data(), count, stride, from, length);
  if (mode == "INDICES" && (stride == 2 || stride == 4))
    failure = meshopt_decodeIndexSequence(bytes.data(), count, stride, from, length);
  if (failure != 0)
    throw Error("a buffer view cannot be decompressed (EXT_meshopt_compression, mode " + mode + ")");
  if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8))
    meshopt_decodeFilterOct(bytes.data(), count, stride);
  if (filter == "QUATERNION" && stride == 8) meshopt_decodeFilterQuat(bytes.data(), count, stride);
  if (filter == "EXPONENTIAL" && stride % 4 == 0) meshopt_decodeFilterExp(bytes.data(), count, stride);
  return bytes;
}

void read_buffers(GltfFile& file, const std::optional<std::string>& binary) {
  const auto count = [&](const char* key) { return file.json.contains(key) ? file.json.at(key).size() : 0; };
  for (std::size_t i = 0; i < count("buffers"); ++i) file.buffers.push_back(read_buffer(file, i, binary));
  file.buffer_views.resize(count("bufferViews"));
  const auto place = "/extensions/EXT_meshopt_compression"_json_pointer;
  for (std::size_t i = 0; i < file.buffer_views.size(); ++i)
    if (const Json& view = file.json.at("bufferViews").at(i); view.contains(place))
      file.buffer_views[i] = decompressed(file, view.at(place));
}

}  // namespace

std::span<const char> GltfFile::view(std::size_t number) const {
  if (number >= buffer_views.size())
    throw Error("found a reference to buffer view " + std::to_string(number) + ", there are " +
                std::to_string(buffer_views.size()));
  if (!buffer_views[number].empty()) return buffer_views[number];
  const Json& view = json.at("bufferViews").at(number);
  return range(buffer_of(*this, view), view.value("byteOffset", std::size_t{0}),
               view.at("byteLength").get<std::size_t>(), "buffer view " + std::to_string(number));
}

GltfFile read_gltf_file(const std::string& path) try {
  const std::string bytes = read_text_file(path);
  if (bytes.empty()) throw Error("the file is empty, expected glTF 2");
  const Chunks chunks = split(bytes);
  GltfFile file{.path = path, .json = parse(chunks.json), .buffers = {}, .buffer_views = {}, .warnings = {}};
  check_version(file.json);
  check_extensions(file);
  read_buffers(file, chunks.binary);
  return file;
} catch (const Json::exception& error) {
  throw Error(path + ": is not valid glTF: " + error.what());
} catch (const Error& error) {
  throw Error(error.code(), path + ": " + error.what());
}

std::vector<ModelImage> gltf_images(const GltfFile& file) {
  std::vector<ModelImage> images;
  if (!file.json.contains("images")) return images;
  for (const Json& image : file.json.at("images")) {
    ModelImage& to = images.emplace_back();
    to.name = image.value("name", "image " + std::to_string(images.size() - 1));
    if (image.contains("bufferView")) {
      const auto bytes = file.view(image.at("bufferView").get<std::size_t>());
      to.encoded.assign(bytes.begin(), bytes.end());
    } else if (image.contains("uri")) {
      const auto& uri = image.at("uri").get_ref<const std::string&>();
      if (is_data_uri(uri)) to.encoded = data_of_uri(uri);
      else to.name = percent_decoded(uri);
    }
  }
  return images;
}

}  // namespace tessera::program
