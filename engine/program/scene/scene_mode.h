// Scenes in a display mode: the mode determines the size, the colours and the aspect of the picture.
#pragma once

#include <span>
#include <string>

#include "engine/program/scene/scene.h"

namespace tessera::program {

struct Picture;

/// Returns display_mode(name).
/// @throws Error as display_mode(); for a mistyped name with a suggestion
DisplayMode named_display_mode(const std::string& name);

/// Gives the scene's frame buffer the size, bits and palette of a mode; depth, stencil, alpha, samples and
/// dither stay.
/// @throws Error for a mode of character cells
void set_mode(const DisplayMode& mode, Scene& scene);
/// Replaces the palette of the scene's mode.
/// @throws Error for colours that the mode cannot show; see check_palette()
void set_mode_palette(std::span<const Color> palette, Scene& scene);
/// Sets the source of the mode's palette: adaptive or ramps.
/// @throws Error for a mode whose palette is fixed or that has none; see palette_request()
void set_mode_palette(PaletteSource source, Scene& scene);
/// Sets a named palette, or the source of that name.
/// @throws Error as both above
void set_mode_palette(const std::string& name, Scene& scene);
/// Makes the scene's frame buffer one of 24 bits, whose pictures are reduced to the colours of the mode, or
/// to those that the frame buffer had. The dither is that of the reduction.
void reduce_to_mode(Scene& scene);

/// Reduces the scene of a model that blends or discards fragments if its frame buffer holds indices, which
/// cannot do that. Adds a warning.
void reduce_transparent_model(Scene& scene);

/// Applies mode, reduction and palette of the overrides.
/// @throws Error also for overrides that a mode determines. @pre the overrides or the scene have a mode
void apply_mode(const SceneOverrides& overrides, Scene& scene);

/// Stores a finished picture in a frame buffer of fewer colours, and replaces the picture by the result. Each
/// pixel is stored as a draw of its colour: rounded or dithered, or as the nearest palette entry.
void reduce_picture(Renderer& renderer, Picture& picture, FrameBuffer& buffer);

}  // namespace tessera::program
