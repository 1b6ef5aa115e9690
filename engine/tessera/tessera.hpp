// Tessera: a multithreaded, tile-based software rasterizer. This is the only header that users include.
//
//   tessera::Renderer renderer;                                     // all cores, best instruction set
//   tessera::FrameBuffer buffer({.width = 640, .height = 480});     // 24-bit colour, 24-bit depth
//   tessera::Frame frame(buffer);
//   frame.clear({.color = tessera::Color{0, 0, 0, 1}, .depth = 1.0});
//   frame.set_camera({.view = look_at(...), .projection = perspective(...)});
//   frame.draw(mesh, {.material = red, .shading = tessera::Shading::phong});
//   renderer.finish(frame, {.pixels = pixels, .width = 640, .height = 480, .stride_bytes = 640 * 4});
//
// Conventions are OpenGL's: right-handed, camera looks along -z, column vectors, matrices written in rows as
// on paper, counter-clockwise fronts, angles in degrees, window origin at the lower left. No transfer curve:
// 0.5 is 128 of 255. Images and planes handed over start with the top row.
//
// Errors. Whatever the caller or the world got wrong throws tessera::Error before a pixel is touched; its
// message says what was found and what was needed. Odd data (NaN vertices, triangles without area) is dropped
// and counted in FrameStats.
//
// Threads. Distinct objects may be used on distinct threads at the same time; one object by one thread at a
// time. There is no global state. The same frame gives the same bits for any number of threads, tile size and
// instruction set.
//
// Lifetimes. Meshes, textures, bitmaps and images are borrowed: what a draw points to has to stay as it is
// until Renderer::finish returns. An object that was moved from may be assigned to or destroyed, and nothing
// else.
#pragma once

#if __cplusplus < 202002L && !(defined(_MSVC_LANG) && _MSVC_LANG >= 202002L)
#error "tessera.hpp needs C++20: -std=c++20"
#endif

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <tessera/effect_note.hpp>
#include <tessera/enums.hpp>

#include "export.h"
#include "primitives.hpp"
#include "version.h"

namespace tessera {

/// The version of the library that runs, "0.1.0"; TESSERA_VERSION is that of the header.
TESSERA_API std::string_view version();

// Implementation detail, not part of the API.
namespace detail {
struct FrameBufferState;
struct FrameRecording;
struct RendererState;
struct TextureState;
}  // namespace detail

/// Kinds of errors. Values are stable; new enumerators are appended.
enum class ErrorCode : std::uint8_t {
  invalid_argument,     ///< a value is out of range, or values do not fit together
  incompatible_format,  ///< the frame buffer's format lacks what is asked for
  invalid_state,     ///< an object that was moved from, a buffer that was not kept, a call at the wrong time
  unsupported,       ///< this build or machine cannot do it
  out_of_memory,     ///< an allocation failed
  cancelled,         ///< a progress callback stopped the frame
  executor_failure,  ///< an Executor broke its contract
  internal           ///< a defect of the library
};

/// The one exception type of the library: also where memory runs out, but in the small lists that name things
/// (material_names, available_instruction_sets, serial_executor).
class TESSERA_API Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : Error(ErrorCode::invalid_argument, message) {}
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}

  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};
/// Thrown by Renderer::finish if its progress callback returned false.
class TESSERA_API Cancelled : public Error {
 public:
  explicit Cancelled(const std::string& message) : Error(ErrorCode::cancelled, message) {}
};

struct Vec3 {
  double x = 0, y = 0, z = 0;
};
/// Red, green, blue, alpha; 1 is full. Any finite number, except where a range is named.
struct Color {
  float r = 0, g = 0, b = 0, a = 1;
};
/// A rectangle of pixels; x, y is its lower left corner in window coordinates (origin lower left).
struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
};
/// 4x4, in rows as on paper: m[4 * row + column]; applies to column vectors. Elements may be any numbers
/// until something is done by them: what takes a matrix throws Error where one is not finite.
struct Matrix {
  std::array<double, 16> m = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
};
/// Sine and cosine of one angle.
struct SinCos {
  double sine, cosine;
};
/// Sine and cosine of any finite angle in degrees, with an error below 1e-15; multiples of 90 are exact.
/// The result has the same bits on every machine.
TESSERA_API SinCos sin_cos_degrees(double degrees);
TESSERA_API Matrix operator*(const Matrix& left, const Matrix& right);
TESSERA_API Matrix translate(double x, double y, double z);
TESSERA_API Matrix
rotate(double degrees, double x, double y,
       double z);  ///< about an axis, counter-clockwise; throws Error for an axis of length 0
TESSERA_API Matrix scale(double x, double y, double z);
TESSERA_API Matrix look_at(Vec3 eye, Vec3 target,
                           Vec3 up);  ///< world to eye; throws Error where the three do not span a frame

// ---- frame buffer
// -------------------------------------------------------------------------------------------------

enum class ColorMode : std::uint8_t { rgb, index };

inline constexpr int kMaxFrameBufferSize = 16384;  ///< largest width and height, in pixels

