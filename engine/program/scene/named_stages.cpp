#include "engine/program/scene/named_stages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "framebuffer/exact_functions.h"

namespace tessera::program {
namespace {

using json::Object;
using json::Value;

/// Colours at equal distances, linear in between.
class Gradient {
 public:
  explicit Gradient(const Object& object) {
    const auto colors = object.find("colors");
    if (!colors) return;
    if (!colors->json().is_array() || colors->size() < 2) colors->fail("an array of at least two colors");
    colors_.clear();
    for (std::size_t i = 0; i < colors->size(); ++i) colors_.push_back(colors->element(i).color(0, 1));
  }
  /// The colour at `t`, clamped to 0 to 1. NaN counts as 0.
  Color at(float t) const {
    const float at_most_one = t > 0 ? std::min(t, 1.0f) : 0.0f;
    const float place = at_most_one * static_cast<float>(colors_.size() - 1);
    const auto first = std::min(static_cast<std::size_t>(place), colors_.size() - 2);
    const float rest = place - static_cast<float>(first);
    const Color &a = colors_[first], &b = colors_[first + 1];
    const auto mix = [rest](float from, float to) { return std::fma(rest, to - from, from); };
    return {mix(a.r, b.r), mix(a.g, b.g), mix(a.b, b.b), mix(a.a, b.a)};
  }

 private:
  std::vector<Color> colors_{{1, 0, 0, 1}, {1, 1, 0, 1}, {0, 1, 0, 1}, {0, 1, 1, 1}, {0, 0, 1, 1}};
};

/// Colours of the vertices, over the height of the mesh.
class GradientObjectY : public NamedStage {
 public:
  GradientObjectY(const Value& value, const MeshData& mesh) : gradient_(Object(value, {"name", "colors"})) {
    const auto components = static_cast<std::size_t>(mesh.position_components);
    low_ = high_ = mesh.positions.size() > 1 ? mesh.positions[1] : 0;
    for (std::size_t i = 1; i < mesh.positions.size(); i += components) {
      low_ = std::min(low_, mesh.positions[i]);
      high_ = std::max(high_, mesh.positions[i]);
    }
  }
  VertexStage vertex_stage() const override { return {.reads = {.object = true}, .writes = {.color = true}}; }
  bool has_vertices() const override { return true; }
  void run(const VertexBlock& block, std::size_t) const override {
    for (std::size_t i = 0; i < block.count; ++i) {
      const Color c = gradient_.at((block.object[1][i] - low_) / (high_ - low_));
      block.color[0][i] = c.r;
      block.color[1][i] = c.g;
      block.color[2][i] = c.b;
      block.color[3][i] = c.a;
    }
  }

 private:
  Gradient gradient_;
  float low_, high_;
};

/// Multiplies colours by a gradient over the window, from the bottom to the top.
class GradientScreenY : public NamedStage {
 public:
  explicit GradientScreenY(const Value& value) : gradient_(Object(value, {"name", "colors"})) {}
  FragmentStage fragment_stage() const override { return {.reads = {.position = true, .color = true}}; }
  bool has_fragments() const override { return true; }
  void run(const FragmentBlock& block, std::size_t) const override {
    const float height = static_cast<float>(block.frame_height);
    for (std::size_t i = 0; i < block.count; ++i) {
      const Color c = gradient_.at(block.y[i] / height);
      block.color[0][i] *= c.r;
      block.color[1][i] *= c.g;
      block.color[2][i] *= c.b;
      block.color[3][i] *= c.a;
    }
  }

 private:
  Gradient gradient_;
};

/// Discards fragments to the right of a share of the window's width.
class Uncover : public NamedStage {
 public:
  explicit Uncover(const Value& value)
      : amount_(Object(value, {"name", "amount"}).require("amount").real(0, 1)) {}
  FragmentStage fragment_stage() const override {
    return {.reads = {.position = true, .color = true}, .discards = true};
  }
  bool has_fragments() const override { return true; }
  void run(const FragmentBlock& block, std::size_t) const override {
    const float edge = amount_ * static_cast<float>(block.frame_width);
    for (std::size_t i = 0; i < block.count; ++i) block.keep[i] &= block.x[i] <= edge ? 1 : 0;
  }

