// User stages: functions of the embedder that draws run on blocks of vertices and of fragments.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tessera {

/// Largest number of extra varyings of a draw.
inline constexpr int kMaxExtras = 8;

/// Values of a vertex, as VertexStage::reads and writes name them.
struct VertexValues {
  bool object = false;    ///< position in object space; cannot be written
  bool eye = false;       ///< position in eye space, where lighting happens
  bool clip = false;      ///< position in clip space, which decides where the vertex is drawn
  bool normal = false;    ///< normal in eye space
  bool color = false;     ///< colour of the vertex, as of Mesh::colors
  bool texcoord = false;  ///< texture coordinates, as of Mesh::texcoords

  bool operator==(const VertexValues&) const = default;
};

/// A block of vertices: one array per component, each of `count` values.
/// - Arrays that the stage neither reads nor writes are null.
/// - Arrays that it writes without reading hold 0.
/// - Values that a mesh lacks: w, colours and alpha are 1, texture coordinates 0, normals generated.
struct VertexBlock {
  std::size_t first = 0;  ///< number of the block's first vertex in the mesh
  std::size_t count = 0;
  std::array<const float*, 4> object{};      ///< x y z w
  std::array<float*, 3> eye{};               ///< x y z
  std::array<double*, 4> clip{};             ///< x y z w
  std::array<float*, 3> normal{};            ///< x y z; lighting expects unit length
  std::array<float*, 4> color{};             ///< r g b a
  std::array<float*, 2> texcoord{};          ///< s t
  std::array<float*, kMaxExtras> extras{};   ///< written: VertexStage::extras arrays
  const double* clip_from_object = nullptr;  ///< matrix of the draw, 16 elements in rows
  const double* eye_from_object = nullptr;   ///< the same to eye space
};

/// A function that runs on every vertex of a draw, between the built-in transform and the clipping.
/// - `run` is called once per block, on any worker, for several blocks at a time, in any order.
/// - Sizes of blocks are no promise. The bits of a picture do not depend on threads, tiles or instruction set
///   if each vertex depends on nothing but its own inputs.
/// - An exception ends the frame: Renderer::finish throws it, and the frame is still recorded.
/// - Vertices with a value that is not finite drop their primitives (FrameStats::dropped_non_finite).
/// - What the data of the mesh prove about a draw is not used for draws with a vertex stage.
/// - Face normals and smooth normals that a mesh lacks are generated from its positions, before the stage.
/// @code
/// float time = 0.5f;  // seconds
/// const auto move = [](const VertexBlock& block, void* data) {
///   const float seconds = *static_cast<const float*>(data);
///   for (std::size_t i = 0; i < block.count; ++i)
///     block.clip[1][i] += 0.1 * std::sin(block.object[0][i] + seconds) * block.clip[3][i];
/// };
/// const VertexStage waves{.run = move,
///                         .data = &time,
///                         .name = "waves",
///                         .reads = {.object = true, .clip = true},
///                         .writes = {.clip = true}};
/// frame.draw(mesh, {.vertex_stage = waves});
/// @endcode
struct VertexStage {
  void (*run)(const VertexBlock& block, void* data) = nullptr;
  void* data = nullptr;         ///< passed to `run`; borrowed like the mesh
  const char* name = "custom";  ///< for Frame::explain; borrowed like the mesh
  VertexValues reads{};         ///< nothing else is computed for the stage
  VertexValues writes{};
  int extras = 0;  ///< extra varyings that it writes, 0 to kMaxExtras

  bool operator==(const VertexStage&) const = default;
};

/// Values of a fragment, as FragmentStage::reads names them.
struct FragmentValues {
  bool position = false;  ///< window position of the pixel's centre
  bool depth = false;     ///< window depth
  bool color = false;     ///< colour after shading and texture; false: neither is computed
  bool eye = false;       ///< interpolated position in eye space
  bool normal = false;    ///< interpolated normal in eye space
  int extras = 0;         ///< interpolated extra varyings, at most those of the vertex stage

  bool operator==(const FragmentValues&) const = default;
};

/// A block of fragments of one face of a draw: one array per component, each of `count` values.
/// - Arrays that the stage neither reads nor writes are null; `color` is never null.
/// - A block may hold a fragment several times; results of the repetitions are dropped.
struct FragmentBlock {
  std::size_t count = 0;
  bool back_face = false;
  int frame_width = 0, frame_height = 0;  ///< size of the frame buffer, pixels
  const float* x = nullptr;               ///< pixels from the left
  const float* y = nullptr;               ///< pixels from the bottom
  std::array<const float*, 3> eye{};      ///< x y z
  std::array<const float*, 3> normal{};   ///< x y z; as interpolated, not normalized
  std::array<const float*, kMaxExtras> extras{};
  std::array<float*, 4> color{};  ///< r g b a, in and out; the material's diffuse colour if not read
  double* depth = nullptr;        ///< 0 to 1, in and out
  std::uint8_t* keep = nullptr;   ///< 1 on entry; 0 discards the fragment
};

/// A function that runs on the fragments of a draw, after shading and texture and before the alpha test.
/// - `run` is called once per block, on any worker, for several blocks at a time, in any order.
/// - A stage that neither discards nor writes depth runs once per visible pixel, unless the result depends on
///   the order of draws (blending, alpha test, dither, ...), colours are flat, or it reads depth and pixels
///   have several samples.
/// - With several samples it runs once per pixel; its depth is that of all samples, and the depth that it
///   reads that of sample 0.
/// - Colours are clamped to 0 to 1. Components that are not finite become 0, and the fragment is counted
///   (FrameStats::non_finite_fragments). Fragments whose depth is not finite are dropped and counted.
/// - An exception ends the frame: Renderer::finish throws it, and the frame is still recorded.
/// - Bits do not depend on threads, tiles or instruction set if each fragment depends on nothing but its own
///   inputs.
/// @code
/// const auto mix = [](const FragmentBlock& block, void*) {
///   for (std::size_t i = 0; i < block.count; ++i)
///     for (float* component : {block.color[0], block.color[1], block.color[2]})
///       component[i] += (0.5f - component[i]) * std::min(-block.eye[2][i] / 50, 1.0f);
/// };
/// const FragmentStage fog{.run = mix, .name = "fog", .reads = {.color = true, .eye = true}};
/// frame.draw(mesh, {.fragment_stage = fog});
/// @endcode
struct FragmentStage {
  void (*run)(const FragmentBlock& block, void* data) = nullptr;
  void* data = nullptr;         ///< passed to `run`; borrowed like the mesh
  const char* name = "custom";  ///< for Frame::explain; borrowed like the mesh
  FragmentValues reads{};       ///< nothing else is computed for the stage
  bool writes_depth = false;    ///< clamped to 0 to 1
  bool discards = false;        ///< writes FragmentBlock::keep

  bool operator==(const FragmentStage&) const = default;
};

}  // namespace tessera
