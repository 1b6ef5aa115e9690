// Layout of the float record that the vertex stage writes for each vertex and that tiles interpolate.
#pragma once

namespace tessera::detail {

struct DrawPlan;

/// Offsets of the first float of each varying in a vertex's record; -1: absent.
/// Varyings that shading reads come first, then the texture coordinates, then the captured normal.
struct VaryingLayout {
  int normal = -1;           ///< x y z, eye space: input of per-pixel lighting
  int position = -1;         ///< x y z, eye space: input of per-pixel lighting
  int color[2] = {-1, -1};   ///< per face: [0] front, [1] back; r g b, or a single index
  int alpha[2] = {-1, -1};   ///< per face: [0] front, [1] back
  int texcoord = -1;         ///< s t
  int captured_normal = -1;  ///< x y z, eye space
  int shading_count = 0;     ///< floats before the alpha of per-pixel lighting, texcoord and captured_normal
  int count = 0;             ///< floats per vertex
};

/// @param plan             complete but for its layout
/// @param capture_normals  the frame captures normals
VaryingLayout varying_layout(const DrawPlan& plan, bool capture_normals);

}  // namespace tessera::detail