/// Ordered dither of every colour that draws, clears and AccumOp::return_color write, by a pattern of that
/// size; indices are stored as they are.
enum class Dither : std::uint8_t { none, bayer2, bayer4, bayer8 };

struct FrameBufferFormat {
  int width = 640, height = 480;  ///< 1 .. kMaxFrameBufferSize
  ColorMode color_mode = ColorMode::rgb;
  int color_bits = 24;  ///< colour planes, 1 .. 24: RGB split, or bits of a palette index
  std::vector<Color>
      palette{};  ///< index mode: at most 2^color_bits entries, 0..1 each; empty: default_palette(color_bits)
  DepthFormat depth = DepthFormat::unorm24;
  int stencil_bits = 8;  ///< 0 .. 8
  int alpha_bits =
      0;  ///< 0 or 8 planes above the colour's; without them the stored alpha reads 1. RGB buffers
  Dither dither = Dither::none;
  int accumulation_bits = 0;  ///< 0, 16 or 32 for each of red, green, blue, alpha; signed. RGB buffers
  /// Coverage samples a pixel: 1, 4 or 8. With several, coverage, depth and stencil belong to each sample,
  /// and a triangle's colour comes about once for each pixel, at its centre, within the range of its vertices
  /// even where that is outside. They are kept until the frame is finished; what it stores and shows is their
  /// mean, and depth and stencil of the first; a frame that goes on from there starts from these. RGB
  /// buffers.
  int samples = 1;
};

/// Built-in palettes: "bw", "gray", "ega16", "vga256", "web216". Throws Error for another name, or more
/// entries than 2^color_bits.
TESSERA_API std::vector<Color> named_palette(std::string_view name, int color_bits);
/// bw at 1 bit, greys at 2 and 3, ega16 at 4 to 7, vga256 at 8 and more.
TESSERA_API std::vector<Color> default_palette(int color_bits);

enum class Buffer : std::uint8_t { color, depth, stencil, accumulation };
struct Camera;

/// One plane of the stack as a 1-bit image: rows from the top, bit 7 of a byte is the leftmost pixel.
/// Borrowed from the frame buffer; valid until it is drawn to or destroyed.
struct PlaneView {
  const std::uint8_t* bits = nullptr;
  int width = 0, height = 0;
  std::ptrdiff_t stride_bytes = 0;
};

/// The caller's memory for a scan-out: 4 bytes a pixel, alpha 255 or what the alpha planes hold. The first
/// row is the top of the picture, `pixels` points at it; stride_bytes may be negative (then rows go upwards
/// in memory) or larger than 4 * width.
struct ImageTarget {
  void* pixels = nullptr;
  int width = 0, height = 0;  ///< must equal the frame buffer's
  std::ptrdiff_t stride_bytes = 0;
  PixelOrder order = PixelOrder::rgba8;
  std::optional<Rect> region{};  ///< only these pixels of it (origin lower left) are written, what lies
                                 ///< outside is left out; what else the memory holds stays
};

/// A stack of bitplanes: colour, depth, stencil and accumulation, one bit for each pixel in each plane. New
/// buffers hold colour 0, depth 1, stencil 0, accumulation 0. A buffer is allocated when a frame first stores
/// something else in it.
class TESSERA_API FrameBuffer {
 public:
  /// Throws Error for sizes, bits or palettes out of range, and where memory runs out.
  explicit FrameBuffer(FrameBufferFormat format);
  /// The same in the caller's memory, which must outlive it: memory_bytes(format) of it, at a multiple of 64.
  /// There are the planes of colour, then of depth, then of stencil, then of accumulation, each as plane()
  /// shows it; they are current for buffers that the last frame kept.
  FrameBuffer(FrameBufferFormat format, std::span<std::byte> memory);
  static std::size_t memory_bytes(const FrameBufferFormat& format);
  ~FrameBuffer();
  FrameBuffer(FrameBuffer&&) noexcept;
  FrameBuffer& operator=(FrameBuffer&&) noexcept;

  const FrameBufferFormat& format() const noexcept;
  /// Index buffers: another palette, at most 2^color_bits entries, 0..1 each; empty:
  /// default_palette(color_bits). What is stored stays and shows through it; frames finished from here on
  /// look for the nearest of its entries. Throws Error for an RGB buffer, for entries out of range or too
  /// many, and where memory runs out; then nothing changed.
  void set_palette(std::span<const Color> entries);
  /// Planes of a buffer: colour bits and alpha bits, depth bits (0, 16, 24, 32), stencil bits, four times the
  /// accumulation bits; 0 of what is no Buffer.
  int plane_count(Buffer buffer) const noexcept;
  /// Bytes that the planes of a buffer take now; 0 while it is not allocated, and of what is no Buffer.
  std::size_t allocated_bytes(Buffer buffer) const noexcept;
  /// Plane k of a buffer, 0 the lowest bit (of blue, of the index, of depth); of accumulation all of red's
  /// come first, then green's, blue's and alpha's. Allocates it if need be. Throws Error for a plane that
  /// does not exist or a buffer that the last frame did not keep.
  PlaneView plane(Buffer buffer, int k) const;

