#include "tests/engine/program/reason_cases.h"

#include <algorithm>

namespace tessera::test {
namespace {

using nlohmann::json;

/// Names of fields in scene files, where they differ from those of the API.
std::string in_scene_file(const std::string& field) {
  if (field == "framebuffer.color_mode") return "framebuffer.color.mode";
  if (field == "material.index_ramp") return "material.color_indexes";
  if (field == "vertex_stage" || field == "fragment_stage") return "stages";
  return field;
}

}  // namespace

json scene_parts() {
  return json::parse(R"({
    "framebuffer": {"width": 16, "height": 16},
    "lights": [{"position": [0, 0, 1, 0]}],
    "light_model": {},
    "quality": {},
    "material": {},
    "textures": {"white": {"channels": 3, "rows": ["ffffff"]},
                 "grey": {"channels": 3, "rows": ["808080"]},
                 "checker": {"channels": 3, "rows": ["ffffff000000", "000000ffffff"]}},
    "mesh": {"positions": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]],
             "normals": [[0, 0, 1], [0, 0.6, 0.8], [0, 0, 1], [0.6, 0, 0.8]],
             "texcoords": [[0, 0], [1, 0], [1, 1], [0, 1]],
             "indices": [0, 1, 2, 0, 2, 3]},
    "clear": {"color": [0, 0, 0, 1]},
    "command": {"draw": "square", "material": "m"}})");
}

std::string scene_file(const json& parts) {
  json scene{{"tessera", 1}};
  for (const char* name : {"framebuffer", "lights", "light_model", "quality", "textures"})
    scene[name] = parts[name];
  scene["materials"]["m"] = parts["material"];
  scene["meshes"]["square"] = parts["mesh"];
  scene["frame"] = json::array();
  if (parts.contains("clear")) scene["frame"].push_back({{"clear", parts["clear"]}});
  scene["frame"].push_back(parts["command"]);
  if (parts.contains("last_clear")) scene["frame"].push_back({{"clear", parts["last_clear"]}});
  return scene.dump();
}

json::json_pointer place_of_cause(const std::string& cause) {
  // These are commands themselves.
  if (cause == "clear") return json::json_pointer("/last_clear");
  if (cause == "bitmap" || cause == "image") return json::json_pointer("/command");
  std::string place = in_scene_file(cause);
  for (const char* part : {"framebuffer", "light_model", "lights", "quality", "material", "mesh"})
    if (place == part || place.starts_with(std::string(part) + '.') ||
        place.starts_with(std::string(part) + '[')) {
      std::erase(place, ']');
      std::replace(place.begin(), place.end(), '[', '/');
      std::replace(place.begin(), place.end(), '.', '/');
      return json::json_pointer("/" + place);
    }
  std::replace(place.begin(), place.end(), '.', '/');
  return json::json_pointer("/command/" + place);
}

void set_value(json& parts, const json::json_pointer& place, const json& value) {
  if (value.is_null()) parts[place.parent_pointer()].erase(place.back());
  else parts[place] = value;
}

