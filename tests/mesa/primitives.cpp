#include "primitives.h"

#include <algorithm>
#include <cmath>

#include "fragment_functions.h"

namespace tessera::mesa {
namespace {

GLenum primitive_mode(reference::PrimitiveType type) {
  switch (type) {
    case reference::PrimitiveType::kPoints: return GL_POINTS;
    case reference::PrimitiveType::kLines: return GL_LINES;
    case reference::PrimitiveType::kLineStrip: return GL_LINE_STRIP;
    case reference::PrimitiveType::kLineLoop: return GL_LINE_LOOP;
    case reference::PrimitiveType::kTriangles: return GL_TRIANGLES;
    case reference::PrimitiveType::kTriangleStrip: return GL_TRIANGLE_STRIP;
    case reference::PrimitiveType::kTriangleFan: return GL_TRIANGLE_FAN;
    case reference::PrimitiveType::kQuads: return GL_QUADS;
    case reference::PrimitiveType::kQuadStrip: return GL_QUAD_STRIP;
    case reference::PrimitiveType::kPolygon: return GL_POLYGON;
  }
  return GL_TRIANGLES;
}

GLenum polygon_mode(reference::PolygonMode mode) {
  switch (mode) {
    case reference::PolygonMode::kFill: return GL_FILL;
    case reference::PolygonMode::kLine: return GL_LINE;
    case reference::PolygonMode::kPoint: return GL_POINT;
  }
  return GL_FILL;
}

// OpenGL lets an implementation round sizes halfway between two integers either way; here they round up.
GLfloat whole_size(double size) { return static_cast<GLfloat>(std::max(1.0, std::floor(size + 0.5))); }

bool has_lines_alone(reference::PrimitiveType type, const reference::Draw& draw) {
  using enum reference::PrimitiveType;
  using enum reference::PolygonMode;
  if (type == kLines || type == kLineStrip || type == kLineLoop) return true;
  const auto [front, back] = draw.polygon_mode;
  const bool has_lines = front == kLine || back == kLine;
  const bool has_points = front == kPoint || back == kPoint;
  return type != kPoints && has_lines && !has_points;
}

// Leaves room for a line's whole width beyond each side.
double growth(int size, double line_width) {
  double times = 2;
  while ((times - 1) * std::max(size, 1) < 2 * line_width) times *= 2;
  return times;
}

}  // namespace

void set_primitive_state(const Functions& gl, const reference::Draw& draw) {
  glFrontFace(draw.front_face == reference::FrontFace::kCcw ? GL_CCW : GL_CW);
  set_enabled(GL_CULL_FACE, draw.cull != reference::Cull::kNone);
  glCullFace(draw.cull == reference::Cull::kFront ? GL_FRONT : GL_BACK);
  glPolygonMode(GL_FRONT, polygon_mode(draw.polygon_mode[0]));
  glPolygonMode(GL_BACK, polygon_mode(draw.polygon_mode[1]));
  glPointSize(whole_size(draw.point_size));
  glLineWidth(whole_size(draw.line_width));
  gl.provoking_vertex(draw.provoking_vertex == reference::ProvokingVertex::kFirst
                          ? GL_FIRST_VERTEX_CONVENTION
                          : GL_LAST_VERTEX_CONVENTION);
}

reference::Rect viewport_of(const reference::Draw& draw, const reference::FrameBufferFormat& format) {
  return draw.viewport.value_or(reference::Rect{0, 0, format.width_px, format.height_px});
}

Growth viewport_growth(reference::PrimitiveType type, const reference::Draw& draw,
                       const reference::Rect& viewport) {
  if (!has_lines_alone(type, draw)) return {};
  return {growth(viewport.width, draw.line_width), growth(viewport.height, draw.line_width)};
}

void set_viewport(const Functions& gl, const reference::Rect& viewport, Growth growth) {
  const double width = growth.x * viewport.width, height = growth.y * viewport.height;
  const double left = viewport.x - (width - viewport.width) / 2;
  const double bottom = viewport.y - (height - viewport.height) / 2;
  gl.viewport_indexed(0, static_cast<GLfloat>(left), static_cast<GLfloat>(bottom),
                      static_cast<GLfloat>(width), static_cast<GLfloat>(height));
}

reference::Mat4 shrinking(Growth growth) {
  reference::Mat4 matrix;
  matrix.rows[0][0] = 1 / growth.x;
  matrix.rows[1][1] = 1 / growth.y;
  return matrix;
}

void draw_vertices(reference::PrimitiveType type, const std::vector<Vertex>& vertices) {
  constexpr GLsizei kStride = sizeof(Vertex);
  for (const GLenum array : {GL_VERTEX_ARRAY, GL_NORMAL_ARRAY, GL_COLOR_ARRAY, GL_TEXTURE_COORD_ARRAY})
    glEnableClientState(array);
  glVertexPointer(4, GL_DOUBLE, kStride, vertices.front().position.data());
  glNormalPointer(GL_FLOAT, kStride, vertices.front().normal.data());
  glColorPointer(4, GL_FLOAT, kStride, vertices.front().color.data());
  glTexCoordPointer(2, GL_DOUBLE, kStride, vertices.front().texcoord.data());
  glDrawArrays(primitive_mode(type), 0, static_cast<GLsizei>(vertices.size()));
}

}  // namespace tessera::mesa