  // Reading back, rows from the top; throws Error for a wrong size or a buffer that the last frame did not
  // keep.
  void read_color(
      const ImageTarget& target) const;  ///< what a display would show, through the palette; or a part of it
  void read_color_words(
      std::span<std::uint32_t> words) const;      ///< stored words A:R:G:B or indices, width * height
  void read_depth(std::span<float> depth) const;  ///< 0 near .. 1 far
  void read_depth_words(
      std::span<std::uint32_t> words) const;  ///< stored levels; the bits of the float for float32
  /// Distances from the eye's plane along the view, in the camera's units (metres), for draws with that
  /// projection and the whole depth range; `background`, which may be any float, a NaN, too, where the depth
  /// is the far end's. The camera's view has no say. Throws Error, too, for a projection by which a depth has
  /// no distance of its own: not finite, or with depths that depend on x and y, or on nothing.
  void read_view_depth(std::span<float> depth, const Camera& camera, float background = 0) const;
  void read_stencil(std::span<std::uint8_t> stencil) const;
  void read_accumulation(
      std::span<float> rgba) const;  ///< r g b a for each pixel, -1 .. 1: 4 * width * height

 private:
  friend class Renderer;
  friend class Frame;
  std::unique_ptr<detail::FrameBufferState> state_;
};

// ---- scene description
// --------------------------------------------------------------------------------------------

/// What a span may be made of without being left behind: not a temporary that owns its elements.
template <class Range, class Element>
concept BorrowableRange = std::convertible_to<Range, std::span<const Element>> &&
    (std::is_lvalue_reference_v<Range> || std::ranges::enable_borrowed_range<std::remove_cvref_t<Range>>);

/// Numbers of the vertices, in the caller's memory: packed, from anything that is a span of floats, or with a
/// stride.
struct FloatArray {
  const float* data = nullptr;
  std::size_t float_count = 0;   ///< packed: all of them
  std::size_t vertices = 0;      ///< strided: how many
  std::size_t stride_bytes = 0;  ///< from one vertex to the next, a multiple of 4; 0: packed

  constexpr FloatArray() = default;
  template <class Range>
  requires BorrowableRange<Range, float>
  constexpr FloatArray(Range&& packed) : FloatArray(std::span<const float>(packed), 0) {}
  constexpr FloatArray(const float* first, std::size_t vertex_count, std::size_t stride)
      : data(first), vertices(vertex_count), stride_bytes(stride) {}
  constexpr bool empty() const { return float_count == 0 && vertices == 0; }

 private:
  constexpr FloatArray(std::span<const float> packed, int)
      : data(packed.data()), float_count(packed.size()) {}
};

/// Colours of the vertices: r g b a as floats, or as bytes where 255 is 1.
struct ColorArray {
  FloatArray floats{};
  const std::uint8_t* bytes = nullptr;
  std::size_t byte_count = 0;    ///< packed bytes: all of them
  std::size_t vertices = 0;      ///< strided bytes: of how many vertices
  std::size_t stride_bytes = 0;  ///< of the bytes: from one vertex to the next; 0: packed

  constexpr ColorArray() = default;
  template <class Range>
  requires BorrowableRange<Range, float>
  constexpr ColorArray(Range&& packed) : floats(packed) {}
  template <class Range>
  requires BorrowableRange<Range, std::uint8_t>
  constexpr ColorArray(Range&& packed)
      : bytes(std::span<const std::uint8_t>(packed).data()),
        byte_count(std::span<const std::uint8_t>(packed).size()) {}
  constexpr ColorArray(const float* first, std::size_t vertex_count, std::size_t stride)
      : floats(first, vertex_count, stride) {}
  constexpr ColorArray(const std::uint8_t* first, std::size_t vertex_count, std::size_t stride)
      : bytes(first), vertices(vertex_count), stride_bytes(stride) {}
  constexpr bool empty() const { return floats.empty() && byte_count == 0 && vertices == 0; }
};

/// Numbers of vertices, of 16 or 32 bits.
struct IndexArray {
  const void* data = nullptr;
  std::size_t count = 0;
  int bits = 32;  ///< 16 or 32

  constexpr IndexArray() = default;
  template <class Range>
  requires BorrowableRange<Range, std::uint32_t>
  constexpr IndexArray(Range&& packed)
      : data(std::span<const std::uint32_t>(packed).data()),
        count(std::span<const std::uint32_t>(packed).size()) {}
  template <class Range>
  requires BorrowableRange<Range, std::uint16_t>
  constexpr IndexArray(Range&& packed)
      : data(std::span<const std::uint16_t>(packed).data()),
        count(std::span<const std::uint16_t>(packed).size()),
        bits(16) {}
  constexpr bool empty() const { return count == 0; }
};

/// Primitives, borrowed from the caller until the frame is finished. Arrays other than positions may be
/// empty.
struct Mesh {
  Primitive primitive = Primitive::triangles;
  FloatArray positions{};  ///< x y z, or x y z w with position_components 4
  int position_components = 3;
  /// x y z for each vertex; empty: face normals (flat) or area-weighted means, of points and lines 0 0 0
  FloatArray normals{};
  ColorArray colors{};         ///< r g b a for each vertex
  IndexArray indices{};        ///< of vertices, in the primitives' order; empty: vertices in order
  FloatArray color_indices{};  ///< one for each vertex, continuous: what unlit draws into index buffers show
                               ///< in place of colours
  FloatArray texcoords{};      ///< s t for each vertex; empty: 0 0
};

