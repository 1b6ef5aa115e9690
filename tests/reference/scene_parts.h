// Parsers for the parts of a scene file; used by load_scene() only.
#pragma once

#include "json_reader.h"
#include "scene.h"

namespace tessera::reference {

FrameBufferFormat parse_framebuffer(const Value& v);

/// @param aspect  width / height of the picture.
Camera parse_camera(const Value& v, double aspect);

/// Camera of a scene without a camera.
Camera default_camera(double aspect);

std::vector<Light> parse_lights(const Value& v);

/// Returns an absolute path unchanged, and any other relative to the scene's directory.
std::string path_in(const std::string& directory, const std::string& path);

/// @param v  the path
Image parse_image_file(const Value& v, const std::string& directory);
Texture parse_texture(const Value& v, const std::string& name, const std::string& directory);

/// @param directory  base of relative file paths.
Mesh parse_mesh(const Value& v, const std::string& name, const std::string& directory);

/// Reads the per-fragment keys of a draw, bitmap or image. A numeric `depth` is skipped: it is the raster
/// depth of a bitmap or an image.
/// @throws std::runtime_error for invalid values and for state without the buffer it needs.
void parse_fragment_state(ObjectReader& reader, const FrameBufferFormat& format, FragmentState& state);

/// Reads the depth range and the polygon offset.
void parse_window_depths(ObjectReader& reader, const FrameBufferFormat& format, Draw& draw);

Bitmap parse_bitmap(const Value& v, const FrameBufferFormat& format);
ImageDrawing parse_image(const Value& v, const FrameBufferFormat& format, const std::string& directory);

/// Four booleans; red, green and blue must be equal if the buffer holds one value per pixel.
std::array<bool, 4> parse_color_mask(const Value& v, const FrameBufferFormat& format);

Clear parse_clear(const Value& v, const Scene& scene);
Accum parse_accum(const Value& v, const Scene& scene);

/// @param scene  complete except for the frame.
/// @param lights  current at the draw
Draw parse_draw(const Value& v, const Scene& scene, const std::vector<Light>& lights);

/// @param directory  base of relative file paths.
std::vector<Command> parse_frame(const Value& v, const Scene& scene, const std::string& directory);

/// One clear of all buffers and one draw per mesh.
std::vector<Command> default_frame(const Scene& scene);

}  // namespace tessera::reference
