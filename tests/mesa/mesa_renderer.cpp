#include "mesa_renderer.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "context.h"
#include "fixed_function.h"
#include "lighting_programs.h"
#include "stored_colors.h"
#include "vertex_list.h"

namespace tessera::mesa {
namespace {

using reference::Clear;
using reference::ColorMode;
using reference::Draw;
using reference::FrameBufferFormat;
using reference::Mat4;
using reference::Rect;

constexpr int kLargestViewport = 8192;  // what the context surely takes

bool has_components(const FrameBufferFormat& format) { return format.color_mode == ColorMode::kRgb && format.color_bits >= 3; }

/// The mask as one of whole components, if it is one.
std::optional<std::array<bool, 4>> component_mask(const Draw& draw, const FrameBufferFormat& format) {
  const auto part = [&](int lowest, int bits) { return draw.plane_mask >> lowest & ((1u << bits) - 1); };
  const auto whole = [](std::uint32_t planes, int bits) { return planes == 0 || std::popcount(planes) == bits; };
  if (!has_components(format)) {
    const std::uint32_t planes = part(0, format.color_bits);
    const bool writes = planes != 0 && draw.color_mask[0];
    if (!whole(planes, format.color_bits)) return std::nullopt;
    return std::array<bool, 4>{writes, writes, writes, true};
  }
  const int blue = format.color_bits / 3, green = (format.color_bits + 2) / 3, red = format.color_bits - green - blue;
  const std::uint32_t r = part(green + blue, red), g = part(blue, green), b = part(0, blue);
  if (!whole(r, red) || !whole(g, green) || !whole(b, blue)) return std::nullopt;
  return std::array<bool, 4>{draw.color_mask[0] && r != 0, draw.color_mask[1] && g != 0, draw.color_mask[2] && b != 0, true};
}

std::optional<std::string> unsupported_draw(const Draw& draw, const FrameBufferFormat& format, std::size_t lights) {
  if (!component_mask(draw, format)) return "a plane mask splits a colour component";
  if (draw.lighting && lights > kMaxProgramLights) return "more lights than the programs take";
  const bool has_offset = draw.polygon_offset.factor != 0 || draw.polygon_offset.units != 0;
  if (draw.alpha_test || draw.stencil || draw.blend || draw.logic_op != reference::LogicOp::kCopy || has_offset)
    return "per-fragment operations";
  if (draw.viewport && (draw.viewport->width > kLargestViewport || draw.viewport->height > kLargestViewport)) return "a viewport beyond Mesa's";
  return std::nullopt;
}

/// What an index buffer cleared to an index shows, if it can be told from the colour alone afterwards.
std::optional<reference::Rgb8> cleared_entry(std::uint32_t index, const FrameBufferFormat& format) {
  const reference::Rgb8 entry = index < format.palette.size() ? format.palette[index] : reference::Rgb8{};
  if (std::ranges::find(format.palette, entry) == format.palette.end()) return std::nullopt;
  return entry;
}

GLenum compare_function(reference::Compare test) {
  switch (test) {
    case reference::Compare::kNever: return GL_NEVER;
    case reference::Compare::kLess: return GL_LESS;
    case reference::Compare::kEqual: return GL_EQUAL;
    case reference::Compare::kLequal: return GL_LEQUAL;
    case reference::Compare::kGreater: return GL_GREATER;
    case reference::Compare::kNotequal: return GL_NOTEQUAL;
    case reference::Compare::kGequal: return GL_GEQUAL;
    case reference::Compare::kAlways: return GL_ALWAYS;
  }
  return GL_ALWAYS;
}

void set_enabled(GLenum capability, bool on) { (on ? glEnable : glDisable)(capability); }

void set_scissor(const std::optional<Rect>& scissor) {
  set_enabled(GL_SCISSOR_TEST, scissor.has_value());
  if (scissor) glScissor(scissor->x, scissor->y, scissor->width, scissor->height);
}

class Renderer {
 public:
  explicit Renderer(const reference::Scene& scene)
      : scene_(scene), format_(scene.framebuffer), context_(format_), gl_(context_.functions()), programs_(gl_), camera_(scene.camera), lights_(scene.lights) {}

  std::vector<std::uint8_t> run() {
    for (const reference::Command& command : scene_.frame) std::visit([this](const auto& c) { execute(c); }, command);
    return shown_colors(context_.read_colors(), format_);
  }

 private:
  void execute(const reference::CameraChange& change) { camera_ = change.camera; }
  void execute(const reference::LightsChange& change) { lights_ = change.lights; }
  void execute(const reference::Accum&) {}  // refused by unsupported()

  void execute(const Clear& clear) {
    GLbitfield buffers = 0;
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    set_scissor(clear.scissor);
    if (clear.color || clear.index) {
      reference::Vec4 c = clear.color.value_or(reference::Vec4{});
      if (clear.index) {
        const reference::Rgb8 entry = cleared_entry(*clear.index, format_).value();
        c = {entry[0] / 255.0, entry[1] / 255.0, entry[2] / 255.0, 1};
      }
      glClearColor(static_cast<GLfloat>(c.x), static_cast<GLfloat>(c.y), static_cast<GLfloat>(c.z), 1);
      buffers |= GL_COLOR_BUFFER_BIT;
    }
    if (clear.depth) {
      glClearDepth(*clear.depth);
      buffers |= GL_DEPTH_BUFFER_BIT;
    }
    glClear(buffers);
    check_errors("clearing");
  }