// ---- textures
// -----------------------------------------------------------------------------------------------------

inline constexpr int kMaxTextureSize = 16384;  ///< largest width and height, in texels

/// Texels in the caller's memory: 8 bits a component, 255 is 1, as they are. s runs from 0 to 1 along a row;
/// t = 0 is the lower edge of the bottom row.
struct TextureImage {
  const void* pixels = nullptr;     ///< of the top row, or of the bottom row with `bottom_row_first`
  int width = 0, height = 0;        ///< 1 .. kMaxTextureSize; one row: a 1-D texture, of which t has no say
  int channels = 4;                 ///< 1: luminance, 2: luminance and alpha, 3: red green blue, 4: and alpha
  std::ptrdiff_t stride_bytes = 0;  ///< from one row to the next; 0: without gaps
  bool bottom_row_first = false;
};

enum class TextureFilter : std::uint8_t {
  nearest,
  linear,
  nearest_mipmap_nearest,
  linear_mipmap_nearest,
  nearest_mipmap_linear,
  linear_mipmap_linear
};
struct TextureSampler {
  TextureFilter mag = TextureFilter::linear;  ///< nearest or linear
  TextureFilter min = TextureFilter::linear_mipmap_linear;
  TextureWrap wrap_s = TextureWrap::repeat, wrap_t = TextureWrap::repeat;
};

/// A texture, ready to be drawn with: a copy of its texels and, for filters with mipmaps, of all smaller
/// sizes. Each size is half the one before, rounded down, and each of its texels the mean of what it covers
/// there, rounded. Level of detail by GL 2.1, equation 3.14, from exact derivatives. Takes 4 bytes a texel, a
/// third more with mipmaps.
class TESSERA_API Texture {
 public:
  /// Throws Error for sizes, channels, strides and filters out of range, pixels that are null, and where
  /// memory runs out.
  explicit Texture(const TextureImage& image, const TextureSampler& sampler = {});
  ~Texture();
  Texture(Texture&&) noexcept;
  Texture& operator=(Texture&&) noexcept;

  int width() const noexcept;
  int height() const noexcept;
  int channels() const noexcept;
  const TextureSampler& sampler() const noexcept;

 private:
  friend class Frame;
  std::unique_ptr<detail::TextureState> state_;
};

struct Material {
  Color ambient{0.2f, 0.2f, 0.2f, 1}, diffuse{0.8f, 0.8f, 0.8f, 1}, specular{0, 0, 0, 1},
      emission{0, 0, 0, 1};
  float shininess = 0;  ///< 0 .. 16384
  /// Index buffers: ambient, diffuse, specular index (a, d, s). Lit draws then have index lighting, min(a + D
  /// (1 - S) (d - a) + S (s - a), s) with the luminances D and S of the diffuse light and the highlights;
  /// absent: the nearest palette entries to their colours.
  std::optional<std::array<float, 3>> index_ramp{};
};
/// The named materials of the lighting tables: "emerald", "polished_gold", ... Empty for an unknown name.
TESSERA_API std::optional<Material> named_material(std::string_view name);
TESSERA_API std::vector<std::string_view> material_names();

/// Defaults are OpenGL's, but every light starts white.
struct Light {
  Color ambient{0, 0, 0, 1}, diffuse{1, 1, 1, 1}, specular{1, 1, 1, 1};
  std::array<float, 4> position{0, 0, 1, 0};      ///< world space; w = 0: directional, towards the light
  std::array<float, 3> spot_direction{0, 0, -1};  ///< world space
  float spot_exponent = 0;                        ///< 0 .. 16384
  float spot_cutoff = 180;                        ///< degrees: 0 .. 90, or 180
  float attenuation_constant = 1, attenuation_linear = 0, attenuation_quadratic = 0;
};

enum class SpecularModel : std::uint8_t { blinn, phong };
struct LightModel {
  Color ambient{0.2f, 0.2f, 0.2f, 1};
  bool local_viewer = false, two_sided = false;
  SpecularModel specular = SpecularModel::blinn;
};

/// With `reversed`, the projection maps z to 0..w, near at 1, far at 0, and depth is z/w; otherwise z runs
/// -w..w. Clears and tests stay as written: a reversed depth wants a clear to 0 and Compare::greater.
struct Camera {
  Matrix view{}, projection{};
  bool reversed = false;
};
/// Far may be infinity. Each throws Error for an empty or non-finite volume.
TESSERA_API Matrix perspective(double fovy_degrees, double aspect, double near, double far,
                               bool reversed = false);
TESSERA_API Matrix frustum(double left, double right, double bottom, double top, double near, double far,
                           bool reversed = false);
TESSERA_API Matrix orthographic(double left, double right, double bottom, double top, double near, double far,
                                bool reversed = false);