 private:
  float amount_;
};

/// Negates z in clip space.
class ReverseClipZ : public NamedStage {
 public:
  VertexStage vertex_stage() const override { return {.reads = {.clip = true}, .writes = {.clip = true}}; }
  bool has_vertices() const override { return true; }
  void run(const VertexBlock& block, std::size_t) const override {
    for (std::size_t i = 0; i < block.count; ++i) block.clip[2][i] = -block.clip[2][i];
  }
};

/// Stores 1 - depth.
class ReverseWindowZ : public NamedStage {
 public:
  FragmentStage fragment_stage() const override {
    return {.reads = {.depth = true, .color = true}, .writes_depth = true};
  }
  bool has_fragments() const override { return true; }
  void run(const FragmentBlock& block, std::size_t) const override {
    for (std::size_t i = 0; i < block.count; ++i) block.depth[i] = 1 - block.depth[i];
  }
};

/// Multiplies x and y in clip space.
class Zoom : public NamedStage {
 public:
  explicit Zoom(const Value& value) : factor_(Object(value, {"name", "factor"}).require("factor").number()) {}
  VertexStage vertex_stage() const override { return {.reads = {.clip = true}, .writes = {.clip = true}}; }
  bool has_vertices() const override { return true; }
  void run(const VertexBlock& block, std::size_t) const override {
    for (std::size_t axis = 0; axis < 2; ++axis)
      for (std::size_t i = 0; i < block.count; ++i) block.clip[axis][i] *= factor_;
  }

 private:
  double factor_;
};

/// Multiplies colours by 1 / d^exponent, with d the distance from a point in world space.
class Falloff : public NamedStage {
 public:
  Falloff(const Value& value, const Matrix& transform) : transform_(transform) {
    const Object object(value, {"name", "from", "exponent"});
    const Vec3 from = object.require("from").vec3();
    from_ = {from.x, from.y, from.z};
    exponent_ = object.require("exponent").number(0, 64);
  }
  VertexStage vertex_stage() const override { return {.reads = {.object = true}, .extras = 3}; }
  FragmentStage fragment_stage() const override { return {.reads = {.color = true, .extras = 3}}; }
  bool has_vertices() const override { return true; }
  bool has_fragments() const override { return true; }
  /// Passes on the vector from the point to the vertex.
  void run(const VertexBlock& block, std::size_t extras) const override {
    const auto& m = transform_.m;
    for (std::size_t i = 0; i < block.count; ++i) {
      const double x = block.object[0][i], y = block.object[1][i], z = block.object[2][i];
      const double object_w = block.object[3][i];
      const auto row = [&](std::size_t r) {
        return m[4 * r] * x + m[4 * r + 1] * y + m[4 * r + 2] * z + m[4 * r + 3] * object_w;
      };
      const double w = row(3);
      for (std::size_t c = 0; c < 3; ++c)
        block.extras[extras + c][i] = static_cast<float>(row(c) / (w != 0 ? w : 1) - from_[c]);
    }
  }
  void run(const FragmentBlock& block, std::size_t extras) const override {
    for (std::size_t i = 0; i < block.count; ++i) {
      const double x = block.extras[extras][i], y = block.extras[extras + 1][i];
      const double z = block.extras[extras + 2][i];
      const float factor = factor_at(x * x + y * y + z * z);
      for (std::size_t c = 0; c < 3; ++c) block.color[c][i] *= factor;
    }
  }

 private:
  /// d^-p = e^(-p/2 ln d^2). At the point itself, the largest factor that is used.
  float factor_at(double squared) const {
    constexpr double kLargest = 1e6;
    if (exponent_ == 0) return 1;
    if (!(squared > 1e-30)) return static_cast<float>(kLargest);
    const double power = -exponent_ / 2 * detail::natural_log(squared);
    return static_cast<float>(power > 13.8 ? kLargest : detail::exponential(power));
  }

