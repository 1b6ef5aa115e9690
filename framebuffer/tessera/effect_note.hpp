// Notes about the effects of a draw: which of them run, which are skipped, and why.
#pragma once

#include <cstdint>
#include <string_view>

namespace tessera {

/// An effect that a draw may consist of. New enumerators are appended.
enum class Effect : std::uint8_t {
  draw,                  ///< the draw as a whole
  planar_shadow,         ///< DrawState::shadow_on
  depth_test,            ///< DepthState::test
  depth_write,           ///< DepthState::write
  plane_masks,           ///< DrawState::color_mask and plane_mask
  alpha_test,            ///< DrawState::alpha_test
  stencil_test,          ///< DrawState::stencil
  blending,              ///< DrawState::blend
  dither,                ///< FrameBufferFormat::dither
  logic_op,              ///< DrawState::logic_op
  alpha_planes,          ///< FrameBufferFormat::alpha_bits
  polygon_offset,        ///< DrawState::polygon_offset
  polygon_mode,          ///< DrawState::front_mode and back_mode
  multisampling,         ///< FrameBufferFormat::samples
  bitmap,                ///< Frame::draw_bitmap
  image,                 ///< Frame::draw_image
  texture,               ///< DrawState::texture
  texture_coordinates,   ///< Mesh::texcoords
  texture_lod,           ///< level of detail of the texture
  lighting,              ///< DrawState::lighting
  two_sided_lighting,    ///< LightModel::two_sided
  index_lighting,        ///< Material::index_ramp
  vertex_colors,         ///< Mesh::colors
  color_indices,         ///< Mesh::color_indices
  generated_normals,     ///< normals of a mesh that has none
  shading,               ///< where and how often colours are evaluated
  light,                 ///< one light on one material
  light_attenuation,     ///< attenuation of a light over distance
  light_spot,            ///< cone of a light
  light_highlight,       ///< specular highlight of a light
  light_ambient,         ///< ambient part of a light, where it differs between points
  light_tracked_colors,  ///< vertex colours in place of the material's diffuse or specular colour
  renormalization,       ///< Quality::renormalize
  interpolation,         ///< Quality::interpolation
  texture_filter,        ///< Quality::texture
  vertex_stage,          ///< DrawState::vertex_stage
  fragment_stage         ///< DrawState::fragment_stage
};

/// Why an effect runs or is skipped, or which variant of it runs. New enumerators are appended.
enum class EffectReason : std::uint8_t {
  requested,                  ///< active: the state requests it
  disabled,                   ///< the state turns it off
  no_depth_buffer,            ///< the frame buffer has no depth buffer
  passes_and_writes_nothing,  ///< a test that always passes and writes nothing
  always_passes,              ///< a test that always passes
  replaces_destination,       ///< the blend equation yields the source colour
  stores_indices,             ///< colour indices are stored
  rgb_buffer,                 ///< the frame buffer holds RGB
  no_pixel_can_change,        ///< tests, masks or rectangles leave no pixel to change
  no_color_stored,            ///< no colour plane can change
  color_and_alpha_unused,     ///< the result reaches neither a stored colour nor a test
  no_effect,                  ///< every colour would stay as it is
  not_in_mesh,                ///< the mesh lacks the vertex attribute
  no_faces,                   ///< points and lines have no faces to derive normals from
  draw_is_lit,                ///< lit draws ignore the effect
  draw_has_color_indices,     ///< colour indices replace it
  color_material_none,        ///< DrawState::color_material is none
  material_has_index_ramp,    ///< index lighting replaces it
  independent_of_surface,     ///< no light depends on the surface: the colour is a constant
  folded,                     ///< applied in advance to the colours of vertices, faces or the draw
  one_color_per_pixel,        ///< one colour, applied at each pixel
  per_pixel,                  ///< evaluated once per visible pixel
  per_fragment,               ///< evaluated for every fragment, in order
  per_vertex,                 ///< evaluated at the vertices
  per_face,                   ///< evaluated once per triangle, with the face's normal
  per_provoking_vertex,       ///< evaluated once per triangle, at the provoking vertex of its polygon
  per_point,                  ///< one colour per point
  per_draw,                   ///< one colour for the draw
  per_texel,                  ///< one colour per texel of the image
  interpolated,               ///< colours of vertices, interpolated as triangles are drawn
  interpolated_per_pixel,     ///< colours of vertices, interpolated once per visible pixel
  face_normals,               ///< one normal per face
  mean_normals,               ///< area-weighted means over the faces at each position
  black,                      ///< all products of light and material are black
  constant_ambient,           ///< only a constant ambient part remains, added in advance
  directional,                ///< the light's direction is the same everywhere
  positional,                 ///< the light's direction differs between points
  unit_attenuation,           ///< attenuation factors are 1, 0, 0
  cutoff_180,                 ///< the spot cutoff is 180 degrees
  black_specular,             ///< the specular product of light and material is black
  blinn_infinite_viewer,      ///< (N.H)^shininess, viewer at infinity
  blinn_local_viewer,         ///< (N.H)^shininess, viewer at the eye
  phong_infinite_viewer,      ///< (R.E)^shininess, viewer at infinity
  phong_local_viewer,         ///< (R.E)^shininess, viewer at the eye
  light_behind,               ///< the light is behind every normal of the draw
  light_outside_cone,         ///< every point of the draw is outside the light's cone
  alpha_is_one,               ///< alpha is 1 everywhere: the blend equation yields the source colour
  alpha_is_zero,              ///< alpha is 0 everywhere: the blend equation yields the stored colour
  every_fragment_passes,      ///< the alpha of all fragments passes the test
  every_fragment_fails,       ///< the alpha of all fragments fails the test
  equal_normals,              ///< all normals are equal, lights directional, the viewer infinite
  equal_colors,               ///< all vertex colours are equal
  outside_view,               ///< all vertices are outside one side of the view volume or the scissor
  never_read,                 ///< the buffers that it changes are replaced before anything reads them
  affine,                     ///< linear in the window
  capped,                     ///< replaced by a less accurate variant
  per_2x2_pixels,             ///< evaluated once per triangle and 2x2 pixels
  per_4x4_pixels,             ///< evaluated once per triangle and 4x4 pixels
  below_threshold,            ///< the light's contribution is below Quality::light_threshold
  per_finished_frame,         ///< applied once, to the finished frame
  each_vertex,                ///< runs on every vertex
  before_tests,               ///< runs on every fragment, before the tests that it decides
  replaced_by_stage           ///< the fragment stage does not read colours
};

/// One effect of a draw. Frame::effects returns them, Frame::explain their text.
struct EffectNote {
  Effect effect = Effect::draw;
  bool active = true;  ///< false: no code runs for it
  EffectReason reason = EffectReason::requested;
  bool back_faces = false;  ///< two-sided lighting: about the back faces' material
  int light = -1;           ///< number of the light, from 0; -1: not about a light
  int width = 0;            ///< bitmap, image and texture: texels per row
  int height = 0;           ///< bitmap, image and texture: rows
  int channels = 0;         ///< image and texture: 1 to 4
  int samples = 0;          ///< multisampling: per pixel
  /// The field that decides, where effect and reason do not determine it. That of a light begins with a dot;
  /// EffectExplanation::cause is complete.
  std::string_view cause{};
  std::string_view name{};  ///< stages: VertexStage::name or FragmentStage::name

  bool operator==(const EffectNote&) const = default;
};

}  // namespace tessera
