// The parts a scene file is read in; used by load_scene() only.
#pragma once

#include "json_reader.h"
#include "scene.h"

namespace tessera::reference {

FrameBufferFormat parse_framebuffer(const Value& v);

/// @param aspect  width / height of the picture.
Camera parse_camera(const Value& v, double aspect);

/// The camera of a scene that names none.
Camera default_camera(double aspect);

std::vector<Light> parse_lights(const Value& v);

/// A path as it is written, or relative to the scene's directory.
std::string path_in(const std::string& directory, const std::string& path);

/// @param v  the path
Image parse_image_file(const Value& v, const std::string& directory);
Texture parse_texture(const Value& v, const std::string& name, const std::string& directory);

/// @param directory  what file paths are relative to.
Mesh parse_mesh(const Value& v, const std::string& name, const std::string& directory);

/// Reads the keys of a draw, bitmap or image that its fragments obey. A `depth` that is a number is left
/// alone: it is where a bitmap or an image lies.
/// @throws std::runtime_error for what the frame buffer has no buffer for and for what it refuses.
void parse_fragment_state(ObjectReader& reader, const FrameBufferFormat& format, FragmentState& state);

/// Reads depth range and polygon offset.
void parse_window_depths(ObjectReader& reader, const FrameBufferFormat& format, Draw& draw);

Bitmap parse_bitmap(const Value& v, const FrameBufferFormat& format);
ImageDrawing parse_image(const Value& v, const FrameBufferFormat& format, const std::string& directory);

/// Four of true and false: red, green and blue the same if the buffer holds one value for each pixel.
std::array<bool, 4> parse_color_mask(const Value& v, const FrameBufferFormat& format);

Clear parse_clear(const Value& v, const Scene& scene);
Accum parse_accum(const Value& v, const Scene& scene);

/// @param scene  all but the frame has been read.
/// @param lights  in force at the draw
Draw parse_draw(const Value& v, const Scene& scene, const std::vector<Light>& lights);

/// @param directory  what file paths are relative to.
std::vector<Command> parse_frame(const Value& v, const Scene& scene, const std::string& directory);

/// One clear of what there is and one draw of every mesh.
std::vector<Command> default_frame(const Scene& scene);

}  // namespace tessera::reference
