#include "mesa_renderer.h"

#include <stdexcept>

#include "buffers.h"
#include "context.h"
#include "cut_quads.h"
#include "fixed_function.h"
#include "fragment_functions.h"
#include "limits.h"
#include "pixel_rectangles.h"
#include "primitives.h"
#include "program_lighting.h"
#include "program_texturing.h"
#include "shadow.h"
#include "stored_colors.h"
#include "tests/reference/window.h"
#include "textures.h"
#include "vertex_list.h"

namespace tessera::mesa {
namespace {

using reference::Clear;
using reference::Draw;
using reference::FrameBufferFormat;
using reference::Mat4;
using reference::Rect;

GLenum accum_operation(reference::AccumOp op) {
  switch (op) {
    case reference::AccumOp::kAccum: return GL_ACCUM;
    case reference::AccumOp::kLoad: return GL_LOAD;
    case reference::AccumOp::kAdd: return GL_ADD;
    case reference::AccumOp::kMult: return GL_MULT;
    case reference::AccumOp::kReturn: return GL_RETURN;
  }
  return GL_RETURN;
}

class Renderer {
 public:
  Renderer(const reference::Scene& scene, LevelOfDetail level_of_detail)
      : scene_(scene),
        format_(scene.framebuffer),
        level_of_detail_(level_of_detail),
        context_(format_.width_px, format_.height_px, buffers_for(scene)),
        gl_(context_.functions()),
        programs_(gl_),
        textures_(gl_, scene),
        camera_(scene.camera),
        lights_(scene.lights) {}

  std::vector<std::uint8_t> run() {
    for (const reference::Command& command : scene_.frame)
      std::visit([this](const auto& c) { execute(c); }, command);
    return shown_colors(context_.read_colors(), format_);
  }

 private:
  void execute(const reference::CameraChange& change) { camera_ = change.camera; }
  void execute(const reference::LightsChange& change) { lights_ = change.lights; }
  void execute(const Clear& clear) {
    GLbitfield buffers = 0;
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glStencilMask(~GLuint{0});
    set_scissor(clear.scissor);
    if (clear.color || clear.index) {
      reference::Vec4 c = clear.color.value_or(reference::Vec4{});
      if (clear.index) {
        const reference::Rgb8 entry = cleared_entry(*clear.index, format_).value();
        c = {entry[0] / 255.0, entry[1] / 255.0, entry[2] / 255.0, 1};
      }
      glClearColor(static_cast<GLfloat>(c.x), static_cast<GLfloat>(c.y), static_cast<GLfloat>(c.z),
                   format_.alpha_bits > 0 ? static_cast<GLfloat>(c.w) : 1);
      buffers |= GL_COLOR_BUFFER_BIT;
    }
    if (clear.depth) {
      glClearDepth(*clear.depth);
      buffers |= GL_DEPTH_BUFFER_BIT;
    }
    if (clear.stencil) {
      glClearStencil(static_cast<GLint>(*clear.stencil));
      buffers |= GL_STENCIL_BUFFER_BIT;
    }
    if (clear.accumulation && buffers_for(scene_).color == ColorStore::kWindow) {
      const reference::Vec4 a = *clear.accumulation;
      glClearAccum(static_cast<GLfloat>(a.x), static_cast<GLfloat>(a.y), static_cast<GLfloat>(a.z),
                   static_cast<GLfloat>(a.w));
      buffers |= GL_ACCUM_BUFFER_BIT;
    }
    glClear(buffers);
    check_errors("clearing");
  }

  void execute(const reference::Accum& accum) {
    set_scissor(accum.scissor);
    set_color_mask(component_mask(accum.color_mask, ~std::uint32_t{0}, format_).value());
    glAccum(accum_operation(accum.op), static_cast<GLfloat>(accum.value));
    check_errors("accumulating");
  }

  // OpenGL's bitmaps and images are front-facing; Mesa draws them as polygons that may be back-facing.
  void set_raster_state(reference::FragmentState state) {
    if (state.stencil) state.stencil->back = state.stencil->front;
    set_fragment_functions(gl_, state, format_);
    programs_.use(LightingBy::kFixedFunctions, false);
    textures_.use_none();
  }