/// World to world: flattens what lies between a light and the plane a x + b y + c z + d = 0 onto that plane,
/// away from the light. Throws Error for a plane without normal, and where the light lies in the plane or
/// shines along it.
TESSERA_API Matrix planar_shadow(const std::array<double, 4>& plane, const Light& light);

/// Where a camera's own axes point: opencv x right, y down, z forwards; opengl x right, y up, z backwards.
enum class CameraAxes : std::uint8_t { opencv, opengl };
/// A calibrated camera without distortion. A point (x, y, z) before it, in OpenCV's axes, falls on the pixel
/// coordinates (fx x/z + cx, fy y/z + cy), where (0, 0) is the centre of the top left pixel.
struct Intrinsics {
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< pixels; fx and fy above 0
  int width = 0, height = 0;              ///< of the picture that they are meant for, pixels
};
/// In a frame buffer of another size the picture is stretched. `camera_from_world` is the 4x4 extrinsic
/// matrix, in the given axes; near and far as in perspective(), in its units (metres). Throws Error for focal
/// lengths, sizes and volumes out of range, and a matrix that is not finite.
TESSERA_API Camera calibrated_camera(const Intrinsics& intrinsics, const Matrix& camera_from_world,
                                     double near, double far, CameraAxes axes = CameraAxes::opencv,
                                     bool reversed = false);

enum class Shading : std::uint8_t { flat, gouraud, phong };
enum class ColorMaterial : std::uint8_t { none, ambient_and_diffuse, diffuse, ambient, emission, specular };
enum class Cull : std::uint8_t { none, back, front };
enum class FrontFace : std::uint8_t { ccw, cw };

struct DepthState {
  bool enabled = true;  ///< false: neither test nor write; ignored without a depth buffer
  Compare test = Compare::less;
  bool write = true;
};

/// The test passes where (ref & mask) func (stored & mask). incr and decr stay at the ends of the buffer's
/// bits; masks are cut to them.
struct StencilFace {
  Compare func = Compare::always;
  std::uint32_t ref = 0;  ///< cut to the largest value of the buffer's bits
  std::uint32_t mask = 255;
  StencilOp fail = StencilOp::keep, zfail = StencilOp::keep,
            zpass = StencilOp::keep;  ///< the test fails; the depth test fails; both pass
  std::uint32_t write_mask = 255;
};
struct StencilState {
  StencilFace front{};
  std::optional<StencilFace> back{};  ///< of back faces; absent: as the front
};

/// In floats, with the stored colour; clamped to 0 .. 1 and rounded once. Not beside a LogicOp other than
/// copy.
struct BlendState {
  BlendFactor src = BlendFactor::src_alpha, dst = BlendFactor::one_minus_src_alpha;
  std::optional<BlendFactor> src_alpha{}, dst_alpha{};  ///< of alpha; absent: as for the colour
  BlendEquation equation = BlendEquation::add;
  Color color{0, 0, 0, 0};  ///< the constant, 0 .. 1
};
/// Passes where the fragment's alpha func ref: the material's diffuse alpha, or that of the vertex colours
/// which replace it, under the texture.
struct AlphaTest {
  Compare func = Compare::greater;
  float ref = 0.5f;  ///< 0 .. 1
};
/// Adds factor * (the polygon's largest depth slope) + units * (the format's smallest difference) to the
/// depth, which stays within 0 .. 1. Needs a depth buffer.
struct PolygonOffset {
  float factor = 0, units = 0;
};
/// In place of the object its planar_shadow(): unlit and untextured, in one colour. What else a draw has
/// stays as it is.
struct ShadowOn {
  std::array<double, 4> plane{};  ///< a b c d, world space
  std::size_t light = 0;          ///< of the frame's lights, counted from 0
  Color color{0, 0, 0, 1};
};

/// What a fragment goes through, in order: scissor, alpha test, stencil, depth, blending, dither, logic
/// operation, masks.
struct DrawState {
  Material material{};
  std::optional<Material> back_material{};  ///< two-sided lighting; absent: as the front
  Matrix transform{};                       ///< object to world
  Shading shading = Shading::gouraud;
  bool lighting = true;  ///< false: vertex colours, or the material's diffuse colour
  ColorMaterial color_material = ColorMaterial::none;  ///< lit: what of the material the vertices' colours
                                                       ///< replace; none: they are not used
  ProvokingVertex provoking_vertex = ProvokingVertex::last;
  bool normalize = true;
  const Texture* texture =
      nullptr;  ///< borrowed like the mesh; null: none. Where indices are drawn it has no say
  TextureEnv texture_env = TextureEnv::modulate;
  Color texture_env_color{0, 0, 0,
                          0};  ///< of TextureEnv::blend; counts as 0 where it is less, as 1 where it is more
  Cull cull = Cull::none;
  FrontFace front_face = FrontFace::ccw;
  PolygonMode front_mode = PolygonMode::fill, back_mode = PolygonMode::fill;
  /// In pixels, above 0; above 65536 as 65536. With one sample a pixel it is rounded, and points are squares,
  /// lines rows of pixels along x or y; with several samples points are discs, lines rectangles. A point is
  /// drawn if its centre is in the view volume. Nothing leaves the viewport. Primitives that are points or
  /// lines take no polygon offset; edges and corners of polygons do. Textures: points show level 0, lines the
  /// level of detail along them.
  float point_size = 1, line_width = 1;
  DepthState depth{};
  double depth_near = 0, depth_far = 1;  ///< depth range, each 0 .. 1
  PolygonOffset polygon_offset{};
  std::optional<AlphaTest> alpha_test{};  ///< RGB buffers
  std::optional<StencilState> stencil{};
  std::optional<BlendState> blend{};  ///< RGB buffers
  LogicOp logic_op = LogicOp::copy;
  std::array<bool, 4> color_mask{true, true, true, true};
  std::uint32_t plane_mask = 0xffffffffu;  ///< bit k: colour (then alpha) plane k may change
  std::optional<Rect> viewport{};          ///< absent: the whole buffer
  std::optional<Rect> scissor{};
  std::optional<ShadowOn> shadow_on{};
};