std::vector<ReasonCase> reason_cases() {
  using enum EffectReason;
  return {
      {requested, "blending", R"({"command": {"blend": {}}, "material": {"diffuse": [1, 1, 1, 0.5]}})",
       "blend", "null"},
      {disabled, "lighting", R"({"command": {"lighting": false}})", "lighting", "true"},
      {no_depth_buffer, "depth_test", R"({"framebuffer": {"depth": "none"}})", "framebuffer.depth",
       R"("unorm24")"},
      {passes_and_writes_nothing, "stencil_test", R"({"command": {"stencil": {}}})", "stencil",
       R"({"zpass": "incr"})"},
      {passes_and_writes_nothing, "depth_test",
       R"({"command": {"depth": {"test": "always", "write": false}}})", "depth.test", R"("less")"},
      {always_passes, "alpha_test", R"({"command": {"alpha_test": {"func": "always"}}})", "alpha_test",
       R"({"func": "less"})"},
      {replaces_destination, "blending", R"({"command": {"blend": {"src": "one", "dst": "zero"}}})", "blend",
       R"({"src": "one", "dst": "one"})"},
      {stores_indices, "dither",
       R"({"framebuffer": {"color": {"mode": "index", "bits": 8}, "dither": "bayer2"},
           "mesh": {"color_indices": [1, 2, 3, 4]}, "command": {"lighting": false}})",
       "framebuffer.color_mode", R"("rgb")"},
      {per_finished_frame, "dither",
       R"({"framebuffer": {"color": {"bits": 8}, "dither": "floyd_steinberg"}})", "framebuffer.dither",
       R"("bayer2")"},
      {rgb_buffer, "color_indices",
       R"({"framebuffer": {"color": {"mode": "rgb", "bits": 8}}, "mesh": {"color_indices": [1, 2, 3, 4]}})",
       "framebuffer.color_mode", R"("index")"},
      {no_pixel_can_change, "draw", R"({"command": {"scissor": [0, 0, 0, 5]}})", "scissor", "[0, 0, 5, 5]"},
      {no_pixel_can_change, "draw", R"({"command": {"depth": {"test": "never"}}})", "depth.test",
       R"("less")"},
      {no_pixel_can_change, "draw",
       R"({"command": {"color_mask": [false, false, false, false], "depth": false}})", "color_mask",
       "[true, true, true, true]"},
      {no_pixel_can_change, "draw", R"({"command": {"plane_mask": 0, "depth": false}})", "plane_mask", "255"},
      {no_pixel_can_change, "draw", R"({"command": {"alpha_test": {"func": "never"}}})", "alpha_test",
       R"({"func": "greater"})"},
      {no_color_stored, "shading", R"({"command": {"color_mask": [false, false, false, false]}})",
       "color_mask", "[true, true, true, true]"},
      {color_and_alpha_unused, "texture",
       R"({"command": {"texture": "checker", "color_mask": [false, false, false, false]}})", "texture",
       "null"},
      {no_effect, "texture", R"({"command": {"texture": "white"}})", "texture", R"("checker")"},
      {not_in_mesh, "vertex_colors", R"({"command": {"lighting": false}})", "mesh.colors",
       "[[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1], [1, 1, 1, 1]]"},
      {not_in_mesh, "texture_coordinates",
       R"({"command": {"texture": "checker"}, "mesh": {"texcoords": null}})", "mesh.texcoords",
       "[[0, 0], [1, 0], [1, 1], [0, 1]]"},
      {no_faces, "generated_normals", R"({"mesh": {"primitive": "points", "normals": null}})",
       "mesh.primitive", R"("triangles")"},
      {draw_is_lit, "color_indices",
       R"({"framebuffer": {"color": {"mode": "index", "bits": 8}}, "mesh": {"color_indices": [1, 2, 3, 4]}})",
       "lighting", "false"},
      {draw_has_color_indices, "vertex_colors",
       R"({"framebuffer": {"color": {"mode": "index", "bits": 8}}, "command": {"lighting": false},
           "mesh": {"color_indices": [1, 2, 3, 4],
                    "colors": [[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1], [1, 1, 1, 1]]}})",
       "mesh.color_indices", "null"},
      {color_material_none, "vertex_colors",
       R"({"mesh": {"colors": [[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1], [1, 1, 1, 1]]}})", "color_material",
       R"("diffuse")"},
      {material_has_index_ramp, "vertex_colors",
       R"({"framebuffer": {"color": {"mode": "index", "bits": 8}}, "command": {"color_material": "diffuse"},
           "material": {"color_indexes": [0, 5, 9]},
           "mesh": {"colors": [[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1], [1, 1, 1, 1]]}})",
       "material.index_ramp", "null"},
      {independent_of_surface, "lighting", R"({"lights": []})", "lights", R"([{"position": [0, 0, 1, 0]}])"},
      {folded, "texture", R"({"command": {"texture": "grey"}})", "texture", R"("checker")"},
      {one_color_per_pixel, "texture", R"({"command": {"texture": "grey", "shading": "phong"}})", "texture",
       R"("checker")"},
      {per_pixel, "shading", R"({"command": {"shading": "phong"}})", "shading", R"("gouraud")"},
      {per_fragment, "shading",
       R"({"command": {"shading": "phong", "blend": {}}, "material": {"diffuse": [1, 1, 1, 0.5]}})",
       "shading", R"("gouraud")"},
      {per_vertex, "shading", R"({"command": {"shading": "flat"}})", "shading", R"("gouraud")"},
      {per_face, "shading", R"({"command": {"shading": "flat"}, "mesh": {"normals": null}})", "shading",
       R"("gouraud")"},
      {per_provoking_vertex, "shading",
       R"({"command": {"shading": "flat"}, "mesh": {"primitive": "quads", "indices": [0, 1, 2, 3]}})",
       "shading", R"("gouraud")"},
      {per_point, "shading", R"({"mesh": {"primitive": "points"}})", "mesh.primitive", R"("triangles")"},
      {per_draw, "shading", R"({"command": {"lighting": false}})", "mesh.colors",
       "[[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1], [1, 1, 1, 1]]"},
      {per_draw, "shading", R"({"lights": []})", "lights", R"([{"position": [0, 0, 1, 0]}])"},
      {per_texel, "image",
       R"({"command": {"draw": null, "material": null, "image": {"at": [1, 1], "file": "image.ppm"}}})",
       "image", R"({"draw": "square", "material": "m"})"},
      {interpolated, "shading", "{}", "shading", R"("flat")"},
      {interpolated_per_pixel, "shading", R"({"framebuffer": {"color": {"bits": 2}}})", "shading",
       R"("flat")"},
      {face_normals, "generated_normals", R"({"command": {"shading": "flat"}, "mesh": {"normals": null}})",
       "mesh.normals", "[[0, 0, 1], [0, 0.6, 0.8], [0, 0, 1], [0.6, 0, 0.8]]"},
      {mean_normals, "generated_normals", R"({"mesh": {"normals": null}})", "mesh.normals",
       "[[0, 0, 1], [0, 0.6, 0.8], [0, 0, 1], [0.6, 0, 0.8]]"},
      {black, "light", R"({"lights": [{"diffuse": [0, 0, 0, 1], "specular": [0, 0, 0, 1]}]})",
       "lights[0].diffuse", "[1, 1, 1, 1]"},
      {black, "light", R"({"material": {"diffuse": [0, 0, 0, 1]}})", "material.diffuse", "[1, 1, 1, 1]"},
      {black, "light", R"({"lights": [{"spot_direction": [0, 1, -1], "spot_cutoff": 40}]})",
       "lights[0].spot_cutoff", "50"},
      {constant_ambient, "light",
       R"({"lights": [{"ambient": [0.1, 0, 0, 1], "diffuse": [0, 0, 0, 1], "specular": [0, 0, 0, 1]}]})",
       "lights[0].ambient", "[0, 0, 0, 1]"},
      {directional, "light", "{}", "lights[0].position", "[0, 0, 3, 1]"},
      {positional, "light", R"({"lights": [{"position": [0, 0, 3, 1]}]})", "lights[0].position",
       "[0, 0, 1, 0]"},
      {unit_attenuation, "light_attenuation", R"({"lights": [{"position": [0, 0, 3, 1]}]})",
       "lights[0].attenuation", "[1, 1, 0]"},
      {cutoff_180, "light_spot", R"({"lights": [{"position": [0, 0, 3, 1]}]})", "lights[0].spot_cutoff",
       "60"},
      {black_specular, "light_highlight", "{}", "material.specular", "[1, 1, 1, 1]"},
      {blinn_infinite_viewer, "light_highlight", R"({"material": {"specular": [1, 1, 1, 1]}})",
       "light_model.local_viewer", "true"},
      {blinn_local_viewer, "light_highlight",
       R"({"material": {"specular": [1, 1, 1, 1]}, "light_model": {"local_viewer": true}})",
       "light_model.local_viewer", "false"},
      {phong_infinite_viewer, "light_highlight",
       R"({"material": {"specular": [1, 1, 1, 1]}, "light_model": {"specular": "phong"}})",
       "light_model.specular", R"("blinn")"},
      {phong_local_viewer, "light_highlight",
       R"({"material": {"specular": [1, 1, 1, 1]},
           "light_model": {"specular": "phong", "local_viewer": true}})",
       "light_model.specular", R"("blinn")"},
      {light_behind, "light", R"({"lights": [{}, {"position": [0, 0, -1, 0]}]})", "lights[1].position",
       "[0, 0, 1, 0]"},
      {light_outside_cone, "light",
       R"({"lights": [{}, {"position": [0, 0, 4, 1], "spot_direction": [1, 0, -1], "spot_cutoff": 10}]})",
       "lights[1].spot_cutoff", "60"},
      {alpha_is_one, "blending", R"({"command": {"blend": {}}})", "material.diffuse", "[1, 1, 1, 0.5]"},
      {alpha_is_one, "blending",
       R"({"command": {"blend": {}, "lighting": false},
           "mesh": {"colors": [[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1], [1, 1, 1, 1]]}})",
       "mesh.colors", "[[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 0.5], [1, 1, 1, 1]]"},
      {alpha_is_zero, "blending", R"({"command": {"blend": {}}, "material": {"diffuse": [1, 1, 1, 0]}})",
       "material.diffuse", "[1, 1, 1, 0.5]"},
      {every_fragment_passes, "alpha_test", R"({"command": {"alpha_test": {}}})", "material.diffuse",
       "[1, 1, 1, 0.2]"},
      {every_fragment_fails, "alpha_test",
       R"({"command": {"alpha_test": {}}, "material": {"diffuse": [1, 1, 1, 0.2]}})", "material.diffuse",
       "[1, 1, 1, 1]"},
      {equal_normals, "lighting", R"({"mesh": {"normals": [[0, 0, 1], [0, 0, 1], [0, 0, 1], [0, 0, 1]]}})",
       "mesh.normals", "[[0, 0, 1], [0, 0, 1], [0, 0, 1], [0, 0.6, 0.8]]"},
      {equal_colors, "vertex_colors",
       R"({"command": {"lighting": false},
           "mesh": {"colors": [[1, 0, 0, 1], [1, 0, 0, 1], [1, 0, 0, 1], [1, 0, 0, 1]]}})",
       "mesh.colors", "[[1, 0, 0, 1], [1, 0, 0, 1], [1, 0, 0, 1], [1, 0, 0.5, 1]]"},
      {outside_view, "draw", R"({"mesh": {"positions": [[2, -1, 0], [3, -1, 0], [3, 1, 0], [2, 1, 0]]}})",
       "mesh.positions", "[[0.5, -1, 0], [3, -1, 0], [3, 1, 0], [2, 1, 0]]"},
      {never_read, "draw", R"({"command": {"depth": false}, "last_clear": {"color": [0, 0, 1, 1]}})", "clear",
       "null"},
      {affine, "interpolation", R"({"quality": {"interpolation": "affine"}})", "quality.interpolation",
       R"("perspective")"},
      {capped, "texture_filter", R"({"command": {"texture": "checker"}, "quality": {"texture": "bilinear"}})",
       "quality.texture", R"("as_asked")"},
      {per_2x2_pixels, "shading", R"({"command": {"shading": "phong"}, "quality": {"shading": "phong_2x2"}})",
       "quality.shading", R"("as_asked")"},
      {per_4x4_pixels, "shading", R"({"command": {"shading": "phong"}, "quality": {"shading": "phong_4x4"}})",
       "quality.shading", R"("phong_2x2")"},
      {below_threshold, "light",
       R"({"lights": [{}, {"position": [0, 1, 5, 1], "diffuse": [0.1, 0.1, 0.1, 1]}],
           "quality": {"light_threshold": 0.2}})",
       "quality.light_threshold", "0.01"},
      {disabled, "renormalization", R"({"command": {"shading": "phong"}, "quality": {"renormalize": false}})",
       "quality.renormalize", "true"},
      {interpolated, "shading", R"({"command": {"shading": "phong"}, "quality": {"shading": "gouraud"}})",
       "quality.shading", R"("as_asked")"},
      {per_vertex, "shading", R"({"quality": {"shading": "flat"}})", "quality.shading", R"("as_asked")"},
      {blinn_infinite_viewer, "light_highlight",
       R"({"material": {"specular": [1, 1, 1, 1]}, "light_model": {"local_viewer": true},
           "quality": {"viewer": "infinite"}})",
       "quality.viewer", R"("as_asked")"},
      {each_vertex, "vertex_stage", R"({"command": {"stages": [{"name": "zoom", "factor": 2}]}})",
       "vertex_stage", "[]"},
      {before_tests, "fragment_stage", R"({"command": {"stages": [{"name": "uncover", "amount": 0.5}]}})",
       "fragment_stage", R"([{"name": "gradient_screen_y"}])"},
  };
}

std::vector<BufferReasonCase> buffer_reason_cases() {
  return {
      {BufferReason::not_in_format, "stencil", R"({"framebuffer": {"stencil": 0}})", "/framebuffer/stencil",
       "8"},
      {BufferReason::not_used, "stencil", "{}", "/command/stencil", R"({"zpass": "incr"})"},
      {BufferReason::unchanged, "color",
       R"({"clear": null, "command": {"color_mask": [false, false, false, false]}})", "/command/color_mask",
       "[true, true, true, true]"},
      {BufferReason::not_kept, "depth", "{}", "/command/depth", "false"},
  };
}

}  // namespace tessera::test
