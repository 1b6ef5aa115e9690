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
  /// Index mode: the set entries, at most 2^color_bits; others are displayed black.
  std::vector<Rgb8> palette;
  Dither dither = Dither::kNone;
  int alpha_bits = 0;  ///< 0 or 8; RGB only
  DepthFormat depth = DepthFormat::kUnorm24;
  int stencil_bits = 8;       ///< 0..8
  int accumulation_bits = 0;  ///< per component: 0, 16 or 32; RGB only
  int samples = 1;            ///< per pixel: 1, 4 or 8; more than 1 RGB only
};

/// A rectangle of pixels in window coordinates (origin lower left, y up): x..x+width-1, y..y+height-1.
struct Rect {
  int x = 0, y = 0;
  int width = 0, height = 0;
};

// ---- Camera, lights, materials

struct Camera {
  Mat4 view_from_world;
  /// Clip space is |x|, |y| <= w. Normal projections: -w <= z <= w, depth = (z/w + 1)/2.
  /// Reversed ones: 0 <= z <= w, near at z = w, far at z = 0, depth = z/w (as glClipControl's zero to one).
  Mat4 clip_from_view;
  bool reversed = false;
  bool infinite_far = false;  ///< far is "infinity": no clipping against a far plane
};

enum class SpecularModel { kBlinn, kPhong };

struct LightModel {
  Vec4 ambient{0.2, 0.2, 0.2, 1};
  bool local_viewer = false;
  bool two_sided = false;
  SpecularModel specular = SpecularModel::kBlinn;  ///< kBlinn matches OpenGL
};

/// Position and spot direction are in world space; each draw transforms them by its camera.
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

/// 8-bit levels, row by row from the bottom, channels interleaved: luminance, luminance and alpha, RGB or
/// RGBA.
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

/// An image one row high is a 1-D texture; t is ignored.
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

/// Vertices and their primitives, as for glBegin() and glDrawElements() (see primitives.h).
struct Mesh {
  std::string name;
  PrimitiveType primitive = PrimitiveType::kTriangles;
  std::vector<Vec4> positions;  ///< object space, w = 1 unless the scene gives it
  /// One per position, or empty if the mesh has none (see generated_normals.h).
  std::vector<Vec3> normals;
  std::vector<Vec4> colors;  ///< RGBA, one per position, or empty if the mesh has none
  /// Texture coordinates s and t, one per position; empty: 0, 0 everywhere.
  std::vector<std::array<double, 2>> texcoords;
  /// Palette indices for unlit draws into index buffers, one per position, or empty.
  std::vector<double> color_indices;
  std::vector<std::uint32_t> indices;  ///< a valid count for the primitive type, all below positions.size()
};

// ---- Commands of a frame

enum class Shading { kFlat, kGouraud, kPhong };
enum class ColorMaterial { kNone, kAmbientAndDiffuse, kDiffuse, kAmbient, kEmission, kSpecular };
enum class ProvokingVertex { kLast, kFirst };  ///< see primitives.h
enum class Cull { kNone, kBack, kFront };
enum class FrontFace { kCcw, kCw };
enum class PolygonMode { kFill, kLine, kPoint };

/// Clears the listed buffers, ignoring write masks.
struct Clear {
  std::optional<Vec4> color;  ///< 0..1; on an index buffer: its nearest palette entry
  /// Index buffers only, already masked to the buffer's bits; takes precedence over `color`.
  std::optional<std::uint32_t> index;
  std::optional<double> depth;           ///< 0..1
  std::optional<std::uint32_t> stencil;  ///< already masked to the buffer's bits
  std::optional<Vec4> accumulation;      ///< -1..1
  std::optional<Rect> scissor;           ///< none: the whole buffer
};

enum class AccumOp { kAccum, kLoad, kAdd, kMult, kReturn };

/// Combines the colour buffer with the accumulation buffer.
struct Accum {
  AccumOp op = AccumOp::kAccum;
  double value = 1;
  std::optional<Rect> scissor;                             ///< none: the whole buffer
  std::array<bool, 4> color_mask{true, true, true, true};  ///< for kReturn
};

/// Per-fragment state.
struct FragmentState {
  std::optional<Rect> scissor;  ///< none: off; likewise for the other optional states
  std::optional<AlphaTest> alpha_test;
  std::optional<StencilState> stencil;
  std::optional<DepthState> depth = DepthState{};  ///< none: neither depth test nor depth write
  std::optional<Blend> blend;
  LogicOp logic_op = LogicOp::kCopy;
  std::array<bool, 4> color_mask{true, true, true, true};  ///< R, G, B, A
  /// Bit k: plane k of the packed color A:R:G:B (or of the index) is writable.
  std::uint32_t plane_mask = 0xffffffffu;
};