/// What the pixels of bitmaps and images go through: that part of a DrawState. To the stencil test they are
/// front faces.
struct FragmentState {
  DepthState depth{};
  std::optional<AlphaTest> alpha_test{};
  std::optional<StencilState> stencil{};
  std::optional<BlendState> blend{};
  LogicOp logic_op = LogicOp::copy;
  std::array<bool, 4> color_mask{true, true, true, true};
  std::uint32_t plane_mask = 0xffffffffu;
  std::optional<Rect> scissor{};
};

/// A bit pattern in one colour; bits that are 0 leave what is there. Rows from the top, bit 7 of a byte is
/// the leftmost pixel, as in a PlaneView. Borrowed until the frame is finished.
struct Bitmap {
  const std::uint8_t* bits = nullptr;
  int width = 0, height = 0;        ///< 1 .. kMaxFrameBufferSize
  std::ptrdiff_t stride_bytes = 0;  ///< from a row to the one below it; 0: (width + 7) / 8
  double x = 0, y = 0;              ///< of the lower left corner, window coordinates; rounded down
  double depth = 0;                 ///< window depth, 0 .. 1
  Color color{1, 1, 1, 1};
};

/// Pixels of 8 bits a component, rows from the top. Texel (i, j), counted from the lower left, covers what
/// lies from (x + i zoom_x, y + j zoom_y), included, to where the next one begins. Borrowed until the frame
/// is finished.
struct PixelImage {
  const std::uint8_t* pixels = nullptr;
  int width = 0, height = 0;        ///< 1 .. kMaxFrameBufferSize
  int channels = 4;                 ///< 1: grey, 2: grey and alpha, 3: r g b, 4: r g b a
  std::ptrdiff_t stride_bytes = 0;  ///< from a row to the one below it; 0: width * channels
  double x = 0, y = 0;              ///< of the lower left corner, window coordinates
  double zoom_x = 1, zoom_y = 1;    ///< pixels a texel; below 0 the image goes to the left or downwards from
                                    ///< there, at 0 there is nothing of it
  double depth = 0;                 ///< window depth, 0 .. 1
};

/// Only the buffers named are cleared, through full masks; colours with the buffer's dither.
struct Clear {
  std::optional<Color> color{};            ///< RGB buffers (0..1)
  std::optional<std::uint32_t> index{};    ///< index buffers, below 2^color_bits; `color` there clears to the
                                           ///< nearest palette entry, unless both are given
  std::optional<double> depth{};           ///< 0 .. 1
  std::optional<std::uint32_t> stencil{};  ///< below 2^stencil_bits
  std::optional<Color> accumulation{};     ///< -1 .. 1
  std::optional<Rect> scissor{};
};

/// What happens between the colour and the accumulation buffer, for whole rectangles. Components that leave
/// -1 .. 1 stay at its end; without alpha planes alpha is 1, of luminance red, green and blue are the grey.
struct Accum {
  AccumOp op = AccumOp::accum;
  double value = 1;  ///< any finite number
  std::optional<Rect> scissor{};
  std::array<bool, 4> color_mask{true, true, true, true};  ///< return_color: what of the colour may change
};

// ---- frames
// -------------------------------------------------------------------------------------------------------

/// What a frame can tell of each pixel besides its colour: for picking, and for tools. Rows from the top,
/// width * height pixels. Each costs one more pass over the tiles, and nothing where its span is empty. With
/// several samples it is what is seen at the pixel's centre, of points and lines as one sample has them; of
/// draws that blend, the last one that passed the tests. Accumulation does not change it.
struct Capture {
  static constexpr std::uint32_t kNothing = 0xffffffffu;  ///< no draw gave this pixel its colour

  std::span<std::uint32_t>
      draw_ids{};  ///< which draw of the frame, counted from 0; bitmaps and images are draws, too
  std::span<std::uint32_t> primitive_ids{};  ///< which point, line, triangle, quad or polygon of that draw's
                                             ///< mesh; 0 of bitmaps and images
  /// x y z for each pixel: the vertices' normals (in meshes without, the means of the faces'), interpolated,
  /// in eye space, of length 1; 0 0 0 where nothing was drawn, of bitmaps and images, and where they cancel
  /// out.
  std::span<float> normals{};
};

