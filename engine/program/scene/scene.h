// A scene: plain data with every default filled in and every name and path resolved. record() turns it into a
// Frame:
//
//   Scene scene = load_scene("pot.json");
//   FrameBuffer buffer(scene.framebuffer);
//   Frame frame(buffer);
//   record(scene, frame);  // the frame borrows from the scene, which must outlive it
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/program/import/model.h"
#include "engine/program/scene/mesh_data.h"
#include "engine/tessera/display_mode.hpp"
#include "engine/tessera/tessera.hpp"

namespace tessera::program {

class NamedStages;
struct Picture;

/// A perspective projection with the aspect of the picture.
struct Lens {
  double fovy = 45;              ///< degrees
  double near = 0.1, far = 100;  ///< far may be infinite
};

/// Arguments of look_at().
struct Viewpoint {
  Vec3 eye{0, 0, 4}, target{0, 0, 0}, up{0, 1, 0};
};

/// A camera whose aspect follows the size of the picture.
struct SceneCamera {
  Matrix view;
  std::variant<Lens, Matrix> projection;
  bool reversed = false;
  std::optional<Viewpoint> viewpoint{};  ///< absent: `view` was given as a matrix

  Camera at_aspect(double aspect) const;
};
/// @throws Error as look_at()
SceneCamera camera_at(const Viewpoint& viewpoint, const Lens& lens);

struct DrawCommand {
  std::size_t mesh = 0;  ///< index into Scene::meshes
  DrawState state;
  std::shared_ptr<const NamedStages> stages{};  ///< user stages of `state`; null: none
  /// Range of the mesh's indices; index_count 0: the whole mesh.
  std::size_t first_index = 0, index_count = 0;
  std::string material_name{};  ///< models only

