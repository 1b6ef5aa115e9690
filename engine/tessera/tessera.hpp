// Tessera: a multithreaded, tile-based software rasterizer. This header includes the whole public API.
//
//   tessera::Renderer renderer;                                  // all cores, best instruction set
//   tessera::FrameBuffer buffer({.width = 640, .height = 480});  // 24-bit colour, 24-bit depth
//   tessera::Frame frame(buffer);
//   frame.clear({.color = tessera::Color{0, 0, 0, 1}, .depth = 1.0});
//   frame.set_camera({.view = look_at(...), .projection = perspective(...)});
//   frame.draw(mesh, {.material = red, .shading = tessera::Shading::phong});
//   renderer.finish(frame, {.pixels = pixels, .width = 640, .height = 480, .stride_bytes = 640 * 4});
//
// Conventions: OpenGL's.
// - Right-handed; the camera looks along -z; column vectors; matrices are written in rows.
// - Front faces are counter-clockwise. Angles are in degrees.
// - Window coordinates have their origin at the lower left. Images and planes in memory: top row first.
// - Geometry is double, colours and lights are float. No transfer curve is applied.
//
// Errors: tessera::Error. Errors of arguments are thrown before a pixel changes; for cancelled frames see
// RendererOptions::progress.
// - code() is the kind of error, what() the value found and the values expected.
// - Odd data (NaN vertices, triangles without area) is no error: it is dropped and counted in FrameStats.
// - Functions marked noexcept, destructors and moves do not throw; all others may throw Error.
//
// Threads: distinct objects may be used by distinct threads at the same time, one object by one thread at a
// time. There is no global state. A frame gives the same bits for any number of threads, tile size and
// instruction set.
//
// Lifetimes: meshes, textures, bitmaps and images are borrowed until the frame is finished or reset. Objects
// that were moved from may only be assigned to or destroyed.
//
// ABI: C++ only. Library and program must be built with compatible compilers and the same standard library;
// structures change between minor versions.
#pragma once

#include "commands.hpp"
#include "display_mode.hpp"
#include "executor.hpp"
#include "export.h"
#include "frame.hpp"
#include "framebuffer.hpp"
#include "mesh.hpp"
#include "palettes.hpp"
#include "prices.hpp"
#include "primitives.hpp"
#include "quality.hpp"
#include "renderer.hpp"
#include "scene.hpp"
#include "screen_geometry.hpp"
#include "state.hpp"
#include "texture.hpp"
#include "types.hpp"
#include "version.h"