  void execute(const reference::Bitmap& bitmap) {
    set_raster_state(bitmap);
    draw_bitmap(gl_, bitmap);
    check_errors("drawing a bitmap");
  }

  void execute(const reference::ImageDrawing& drawing) {
    set_raster_state(drawing);
    draw_image(gl_, drawing);
    check_errors("drawing an image");
  }

  void execute(const Draw& command) {
    const Draw draw = as_drawn(command, lights_);
    const reference::Mesh& mesh = scene_.meshes.at(draw.mesh);
    std::vector<Vertex> vertices = vertex_list(mesh, draw);
    const reference::PrimitiveType primitive = split_cut_quads(mesh, draw, camera_, vertices);
    if (vertices.empty()) return;
    set_fragment_functions(gl_, draw, format_);
    set_window_depths(draw, format_.depth);
    set_window(draw, mesh.primitive);
    set_primitive_state(gl_, draw);
    set_colors(draw, mesh, vertices);
    draw_vertices(primitive, vertices);
    check_errors("drawing " + mesh.name);
  }

  void set_window(const Draw& draw, reference::PrimitiveType type) {
    const Rect viewport = viewport_of(draw, format_);
    const Growth growth = viewport_growth(type, draw, viewport);
    set_viewport(gl_, viewport, growth);
    // Mesa's points and lines extend beyond the viewport.
    set_scissor(draw.scissor ? reference::intersection(*draw.scissor, viewport) : viewport);
    gl_.clip_control(GL_LOWER_LEFT, camera_.reversed ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
    glMatrixMode(GL_PROJECTION);
    load_matrix(reference::multiply(shrinking(growth), camera_.clip_from_view));
    glMatrixMode(GL_MODELVIEW);
  }

  LightingBy lighting_by(const Draw& draw, const std::vector<Vertex>& vertices) const {
    if (fixed_functions_can(draw, scene_.light_model, lights_, camera_, vertices))
      return LightingBy::kFixedFunctions;
    return draw.shading == reference::Shading::kPhong ? LightingBy::kFragmentProgram
                                                      : LightingBy::kVertexProgram;
  }

  // Leaves the model view matrix set to eye from object.
  void set_colors(const Draw& draw, const reference::Mesh& mesh, const std::vector<Vertex>& vertices) {
    const reference::Texture* const texture = draw.texture ? &scene_.textures.at(*draw.texture) : nullptr;
    const LightingBy lighting = lighting_by(draw, vertices);
    glShadeModel(draw.shading == reference::Shading::kFlat ? GL_FLAT : GL_SMOOTH);
    set_enabled(GL_NORMALIZE, draw.normalize);
    textures_.use(draw);
    programs_.use(lighting,
                  texture != nullptr && asks_for_level(*texture) && level_of_detail_ == LevelOfDetail::exact);
    set_program_texture(programs_, draw, mesh, texture);
    if (lighting == LightingBy::kFixedFunctions) {
      load_matrix(camera_.view_from_world);
      set_fixed_function_lighting(draw, scene_.light_model, lights_, has_vertex_colors(draw, mesh));
    } else {
      set_program_lighting(programs_, draw, scene_.light_model, lights_, camera_,
                           has_vertex_colors(draw, mesh));
    }
    load_matrix(reference::multiply(camera_.view_from_world, draw.world_from_object));
  }

  static void load_matrix(const Mat4& m) { glLoadTransposeMatrixd(m.rows[0].data()); }  // rows are contiguous

  const reference::Scene& scene_;
  const FrameBufferFormat& format_;
  LevelOfDetail level_of_detail_;
  Context context_;
  const Functions& gl_;
  Programs programs_;
  Textures textures_;
  reference::Camera camera_;
  std::vector<reference::Light> lights_;
};

}  // namespace

std::optional<std::string> unsupported(const reference::Scene& scene) { return first_limit(scene); }

std::vector<std::uint8_t> render(const reference::Scene& scene, LevelOfDetail level_of_detail) {
  if (const auto reason = unsupported(scene)) throw std::runtime_error("Mesa cannot follow: " + *reason);
  return Renderer(scene, level_of_detail).run();
}

}  // namespace tessera::mesa
