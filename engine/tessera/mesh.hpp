// Meshes: arrays of vertices, borrowed from the caller.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <ranges>
#include <span>
#include <type_traits>

#include "primitives.hpp"
#include "types.hpp"

namespace tessera {

/// Ranges that convert to a span without dangling: lvalues and borrowed ranges.
template <class Range, class Element>
concept BorrowableRange = std::convertible_to<Range, std::span<const Element>> &&
    (std::is_lvalue_reference_v<Range> || std::ranges::enable_borrowed_range<std::remove_cvref_t<Range>>);

/// Floats per vertex in the caller's memory: packed, or with a stride.
struct FloatArray {
  const float* data = nullptr;
  std::size_t float_count = 0;   ///< packed: number of floats
  std::size_t vertices = 0;      ///< strided: number of vertices
  std::size_t stride_bytes = 0;  ///< strided: from vertex to vertex, a multiple of 4; 0: packed

  constexpr FloatArray() = default;
  template <class Range>
  requires BorrowableRange<Range, float>
  constexpr FloatArray(Range&& packed) : FloatArray(std::span<const float>(packed), 0) {}
  constexpr FloatArray(const float* first, std::size_t vertex_count, std::size_t stride)
      : data(first), vertices(vertex_count), stride_bytes(stride) {}
  constexpr bool empty() const { return float_count == 0 && vertices == 0; }

 private:
  constexpr FloatArray(std::span<const float> packed, int)
      : data(packed.data()), float_count(packed.size()) {}
};

/// Colours r g b a per vertex, as floats or as bytes (255 is 1).
struct ColorArray {
  FloatArray floats{};
  const std::uint8_t* bytes = nullptr;
  std::size_t byte_count = 0;    ///< packed bytes: number of bytes
  std::size_t vertices = 0;      ///< strided bytes: number of vertices
  std::size_t stride_bytes = 0;  ///< strided bytes: from vertex to vertex; 0: packed

  constexpr ColorArray() = default;
  template <class Range>
  requires BorrowableRange<Range, float>
  constexpr ColorArray(Range&& packed) : floats(packed) {}
  template <class Range>
  requires BorrowableRange<Range, std::uint8_t>
  constexpr ColorArray(Range&& packed)
      : bytes(std::span<const std::uint8_t>(packed).data()),
        byte_count(std::span<const std::uint8_t>(packed).size()) {}
  constexpr ColorArray(const float* first, std::size_t vertex_count, std::size_t stride)
      : floats(first, vertex_count, stride) {}
  constexpr ColorArray(const std::uint8_t* first, std::size_t vertex_count, std::size_t stride)
      : bytes(first), vertices(vertex_count), stride_bytes(stride) {}
  constexpr bool empty() const { return floats.empty() && byte_count == 0 && vertices == 0; }
};

/// Vertex numbers of 16 or 32 bits.
struct IndexArray {
  const void* data = nullptr;
  std::size_t count = 0;  ///< number of indices
  int bits = 32;          ///< 16 or 32

  constexpr IndexArray() = default;
  template <class Range>
  requires BorrowableRange<Range, std::uint32_t>
  constexpr IndexArray(Range&& packed)
      : data(std::span<const std::uint32_t>(packed).data()),
        count(std::span<const std::uint32_t>(packed).size()) {}
  template <class Range>
  requires BorrowableRange<Range, std::uint16_t>
  constexpr IndexArray(Range&& packed)
      : data(std::span<const std::uint16_t>(packed).data()),
        count(std::span<const std::uint16_t>(packed).size()),
        bits(16) {}
  constexpr bool empty() const { return count == 0; }
};

/// Primitives and their vertices.
/// - Borrowed: the arrays must stay unchanged until the frame is finished or reset.
/// - Attribute arrays may be empty; else they hold one entry per vertex. `indices` may have any length.
/// - A vertex with a NaN or an infinity in an array that the draw uses drops its primitives.
/// @code
/// const float positions[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
/// const std::uint16_t indices[] = {0, 1, 2, 0, 2, 3};
/// frame.draw({.positions = positions, .indices = indices});
/// struct Vertex { float position[3], texcoord[2]; };  // interleaved
/// const std::vector<Vertex> vertices(3);
/// frame.draw({.positions = {vertices[0].position, 3, sizeof(Vertex)},
///             .texcoords = {vertices[0].texcoord, 3, sizeof(Vertex)}});
/// @endcode
struct Mesh {
  Primitive primitive = Primitive::triangles;
  FloatArray positions{};       ///< x y z, or x y z w; object space
  int position_components = 3;  ///< 3 or 4
  /// x y z, object space, any length. Empty: face normals (flat shading) or area-weighted means of the faces
  /// at each position; for points and lines 0 0 0.
  FloatArray normals{};
  ColorArray colors{};   ///< r g b a
  IndexArray indices{};  ///< vertices in the order of the primitives; empty: vertices in order
  /// One index per vertex, interpolated: the colours of unlit draws into colour-index buffers.
  FloatArray color_indices{};
  FloatArray texcoords{};  ///< s t; empty: 0 0
};

}  // namespace tessera
