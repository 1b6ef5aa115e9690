// Models from files. Readers of our own read Wavefront OBJ with MTL materials, glTF, STL, PLY and 3MF, assimp
// everything else, all in a child process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/program/scene/mesh_data.h"

namespace tessera::program {

inline constexpr int kMaxNodeDepth = 500;  ///< files whose nodes are nested deeper are rejected
inline constexpr std::string_view kHoldsNothing = "holds no triangle, line or point";  ///< a message

/// An image of a material. Readers of models name files or give their bytes; decode_images() does the rest.
struct ModelImage {
  /// A file relative to the model's folder, as the model names it; with `encoded`, any name. Empty: white,
  /// if there is an alpha_name.
  std::string name;
  std::string encoded;  ///< bytes of an image file within the model; empty: read the file `name`
  /// A second image file whose luminance becomes the alpha (map_d of MTL); empty: none.
  std::string alpha_name;
  // Filled in by decode_images():
  int width = 0, height = 0;         ///< pixels
  bool has_alpha = false;            ///< some alpha is below 255
  std::vector<std::uint8_t> pixels;  ///< RGBA, rows from the top without gaps
};

/// An image and how it is sampled.
struct ModelTexture {
  std::size_t image = 0;  ///< index into Model::images
  TextureSampler sampler;
};

/// How alpha, the product of those of material, vertex colour and texture, is used.
enum class ModelAlpha : std::uint8_t {
  opaque,  ///< ignored
  mask,    ///< fragments below the cutoff are discarded, all others are opaque
  blend    ///< drawn over what lies behind
};

/// The triangles, lines or points of one material: a range of the mesh's indices.
struct ModelPart {
  std::string material_name;                   ///< empty: the file names none
  Material material;                           ///< diffuse alpha is the material's
  Primitive primitive = Primitive::triangles;  ///< triangles, lines or points
  std::size_t first_index = 0;
  std::size_t index_count = 0;
  /// Vertex colours replace the ambient and diffuse colour; readers multiply them by the material's.
  bool uses_colors = false;
  bool is_unlit = false;                 ///< lights and normals are ignored: the colour is the diffuse one
  bool is_double_sided = true;           ///< false: back faces are culled
  std::optional<std::size_t> texture{};  ///< index into Model::textures; multiplies ambient and diffuse
  ModelAlpha alpha = ModelAlpha::opaque;
  float alpha_cutoff = 0.5f;  ///< ModelAlpha::mask
};

/// A camera of a model file, valid for any size of the picture.
/// half_width and half_height describe the view volume: in world units if orthographic, else at distance 1.
/// One of them may be 0; the aspect of the picture then determines it.
struct ModelCamera {
  Matrix view;
  bool is_orthographic = false;
  double half_width = 0;
  double half_height = 0;
  double near = 0;  ///< 0: not given
  double far = 0;   ///< 0: not given
};

struct Model {
  MeshData mesh;  ///< all parts, indexed; colours and texture coordinates if the file has them
  /// In the order of first use, but parts of lines and points come after those of triangles. Never empty.
  std::vector<ModelPart> parts;
  std::vector<ModelImage> images;
  std::vector<ModelTexture> textures;
  /// Point that was subtracted from the coordinates of the file, so that floats are precise far from the
  /// origin.
  Vec3 origin{};
  std::vector<std::string> warnings;  ///< one line each, such as a missing material file
  std::vector<ModelCamera> cameras;
  std::vector<Light> lights;  ///< in world space
  std::optional<Color> ambient_light;
};

enum class ModelUse {
  mesh,    ///< as in the file: OBJ files may lack normals and have any winding
  display  ///< every corner has a normal, and triangles are wound to match (model_normals.h)
};

/// Limits of the process that reads a model, and what is asked and told meanwhile.
struct ImportOptions {
  /// Memory of the process, and at most as much for the model. 0: a quarter of the machine's memory or of
  /// what the control group of this process may have, at least 1 GiB.
  std::size_t memory_bytes = 0;
  int seconds = 10;                         ///< without progress
  std::function<bool()> should_continue{};  ///< polled about ten times a second; false cancels
  /// Receives the file and the share of it that is done, 0 .. 1.
  std::function<void(const std::string& path, double done)> progress{};
};

/// Reads a model in a child process with limits.
/// - Forks this process: call it before other threads run.
/// @throws Error, naming the file and if possible the line, for a file that is missing, broken or without
///   triangles, or that exceeds a limit
/// @throws Cancelled
Model import_model(const std::string& path, ModelUse use = ModelUse::mesh, const ImportOptions& options = {});

/// Returns the file name extensions of the readable formats, in lower case with their dots.
/// @throws Error without the import module
std::vector<std::string> model_extensions();

/// Returns each part as a separate mesh with only the vertices it uses.
std::vector<MeshData> split_into_parts(Model model);

}  // namespace tessera::program
