// Frames built from a fuzzer's bytes: everything the public interface accepts, in sizes that are drawn
// quickly.
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

/// Arrays allocated exactly, so that sanitizers detect reads past their ends.
struct ExactSizeMesh {
  Mesh mesh;  ///< without its arrays
  std::vector<float> positions;
  std::vector<float> normals;
  std::vector<float> colors;
  std::vector<float> color_indices;
  std::vector<float> texcoords;
  std::vector<std::uint8_t> color_bytes;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint16_t> short_indices;
  std::size_t vertices = 0;
  std::size_t stride_floats = 0;  ///< floats between vertices in all float arrays; 0: packed
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

/// Destination of a frame's picture; absent: it stays in the buffer.
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
  RendererOptions options[2];       ///< for the two renderings
  bool uses_caller_memory = false;  ///< the second rendering draws into memory of the caller
  std::deque<Texture> textures;
  std::vector<ExactSizeMesh> meshes;
  std::vector<PipelineFrame> frames;
};

}  // namespace tessera::fuzz
