// Table of every number in the structs of the interface: its location, the values that are rejected, and the
// call that rejects them. A struct that gains a member fails to compile here; add the member's row next to
// the others of the struct.
#pragma once

#include <cstdio>
#include <functional>
#include <type_traits>

#include "tests/numerics/interface_case.h"
#include "tests/numerics/odd_values.h"

namespace tessera::test {

enum class Verdict { fine, refused, either };

/// One number and the odd values it is tested with.
struct Field {
  std::string name;
  const char* call;  ///< the call that rejects it
  std::size_t values = 0;
  std::function<bool(InterfaceCase&, std::size_t)> set;  ///< returns false if the case has no such number
  std::function<Verdict(std::size_t)> verdict;
  std::function<std::vector<std::string>(std::size_t)> found;  ///< spellings of the value in a message
};

template <class T>
std::vector<std::string> texts_of(T value) {
  char shortest[64];
  std::snprintf(shortest, sizeof shortest, "%.9g", static_cast<double>(value));
  return {std::to_string(value), shortest};
}

/// @param at InterfaceCase& -> T*, null if the case has no such number
template <class T, class At, class Rule>
Field field(std::string name, const char* call, const At& at, const Rule& rule,
            const std::vector<T>& values) {
  return {std::move(name),
          call,
          values.size(),
          [=](InterfaceCase& world, std::size_t i) {
            T* const place = at(world);
            if (place != nullptr) *place = values[i];
            return place != nullptr;
          },
          [=](std::size_t i) { return rule(values[i]); },
          [=](std::size_t i) {
            if constexpr (std::is_enum_v<T>) return texts_of(static_cast<unsigned>(values[i]));
            else return texts_of(values[i]);
          }};
}
template <class At>
using NumberAt = std::remove_pointer_t<std::invoke_result_t<At, InterfaceCase&>>;

class Fields {
 public:
  std::vector<Field> all;

