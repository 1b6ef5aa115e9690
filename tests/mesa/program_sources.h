// GLSL sources.
#pragma once

namespace tessera::mesa {

// First line of every source.
inline constexpr const char* kVersion = "#version 130\n";

// Shared by vertex and pixel lighting. A light takes seven vectors, in the order of append_light(); a
// material five.
inline constexpr const char* kLighting = R"(uniform int light_count;
uniform vec4 light_values[7 * 32];
uniform vec4 materials[2 * 5];  // front, back
uniform vec4 scene_ambient;
uniform int local_viewer, phong_highlight, color_material, normalize_normals;

vec3 unit(vec3 v) { float l = length(v); return l > 0.0 ? v / l : vec3(0.0); }
float power(float x, float y) { return y == 0.0 ? 1.0 : x <= 0.0 ? 0.0 : pow(x, y); }

vec4 lit(vec3 p, vec3 n, int side, vec4 vertex_color) {
  vec4 ambient = materials[5 * side], diffuse = materials[5 * side + 1];
  vec4 specular = materials[5 * side + 2], emission = materials[5 * side + 3];
  float shininess = materials[5 * side + 4].x;
  if (color_material == 1 || color_material == 3) ambient = vertex_color;
  if (color_material == 1 || color_material == 2) diffuse = vertex_color;
  if (color_material == 4) emission = vertex_color;
  if (color_material == 5) specular = vertex_color;

  vec3 e = local_viewer != 0 ? unit(-p) : vec3(0.0, 0.0, 1.0);
  vec3 sum = emission.rgb + scene_ambient.rgb * ambient.rgb;
  for (int i = 0; i < light_count; ++i) {
    vec4 position = light_values[7 * i + 3];
    vec4 spot = light_values[7 * i + 4];
    vec4 factors = light_values[7 * i + 5];
    float exponent = light_values[7 * i + 6].x;
    bool is_spot = light_values[7 * i + 6].y != 0.0;
    vec3 to_light = position.xyz;  // w = 0: a unit vector already
    float strength = 1.0;
    if (position.w != 0.0) {
      vec3 way = position.xyz - p;
      float d = length(way), denominator = factors.x + factors.y * d + factors.z * d * d;
      to_light = unit(way);
      strength = denominator <= 0.0 ? 1.0e6 : 1.0 / denominator;
    }
    if (is_spot) {
      float along = dot(-to_light, spot.xyz);
      strength *= along < spot.w || along <= 0.0 ? 0.0 : power(along, exponent);
    }
    float facing = dot(to_light, n);
    vec3 light = light_values[7 * i].rgb * ambient.rgb +
                 max(facing, 0.0) * light_values[7 * i + 1].rgb * diffuse.rgb;
    if (facing > 0.0) {
      float cosine = phong_highlight != 0 ? dot(2.0 * facing * n - to_light, e) : dot(unit(to_light + e), n);
      light += power(max(cosine, 0.0), shininess) * light_values[7 * i + 2].rgb * specular.rgb;
    }
    sum += strength * light;
  }
  return clamp(vec4(sum, diffuse.a), 0.0, 1.0);
}

vec3 divided(vec4 p) { return p.xyz / p.w; }
)";

// Mesa's gl_NormalMatrix uses the inverse of all 16 elements, not of the upper left 3x3 part as GLSL
// specifies. They differ for projective matrices.
inline constexpr const char* kEyeNormal = R"(
vec3 eye_normal() {
  vec4 a = gl_ModelViewMatrix[0], b = gl_ModelViewMatrix[1], c = gl_ModelViewMatrix[2];
  if (a.w == 0.0 && b.w == 0.0 && c.w == 0.0) return gl_NormalMatrix * gl_Normal;
  mat3 cofactors = mat3(cross(b.xyz, c.xyz), cross(c.xyz, a.xyz), cross(a.xyz, b.xyz));
  return cofactors * gl_Normal / dot(a.xyz, cofactors[0]);
}
)";

inline constexpr const char* kVertexLit = R"(
void main() {
  vec3 p = divided(gl_ModelViewMatrix * gl_Vertex), n = eye_normal();
  if (normalize_normals != 0) n = unit(n);
  gl_Position = ftransform();
  gl_FrontColor = lit(p, n, 0, gl_Color);
  gl_BackColor = lit(p, -n, 1, gl_Color);
  gl_TexCoord[0] = gl_MultiTexCoord0;
}
)";

inline constexpr const char* kPixelLitVertex = R"(
out vec3 position, normal;
out vec4 color;
out vec2 texcoord;
void main() {
  position = divided(gl_ModelViewMatrix * gl_Vertex);
  normal = eye_normal();
  if (normalize_normals != 0) normal = unit(normal);
  color = gl_Color;
  texcoord = gl_MultiTexCoord0.st;
  gl_Position = ftransform();
}
)";

// Shared by the fragment programs. The derivatives for the level of detail are exact: 1/w and its products
// are linear in the window, so differences between neighbours equal the derivative everywhere, and the
// quotient rule gives the rest. On a line
// the derivatives along x and y are components of the one along its length, so their squares add. Mesa's
// own level of detail uses differences of the quotients and a logarithm that is piecewise linear between
// powers of two. The environments are tables 3.22 and 3.23 of OpenGL 1.5; a texel without alpha has alpha 1.
inline constexpr const char* kTexturing = R"(uniform int texture_dimensions;  // 0: none
uniform vec4 texture_size;       // xy: texels, height 0 for 1-D; z: 1 on a line; w: largest magnified level
uniform int texture_env;         // modulate, replace, decal, blend, add
uniform int texture_has_alpha;
uniform vec4 texture_env_color;
uniform sampler2D image;
uniform sampler1D row;

float level_of_detail(vec2 at) {
  float r = gl_FragCoord.w;  // 1/w
  vec2 dx = texture_size.xy * (dFdx(at * r) - at * dFdx(r)) / r;
  vec2 dy = texture_size.xy * (dFdy(at * r) - at * dFdy(r)) / r;
  float square = texture_size.z != 0.0 ? dot(dx, dx) + dot(dy, dy) : max(dot(dx, dx), dot(dy, dy));
  float level = 0.5 * log2(max(square, 1.0e-30));
  return level > texture_size.w ? level : 0.0;
}

vec4 textured(vec4 f, vec2 at) {
  if (texture_dimensions == 0) return f;
  float level = level_of_detail(at);
  vec4 t = texture_dimensions == 2 ? textureLod(image, at, level) : textureLod(row, at.s, level);
  if (texture_env == 0) return f * t;
  if (texture_env == 1) return vec4(t.rgb, texture_has_alpha != 0 ? t.a : f.a);
  if (texture_env == 2) return vec4(mix(f.rgb, t.rgb, t.a), f.a);
  if (texture_env == 3) return vec4(mix(f.rgb, clamp(texture_env_color.rgb, 0.0, 1.0), t.rgb), f.a * t.a);
  return vec4(min(f.rgb + t.rgb, 1.0), f.a * t.a);
}
)";

inline constexpr const char* kTexturedFragment = R"(
void main() { gl_FragColor = textured(gl_Color, gl_TexCoord[0].st); }
)";

inline constexpr const char* kPixelLitFragment = R"(
uniform int two_sided;
in vec3 position, normal;
in vec4 color;
in vec2 texcoord;
void main() {
  bool back = two_sided != 0 && !gl_FrontFacing;
  vec3 n = unit(normal);
  gl_FragColor = textured(lit(position, back ? -n : n, back ? 1 : 0, color), texcoord);
}
)";

}  // namespace tessera::mesa
