#include "engine/import/model_bytes.h"

#include <cstring>
#include <type_traits>

namespace tessera {
namespace {

class Writer {
 public:
  std::string bytes;

  template <class T>
  void operator()(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void operator()(const std::string& text) {
    (*this)(text.size());
    bytes += text;
  }
  template <class T>
  void operator()(const std::vector<T>& list) {
    (*this)(list.size());
    if constexpr (std::is_trivially_copyable_v<T>) {
      bytes.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T));
    } else {
      for (const T& element : list) (*this)(element);
    }
  }
  void operator()(const ModelPart& part) {
    (*this)(part.material_name);
    (*this)(part.material);
    (*this)(part.first_index);
    (*this)(part.index_count);
    (*this)(part.uses_colors);
  }
};

class Reader {
 public:
  explicit Reader(const std::string& bytes) : bytes_(bytes) {}

  template <class T>
  void operator()(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::memcpy(&value, take(sizeof value), sizeof value);
  }
  void operator()(std::string& text) {
    const std::size_t size = count(1);
    text.assign(take(size), size);
  }
  template <class T>
  void operator()(std::vector<T>& list) {
    if constexpr (std::is_trivially_copyable_v<T>) {
      list.resize(count(sizeof(T)));
      if (!list.empty()) std::memcpy(list.data(), take(list.size() * sizeof(T)), list.size() * sizeof(T));
    } else {
      list.resize(count(1));
      for (T& element : list) (*this)(element);
    }
  }
  void operator()(ModelPart& part) {
    (*this)(part.material_name);
    (*this)(part.material);
    (*this)(part.first_index);
    (*this)(part.index_count);
    (*this)(part.uses_colors);
  }

 private:
  std::size_t count(std::size_t element_bytes) {
    std::size_t size = 0;
    (*this)(size);
    if (size > (bytes_.size() - at_) / element_bytes) throw Error("the reading process sent half a model");
    return size;
  }
  const char* take(std::size_t size) {
    if (size > bytes_.size() - at_) throw Error("the reading process sent half a model");
    const char* const from = bytes_.data() + at_;
    at_ += size;
    return from;
  }
  const std::string& bytes_;
  std::size_t at_ = 0;
};

// One list of members for both ways.
template <class Stream, class ModelOrConst>
void stream(Stream& stream, ModelOrConst& model) {
  stream(model.mesh.positions);
  stream(model.mesh.normals);
  stream(model.mesh.colors);
  stream(model.mesh.indices);
  stream(model.parts);
  stream(model.warnings);
  stream(model.cameras);
  stream(model.lights);
  stream(model.ambient_light);
}

}  // namespace

std::string to_bytes(const Model& model) {
  Writer writer;
  stream(writer, model);
  return std::move(writer.bytes);
}

Model model_from_bytes(const std::string& bytes) {
  Model model;
  Reader reader(bytes);
  stream(reader, model);
  return model;
}

}  // namespace tessera