/// Draws the object's shadow instead: flattened onto a plane, unlit and untextured (see planar_shadow.h).
struct ShadowOn {
  Vec4 plane;             ///< a, b, c, d of a x + b y + c z + d = 0 in world space
  std::size_t light = 0;  ///< index in the current list of lights
  Vec4 color{0, 0, 0, 1};
};

/// A named user stage of a draw.
struct Stage {
  enum class Kind : std::uint8_t {
    kGradientObjectY,
    kGradientScreenY,
    kUncover,
    kReverseClipZ,
    kReverseWindowZ,
    kZoom,
    kFalloff
  };
  Kind kind = Kind::kZoom;
  double value = 0;          ///< amount, factor or exponent
  Vec3 from;                 ///< kFalloff: world space
  std::vector<Vec4> colors;  ///< gradients: at least two
};

struct Draw : FragmentState {
  std::size_t mesh = 0;    ///< index into Scene::meshes
  Material material;       ///< front faces; also back faces unless lighting is two-sided
  Material back_material;  ///< back faces under two-sided lighting
  Mat4 world_from_object;
  Shading shading = Shading::kGouraud;
  bool lighting = true;  ///< false: vertex colours if present, else the material's diffuse colour
  /// Vertex colours, if present, replace these colours of both materials.
  ColorMaterial color_material = ColorMaterial::kNone;
  ProvokingVertex provoking_vertex = ProvokingVertex::kLast;
  bool normalize = true;  ///< normalizes eye-space normals at the vertices
  Cull cull = Cull::kNone;
  FrontFace front_face = FrontFace::kCcw;
  /// Per face: [0] front, [1] back. Lines are the boundary of the clipped polygon, points its corners.
  std::array<PolygonMode, 2> polygon_mode{PolygonMode::kFill, PolygonMode::kFill};
  std::array<double, 2> depth_range{0, 1};
  PolygonOffset polygon_offset;
  double point_size = 1;  ///< pixels, above 0
  double line_width = 1;
  /// Index into Scene::textures; ignored for palette indices.
  std::optional<std::size_t> texture;
  TextureEnv texture_env = TextureEnv::kModulate;
  Vec4 texture_env_color{0, 0, 0, 0};
  std::optional<ShadowOn> shadow_on;  ///< none: draws the object itself
  std::optional<Rect> viewport;       ///< none: the whole buffer
  std::vector<Stage> stages;          ///< run in order
};

/// A bitmap at a window position: each set bit is a pixel of one colour, with its lower left corner at
/// integer coordinates.
struct Bitmap : FragmentState {
  std::array<double, 2> at{0, 0};  ///< window coordinates of the lower left corner, rounded down
  double raster_depth = 0;         ///< window depth, 0..1
  int width = 0, height = 0;
  std::vector<bool> bits;  ///< row by row from the bottom
  Vec4 color{1, 1, 1, 1};
};

/// An image at a window position; each of its pixels is a rectangle of the zoom's size.
struct ImageDrawing : FragmentState {
  std::array<double, 2> at{0, 0};  ///< window coordinates of the lower left corner of the lower left pixel
  double raster_depth = 0;         ///< window depth, 0..1
  Image image;
  std::array<double, 2> zoom{1, 1};  ///< x and y; negative values extend the image to the left or downwards
};

/// Sets the camera of the following commands.
struct CameraChange {
  Camera camera;
};

/// Replaces the list of lights for the following commands.
struct LightsChange {
  std::vector<Light> lights;
};

using Command = std::variant<Clear, Draw, Bitmap, ImageDrawing, Accum, CameraChange, LightsChange>;

struct Scene {
  std::string title;
  FrameBufferFormat framebuffer;
  Camera camera;  ///< at the start of the frame
  LightModel light_model;
  std::vector<Light> lights;  ///< at the start of the frame
  std::map<std::string, Material> materials;
  std::vector<Texture> textures;  ///< in file order
  std::vector<Mesh> meshes;       ///< in file order
  std::vector<Command> frame;     ///< in order; the default frame if the scene has none
};

/// Reads a scene file (version 1 of the format, the parts that the reference renderers support).
/// @throws std::runtime_error for a missing or malformed file and for every unsupported key or value.
Scene load_scene(const std::string& path);

/// Parses JSON text; paths in it are relative to `directory`.
/// @param time  0 to 1: that of the picture of an animation
Scene parse_scene(const std::string& json_text, const std::string& directory, double time = 0);

}  // namespace tessera::reference
