// Recording of frames.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tessera/effect_note.hpp>

#include "commands.hpp"
#include "framebuffer.hpp"
#include "mesh.hpp"
#include "quality.hpp"
#include "scene.hpp"
#include "state.hpp"
#include "types.hpp"

namespace tessera {

class Renderer;

/// Stable names for programs: "depth_test", "no_depth_buffer". Empty for values that are no enumerators.
TESSERA_API std::string_view code(Effect effect);
TESSERA_API std::string_view code(EffectReason reason);

/// An effect of a draw for programs and for people.
struct EffectExplanation {
  EffectNote note;
  std::string cause;  ///< the field that decides: "lights[2].spot_cutoff", "depth.test", "mesh.normals"
  std::string text;   ///< its line of Frame::explain, without the end of the line
};
struct DrawExplanation {
  std::vector<EffectExplanation> effects;
  std::vector<std::string> code_paths;  ///< one per polygon mode; none if the draw can change no pixel
};

/// Why the planes of a buffer are written or not.
enum class BufferReason : std::uint8_t {
  not_in_format,  ///< the frame buffer has no such buffer
  not_used,       ///< nothing reads it: neither tiles nor planes are allocated
  unchanged,      ///< read only
  kept,           ///< the frame keeps it: tiles are stored in its planes
  ends_cleared,   ///< it ends as one value: no planes are written
  not_kept        ///< it exists in tiles only: no planes are allocated
};
/// Use of a buffer by a frame.
struct BufferNote {
  Buffer buffer = Buffer::color;
  bool in_tiles = false;  ///< tiles have memory for it
  bool loaded = false;    ///< tiles start from its planes
  bool stored = false;    ///< tiles are stored in its planes
  BufferReason reason = BufferReason::not_used;

  bool operator==(const BufferNote&) const = default;
};
TESSERA_API std::string_view code(BufferReason reason);
/// A line of text, without its end: "depth: not allocated, the frame does not keep it".
TESSERA_API std::string text(const BufferNote& note);

/// Records the commands of a frame, in order. Nothing is rendered until Renderer::finish.
/// - The frame buffer must outlive the frame. It may be moved, and must not be assigned to.
/// - Arguments are checked when they are recorded. A call that throws records nothing.
/// - A frame that was moved from may only be assigned to or destroyed.
/// @code
/// Frame frame(buffer);
/// frame.set_camera({.view = look_at({0, 1, 5}, {0, 0, 0}, {0, 1, 0}),
///                   .projection = perspective(45, 1.5, 0.1, 50)});
/// frame.set_lights({Light{.position = {1, 2, 3, 0}}});
/// frame.clear({.color = Color{0, 0, 0, 1}, .depth = 1.0});
/// frame.draw(mesh, {.shading = Shading::phong});
/// std::printf("%s", frame.explain(0).c_str());  // what runs for draw 0, and why
/// frame.keep({Buffer::color});                  // depth and stencil are not stored
/// renderer.finish(frame);
/// @endcode
class TESSERA_API Frame {
 public:
  /// @throws Error  if the frame buffer was moved from, or out of memory
  explicit Frame(FrameBuffer& target);
  /// Validates the indices of large meshes (65,536 indices and more) with the workers of `helper`. A single
  /// thread validates about 5e9 indices per second.
  /// - draw() and the helper's finish() must not run concurrently. Within the helper's own progress callback,
  ///   validation is single-threaded.
  /// - The helper must outlive the frame. It may be moved, and must not be assigned to.
  /// - Any renderer may finish the frame.
  Frame(FrameBuffer& target, Renderer& helper);
  ~Frame();
  Frame(Frame&&) noexcept;
  Frame& operator=(Frame&&) noexcept;

  // State of the draws that follow. Initially: identity matrices, one default Light, a default LightModel, no
  // caps.
  // These functions throw Error for values that are out of range or not finite, or if memory runs out.

  void set_camera(const Camera& camera);
  void set_lights(std::span<const Light> lights);
  void set_lights(std::initializer_list<Light> lights) {
    set_lights(std::span<const Light>(lights.begin(), lights.size()));
  }
  void set_light_model(const LightModel& model);
  void set_quality(const Quality& quality);

  /// @throws Error  for values out of range, and for buffers that the frame buffer lacks
  void clear(const Clear& clear);
  /// @throws Error  for values out of range, and without an accumulation buffer
  void accumulate(const Accum& accum);
  /// Cost: validates every index; the rest of the work is the renderer's.
  /// @throws Error  for arrays that do not fit together, values or indices out of range, a moved-from
  ///                texture, or a planar shadow that does not exist
  void draw(const Mesh& mesh, const DrawState& state = {});
  /// Draws a bitmap or an image. Camera and viewport do not apply; pixels outside the frame buffer are
  /// dropped.
  /// @throws Error  for null pointers, and for sizes or values out of range
  void draw_bitmap(const Bitmap& bitmap, const FragmentState& state = {});
  void draw_image(const PixelImage& image, const FragmentState& state = {});

  /// Buffers that the frame buffer holds after the frame (store ops). Other buffers that the frame touches
  /// are discarded: reading or loading them is an error until they are cleared as a whole. Default: every
  /// buffer, or none if the frame is finished into an ImageTarget.
  void keep(std::initializer_list<Buffer> buffers);

  /// Requests per-pixel data from the next finish().
  /// @throws Error  for a span of another size
  void capture(const Capture& capture);

  /// The effects of a draw: which of them run, which are skipped, and why.
  /// @param draw_index  from 0; bitmaps and images count as draws
  /// @throws Error  if the frame has no such draw
  std::vector<EffectNote> effects(std::size_t draw_index) const;
  /// effects() with their causes and texts, and the code paths of the draw's pixels.
  DrawExplanation explanation(std::size_t draw_index) const;
  /// The texts of explanation(), one line each. Wording may change between versions; programs use codes.
  std::string explain(std::size_t draw_index) const;
  std::size_t draw_count() const noexcept;
  /// The use of each buffer, in the order of Buffer.
  /// @param presented  Renderer::finish writes an image
  /// @throws Error  if the frame loads a buffer that the frame before did not keep
  std::vector<BufferNote> buffers(bool presented = true) const;

  /// Forgets all commands, captures and keep(). Camera, lights, light model and quality stay.
  void reset() noexcept;

 private:
  friend class Renderer;
  std::unique_ptr<detail::FrameRecording> recording_;
};

}  // namespace tessera
