// A parsed scene: plain data for the reference renderers, with every default filled in, every mesh generated
// and every angle, name and path resolved. Conventions are OpenGL's: right-handed, camera along -z, window
// origin at the lower left, y up, angles in degrees, colours RGBA with 1.0 full and no transfer curve.
// Matrices are rows as on paper, for column vectors (transpose them for glLoadMatrixd).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fragment_state.h"
#include "linear.h"

namespace tessera::reference {

// ---- Frame buffer

enum class ColorMode { kRgb, kIndex };
enum class DepthFormat { kNone, kUnorm16, kUnorm24, kUnorm32, kFloat32 };

using Rgb8 = std::array<std::uint8_t, 3>;

struct FrameBufferFormat {
  int width_px = 640;
  int height_px = 480;
  ColorMode color_mode = ColorMode::kRgb;
  int color_bits = 24;  ///< 1..24; RGB: split over the components, index: bits of a stored index
  std::vector<Rgb8>
      palette;  ///< index mode: the entries that are set, at most 2^color_bits; the others show black
  Dither dither = Dither::kNone;
  int alpha_bits = 0;  ///< 0 or 8; RGB only
  DepthFormat depth = DepthFormat::kUnorm24;
  int stencil_bits = 8;       ///< 0..8
  int accumulation_bits = 0;  ///< of each component: 0, 16 or 32; RGB only
  int samples = 1;            ///< of each pixel: 1, 4 or 8; more than 1 RGB only
};

/// A rectangle of pixels in window coordinates (origin lower left, y up): x..x+width-1, y..y+height-1.
struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
};

// ---- Camera, lights, materials

struct Camera {
  Mat4 view_from_world;
  /// Clip space is |x|, |y| <= w. Normal projections: -w <= z <= w, depth = (z/w + 1)/2.
  /// Reversed ones: 0 <= z <= w, near at z = w, far at z = 0, depth = z/w (as glClipControl's zero to one).
  Mat4 clip_from_view;
  bool reversed = false;
  bool infinite_far = false;  ///< "far" is "infinity": there is no far plane to clip against
};

enum class SpecularModel { kBlinn, kPhong };

struct LightModel {
  Vec4 ambient{0.2, 0.2, 0.2, 1};
  bool local_viewer = false;
  bool two_sided = false;
  SpecularModel specular = SpecularModel::kBlinn;  ///< kBlinn is OpenGL's
};

/// Position and spot direction are in world space: at each draw they go into eye space by that draw's camera.
struct Light {
  Vec4 ambient{0, 0, 0, 1};
  Vec4 diffuse{1, 1, 1, 1};
  Vec4 specular{1, 1, 1, 1};
  Vec4 position{0, 0, 1, 0};      ///< w = 0: directional, xyz points towards the light; else a point at xyz/w
  Vec3 spot_direction{0, 0, -1};  ///< as written, not normalized
  double spot_exponent = 0;
  double spot_cutoff = 180;                    ///< degrees, 0..90 or 180
  std::array<double, 3> attenuation{1, 0, 0};  ///< constant, linear, quadratic
};

struct Material {
  Vec4 ambient{0.2, 0.2, 0.2, 1};
  Vec4 diffuse{0.8, 0.8, 0.8, 1};
  Vec4 specular{0, 0, 0, 1};
  Vec4 emission{0, 0, 0, 1};
  double shininess = 0;  ///< 0..16384
  /// Ambient, diffuse and specular index. If present, lit draws into an index buffer use index lighting.
  std::optional<std::array<double, 3>> color_indexes;
};

// ---- Textures

/// Levels of 8 bits, row by row from the bottom, the channels of a pixel side by side: luminance, luminance
/// and alpha, RGB or RGBA.
struct Image {
  int width = 0, height = 0;
  int channels = 0;  ///< 1 to 4
  std::vector<std::uint8_t> levels;
};

