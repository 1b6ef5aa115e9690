// Layout of the float record that the vertex stage writes for each vertex and that tiles interpolate.
#pragma once

namespace tessera::detail {

struct DrawPlan;

/// Offset of the first float of each varying in the record of a vertex; -1: absent.
/// Order: inputs of shading, alpha of per-pixel lighting, texture coordinates, captured normal,
/// inputs of the fragment stage.
struct VaryingLayout {
  int normal = -1;           ///< per-pixel lighting: x y z, eye space
  int position = -1;         ///< per-pixel lighting: x y z, eye space
  int color[2] = {-1, -1};   ///< per face: [0] front, [1] back; r g b, r g b a, or an index
  int alpha[2] = {-1, -1};   ///< per face: [0] front, [1] back; part of the colour, or separate
  int texcoord = -1;         ///< s t
  int captured_normal = -1;  ///< x y z, eye space
  int stage_eye = -1;        ///< input of the fragment stage: x y z; may be `position`
  int stage_normal = -1;     ///< input of the fragment stage: x y z; may be `normal`
  int stage_extras = -1;     ///< inputs of the fragment stage: extra varyings
  int shading_count = 0;     ///< floats that are inputs of shading: the first ones of the record
  int count = 0;             ///< floats per vertex
};

/// @param plan             complete, except for its layout
/// @param capture_normals  the frame captures normals
VaryingLayout varying_layout(const DrawPlan& plan, bool capture_normals);

}  // namespace tessera::detail