  Matrix transform_;
  std::array<double, 3> from_{};
  double exponent_ = 0;
};

std::unique_ptr<NamedStage> read_reverse_z(const Value& value) {
  enum class Space : std::uint8_t { clip, window };
  const Space space = Object(value, {"name", "space"})
                          .require("space")
                          .choice<Space>({{"clip", Space::clip}, {"window", Space::window}});
  if (space == Space::clip) return std::make_unique<ReverseClipZ>();
  return std::make_unique<ReverseWindowZ>();
}

enum class StageName : std::uint8_t {
  gradient_object_y,
  gradient_screen_y,
  uncover,
  reverse_z,
  zoom,
  falloff
};

StageName read_name(const Value& value) {
  if (!value.json().is_object() || !value.json().contains("name"))
    value.fail("an object with the \"name\" of a stage");
  return value.member("name").choice<StageName>({{"gradient_object_y", StageName::gradient_object_y},
                                                 {"gradient_screen_y", StageName::gradient_screen_y},
                                                 {"uncover", StageName::uncover},
                                                 {"reverse_z", StageName::reverse_z},
                                                 {"zoom", StageName::zoom},
                                                 {"falloff", StageName::falloff}});
}

std::unique_ptr<NamedStage> read_stage(const Value& value, const MeshData& mesh, const Matrix& transform) {
  switch (read_name(value)) {
    case StageName::gradient_object_y: return std::make_unique<GradientObjectY>(value, mesh);
    case StageName::gradient_screen_y: return std::make_unique<GradientScreenY>(value);
    case StageName::uncover: return std::make_unique<Uncover>(value);
    case StageName::reverse_z: return read_reverse_z(value);
    case StageName::zoom: return std::make_unique<Zoom>(value);
    default: return std::make_unique<Falloff>(value, transform);
  }
}

void merge(VertexValues& to, const VertexValues& from) {
  to.object |= from.object;
  to.eye |= from.eye;
  to.clip |= from.clip;
  to.normal |= from.normal;
  to.color |= from.color;
  to.texcoord |= from.texcoord;
}

void append_name(std::string& names, const std::string& name) { names += (names.empty() ? "" : ", ") + name; }

}  // namespace

NamedStages::NamedStages(const Value& value, const MeshData& mesh, const Matrix& transform) {
  FragmentValues& reads = fragment_stage_.reads;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const Value element = value.element(i);
    Placed placed{read_stage(element, mesh, transform), static_cast<std::size_t>(vertex_stage_.extras)};
    const std::string name = element.member("name").text();
    if (placed.stage->has_vertices()) {
      const VertexStage vertices = placed.stage->vertex_stage();
      merge(vertex_stage_.reads, vertices.reads);
      merge(vertex_stage_.writes, vertices.writes);
      vertex_stage_.extras += vertices.extras;
      append_name(vertex_names_, name);
    }
    if (placed.stage->has_fragments()) {
      const FragmentStage fragments = placed.stage->fragment_stage();
      reads.position |= fragments.reads.position;
      reads.depth |= fragments.reads.depth;
      fragment_stage_.writes_depth |= fragments.writes_depth;
      fragment_stage_.discards |= fragments.discards;
      append_name(fragment_names_, name);
    }
    if (vertex_stage_.extras > kMaxExtras)
      element.refuse("the stages of this draw need more than " + std::to_string(kMaxExtras) +
                     " extra varyings");
    stages_.push_back(std::move(placed));
  }
  reads.color = true;
  if (!fragment_names_.empty()) reads.extras = vertex_stage_.extras;
}

void NamedStages::attach(DrawState& state) const {
  if (!vertex_names_.empty()) {
    state.vertex_stage = vertex_stage_;
    state.vertex_stage->name = vertex_names_.c_str();
    state.vertex_stage->data = const_cast<NamedStages*>(this);
    state.vertex_stage->run = [](const VertexBlock& block, void* data) {
      for (const Placed& placed : static_cast<const NamedStages*>(data)->stages_)
        placed.stage->run(block, placed.extras);
    };
    const bool is_lit_by_material = state.lighting && state.color_material == ColorMaterial::none;
    if (vertex_stage_.writes.color && is_lit_by_material)
      state.color_material = ColorMaterial::ambient_and_diffuse;
  }
  if (fragment_names_.empty()) return;
  state.fragment_stage = fragment_stage_;
  state.fragment_stage->name = fragment_names_.c_str();
  state.fragment_stage->data = const_cast<NamedStages*>(this);
  state.fragment_stage->run = [](const FragmentBlock& block, void* data) {
    for (const Placed& placed : static_cast<const NamedStages*>(data)->stages_)
      placed.stage->run(block, placed.extras);
  };
}

}  // namespace tessera::program
