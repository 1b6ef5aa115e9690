#include "perf/rivals/literal_shaders.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace tessera::rivals {
namespace {

constexpr const char* kHead = "#version 330\n";

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9e", value);
  return text;
}

std::string vector_literal(double x, double y, double z) {
  return "vec3(" + number(x) + "," + number(y) + "," + number(z) + ")";
}
std::string color_literal(const Color& c) { return vector_literal(c.r, c.g, c.b); }
Color product(const Color& a, const Color& b) { return {a.r * b.r, a.g * b.g, a.b * b.b, 1}; }

/// GLSL matrices are column-major.
std::string matrix_literal(const Matrix& matrix, int size) {
  std::string text = "mat" + std::to_string(size) + "(";
  for (int column = 0; column < size; ++column)
    for (int row = 0; row < size; ++row)
      text += (column + row > 0 ? "," : "") + number(matrix.m[static_cast<std::size_t>(4 * row + column)]);
  return text + ")";
}

struct Vector {
  double x, y, z;
  Vector normalized() const {
    const double length = std::sqrt(x * x + y * y + z * z);
    return {x / length, y / length, z / length};
  }
  std::string literal() const { return vector_literal(x, y, z); }
};

Vector to_eye(const Matrix& view, double x, double y, double z, double w) {
  const auto row = [&](std::size_t r) {
    return view.m[4 * r] * x + view.m[4 * r + 1] * y + view.m[4 * r + 2] * z + view.m[4 * r + 3] * w;
  };
  return {row(0), row(1), row(2)};
}

/// Writes GLSL that adds one light's contribution to `sum`, for the normal n at p and the direction v to the
/// eye.
void add_light(std::ostringstream& s, const Light& light, const LitDraw& draw) {
  const Material& m = draw.material;
  const Vector at =
      to_eye(draw.camera.view, light.position[0], light.position[1], light.position[2], light.position[3]);
  s << "  {\n    float strength = 1.0;\n";
  if (light.position[3] == 0) {
    s << "    const vec3 l = " << at.normalized().literal() << ";\n";
  } else {
    s << "    vec3 to = " << at.literal()
      << " - p;\n    float d2 = dot(to, to), inverse = inversesqrt(d2);\n    vec3 l = to * inverse;\n";
    if (light.attenuation_constant != 1 || light.attenuation_linear != 0 || light.attenuation_quadratic != 0)
      s << "    strength = 1.0 / (" << number(light.attenuation_constant) << " + "
        << number(light.attenuation_linear) << " * d2 * inverse + " << number(light.attenuation_quadratic)
        << " * d2);\n";
  }
  if (light.spot_cutoff < 180) {
    const Vector aim =
        to_eye(draw.camera.view, light.spot_direction[0], light.spot_direction[1], light.spot_direction[2], 0)
            .normalized();
    s << "    float cone = -dot(l, " << aim.literal() << ");\n    strength *= cone < "
      << number(std::cos(double{light.spot_cutoff} * std::numbers::pi / 180)) << " ? 0.0 : pow(cone, "
      << number(light.spot_exponent) << ");\n";
  }
  s << "    float nl = dot(n, l);\n    float highlight = nl > 0.0 ? pow(max(dot(n, normalize(l + v)), 0.0), "
    << number(m.shininess) << ") : 0.0;\n"
    << "    sum += strength * (" << color_literal(product(light.ambient, m.ambient)) << " + max(nl, 0.0) * "
    << color_literal(product(light.diffuse, m.diffuse)) << " + highlight * "
    << color_literal(product(light.specular, m.specular)) << ");\n  }\n";
}

/// GLSL function light(normal, position), in eye space.
std::string lighting_function(const LitDraw& draw) {
  if (draw.model.two_sided || draw.model.specular != SpecularModel::blinn)
    throw std::runtime_error("the rival's shaders support one-sided lighting with Blinn highlights only");
  const Material& m = draw.material;
  const Color scene = product(draw.model.ambient, m.ambient);
  std::ostringstream s;
  s << "vec3 light(vec3 n, vec3 p) {\n  vec3 sum = "
    << color_literal({m.emission.r + scene.r, m.emission.g + scene.g, m.emission.b + scene.b, 1}) << ";\n"
    << (draw.model.local_viewer ? "  vec3 v = -normalize(p);\n" : "  const vec3 v = vec3(0.0, 0.0, 1.0);\n");
  for (const Light& light : draw.lights) add_light(s, light, draw);
  s << "  return clamp(sum, 0.0, 1.0);\n}\n";
  return s.str();
}

}  // namespace

