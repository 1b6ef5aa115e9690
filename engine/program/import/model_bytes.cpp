#include "engine/program/import/model_bytes.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>

namespace tessera::program {
namespace {

// Arithmetic types only: they have no padding, so no uninitialized byte is sent.
template <class T>
constexpr bool kIsPlain = std::is_arithmetic_v<T>;

template <class T, class U>
concept SameUnqualified = std::is_same_v<std::remove_const_t<T>, U>;

// Calls the stream for each member. The same list serves Writer and Reader.
template <class Stream>
void visit_members(Stream& stream, SameUnqualified<Color> auto& value);
template <class Stream>
void visit_members(Stream& stream, SameUnqualified<Material> auto& value);
template <class Stream>
void visit_members(Stream& stream, SameUnqualified<Light> auto& value);
template <class Stream>
void visit_members(Stream& stream, SameUnqualified<ModelCamera> auto& value);
template <class Stream>
void visit_members(Stream& stream, SameUnqualified<ModelPart> auto& value);
template <class Stream>
void visit_members(Stream& stream, SameUnqualified<ModelImage> auto& value);
template <class Stream>
void visit_members(Stream& stream, SameUnqualified<ModelTexture> auto& value);
template <class Stream>
void visit_members(Stream& stream, SameUnqualified<std::string> auto& value);
template <class Stream>
void visit_members(Stream& stream, SameUnqualified<std::size_t> auto& value);

class Writer {
 public:
  explicit Writer(const ByteWriter& write) : write_(write) {}

  template <class T>
  requires kIsPlain<T>
  void operator()(const T& value) { write_(reinterpret_cast<const char*>(&value), sizeof value); }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void enumerator(Enum value, Enum) { (*this)(static_cast<std::uint8_t>(value)); }
  void operator()(const std::string& text) { list(text); }
  template <class T>
  void operator()(const std::vector<T>& elements) {
    if constexpr (kIsPlain<T>) {
      list(elements);
    } else {
      (*this)(elements.size());
      for (const T& element : elements) visit_members(*this, element);
    }
  }
  template <class T>
  void operator()(const std::optional<T>& value) {
    (*this)(value.has_value());
    if (value) visit_members(*this, *value);
  }

 private:
  template <class List>
  void list(const List& elements) {
    (*this)(elements.size());
    if (!elements.empty())
      write_(reinterpret_cast<const char*>(elements.data()), elements.size() * sizeof(elements[0]));
  }

  const ByteWriter& write_;
};

class Reader {
 public:
  /// Enumerators up to `last`.
  template <class Enum>
  requires std::is_enum_v<Enum>
  void enumerator(Enum& value, Enum last) {
    std::uint8_t number = 0;
    (*this)(number);
    if (number > static_cast<std::uint8_t>(last)) fail();
    value = static_cast<Enum>(number);
  }

  Reader(const ByteReader& read, std::uint64_t bytes, const std::string& path)
      : read_(read), left_(bytes), path_(path) {}

  template <class T>
  requires kIsPlain<T>
  void operator()(T& value) { take(&value, sizeof value); }
  void operator()(bool& value) {
    char byte = 0;
    take(&byte, 1);
    if (byte != 0 && byte != 1) fail();
    value = byte == 1;
  }
  void operator()(std::string& text) { list(text); }
  template <class T>
  void operator()(std::vector<T>& elements) {
    if constexpr (kIsPlain<T>) {
      list(elements);
    } else {
      // Elements are appended one by one, so that a wrong count allocates nothing.
      for (std::size_t left = count(1); left > 0; --left) visit_members(*this, elements.emplace_back());
    }
  }
  template <class T>
  void operator()(std::optional<T>& value) {
    bool has = false;
    (*this)(has);
    if (has) visit_members(*this, value.emplace());
  }
  void end() const {
    if (left_ != 0) fail();
  }
  [[noreturn]] void fail() const { throw Error(path_ + ": the reading process sent an invalid model"); }