  Mesh view(const std::vector<MeshData>& meshes) const;
};
struct BitmapCommand {
  Bitmap bitmap;  ///< without bits
  std::vector<std::uint8_t> bits;
  FragmentState state;
  Bitmap view() const;
};
struct ImageCommand {
  PixelImage image;  ///< without pixels and size
  std::shared_ptr<const Picture> picture;
  FragmentState state;
  PixelImage view() const;
};
using LightList = std::vector<Light>;
using Command =
    std::variant<Clear, DrawCommand, BitmapCommand, ImageCommand, Accum, SceneCamera, LightList, Quality>;

struct SceneCommand {
  Command value;
  std::string pointer;  ///< JSON pointer, for messages; empty: a command of the default frame
};

/// Triangles that blend. They are drawn last, from back to front.
struct BlendedTriangles {
  std::size_t mesh = 0;                ///< index into Scene::meshes; its indices are sorted
  std::vector<std::uint32_t> indices;  ///< in the order of the model, three per triangle
  std::vector<std::uint32_t> draw_of;  ///< per triangle: index into `draws`
  std::vector<DrawCommand> draws;      ///< without ranges
};

/// Origin of the palette. given: named or listed in the scene, or the default. adaptive: chosen for the
/// pictures at 24 bits. ramps: chosen for the materials and lights.
enum class PaletteSource : std::uint8_t { given, adaptive, ramps };
/// Pictures of an animation that share a chosen palette. animation: all. frame: none. smooth: none, but
/// entries move little from picture to picture; adaptive only.
enum class PaletteOver : std::uint8_t { animation, frame, smooth };

struct Scene {
  std::string name;  ///< the file, for messages
  std::string title;
  FrameBufferFormat framebuffer;
  std::string palette_name;  ///< a built-in palette; empty: determined by bits, or entries of the scene
  /// Other than given: the frame buffer has its default palette until a palette is chosen; see
  /// chosen_palette.h.
  PaletteSource palette_source = PaletteSource::given;
  PaletteOver palette_over = PaletteOver::animation;
  std::optional<DisplayMode> mode = {};  ///< display mode of the picture; see scene_mode.h
  std::optional<FrameBufferFormat> reduced =
      {};  ///< the mode's frame buffer, if `framebuffer` has more colours
  SceneCamera camera;
  LightModel light_model;
  LightList lights{Light{}};
  Quality quality;
  std::vector<MeshData> meshes;                          ///< in the order of the file
  std::vector<std::shared_ptr<const Texture>> textures;  ///< in the order of the file; draws point to them
  std::vector<SceneCommand> frame;
  // Models only; see follow_camera.h.
  bool is_model = false;
  bool has_shoulder_light = false;  ///< the only light lies over the left shoulder of the camera
  std::optional<BlendedTriangles> blended{};
  std::vector<std::shared_ptr<const Picture>> texture_pictures{};  ///< those of `textures`, to write them
  std::vector<std::string> warnings;
};

/// A scene file of format version 1, whose numbers may change over time. Paths in it are relative to its
/// folder. Models and images are read once, textures once per sampler.
class SceneFile {
 public:
  /// @param options  for reading models
  /// @throws Error, naming file, JSON pointer, what was found and what was expected
  explicit SceneFile(const std::string& path, const ImportOptions& options = {});
  ~SceneFile();
  SceneFile(SceneFile&&) noexcept;
  /// Evaluates the scene at `time`, 0 .. 1.
  Scene at(double time);
  /// Returns whether any number changes over time.
  bool is_animated() const;
  /// Returns whether at() has read a model.
  bool has_models() const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

/// Reads the scene of a file at time 0.
Scene load_scene(const std::string& path);
/// Reads the scene of a JSON text at time 0.
/// @param name         name of the file, for messages
/// @param base_folder  folder of relative paths in the scene; empty: the current folder
Scene parse_scene(std::string_view text, const std::string& name, const std::string& base_folder = "");
/// Returns the shiny teapot, which the program renders without an input.
Scene builtin_scene();

/// The axis of a model that points up in pictures; z_down and the like: its negative.
enum class UpAxis : std::uint8_t { x, y, z, x_down, y_down, z_down };

/// Replacements for values of a scene; empty: the scene's own.
struct SceneOverrides {
  std::optional<int> width = {}, height = {};
  std::optional<DisplayMode> mode = {};  ///< excludes width, height and color_bits
  bool reduce = false;  ///< draws at 24 bits and reduces the picture to the colours of the mode
  std::optional<Shading> shading = {};  ///< shading of every draw
  std::optional<int> color_bits = {};
  /// Name, or "adaptive" or "ramps"; makes the colour buffer a colour-index buffer.
  std::optional<std::string> palette = {};
  std::optional<PaletteOver> palette_over = {};
  // The dither is that of the reduction, if the scene is reduced.
  std::optional<Dither> dither = {};
  std::optional<DitherSpace> dither_in = {};
  std::optional<float> dither_gamma = {};
  std::optional<SceneCamera> camera = {};  ///< for the whole frame; keeps the scene's `reversed`
  LightList lights = {};                   ///< for the whole frame
  std::optional<Quality> quality = {};     ///< for the whole frame
  std::optional<int> samples = {};         ///< per pixel: 1, 4 or 8
  /// Colour of all clears; alpha 0: no background, and the picture has alpha.
  std::optional<Color> background = {};
  bool wireframe = false;  ///< draws the edges of polygons
  /// Turns the camera once around the vertical axis through the middle of the scene while time goes from 0
  /// to 1.
  bool turntable = false;
  std::optional<UpAxis> up = {};  ///< models only: the axis of the file that points up
};
/// @throws Error for values out of range, for a palette that does not fit into the colour bits, and for
/// values that the display mode determines
void apply(const SceneOverrides& overrides, Scene& scene);

/// Returns the fewest colour bits that hold a named palette; 8 for a palette of any number of bits or an
/// unknown name.
int palette_bits(std::string_view name);
/// Returns the source of a palette: adaptive or ramps for these names, else given.
PaletteSource palette_source(std::string_view name);

/// Records the scene's commands. The frame borrows meshes, textures, bitmaps and images of the scene until it
/// is finished.
/// @throws Error, naming the command
void record(const Scene& scene, Frame& frame);

}  // namespace tessera::program