  void execute(const Draw& draw) {
    const reference::Mesh& mesh = scene_.meshes.at(draw.mesh);
    const std::vector<Vertex> vertices = vertex_list(mesh, draw);
    if (vertices.empty()) return;
    set_fragment_state(draw);
    set_geometry_state(draw);
    set_colors(draw, !mesh.colors.empty(), vertices);
    draw_vertices(vertices);
    check_errors("drawing " + mesh.name);
  }

  void set_fragment_state(const Draw& draw) {
    const std::array<bool, 4> mask = component_mask(draw, format_).value();
    glColorMask(mask[0], mask[1], mask[2], mask[3]);
    set_scissor(draw.scissor);
    set_enabled(GL_DEPTH_TEST, draw.depth.has_value());
    if (draw.depth) {
      glDepthFunc(compare_function(draw.depth->test));
      glDepthMask(draw.depth->write ? GL_TRUE : GL_FALSE);
    }
    glDepthRange(draw.depth_range[0], draw.depth_range[1]);
  }

  void set_geometry_state(const Draw& draw) {
    const Rect viewport = draw.viewport.value_or(Rect{0, 0, format_.width_px, format_.height_px});
    glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
    glFrontFace(draw.front_face == reference::FrontFace::kCcw ? GL_CCW : GL_CW);
    set_enabled(GL_CULL_FACE, draw.cull != reference::Cull::kNone);
    glCullFace(draw.cull == reference::Cull::kFront ? GL_FRONT : GL_BACK);
    gl_.clip_control(GL_LOWER_LEFT, camera_.reversed ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
    glMatrixMode(GL_PROJECTION);
    load_matrix(camera_.clip_from_view);
    glMatrixMode(GL_MODELVIEW);
  }

  // Leaves the matrix that takes objects into eye space.
  void set_colors(const Draw& draw, bool has_vertex_colors, const std::vector<Vertex>& vertices) {
    glShadeModel(draw.shading == reference::Shading::kFlat ? GL_FLAT : GL_SMOOTH);
    gl_.provoking_vertex(draw.provoking_vertex == reference::ProvokingVertex::kFirst ? GL_FIRST_VERTEX_CONVENTION : GL_LAST_VERTEX_CONVENTION);
    set_enabled(GL_NORMALIZE, draw.normalize);
    if (fixed_functions_can(draw, scene_.light_model, lights_, vertices)) {
      gl_.use_program(0);
      load_matrix(camera_.view_from_world);
      set_fixed_function_lighting(draw, scene_.light_model, lights_, has_vertex_colors);
    } else {
      programs_.use(draw, scene_.light_model, lights_, camera_, has_vertex_colors);
    }
    load_matrix(reference::multiply(camera_.view_from_world, draw.world_from_object));
  }

  static void draw_vertices(const std::vector<Vertex>& vertices) {
    constexpr GLsizei kStride = sizeof(Vertex);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_NORMAL_ARRAY);
    glEnableClientState(GL_COLOR_ARRAY);
    glVertexPointer(4, GL_DOUBLE, kStride, vertices.front().position.data());
    glNormalPointer(GL_FLOAT, kStride, vertices.front().normal.data());
    glColorPointer(4, GL_FLOAT, kStride, vertices.front().color.data());
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
  }

  static void load_matrix(const Mat4& m) { glLoadTransposeMatrixd(m.rows[0].data()); }  // the rows lie one after the other

  const reference::Scene& scene_;
  const FrameBufferFormat& format_;
  Context context_;
  const Functions& gl_;
  LightingPrograms programs_;
  reference::Camera camera_;
  std::vector<reference::Light> lights_;
};

}  // namespace

std::optional<std::string> unsupported(const reference::Scene& scene) {
  const FrameBufferFormat& format = scene.framebuffer;
  if (format.dither != reference::Dither::kNone || format.alpha_bits > 0 || format.accumulation_bits > 0 || format.samples > 1)
    return "dither, alpha planes, accumulation or samples";
  std::size_t lights = scene.lights.size();
  for (const reference::Command& command : scene.frame) {
    if (const auto* change = std::get_if<reference::LightsChange>(&command)) lights = change->lights.size();
    if (const auto* clear = std::get_if<Clear>(&command); clear && clear->index && !cleared_entry(*clear->index, scene.framebuffer))
      return "a clear to a palette entry that is not set";
    if (const auto* draw = std::get_if<Draw>(&command))
      if (const auto reason = unsupported_draw(*draw, scene.framebuffer, lights)) return reason;
  }
  return std::nullopt;
}

std::vector<std::uint8_t> render(const reference::Scene& scene) {
  if (const auto reason = unsupported(scene)) throw std::runtime_error("Mesa cannot follow: " + *reason);
  return Renderer(scene).run();
}

}  // namespace tessera::mesa
