// Frames made of a fuzzer's bytes: everything that the public interface takes, in sizes that are quickly
// drawn.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/tessera/tessera.hpp"
#include "tests/fuzz/fuzz_input.h"

namespace tessera::fuzz {

/// Arrays without a byte behind their ends.
struct ExactSizeMesh {
  Mesh mesh;  ///< all but its arrays
  std::vector<float> positions, normals, colors, color_indices, texcoords;
  std::vector<std::uint8_t> color_bytes;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint16_t> short_indices;
  std::size_t vertices = 0,
              stride_floats = 0;  ///< stride_floats: between the vertices of all float arrays; 0: packed
  Mesh view() const;
};

struct DrawMesh {
  std::size_t mesh;
  DrawState state;
};
struct DrawBitmap {
  Bitmap bitmap;
  std::vector<std::uint8_t> bits;
  FragmentState state;
};
struct DrawImage {
  PixelImage image;
  std::vector<std::uint8_t> pixels;
  FragmentState state;
};
using LightList = std::vector<Light>;
using PipelineCommand =
    std::variant<DrawMesh, DrawBitmap, DrawImage, Clear, Accum, Camera, LightList, LightModel>;

/// How the picture of a frame leaves it; absent: it stays in the buffer.
struct Presentation {
  std::ptrdiff_t gap_bytes = 0;  ///< between rows
  bool bottom_up = false;        ///< rows go up in memory
  PixelOrder order = PixelOrder::rgba8;
  std::optional<Rect> part;
};

struct PipelineFrame {
  std::vector<PipelineCommand> commands;
  std::optional<std::vector<Buffer>> keep;
  std::optional<Presentation> presentation;
  bool captures = false;
};

class PipelineCase {
 public:
  explicit PipelineCase(FuzzInput& from);
  PipelineCase(const PipelineCase&) = delete;  // draws point to its textures
  PipelineCase& operator=(const PipelineCase&) = delete;

  FrameBufferFormat format;
  RendererOptions options[2];       ///< two ways to draw the same
  bool uses_caller_memory = false;  ///< the second way draws into memory of the caller
  std::deque<Texture> textures;
  std::vector<ExactSizeMesh> meshes;
  std::vector<PipelineFrame> frames;
};

}  // namespace tessera::fuzz