struct FrameStats {
  std::uint64_t vertices = 0;
  // "Triangles" are also those that quads and polygons consist of, lines, and points. Bitmaps and images
  // count in bin_entries alone.
  std::uint64_t triangles_in = 0;
  std::uint64_t dropped_non_finite = 0;  ///< triangles with a NaN or infinite vertex
  std::uint64_t trivially_rejected =
      0;                          ///< wholly outside the view volume, the scissor or between pixel centres
  std::uint64_t culled = 0;       ///< by facing
  std::uint64_t zero_area = 0;    ///< no area after snapping to 1/256 pixel
  std::uint64_t clipped = 0;      ///< cut by the near or far plane or the guard band
  std::uint64_t binned = 0;       ///< triangles that reached a bin, clipped pieces counted singly
  std::uint64_t bin_entries = 0;  ///< sum over the tiles of the triangles, bitmaps and images in them
  std::uint64_t bin_passes = 0;   ///< how often the triangles were sorted into tiles: more than once where
                                  ///< RendererOptions::bin_memory is small for them
  std::uint64_t tiles = 0, tiles_touched = 0;
  int tile_size = 0;  ///< pixels, as chosen for the frame
  std::uint64_t fragments =
      0;  ///< pixels covered by draws that can change one, before any test; if RendererOptions asks for it
  std::uint64_t shaded_pixels = 0;  ///< evaluations of a colour
  double plan_seconds = 0, vertex_seconds = 0, binning_seconds = 0,
         tile_seconds = 0;  ///< of each stage; tiles with scan-out and store
};

/// Stable names in kebab case, for programs: "depth-test", "no-depth-buffer". Empty for values that are no
/// enumerators.
TESSERA_API std::string_view code(Effect effect);
TESSERA_API std::string_view code(EffectReason reason);

class Renderer;

/// Records what happens in a frame, in order. Nothing is rendered until Renderer::finish. The frame buffer
/// must outlive it, may be moved, and must not be assigned to.
class TESSERA_API Frame {
 public:
  explicit Frame(FrameBuffer& target);
  /// One whose draws of large meshes go faster: where a mesh has 65,536 indices or more, the helper's workers
  /// look through them, of which the caller alone checks about 5 10^9 a second. draw() then uses the helper
  /// as finish() does, so both are for one thread at a time; in the helper's own progress callback, whose
  /// workers are busy, the caller looks alone. The helper must outlive the frame, may be moved, and must not
  /// be assigned to. Any renderer may finish the frame.
  Frame(FrameBuffer& target, Renderer& helper);
  ~Frame();
  Frame(Frame&&) noexcept;
  Frame& operator=(Frame&&) noexcept;

  // State for the draws that follow. The initial camera is the identity; the initial lights are one default
  // Light.
  void set_camera(const Camera& camera);
  void set_lights(std::span<const Light> lights);
  void set_lights(std::initializer_list<Light> lights) {
    set_lights(std::span<const Light>(lights.begin(), lights.size()));
  }
  void set_light_model(const LightModel& model);

  /// Throws Error for values out of range and for a buffer that the frame buffer does not have.
  void clear(const Clear& clear);
  /// Throws Error without an accumulation buffer and for values out of range.
  void accumulate(const Accum& accum);
  /// Throws Error for spans that do not fit together, values and indices out of range, a texture that was
  /// moved from, and a shadow that there is none of; what was recorded stays.
  void draw(const Mesh& mesh, const DrawState& state = {});
  /// Throw Error without bits or pixels and for sizes and values out of range. They know no camera and no
  /// viewport; what reaches beyond the buffer is left out.
  void draw_bitmap(const Bitmap& bitmap, const FragmentState& state = {});
  void draw_image(const PixelImage& image, const FragmentState& state = {});

  /// Which buffers the frame buffer holds afterwards; of the others those that the frame touches are not
  /// stored, and reading them is an error until they are cleared whole. Default: with an ImageTarget none,
  /// without one every buffer.
  void keep(std::initializer_list<Buffer> buffers);

  /// What finish() also writes, once. The spans are borrowed until then. Throws Error for a span of another
  /// size.
  void capture(const Capture& capture);

  /// The effects of a draw: which of them run, which are skipped, and why.
  /// @param draw_index  from 0; bitmaps and images count as draws
  /// @throws Error  if the frame has no such draw
  std::vector<EffectNote> effects(std::size_t draw_index) const;
  /// The same as text, one line per effect. Wording may change between versions; programs use effects().
  std::string explain(std::size_t draw_index) const;
  std::size_t draw_count() const noexcept;
  /// Forgets the clears, accumulations and draws, and what to keep. Camera, lights and light model stay.
  void reset() noexcept;

 private:
  friend class Renderer;
  std::unique_ptr<detail::FrameRecording> recording_;
};

/// Those that this build holds and this machine can run, best first; never empty.
TESSERA_API std::vector<InstructionSet> available_instruction_sets();
TESSERA_API std::string_view name(InstructionSet set);