  template <class At, class Rule>
  void number(const std::string& name, const char* call, const At& at, const Rule& rule) {
    all.push_back(field<NumberAt<At>>(name, call, at, rule, odd_values<NumberAt<At>>()));
  }
  template <class At, class Rule>
  void number(const std::string& name, const char* call, const At& at, const Rule& rule,
              const std::vector<NumberAt<At>>& values) {
    all.push_back(field<NumberAt<At>>(name, call, at, rule, values));
  }
  /// Several numbers, each in turn.
  template <class At, class Rule>
  void numbers(const std::string& name, const char* call, int count, const At& at, const Rule& rule) {
    for (int i = 0; i < count; ++i)
      number(
          name + "[" + std::to_string(i) + "]", call,
          [at, i](InterfaceCase& w) {
            auto* first = at(w);
            return first == nullptr ? nullptr : first + i;
          },
          rule);
  }
  template <class At, class Rule>
  void color(const std::string& name, const char* call, const At& at, const Rule& rule) {
    numbers(
        name, call, 4,
        [at](InterfaceCase& w) {
          Color* const c = at(w);
          return c == nullptr ? nullptr : &c->r;
        },
        rule);
  }
  /// An enumeration: values beyond its last enumerator.
  template <class At>
  void choice(const std::string& name, const char* call, const At& at, NumberAt<At> last) {
    using Enum = NumberAt<At>;
    const unsigned beyond = static_cast<unsigned>(last) + 1;
    all.push_back(field<Enum>(name, call, at, [](Enum) { return Verdict::refused; },
                              {static_cast<Enum>(beyond), static_cast<Enum>(127), static_cast<Enum>(255)}));
  }
  /// @param at  InterfaceCase& -> std::optional<Rect>*
  template <class At, class Position, class Size>
  void rect(const std::string& name, const char* call, const At& at, const Position& position,
            const Size& size) {
    const auto part = [at](int Rect::*member) {
      return [at, member](InterfaceCase& w) -> int* {
        std::optional<Rect>* const rect = at(w);
        return rect != nullptr && *rect ? &((**rect).*member) : nullptr;
      };
    };
    number(name + ".x", call, part(&Rect::x), position);
    number(name + ".y", call, part(&Rect::y), position);
    number(name + ".width", call, part(&Rect::width), size);
    number(name + ".height", call, part(&Rect::height), size);
  }
};

// Rules.
inline Verdict anything(double) { return Verdict::fine; }
inline Verdict finite(double v) { return std::isfinite(v) ? Verdict::fine : Verdict::refused; }
inline Verdict above_zero(double v) { return std::isfinite(v) && v > 0 ? Verdict::fine : Verdict::refused; }
inline auto within(double low, double high) {
  return [=](double v) { return v >= low && v <= high ? Verdict::fine : Verdict::refused; };
}
/// Rejected if not finite; finite values may yield a degenerate shadow.
inline Verdict finite_for_shadow(double v) { return std::isfinite(v) ? Verdict::either : Verdict::refused; }
inline Verdict cutoff(double v) { return v == 180 ? Verdict::fine : within(0, 90)(v); }
inline Verdict not_negative(double v) { return v >= 0 ? Verdict::fine : Verdict::refused; }

inline void add_material(Fields& f, const std::string& name,
                         const std::function<Material*(InterfaceCase&)>& at) {
  const auto part = [at](auto member) {
    return [at, member](InterfaceCase& w) {
      Material* const m = at(w);
      return m == nullptr ? nullptr : &(m->*member);
    };
  };
  [[maybe_unused]] const auto know = [](const Material& m) {
    [[maybe_unused]] const auto& [ambient, diffuse, specular, emission, shininess, index_ramp] = m;
  };
  f.color(name + ".ambient", "Frame::draw", part(&Material::ambient), finite);
  f.color(name + ".diffuse", "Frame::draw", part(&Material::diffuse), finite);
  f.color(name + ".specular", "Frame::draw", part(&Material::specular), finite);
  f.color(name + ".emission", "Frame::draw", part(&Material::emission), finite);
  f.number(name + ".shininess", "Frame::draw", part(&Material::shininess), within(0, 16384));
  f.numbers(
      name + ".index_ramp", "Frame::draw", 3,
      [at](InterfaceCase& w) {
        Material* const m = at(w);
        return m == nullptr || !m->index_ramp ? nullptr : m->index_ramp->data();
      },
      finite);
}

inline void add_lights(Fields& f) {
  [[maybe_unused]] const auto know = [](const Light& l, const LightModel& m) {
    [[maybe_unused]] const auto& [ambient, diffuse, specular, position, spot_direction, spot_exponent,
                                  spot_cutoff, constant, linear, quadratic] = l;
    [[maybe_unused]] const auto& [scene_ambient, local_viewer, two_sided, highlight] = m;
  };
  for (const std::size_t i : {0, 1}) {
    const std::string name = "lights[" + std::to_string(i) + "]";
    constexpr const char* kCall = "Frame::set_lights";
    f.color(
        name + ".ambient", kCall, [i](InterfaceCase& w) { return &w.lights[i].ambient; }, finite);
    f.color(
        name + ".diffuse", kCall, [i](InterfaceCase& w) { return &w.lights[i].diffuse; }, finite);
    f.color(
        name + ".specular", kCall, [i](InterfaceCase& w) { return &w.lights[i].specular; }, finite);
    f.numbers(
        name + ".position", kCall, 4, [i](InterfaceCase& w) { return w.lights[i].position.data(); }, finite);
    f.numbers(
        name + ".spot_direction", kCall, 3,
        [i](InterfaceCase& w) { return w.lights[i].spot_direction.data(); }, finite);
    f.number(
        name + ".spot_exponent", kCall, [i](InterfaceCase& w) { return &w.lights[i].spot_exponent; },
        within(0, 16384));
    f.number(
        name + ".spot_cutoff", kCall, [i](InterfaceCase& w) { return &w.lights[i].spot_cutoff; }, cutoff);
    f.number(
        name + ".attenuation_constant", kCall,
        [i](InterfaceCase& w) { return &w.lights[i].attenuation_constant; }, finite);
    f.number(
        name + ".attenuation_linear", kCall,
        [i](InterfaceCase& w) { return &w.lights[i].attenuation_linear; }, finite);
    f.number(
        name + ".attenuation_quadratic", kCall,
        [i](InterfaceCase& w) { return &w.lights[i].attenuation_quadratic; }, finite);
  }
  f.color(
      "light_model.ambient", "Frame::set_light_model", [](InterfaceCase& w) { return &w.model.ambient; },
      finite);
  f.choice(
      "light_model.specular", "Frame::set_light_model", [](InterfaceCase& w) { return &w.model.specular; },
      SpecularModel::phong);
}

inline void add_clear_and_accum(Fields& f) {
  [[maybe_unused]] const auto know = [](const Clear& c, const Accum& a) {
    [[maybe_unused]] const auto& [color, index, depth, stencil, accumulation, scissor] = c;
    [[maybe_unused]] const auto& [op, value, accum_scissor, color_mask] = a;
  };
  const auto optional = [](auto& o) { return o ? &*o : nullptr; };
  f.color(
      "clear.color", "Frame::clear", [=](InterfaceCase& w) { return optional(w.clear.color); }, within(0, 1));
  f.number(
      "clear.index", "Frame::clear", [=](InterfaceCase& w) { return optional(w.clear.index); },
      within(0, 255));
  f.number(
      "clear.depth", "Frame::clear", [=](InterfaceCase& w) { return optional(w.clear.depth); }, within(0, 1));
  f.number(
      "clear.stencil", "Frame::clear", [=](InterfaceCase& w) { return optional(w.clear.stencil); },
      within(0, 31));
  f.color(
      "clear.accumulation", "Frame::clear", [=](InterfaceCase& w) { return optional(w.clear.accumulation); },
      within(-1, 1));
  f.rect(
      "clear.scissor", "Frame::clear", [](InterfaceCase& w) { return &w.clear.scissor; }, anything,
      not_negative);
  f.number(
      "accum.value", "Frame::accumulate",
      [](InterfaceCase& w) { return w.accum ? &w.accum->value : nullptr; }, finite);
  f.choice(
      "accum.op", "Frame::accumulate", [](InterfaceCase& w) { return w.accum ? &w.accum->op : nullptr; },
      AccumOp::return_color);
  f.rect(
      "accum.scissor", "Frame::accumulate",
      [](InterfaceCase& w) { return w.accum ? &w.accum->scissor : nullptr; }, anything, not_negative);
}

/// Fields that draws, bitmaps and images have in common.
template <class StateAt>
void add_fragments(Fields& f, const std::string& name, const char* call, const StateAt& at) {
  [[maybe_unused]] const auto know = [](const FragmentState& s, const DepthState& d, const AlphaTest& a,
                                        const StencilState& st, const StencilFace& sf, const BlendState& b) {
    [[maybe_unused]] const auto& [depth, alpha_test, stencil, blend, logic_op, color_mask, plane_mask,
                                  scissor] = s;
    [[maybe_unused]] const auto& [enabled, test, write] = d;
    [[maybe_unused]] const auto& [func, ref] = a;
    [[maybe_unused]] const auto& [front, back] = st;
    [[maybe_unused]] const auto& [stencil_func, stencil_ref, mask, fail, zfail, zpass, write_mask] = sf;
    [[maybe_unused]] const auto& [src, dst, src_alpha, dst_alpha, equation, color] = b;
  };
  f.choice(
      name + ".depth.test", call, [at](InterfaceCase& w) { return &at(w).depth.test; }, Compare::always);
  f.number(
      name + ".alpha_test.ref", call,
      [at](InterfaceCase& w) { return at(w).alpha_test ? &at(w).alpha_test->ref : nullptr; }, within(0, 1));
  f.choice(
      name + ".alpha_test.func", call,
      [at](InterfaceCase& w) { return at(w).alpha_test ? &at(w).alpha_test->func : nullptr; },
      Compare::always);
  for (const bool back : {false, true}) {
    const std::string face_name = name + (back ? ".stencil.back" : ".stencil.front");
    const auto face = [at, back](InterfaceCase& w) -> StencilFace* {
      auto& stencil = at(w).stencil;
      if (!stencil) return nullptr;
      if (!back) return &stencil->front;
      return stencil->back ? &*stencil->back : nullptr;
    };
    const auto part = [face](auto member) {
      return [face, member](InterfaceCase& w) {
        StencilFace* const s = face(w);
        return s == nullptr ? nullptr : &(s->*member);
      };
    };
    f.number(face_name + ".ref", call, part(&StencilFace::ref), anything);
    f.number(face_name + ".mask", call, part(&StencilFace::mask), anything);
    f.number(face_name + ".write_mask", call, part(&StencilFace::write_mask), anything);
    f.choice(face_name + ".func", call, part(&StencilFace::func), Compare::always);
    f.choice(face_name + ".fail", call, part(&StencilFace::fail), StencilOp::decr_wrap);
    f.choice(face_name + ".zfail", call, part(&StencilFace::zfail), StencilOp::decr_wrap);
    f.choice(face_name + ".zpass", call, part(&StencilFace::zpass), StencilOp::decr_wrap);
  }
  f.color(
      name + ".blend.color", call,
      [at](InterfaceCase& w) { return at(w).blend ? &at(w).blend->color : nullptr; }, within(0, 1));
  f.choice(
      name + ".blend.src", call, [at](InterfaceCase& w) { return at(w).blend ? &at(w).blend->src : nullptr; },
      BlendFactor::src_alpha_saturate);
  f.choice(
      name + ".blend.dst", call, [at](InterfaceCase& w) { return at(w).blend ? &at(w).blend->dst : nullptr; },
      BlendFactor::src_alpha_saturate);
  f.choice(
      name + ".blend.src_alpha", call,
      [at](InterfaceCase& w) { return at(w).blend ? &at(w).blend->src_alpha.emplace() : nullptr; },
      BlendFactor::src_alpha_saturate);
  f.choice(
      name + ".blend.dst_alpha", call,
      [at](InterfaceCase& w) { return at(w).blend ? &at(w).blend->dst_alpha.emplace() : nullptr; },
      BlendFactor::src_alpha_saturate);
  f.choice(
      name + ".blend.equation", call,
      [at](InterfaceCase& w) { return at(w).blend ? &at(w).blend->equation : nullptr; }, BlendEquation::max);
  f.choice(
      name + ".logic_op", call, [at](InterfaceCase& w) { return at(w).blend ? nullptr : &at(w).logic_op; },
      LogicOp::set);
  f.number(
      name + ".plane_mask", call, [at](InterfaceCase& w) { return &at(w).plane_mask; }, anything);
  f.rect(
      name + ".scissor", call, [at](InterfaceCase& w) { return &at(w).scissor; }, anything, not_negative);
}

/// The whole table (odd_draw_fields.cpp).
std::vector<Field> all_fields();

}  // namespace tessera::test