bench::ShaderSources window_shaders(Varying varying, const Color& color) {
  const std::string head = kHead;
  const std::string position = "layout(location = 0) in vec3 position;\n";
  const std::string transform = "  gl_Position = vec4(position, 1.0);\n";
  switch (varying) {
    case Varying::colors:
      return {head + position + "layout(location = 2) in vec4 c;\nout vec4 c_;\nvoid main() {\n" + transform +
                  "  c_ = c;\n}\n",
              head + "in vec4 c_;\nout vec4 color;\nvoid main() { color = c_; }\n"};
    case Varying::texcoords:
      return {head + position + "layout(location = 3) in vec2 t;\nout vec2 t_;\nvoid main() {\n" + transform +
                  "  t_ = t;\n}\n",
              head +
                  "in vec2 t_;\nuniform sampler2D image;\nout vec4 color;\nvoid main() { color = "
                  "texture(image, t_); }\n"};
    default:
      return {head + position + "void main() {\n" + transform + "}\n",
              head + "out vec4 color;\nvoid main() { color = vec4(" + color_literal(color) + ", 1.0); }\n"};
  }
}

bench::ShaderSources object_shaders(double ambient) {
  const std::string head = kHead;
  return {head +
              "layout(location = 0) in vec3 position;\nlayout(location = 1) in vec3 normal;\nuniform mat4 "
              "clip_from_object;\nuniform vec3 color;\nout vec3 c_;\nvoid main() {\n  gl_Position = "
              "clip_from_object * vec4(position, 1.0);\n  c_ = color * (" +
              number(ambient) + " + max(normal.z, 0.0));\n}\n",
          head + "in vec3 c_;\nout vec4 result;\nvoid main() { result = vec4(c_, 1.0); }\n"};
}

bench::ShaderSources lit_shaders(const LitDraw& draw) {
  const Matrix eye_from_object = draw.camera.view * draw.transform;
  const Matrix clip_from_object = draw.camera.projection * eye_from_object;
  const std::string head = kHead;
  const std::string lighting = lighting_function(draw);
  const std::string inputs = "layout(location = 0) in vec3 position;\nlayout(location = 1) in vec3 normal;\n";
  const std::string rotated = matrix_literal(eye_from_object, 3) + " * normal";
  const std::string transform =
      "  gl_Position = " + matrix_literal(clip_from_object, 4) +
      " * vec4(position, 1.0);\n  vec3 n = " + (draw.normalizes ? "normalize(" + rotated + ")" : rotated) +
      ";\n  vec3 p = (" + matrix_literal(eye_from_object, 4) + " * vec4(position, 1.0)).xyz;\n";
  if (draw.shading == Shading::phong)
    return {head + inputs + "out vec3 n_;\nout vec3 p_;\nvoid main() {\n" + transform +
                "  n_ = n;\n  p_ = p;\n}\n",
            head + "in vec3 n_;\nin vec3 p_;\nout vec4 color;\n" + lighting +
                "void main() { color = vec4(light(normalize(n_), p_), 1.0); }\n"};
  if (draw.is_textured)
    return {head + inputs + "layout(location = 3) in vec2 t;\nout vec3 c_;\nout vec2 t_;\n" + lighting +
                "void main() {\n" + transform + "  c_ = light(n, p);\n  t_ = t;\n}\n",
            head +
                "in vec3 c_;\nin vec2 t_;\nuniform sampler2D image;\nout vec4 color;\nvoid main() { color = "
                "vec4(c_, 1.0) * texture(image, t_); }\n"};
  const std::string qualifier = draw.shading == Shading::flat ? "flat " : "";
  return {head + inputs + qualifier + "out vec3 c_;\n" + lighting + "void main() {\n" + transform +
              "  c_ = light(n, p);\n}\n",
          head + qualifier + "in vec3 c_;\nout vec4 color;\nvoid main() { color = vec4(c_, 1.0); }\n"};
}

}  // namespace tessera::rivals