/// Who runs the work of frames. The library brings two: threads of oneTBB (without one named here), and
/// serial_executor().
class TESSERA_API Executor {
 public:
  virtual ~Executor();
  /// How many workers may be busy at the same time, at least 1; always the same number. Renderers ask when
  /// they are made.
  virtual int workers() const noexcept = 0;
  /// Calls work(context, k) once for each k in 0 .. count-1, count <= workers(): in any order, at the same
  /// time or one after the other, on any threads. Returns when all of them have returned. `work` throws
  /// nothing; what run itself throws comes out of finish(), or of the draw that the renderer helps with.
  /// Frames are faster where each k is the thread's that ran it before: its share is in that thread's caches.
  /// A single renderer calls it once at a time, never from inside `work`. An executor of several renderers is
  /// called by several threads at the same time if the renderers are used by several; and where a progress
  /// callback of one renderer uses another, from inside `work`, by the thread that runs it.
  virtual void run(int count, void (*work)(void* context, int worker), void* context) = 0;
};
/// Everything on the thread that calls.
TESSERA_API std::shared_ptr<Executor> serial_executor();

enum class LogLevel : std::uint8_t { debug, info, warning };

/// What the work of a frame consists of, in this order; frames with little RendererOptions::bin_memory go
/// back from tiles to binning. Each waits for all of the one before.
enum class FrameStage : std::uint8_t {
  vertices,     ///< what indices make; normals of meshes without; positions and colours
  flat_colors,  ///< colours of whole triangles
  binning,      ///< triangles, in batches, into the lists of the tiles that they may touch
  tiles         ///< pixels
};
/// What one worker did at a stretch.
struct FrameTask {
  FrameStage stage = FrameStage::vertices;
  int worker = 0;             ///< below RendererOptions::threads
  double begin = 0, end = 0;  ///< seconds since finish() was called
  Rect pixels{};              ///< of tiles: their part of the frame, origin lower left
  int pass = 0;  ///< counts up through the frame: those of one pass may run side by side, the next one's
                 ///< begin after all of them
};

inline constexpr std::size_t kMinBinMemory = std::size_t{64} << 10;  ///< bytes

struct RendererOptions {
  int threads = 0;    ///< 0: one for each core that the process may use, or each worker of the executor, but
                      ///< 1024 at most; otherwise 1 .. 1024; no more than there are workers
  int tile_size = 0;  ///< pixels: 32, 64, 128; 0: chosen for each frame by its size and the threads
  InstructionSet instruction_set = InstructionSet::automatic;
  bool defer_shading =
      true;  ///< shade once for each visible pixel where that is cheaper; false: at once, always. Same bits.
  /// Bytes that the lists of which triangles lie in which tiles may take, at least kMinBinMemory. A frame
  /// that would need more is rendered part by part, to the same bits; that takes longer.
  std::size_t bin_memory = std::size_t{256} << 20;
  bool count_fragments = false;  ///< one more pass over the tiles, for FrameStats::fragments
  std::uint32_t task_order = 0;  ///< 0: each worker begins with a share of its own, and of tiles with those
                                 ///< that hold most; any other number: vertices, bins and tiles are worked on
                                 ///< in an order of its own. Same bits: for who wants to see that
  std::shared_ptr<Executor> executor{};  ///< absent: oneTBB's threads
  /// Called now and then while a frame runs, at the end of each stage and at most about a hundred times a
  /// second in between, on any of the threads that work, never by two of one renderer at once: `done` rises,
  /// to 1 in frames that have tiles to render. It may record frames and finish them with other renderers;
  /// finish() of its own one throws Error, and the frame that runs must be left alone. Where it returns
  /// false, it is not called again and finish() throws Cancelled; where it throws, finish() throws that
  /// (std::bad_alloc as Error). The frame buffer then holds what it held before, but for tiles of the buffers
  /// kept that were done already; images and captures may be written in part. Finishing the frame after all
  /// gives its picture if it starts with clears of the whole.
  std::function<bool(double done)> progress{};
  /// What the library has to say; it never prints. Called by the thread that calls the Renderer. What it
  /// throws comes out there; a frame is then rendered, and still recorded.
  std::function<void(LogLevel level, std::string_view message)> log{};
  /// For profilers: what a frame's workers did when, in the order in which it began. Called as `log` is, at
  /// the end of each frame; with nothing where there is no memory for it.
  std::function<void(std::span<const FrameTask> tasks)> trace{};
};

/// Owns the working memory of frames in flight and the threads' arena. Create once, use for many frames and
/// frame buffers.
class TESSERA_API Renderer {
 public:
  /// Throws Error for options out of range or an instruction set that this machine cannot run.
  explicit Renderer(RendererOptions options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Runs the frame. It is empty afterwards and may be recorded anew; camera, lights and light model stay. If
  /// this throws, the frame is still recorded: it may be finished again, or reset.
  FrameStats finish(Frame& frame);
  /// Runs the frame and scans the colour buffer out into the caller's memory, straight from the tiles.
  FrameStats finish(Frame& frame, const ImageTarget& target);

  const RendererOptions& options()
      const noexcept;  ///< with the threads and the instruction set that were chosen

 private:
  friend class Frame;
  std::unique_ptr<detail::RendererState> state_;
};

}  // namespace tessera
