// Writes the values of PLY files in all formats and types, independently of the reader.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>

namespace tessera::ply_writer {

enum class Format : std::uint8_t { ascii, little, big };

inline std::string header(Format format, const std::string& elements) {
  const char* const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  return std::string("ply\nformat ") + names[static_cast<std::size_t>(format)] + " 1.0\n" + elements +
         "end_header\n";
}

template <class T>
std::string bytes_of(T value, Format format) {
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
  const bool is_little = std::endian::native == std::endian::little;
  if (is_little != (format == Format::little)) std::ranges::reverse(bytes);
  return bytes;
}

/// A value of a type that a header names.
inline std::string value(double x, const std::string& type, Format format) {
  if (format == Format::ascii) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g ", x);
    return text;
  }
  if (type == "char" || type == "int8") return bytes_of(static_cast<std::int8_t>(x), format);
  if (type == "uchar" || type == "uint8") return bytes_of(static_cast<std::uint8_t>(x), format);
  if (type == "short" || type == "int16") return bytes_of(static_cast<std::int16_t>(x), format);
  if (type == "ushort" || type == "uint16") return bytes_of(static_cast<std::uint16_t>(x), format);
  if (type == "int" || type == "int32") return bytes_of(static_cast<std::int32_t>(x), format);
  if (type == "uint" || type == "uint32") return bytes_of(static_cast<std::uint32_t>(x), format);
  if (type == "float" || type == "float32") return bytes_of(static_cast<float>(x), format);
  return bytes_of(x, format);
}

}  // namespace tessera::ply_writer
