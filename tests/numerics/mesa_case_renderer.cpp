// The hard cases in Mesa: implements tests/numerics/case_renderer.h with OSMesa's fixed functions.
#include "tests/numerics/case_renderer.h"

#include "tests/mesa/context.h"

namespace tessera::test {
namespace {

reference::DepthFormat depth_format(DepthFormat format) {
  switch (format) {
    case DepthFormat::none: break;
    case DepthFormat::unorm16: return reference::DepthFormat::kUnorm16;
    case DepthFormat::unorm24: return reference::DepthFormat::kUnorm24;
    case DepthFormat::unorm32: return reference::DepthFormat::kUnorm32;
    case DepthFormat::float32: return reference::DepthFormat::kFloat32;
  }
  return reference::DepthFormat::kNone;
}

GLenum mode_of(Primitive primitive) {
  constexpr GLenum kModes[] = {GL_POINTS,         GL_LINES,        GL_LINE_STRIP, GL_LINE_LOOP,  GL_TRIANGLES,
                               GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN, GL_QUADS,      GL_QUAD_STRIP, GL_POLYGON};
  return kModes[static_cast<int>(primitive)];
}

GLenum func_of(Compare compare) { return GL_NEVER + static_cast<GLenum>(compare); }

class MesaCases : public CaseRenderer {
 public:
  explicit MesaCases(const CaseFormat& format)
      : format_(format),
        context_(format.width, format.height,
                 {.color = mesa::ColorStore::kFloat, .depth = depth_format(format.depth)}) {
    if (format.reversed) context_.functions().clip_control(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    if (format.texture_width > 0) {
      glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
      glTexImage2D(GL_TEXTURE_2D, 0, GL_LUMINANCE8, format.texture_width, format.texture_height, 0,
                   GL_LUMINANCE, GL_UNSIGNED_BYTE, format.texture.data());
      for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, filter, format.nearest_texel ? GL_NEAREST : GL_LINEAR);
      glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
    }
    glBlendFunc(GL_ONE, GL_ONE);
    mesa::check_errors("setting up the cases");
  }

  const CasePicture& draw(const std::vector<CaseDraw>& draws) override {
    glDepthMask(GL_TRUE);
    glClearColor(0, 0, 0, 1);
    glClearDepth(format_.cleared_depth);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    for (const CaseDraw& d : draws) run(d);
    read();
    mesa::check_errors("drawing a case");
    return picture_;
  }

 private:
  static void enable(GLenum what, bool on) { on ? glEnable(what) : glDisable(what); }

  void run(const CaseDraw& d) const {
    enable(GL_BLEND, d.add);
    enable(GL_DEPTH_TEST, d.test_depth);
    enable(GL_TEXTURE_2D, d.textured);
    glDepthFunc(func_of(d.depth_func));
    glDepthRange(d.depth_near, d.depth_far);
    enable(GL_POLYGON_OFFSET_FILL, d.offset.factor != 0 || d.offset.units != 0);
    glPolygonOffset(d.offset.factor, d.offset.units);
    load_transposed(d.transform.value_or(Matrix{}));
    const Rect view = d.viewport.value_or(Rect{0, 0, format_.width, format_.height});
    context_.functions().viewport_indexed(0, static_cast<GLfloat>(view.x), static_cast<GLfloat>(view.y),
                                          static_cast<GLfloat>(view.width),
                                          static_cast<GLfloat>(view.height));
    glColor4f(d.color.r, d.color.g, d.color.b, d.color.a);
    array(GL_VERTEX_ARRAY, d.positions, [&] { glVertexPointer(4, GL_FLOAT, 0, d.positions.data()); });
    array(GL_COLOR_ARRAY, d.colors, [&] { glColorPointer(4, GL_FLOAT, 0, d.colors.data()); });
    array(GL_TEXTURE_COORD_ARRAY, d.texcoords,
          [&] { glTexCoordPointer(2, GL_FLOAT, 0, d.texcoords.data()); });
    if (d.indices.empty())
      glDrawArrays(mode_of(d.primitive), 0, static_cast<GLsizei>(d.positions.size() / 4));
    else
      glDrawElements(mode_of(d.primitive), static_cast<GLsizei>(d.indices.size()), GL_UNSIGNED_INT,
                     d.indices.data());
  }

  static void load_transposed(const Matrix& matrix) {
    double columns[16];
    for (std::size_t i = 0; i < 16; ++i) columns[i] = matrix.m[i % 4 * 4 + i / 4];
    glLoadMatrixd(columns);
  }

  template <class Point>
  static void array(GLenum which, const std::vector<float>& values, const Point& point) {
    if (values.empty()) return glDisableClientState(which);
    glEnableClientState(which);
    point();
  }

  void read() {
    const std::size_t width = static_cast<std::size_t>(format_.width);
    const std::size_t height = static_cast<std::size_t>(format_.height);
    const std::vector<float> colors = context_.read_colors();
    picture_.colors.resize(width * height);
    for (std::size_t y = 0; y < height; ++y)
      for (std::size_t x = 0; x < width; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          picture_.colors[y * width + x][c] = colors[((height - 1 - y) * width + x) * 3 + c];
    if (format_.depth == DepthFormat::none) return;
    std::vector<std::uint32_t> depth(width * height);
    const bool is_float = format_.depth == DepthFormat::float32;
    glReadPixels(0, 0, format_.width, format_.height, GL_DEPTH_COMPONENT,
                 is_float ? GL_FLOAT : GL_UNSIGNED_INT, depth.data());
    int bits = 32;
    if (format_.depth == DepthFormat::unorm16) bits = 16;
    if (format_.depth == DepthFormat::unorm24) bits = 24;
    picture_.depth.resize(width * height);
    for (std::size_t y = 0; y < height; ++y)
      for (std::size_t x = 0; x < width; ++x)
        picture_.depth[y * width + x] = depth[(height - 1 - y) * width + x] >> (32 - bits);
  }

  CaseFormat format_;
  mesa::Context context_;
  CasePicture picture_;
};

}  // namespace

std::unique_ptr<CaseRenderer> make_mesa(const CaseFormat& format) {
  return std::make_unique<MesaCases>(format);
}

}  // namespace tessera::test
