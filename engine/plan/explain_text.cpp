#include "engine/plan/explain_text.h"

#include <array>
#include <iterator>

#include "engine/buffers/frame_buffer_state.h"

namespace tessera {
namespace {

struct EffectWords {
  Effect effect;
  std::string_view code;   ///< stable, for programs
  std::string_view title;  ///< for people; lights are preceded by their number
};
constexpr EffectWords kEffects[] = {
    {Effect::draw, "draw", "draw"},
    {Effect::planar_shadow, "planar_shadow", "planar shadow"},
    {Effect::depth_test, "depth_test", "depth test"},
    {Effect::depth_write, "depth_write", "depth write"},
    {Effect::plane_masks, "plane_masks", "plane masks"},
    {Effect::alpha_test, "alpha_test", "alpha test"},
    {Effect::stencil_test, "stencil_test", "stencil test"},
    {Effect::blending, "blending", "blending"},
    {Effect::dither, "dither", "dither"},
    {Effect::logic_op, "logic_op", "logic operation"},
    {Effect::alpha_planes, "alpha_planes", "alpha planes"},
    {Effect::polygon_offset, "polygon_offset", "polygon offset"},
    {Effect::polygon_mode, "polygon_mode", "polygon mode"},
    {Effect::multisampling, "multisampling", "multisampling"},
    {Effect::bitmap, "bitmap", "bitmap"},
    {Effect::image, "image", "image"},
    {Effect::texture, "texture", "texture"},
    {Effect::texture_coordinates, "texture_coordinates", "texture coordinates"},
    {Effect::texture_lod, "texture_lod", "texture level of detail"},
    {Effect::lighting, "lighting", "lighting"},
    {Effect::two_sided_lighting, "two_sided_lighting", "two-sided lighting"},
    {Effect::index_lighting, "index_lighting", "index lighting"},
    {Effect::vertex_colors, "vertex_colors", "vertex colours"},
    {Effect::color_indices, "color_indices", "colour indices"},
    {Effect::generated_normals, "generated_normals", "generated normals"},
    {Effect::shading, "shading", "shading"},
    {Effect::light, "light", ""},
    {Effect::light_attenuation, "light_attenuation", " attenuation"},
    {Effect::light_spot, "light_spot", " spot"},
    {Effect::light_highlight, "light_highlight", " highlight"},
    {Effect::light_ambient, "light_ambient", " ambient part"},
    {Effect::light_tracked_colors, "light_tracked_colors", " vertex colours"},
    {Effect::renormalization, "renormalization", "renormalization of normals"},
    {Effect::interpolation, "interpolation", "interpolation"},
    {Effect::texture_filter, "texture_filter", "texture filter"},
    {Effect::vertex_stage, "vertex_stage", "vertex stage"},
    {Effect::fragment_stage, "fragment_stage", "fragment stage"},
};

struct ReasonWords {
  EffectReason reason;
  std::string_view code;    ///< stable, for programs
  std::string_view phrase;  ///< for people
};
constexpr ReasonWords kReasons[] = {
    {EffectReason::requested, "requested", "on"},
    {EffectReason::disabled, "disabled", "off"},
    {EffectReason::no_depth_buffer, "no_depth_buffer", "off, the frame buffer has no depth buffer"},
    {EffectReason::passes_and_writes_nothing, "passes_and_writes_nothing",
     "skipped, it always passes and writes nothing"},
    {EffectReason::always_passes, "always_passes", "skipped, it always passes"},
    {EffectReason::replaces_destination, "replaces_destination",
     "skipped, it replaces the stored colour with the new one"},
    {EffectReason::stores_indices, "stores_indices", "skipped, colour indices are stored"},
    {EffectReason::rgb_buffer, "rgb_buffer", "ignored, the frame buffer holds RGB"},
    {EffectReason::no_pixel_can_change, "no_pixel_can_change", "skipped, it can change no pixel"},
    {EffectReason::no_color_stored, "no_color_stored", "skipped, no colour plane can change"},
    {EffectReason::color_and_alpha_unused, "color_and_alpha_unused",
     "skipped, its colour and alpha are not used"},
    {EffectReason::no_effect, "no_effect", "skipped, its one colour changes nothing"},
    {EffectReason::not_in_mesh, "not_in_mesh", "the mesh has none"},
    {EffectReason::no_faces, "no_faces", "none, points and lines have no faces; normals are 0 0 0"},
    {EffectReason::draw_is_lit, "draw_is_lit", "ignored, the draw is lit"},
    {EffectReason::draw_has_color_indices, "draw_has_color_indices", "ignored, the mesh has colour indices"},
    {EffectReason::color_material_none, "color_material_none",
     "ignored, the draw is lit and color_material is none"},
    {EffectReason::material_has_index_ramp, "material_has_index_ramp",
     "ignored, the material has an index_ramp"},
    {EffectReason::independent_of_surface, "independent_of_surface",
     "constant, no light depends on the surface"},
    {EffectReason::folded, "folded", "one colour, folded into the colours of vertices, faces or the draw"},
    {EffectReason::one_color_per_pixel, "one_color_per_pixel", "one colour, applied at each pixel"},
    {EffectReason::per_pixel, "per_pixel", "once per visible pixel"},
    {EffectReason::per_fragment, "per_fragment",
     "for every fragment, because the result depends on the order"},
    {EffectReason::per_vertex, "per_vertex", "flat, at the vertices"},
    {EffectReason::per_face, "per_face", "flat, once per triangle with its face normal"},
    {EffectReason::per_provoking_vertex, "per_provoking_vertex",
     "flat, once per triangle at the provoking vertex of its polygon"},
    {EffectReason::per_point, "per_point", "one colour per point"},
    {EffectReason::per_draw, "per_draw", "one colour for the draw"},
    {EffectReason::per_texel, "per_texel", "one colour per texel"},
    {EffectReason::interpolated, "interpolated", "colours interpolated as triangles are drawn"},
    {EffectReason::interpolated_per_pixel, "interpolated_per_pixel",
     "colours interpolated once per visible pixel"},
    {EffectReason::face_normals, "face_normals", "face normals"},
    {EffectReason::mean_normals, "mean_normals", "area-weighted means of the face normals at each position"},
    {EffectReason::black, "black", "skipped, it adds black"},
    {EffectReason::constant_ambient, "constant_ambient", "only a constant ambient part, added in advance"},
    {EffectReason::directional, "directional", "directional"},
    {EffectReason::positional, "positional", "positional"},
    {EffectReason::unit_attenuation, "unit_attenuation", "skipped, the factors are 1 0 0"},
    {EffectReason::cutoff_180, "cutoff_180", "off, the cutoff is 180 degrees"},
    {EffectReason::black_specular, "black_specular", "skipped, the specular product is black"},
    {EffectReason::blinn_infinite_viewer, "blinn_infinite_viewer", "Blinn, infinite viewer"},
    {EffectReason::blinn_local_viewer, "blinn_local_viewer", "Blinn, local viewer"},
    {EffectReason::phong_infinite_viewer, "phong_infinite_viewer", "Phong, infinite viewer"},
    {EffectReason::phong_local_viewer, "phong_local_viewer", "Phong, local viewer"},
    {EffectReason::light_behind, "light_behind", "skipped, it is behind every normal"},
    {EffectReason::light_outside_cone, "light_outside_cone", "skipped, no point is inside its cone"},
    {EffectReason::alpha_is_one, "alpha_is_one", "skipped, alpha is 1 everywhere"},
    {EffectReason::alpha_is_zero, "alpha_is_zero", "skipped with all colours, alpha is 0 everywhere"},
    {EffectReason::every_fragment_passes, "every_fragment_passes", "skipped, every fragment passes"},
    {EffectReason::every_fragment_fails, "every_fragment_fails", "skipped, every fragment fails"},
    {EffectReason::equal_normals, "equal_normals", "once, all normals are equal"},
    {EffectReason::equal_colors, "equal_colors", "one colour, all vertices have it"},
    {EffectReason::outside_view, "outside_view", "skipped, it is outside the view volume or the scissor"},
    {EffectReason::never_read, "never_read",
     "skipped, the buffers that it changes are replaced before anything reads them"},
    {EffectReason::affine, "affine", "linear in the window, without perspective"},
    {EffectReason::capped, "capped", "less accurate than asked for"},
    {EffectReason::per_2x2_pixels, "per_2x2_pixels", "once per triangle and 2x2 pixels"},
    {EffectReason::per_4x4_pixels, "per_4x4_pixels", "once per triangle and 4x4 pixels"},
    {EffectReason::below_threshold, "below_threshold", "skipped, it is below the threshold"},
    {EffectReason::per_finished_frame, "per_finished_frame", "once, on the finished frame"},
    {EffectReason::each_vertex, "each_vertex", "for every vertex"},
    {EffectReason::before_tests, "before_tests", "for every fragment, before the tests that it decides"},
    {EffectReason::replaced_by_stage, "replaced_by_stage", "skipped, the fragment stage reads no colour"},
};

struct BufferWords {
  BufferReason reason;
  std::string_view code;    ///< stable, for programs
  std::string_view phrase;  ///< for people
};
constexpr BufferWords kBufferReasons[] = {
    {BufferReason::not_in_format, "not_in_format", "the frame buffer has none"},
    {BufferReason::not_used, "not_used", "not allocated, nothing reads it"},
    {BufferReason::unchanged, "unchanged", "read, not changed"},
    {BufferReason::kept, "kept", "stored in its planes"},
    {BufferReason::ends_cleared, "ends_cleared", "ends as one value, no planes are written"},
    {BufferReason::not_kept, "not_kept", "in tiles only, the frame does not keep it"},
};

template <class Words, std::size_t size, class Key>
constexpr bool is_indexed_by(const Words (&words)[size], Key Words::*key) {
  for (std::size_t i = 0; i < size; ++i)
    if (static_cast<std::size_t>(words[i].*key) != i) return false;
  return true;
}
static_assert(is_indexed_by(kEffects, &EffectWords::effect));
static_assert(is_indexed_by(kReasons, &ReasonWords::reason));
static_assert(is_indexed_by(kBufferReasons, &BufferWords::reason));
static_assert(std::size(kEffects) == static_cast<std::size_t>(Effect::fragment_stage) + 1);
static_assert(std::size(kReasons) == static_cast<std::size_t>(EffectReason::replaced_by_stage) + 1);

const EffectWords& words_of(Effect effect) { return kEffects[static_cast<std::size_t>(effect)]; }
const ReasonWords& words_of(EffectReason reason) { return kReasons[static_cast<std::size_t>(reason)]; }

std::string title(const EffectNote& note) {
  std::string text;
  if (note.back_faces) text += "back faces, ";
  if (note.light >= 0) text += "light " + std::to_string(note.light);
  text.append(words_of(note.effect).title);
  if (!note.name.empty()) text.append(" ").append(note.name);
  return text;
}

/// Sizes and numbers that precede the reason.
std::string numbers(const EffectNote& note) {
  std::string text;
  if (note.samples > 0) text += std::to_string(note.samples) + " samples per pixel; ";
  if (note.width > 0) text += std::to_string(note.width) + " x " + std::to_string(note.height) + ", ";
  if (note.channels > 0)
    text += std::to_string(note.channels) + (note.channels == 1 ? " channel, " : " channels, ");
  return text;
}

/// Wording of effects whose reason is `requested`.
std::string_view phrase_if_requested(Effect effect) {
  switch (effect) {
    case Effect::planar_shadow: return "on, unlit in one colour";
    case Effect::plane_masks: return "some colour planes are masked";
    case Effect::polygon_mode: return "edges or corners of polygons, drawn per fragment";
    case Effect::multisampling: return "coverage, depth and stencil per sample, colour per pixel";
    case Effect::texture_lod: return "from derivatives, per pixel";
    case Effect::index_lighting: return "on; emission, ambient light and material colours are ignored";
    case Effect::light_ambient: return "differs between points";
    case Effect::light_tracked_colors: return "replace material colours";
    default: return words_of(EffectReason::requested).phrase;
  }
}

std::string_view phrase(const EffectNote& note) {
  if (note.reason == EffectReason::requested) return phrase_if_requested(note.effect);
  if (note.effect == Effect::texture_coordinates && note.reason == EffectReason::not_in_mesh)
    return "the mesh has no texture coordinates; the texture's colour at 0 0 is used";
  return words_of(note.reason).phrase;
}

}  // namespace

std::string_view code(Effect effect) {
  return static_cast<std::size_t>(effect) < std::size(kEffects) ? words_of(effect).code : std::string_view();
}
std::string_view code(EffectReason reason) {
  return static_cast<std::size_t>(reason) < std::size(kReasons) ? words_of(reason).code : std::string_view();
}

std::string_view code(BufferReason reason) {
  const auto index = static_cast<std::size_t>(reason);
  return index < std::size(kBufferReasons) ? kBufferReasons[index].code : std::string_view();
}

std::string text(const BufferNote& note) {
  const BufferWords& words = kBufferReasons[static_cast<std::size_t>(note.reason)];
  std::string line(detail::name(note.buffer));
  return line.append(note.loaded ? ": loaded; " : ": ").append(words.phrase);
}

std::string detail::text_of(const EffectNote& note) {
  return title(note).append(": ").append(numbers(note)).append(phrase(note));
}

}  // namespace tessera