enum class MagFilter { kNearest, kLinear };
enum class MinFilter {
  kNearest,
  kLinear,
  kNearestMipmapNearest,
  kLinearMipmapNearest,
  kNearestMipmapLinear,
  kLinearMipmapLinear
};
enum class Wrap { kRepeat, kClampToEdge, kMirroredRepeat };

/// One row high: a 1-D texture, of which t has no say.
struct Texture {
  std::string name;
  Image image;
  MagFilter mag = MagFilter::kLinear;
  MinFilter min = MinFilter::kLinearMipmapLinear;
  Wrap wrap_s = Wrap::kRepeat;
  Wrap wrap_t = Wrap::kRepeat;
};

enum class TextureEnv { kModulate, kReplace, kDecal, kBlend, kAdd };

// ---- Meshes

enum class PrimitiveType {
  kPoints,
  kLines,
  kLineStrip,
  kLineLoop,
  kTriangles,
  kTriangleStrip,
  kTriangleFan,
  kQuads,
  kQuadStrip,
  kPolygon
};

/// A list of vertices and what they make up, as glBegin() and glDrawElements() take them (see primitives.h).
struct Mesh {
  std::string name;
  PrimitiveType primitive = PrimitiveType::kTriangles;
  std::vector<Vec4> positions;  ///< object space, w = 1 unless the scene gives it
  std::vector<Vec3>
      normals;               ///< one for each position, or empty: the mesh has none (see generated_normals.h)
  std::vector<Vec4> colors;  ///< RGBA, one for each position, or empty: the mesh has none
  std::vector<std::array<double, 2>>
      texcoords;                       ///< s and t, one for each position, or empty: 0, 0 everywhere
  std::vector<double> color_indices;   ///< palette indices, one for each position, or empty; unlit draws into
                                       ///< index buffers use them
  std::vector<std::uint32_t> indices;  ///< as many as the primitive needs, all below positions.size()
};

// ---- What happens in a frame

enum class Shading { kFlat, kGouraud, kPhong };
enum class ColorMaterial { kNone, kAmbientAndDiffuse, kDiffuse, kAmbient, kEmission, kSpecular };
enum class ProvokingVertex { kLast, kFirst };  ///< see primitives.h
enum class Cull { kNone, kBack, kFront };
enum class FrontFace { kCcw, kCw };
enum class PolygonMode { kFill, kLine, kPoint };

/// Clears the buffers named, through full masks.
struct Clear {
  std::optional<Vec4> color;  ///< 0..1; on an index buffer: its nearest palette entry
  std::optional<std::uint32_t>
      index;  ///< index buffers only, already masked to the buffer's bits; goes before `color`
  std::optional<double> depth;           ///< 0..1
  std::optional<std::uint32_t> stencil;  ///< already masked to the buffer's bits
  std::optional<Vec4> accumulation;      ///< -1..1
  std::optional<Rect> scissor;           ///< absent: the whole buffer
};

enum class AccumOp { kAccum, kLoad, kAdd, kMult, kReturn };

/// Combines the colour buffer with the accumulation buffer.
struct Accum {
  AccumOp op = AccumOp::kAccum;
  double value = 1;
  std::optional<Rect> scissor;                             ///< absent: the whole buffer
  std::array<bool, 4> color_mask{true, true, true, true};  ///< of kReturn
};

/// What happens to fragments on their way into the buffers.
struct FragmentState {
  std::optional<Rect> scissor;  ///< absent: off; so the other optional ones
  std::optional<AlphaTest> alpha_test;
  std::optional<StencilState> stencil;
  std::optional<DepthState> depth = DepthState{};  ///< absent: no depth test and no depth write
  std::optional<Blend> blend;
  LogicOp logic_op = LogicOp::kCopy;
  std::array<bool, 4> color_mask{true, true, true, true};  ///< R, G, B, A
  std::uint32_t plane_mask =
      0xffffffffu;  ///< bit k: bitplane k of the colour word A:R:G:B (or of the index) may change
};