 private:
  template <class List>
  void list(List& elements) {
    elements.resize(count(sizeof(elements[0])));
    if (!elements.empty()) take(elements.data(), elements.size() * sizeof(elements[0]));
  }
  std::size_t count(std::size_t element_bytes) {
    std::size_t size = 0;
    (*this)(size);
    if (size > left_ / element_bytes) fail();
    return size;
  }
  void take(void* to, std::size_t size) {
    if (size > left_) fail();
    left_ -= size;
    read_(static_cast<char*>(to), size);
  }
  const ByteReader& read_;
  std::uint64_t left_;
  const std::string& path_;
};

template <class Stream>
void visit_members(Stream& stream, SameUnqualified<Color> auto& c) {
  stream(c.r), stream(c.g), stream(c.b), stream(c.a);
}
template <class Stream>
void visit_members(Stream& stream, SameUnqualified<Material> auto& m) {
  for (auto* color : {&m.ambient, &m.diffuse, &m.specular, &m.emission}) visit_members(stream, *color);
  stream(m.shininess);
}
template <class Stream>
void visit_members(Stream& stream, SameUnqualified<Light> auto& l) {
  for (auto* color : {&l.ambient, &l.diffuse, &l.specular}) visit_members(stream, *color);
  for (auto& x : l.position) stream(x);
  for (auto& x : l.spot_direction) stream(x);
  for (auto* x : {&l.spot_exponent, &l.spot_cutoff, &l.attenuation_constant, &l.attenuation_linear,
                  &l.attenuation_quadratic})
    stream(*x);
}
template <class Stream>
void visit_members(Stream& stream, SameUnqualified<ModelCamera> auto& c) {
  for (auto& x : c.view.m) stream(x);
  stream(c.is_orthographic);
  for (auto* x : {&c.half_width, &c.half_height, &c.near, &c.far}) stream(*x);
}
template <class Stream>
void visit_members(Stream& stream, SameUnqualified<ModelPart> auto& p) {
  stream(p.material_name);
  visit_members(stream, p.material);
  stream.enumerator(p.primitive, Primitive::triangles);
  stream(p.first_index);
  stream(p.index_count);
  stream(p.uses_colors);
  stream(p.is_unlit);
  stream(p.is_double_sided);
  stream(p.texture);
  stream.enumerator(p.alpha, ModelAlpha::blend);
  stream(p.alpha_cutoff);
}
template <class Stream>
void visit_members(Stream& stream, SameUnqualified<ModelImage> auto& image) {
  stream(image.name);
  stream(image.encoded);
  stream(image.alpha_name);
  stream(image.width);
  stream(image.height);
  stream(image.has_alpha);
  stream(image.pixels);
}
template <class Stream>
void visit_members(Stream& stream, SameUnqualified<ModelTexture> auto& texture) {
  stream(texture.image);
  stream.enumerator(texture.sampler.mag, TextureFilter::linear);
  stream.enumerator(texture.sampler.min, TextureFilter::linear_mipmap_linear);
  stream.enumerator(texture.sampler.wrap_s, TextureWrap::mirrored_repeat);
  stream.enumerator(texture.sampler.wrap_t, TextureWrap::mirrored_repeat);
}
template <class Stream>
void visit_members(Stream& stream, SameUnqualified<std::string> auto& text) {
  stream(text);
}
template <class Stream>
void visit_members(Stream& stream, SameUnqualified<std::size_t> auto& number) {
  stream(number);
}
template <class Stream>
void visit_members(Stream& stream, SameUnqualified<Model> auto& model) {
  stream(model.mesh.positions);
  stream(model.mesh.normals);
  stream(model.mesh.colors);
  stream(model.mesh.texcoords);
  stream(model.mesh.indices);
  stream(model.parts);
  stream(model.images);
  stream(model.textures);
  for (auto* x : {&model.origin.x, &model.origin.y, &model.origin.z}) stream(*x);
  stream(model.warnings);
  stream(model.cameras);
  stream(model.lights);
  stream(model.ambient_light);
}

/// Images are decoded, or not yet.
bool is_valid(const ModelImage& image) {
  if (image.width < 0 || image.height < 0) return false;
  return image.pixels.size() ==
         4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
}

/// Whether a part has whole primitives, and a texture that exists.
bool is_valid(const ModelPart& part, const Model& model) {
  std::size_t corners = 3;
  if (part.primitive == Primitive::points) corners = 1;
  if (part.primitive == Primitive::lines) corners = 2;
  const bool is_list = corners < 3 || part.primitive == Primitive::triangles;
  return is_list && part.index_count % corners == 0 &&
         (!part.texture || *part.texture < model.textures.size());
}

bool is_valid(const Model& model) {
  const MeshData& mesh = model.mesh;
  const std::size_t vertices = mesh.positions.size() / 3;
  const auto fits = [&](const std::vector<float>& list, std::size_t components) {
    return list.empty() || list.size() == components * vertices;
  };
  const bool attributes_fit = mesh.positions.size() == 3 * vertices && fits(mesh.normals, 3) &&
                              fits(mesh.colors, 4) && fits(mesh.texcoords, 2);
  if (!attributes_fit || model.parts.empty()) return false;
  for (const std::uint32_t index : mesh.indices)
    if (index >= vertices) return false;
  if (!std::ranges::all_of(model.images, [](const ModelImage& image) { return is_valid(image); }))
    return false;
  for (const ModelTexture& texture : model.textures)
    if (texture.image >= model.images.size()) return false;
  std::size_t next = 0;
  for (const ModelPart& part : model.parts) {
    if (!is_valid(part, model) || part.first_index != next || part.index_count > mesh.indices.size() - next)
      return false;
    next += part.index_count;
  }
  return next == mesh.indices.size();
}

}  // namespace

void write_model(const Model& model, const ByteWriter& write) {
  Writer writer(write);
  visit_members(writer, model);
}

std::uint64_t model_byte_count(const Model& model) {
  std::uint64_t bytes = 0;
  write_model(model, [&bytes](const char*, std::size_t count) { bytes += count; });
  return bytes;
}

std::string to_bytes(const Model& model) {
  std::string bytes;
  bytes.reserve(model_byte_count(model));
  write_model(model, [&bytes](const char* from, std::size_t count) { bytes.append(from, count); });
  return bytes;
}

Model read_model(const ByteReader& read, std::uint64_t bytes, const std::string& path) {
  Model model;
  Reader reader(read, bytes, path);
  visit_members(reader, model);
  reader.end();
  if (!is_valid(model)) reader.fail();
  return model;
}

Model model_from_bytes(const std::string& bytes, const std::string& path) {
  const char* at = bytes.data();
  const auto read = [&at](char* to, std::size_t count) {
    std::memcpy(to, at, count);
    at += count;
  };
  return read_model(read, bytes.size(), path);
}

}  // namespace tessera::program
