// A scene: plain data with every default filled in and every name, path and angle resolved, and how it
// becomes a Frame.
//
//   Scene scene = load_scene("pot.json");
//   FrameBuffer buffer(scene.framebuffer);
//   Frame frame(buffer);
//   record(scene, frame);                    // meshes, textures, bitmaps and images stay the scene's: it
//   must outlive the frame
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/program/scene/mesh_data.h"
#include "engine/tessera/tessera.hpp"

namespace tessera::program {

struct Picture;

/// A perspective whose aspect is the picture's.
struct Lens {
  double fovy = 45;              ///< degrees
  double near = 0.1, far = 100;  ///< far may be infinite
};

/// A camera that follows the size of the picture.
struct SceneCamera {
  Matrix view;
  std::variant<Lens, Matrix> projection;
  bool reversed = false;

  Camera at_aspect(double aspect) const;
};

struct DrawCommand {
  std::size_t mesh = 0;  ///< index into Scene::meshes
  DrawState state;
};
struct BitmapCommand {
  Bitmap bitmap;  ///< all but its bits
  std::vector<std::uint8_t> bits;
  FragmentState state;
  Bitmap view() const;
};
struct ImageCommand {
  PixelImage image;  ///< all but its pixels
  std::shared_ptr<const Picture> picture;
  FragmentState state;
  PixelImage view() const;
};
using LightList = std::vector<Light>;
using Command = std::variant<Clear, DrawCommand, BitmapCommand, ImageCommand, Accum, SceneCamera, LightList>;

struct SceneCommand {
  Command what;
  std::string pointer;  ///< where it stands in the file, for messages; empty: the scene made it
};

struct Scene {
  std::string name;  ///< the file, for messages
  std::string title;
  FrameBufferFormat framebuffer;
  std::string palette_name;  ///< of a palette known by name; empty: by bits, or the scene's own entries
  SceneCamera camera;
  LightModel light_model;
  LightList lights{Light{}};
  std::vector<MeshData> meshes;                          ///< in the order of the file
  std::vector<std::shared_ptr<const Texture>> textures;  ///< likewise; draws point to them
  std::vector<SceneCommand> frame;
  std::vector<std::string> warnings;  ///< what was odd, but no error
};

/// A scene file, format version 1, whose numbers may change over time. Paths in it are relative to it; models
/// and images are read once, textures once for each sampler.
class SceneFile {
 public:
  /// @param should_continue  asked while models are read; false ends it with Cancelled
  /// @throws Error, naming file, JSON pointer, what was found and what was expected.
  explicit SceneFile(const std::string& path, std::function<bool()> should_continue = {});
  ~SceneFile();
  SceneFile(SceneFile&&) noexcept;
  /// @param time  0 .. 1 over an animation
  Scene at(double time);
  /// Some number changes over time.
  bool is_animated() const;
  /// The files that scenes so far were read from: this one, images, models, and what models refer to, found
  /// or not.
  const std::set<std::string>& files() const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

/// The scene of a file, at its beginning.
Scene load_scene(const std::string& path);
/// The same from JSON text.
/// @param name         the file's name in messages
/// @param base_folder  what paths in the scene are relative to; empty: the current folder
Scene parse_scene(std::string_view text, const std::string& name, const std::string& base_folder = "");
/// The shiny teapot, drawn when no scene is named.
Scene builtin_scene();

/// What a caller wants otherwise than the scene has it.
struct SceneOverrides {
  std::optional<int> width = {}, height = {};
  std::optional<Shading> shading = {};  ///< of every draw
  std::optional<int> color_bits = {};
  std::optional<std::string> palette = {};  ///< by name; turns the colour buffer into an index buffer
  std::optional<SceneCamera> camera = {};   ///< for the whole frame; reversed where the scene's is
  LightList lights = {};                    ///< for the whole frame; empty: the scene's
};
/// @throws Error for values out of range and for a palette that does not fit into the bits.
void apply(const SceneOverrides& overrides, Scene& scene);

/// The fewest colour bits that hold a palette known by name; 8 for one that fills any number of bits, or is
/// unknown.
int palette_bits(std::string_view name);

/// Replays the scene's commands. The frame borrows the scene's meshes, textures, bitmaps and images until it
/// is finished.
/// @throws Error, naming the command.
void record(const Scene& scene, Frame& frame);

}  // namespace tessera::program
