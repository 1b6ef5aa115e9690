#include "engine/program/scene/json_text.h"

#include <algorithm>
#include <charconv>
#include <cstddef>

namespace tessera::program::json {
namespace {

constexpr std::size_t kColumns = 100;

std::string scalar_text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

class Writer {
 public:
  /// @param indent  columns before the lines after the first
  void write(const Json& json, std::size_t indent) {
    if (write_on_line(json, line_end(indent)) || !json.is_structured()) return;
    const bool is_object = json.is_object();
    text_ += is_object ? "{" : "[";
    if (json.is_array() && std::ranges::none_of(json, [](const Json& j) { return j.is_structured(); }))
      write_wrapped(json, indent + 2);
    else write_elements(json, indent + 2);
    break_line(indent);
    text_ += is_object ? "}" : "]";
  }

  std::string take() { return std::move(text_) + "\n"; }

 private:
  std::size_t column() const { return text_.size() - line_begin_; }
  std::size_t line_end(std::size_t indent) const {
    return line_begin_ + std::max(kColumns, indent + kColumns / 2);
  }
  void break_line(std::size_t indent) {
    text_ += "\n";
    line_begin_ = text_.size();
    text_.append(indent, ' ');
  }

  /// Writes a value on the current line. Returns false, without a change, if it ends beyond `end`.
  bool write_on_line(const Json& json, std::size_t end) {
    const std::size_t begin = text_.size();
    if (append_flat(json, end)) return true;
    if (json.is_structured()) text_.resize(begin);
    return false;
  }

  /// Gives up early, with a part of the value written, if the text passes `end`.
  bool append_flat(const Json& json, std::size_t end) {
    if (!json.is_structured()) {
      text_ += scalar_text(json);
      return text_.size() <= end;
    }
    const bool is_object = json.is_object();
    text_ += is_object ? "{" : "[";
    const char* separator = "";
    for (const auto& [key, element] : json.items()) {
      text_ += separator;
      if (is_object) text_ += scalar_text(key) + ": ";
      if (!append_flat(element, end)) return false;
      separator = ", ";
    }
    text_ += is_object ? "}" : "]";
    return text_.size() <= end;
  }

  void write_elements(const Json& json, std::size_t indent) {
    const char* separator = "";
    for (const auto& [key, element] : json.items()) {
      text_ += separator;
      break_line(indent);
      if (json.is_object()) text_ += scalar_text(key) + ": ";
      write(element, indent);
      separator = ",";
    }
  }

  void write_wrapped(const Json& list, std::size_t indent) {
    const char* separator = "";
    break_line(indent);
    for (const Json& element : list) {
      const std::string text = scalar_text(element);
      text_ += separator;
      if (column() > indent) {
        if (column() + 1 + text.size() > kColumns) break_line(indent);
        else text_ += " ";
      }
      text_ += text;
      separator = ",";
    }
  }

  std::string text_;
  std::size_t line_begin_ = 0;  // offset of the current line in text_
};

}  // namespace

Json number(float x) {
  char digits[32];
  const auto written = std::to_chars(digits, digits + sizeof digits, x);
  double shortest = 0;
  std::from_chars(digits, written.ptr, shortest);
  // Rounding the digits to double and then to float could give a neighbour.
  return static_cast<float>(shortest) == x ? shortest : static_cast<double>(x);
}

std::string readable_text(const Json& json) {
  Writer writer;
  writer.write(json, 0);
  return writer.take();
}

}  // namespace tessera::program::json