/// Instead of the object its shadow: flattened onto a plane, unlit and untextured (see planar_shadow.h).
struct ShadowOn {
  Vec4 plane;             ///< a, b, c, d of a x + b y + c z + d = 0 in world space
  std::size_t light = 0;  ///< number in the list of lights in force
  Vec4 color{0, 0, 0, 1};
};

struct Draw : FragmentState {
  std::size_t mesh = 0;    ///< index into Scene::meshes
  Material material;       ///< front faces, and back faces too unless lighting is two-sided
  Material back_material;  ///< back faces under two-sided lighting
  Mat4 world_from_object;
  Shading shading = Shading::kGouraud;
  bool lighting = true;  ///< false: vertex colours if the mesh has them, else the material's diffuse colour
  /// Vertex colours, if the mesh has them, replace these colours of both materials.
  ColorMaterial color_material = ColorMaterial::kNone;
  ProvokingVertex provoking_vertex = ProvokingVertex::kLast;
  bool normalize = true;  ///< eye-space normals are normalized at the vertices
  Cull cull = Cull::kNone;
  FrontFace front_face = FrontFace::kCcw;
  /// Of front and of back faces. Lines are the boundary of the polygon, or of what clipping leaves of it,
  /// points its corners.
  std::array<PolygonMode, 2> polygon_mode{PolygonMode::kFill, PolygonMode::kFill};
  std::array<double, 2> depth_range{0, 1};
  PolygonOffset polygon_offset;
  double point_size = 1;  ///< in pixels, above 0
  double line_width = 1;
  std::optional<std::size_t>
      texture;  ///< index into Scene::textures; it has no say where a palette index is drawn
  TextureEnv texture_env = TextureEnv::kModulate;
  Vec4 texture_env_color{0, 0, 0, 0};
  std::optional<ShadowOn> shadow_on;  ///< absent: the object itself
  std::optional<Rect> viewport;       ///< absent: the whole buffer
};

/// Bits at a window position: each that is set is a pixel of one colour, whose lower left corner lies at
/// whole coordinates.
struct Bitmap : FragmentState {
  std::array<double, 2> at{0, 0};  ///< window coordinates of the lower left corner, rounded down
  double raster_depth = 0;         ///< in the window, 0..1
  int width = 0, height = 0;
  std::vector<bool> bits;  ///< row by row from the bottom
  Vec4 color{1, 1, 1, 1};
};

/// An image at a window position, each of its pixels a rectangle of the zoom's size.
struct ImageDrawing : FragmentState {
  std::array<double, 2> at{0, 0};  ///< window coordinates of the lower left corner of the lower left pixel
  double raster_depth = 0;         ///< in the window, 0..1
  Image image;
  std::array<double, 2> zoom{1, 1};  ///< of x and y; below 0 the image extends to the left or downwards
};

/// The camera from here on.
struct CameraChange {
  Camera camera;
};

/// The whole list of lights from here on.
struct LightsChange {
  std::vector<Light> lights;
};

using Command = std::variant<Clear, Draw, Bitmap, ImageDrawing, Accum, CameraChange, LightsChange>;

struct Scene {
  std::string title;
  FrameBufferFormat framebuffer;
  Camera camera;  ///< in force at the start of the frame
  LightModel light_model;
  std::vector<Light> lights;  ///< in force at the start of the frame
  std::map<std::string, Material> materials;
  std::vector<Texture> textures;  ///< in the order of the file
  std::vector<Mesh> meshes;       ///< in the order of the file
  std::vector<Command> frame;     ///< in order; the default frame if the scene has none
};

/// Reads a scene file (version 1 of the format, the parts these renderers cover).
/// @throws std::runtime_error for a missing or malformed file and for every key or value that is not covered.
Scene load_scene(const std::string& path);

/// The same from JSON text; paths inside it are relative to `directory`.
Scene parse_scene(const std::string& json_text, const std::string& directory);

}  // namespace tessera::reference
