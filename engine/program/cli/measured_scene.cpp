#include "engine/program/cli/measured_scene.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include <nlohmann/json.hpp>

namespace tessera::program::cli {
namespace {

void add(DrawMeasurement& sum, const DrawMeasurement& draw) {
  sum.vertex_seconds += draw.vertex_seconds;
  sum.binning_seconds += draw.binning_seconds;
  sum.tile_seconds += draw.tile_seconds;
  sum.vertex_batches += draw.vertex_batches;
  sum.tiles += draw.tiles;
  sum.shaded_pixels += draw.shaded_pixels;
  sum.fragments += draw.fragments;
}

bool is_about(const EffectNote& note, const LeftOutEffect& effect) {
  return note.effect == effect.effect && note.light == effect.light && note.back_faces == effect.back_faces;
}

/// The effects that a draw leaves out. An effect with several notes is left out if none of them is active.
std::vector<LeftOutEffect> left_out_of(const std::vector<EffectNote>& notes) {
  std::vector<LeftOutEffect> effects;
  for (const EffectNote& note : notes) {
    if (note.active) continue;
    const LeftOutEffect effect{.effect = note.effect,
                               .light = note.light,
                               .back_faces = note.back_faces,
                               .reasons = {note.reason},
                               .draw_count = 1};
    const auto runs = [&](const EffectNote& other) { return other.active && is_about(other, effect); };
    const auto is_listed = [&](const LeftOutEffect& other) { return is_about(note, other); };
    if (std::none_of(notes.begin(), notes.end(), runs) &&
        std::none_of(effects.begin(), effects.end(), is_listed))
      effects.push_back(effect);
  }
  return effects;
}

/// Adds an effect that a draw leaves out to those of the scene.
void add_left_out(std::vector<LeftOutEffect>& scene, const LeftOutEffect& effect,
                  const DrawMeasurement& draw) {
  auto found = std::find_if(scene.begin(), scene.end(), [&](const LeftOutEffect& other) {
    return effect.effect == other.effect && effect.light == other.light &&
           effect.back_faces == other.back_faces;
  });
  if (found == scene.end()) found = scene.insert(scene.end(), effect);
  else ++found->draw_count;
  const EffectReason reason = effect.reasons.front();
  if (std::find(found->reasons.begin(), found->reasons.end(), reason) == found->reasons.end())
    found->reasons.push_back(reason);
  add(found->draws, draw);
}

double share(double part, double all) { return all > 0 ? part / all : 0; }
double share(std::uint64_t part, std::uint64_t all) {
  return share(static_cast<double>(part), static_cast<double>(all));
}

std::string milliseconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f ms", 1e3 * seconds);
  return text;
}

std::string percent_text(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %%", 100 * share);
  return text;
}

std::string name_of(const LeftOutEffect& effect) {
  std::string name(code(effect.effect));
  if (effect.light >= 0)
    name = "light " + std::to_string(effect.light) + (effect.effect == Effect::light ? "" : " " + name);
  if (effect.back_faces) name += ", back faces";
  return name;
}

}  // namespace

MeasuredScene measure(const Scene& scene, int threads) {
  FrameBuffer buffer(scene.framebuffer);
  const auto width = static_cast<std::size_t>(scene.framebuffer.width);
  std::vector<std::uint8_t> image(4 * width * static_cast<std::size_t>(scene.framebuffer.height));
  const ImageTarget target{.pixels = image.data(),
                           .width = scene.framebuffer.width,
                           .height = scene.framebuffer.height,
                           .stride_bytes = static_cast<std::ptrdiff_t>(4 * width)};
  Frame frame(buffer);
  // Returns the wall time.
  const auto render = [&](Renderer& renderer) {
    frame.reset();
    record(scene, frame);
    const auto begin = std::chrono::steady_clock::now();
    renderer.finish(frame, target);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  record(scene, frame);
  std::vector<std::vector<EffectNote>> notes;
  for (std::size_t d = 0; d < frame.draw_count(); ++d) notes.push_back(frame.effects(d));
  Renderer counting({.threads = threads, .debug = {.count_fragments = true, .measure_draws = true}});
  render(counting);
  Renderer renderer({.threads = threads, .debug = {.measure_draws = true}});
  render(renderer);  // allocates memory
  MeasuredScene measured{.threads = renderer.options().threads,
                         .instruction_set = renderer.options().instruction_set,
                         .frame_seconds = render(renderer)};
  for (std::size_t d = 0; d < notes.size(); ++d) {
    DrawMeasurement draw = renderer.draw_measurements()[d];
    draw.fragments = counting.draw_measurements()[d].fragments;
    for (const LeftOutEffect& effect : left_out_of(notes[d])) add_left_out(measured.left_out, effect, draw);
    add(measured.all_draws, draw);
    measured.draws.push_back(draw);
  }
  return measured;
}

std::string measured_text(const DrawMeasurement& draw) {
  return "  measured: vertices " + milliseconds_text(draw.vertex_seconds) + ", binning " +
         milliseconds_text(draw.binning_seconds) + ", tiles " + milliseconds_text(draw.tile_seconds) + "; " +
         std::to_string(draw.vertex_batches) + " batches of vertices, " + std::to_string(draw.tiles) +
         " tiles, " + std::to_string(draw.fragments) + " pixels covered, " +
         std::to_string(draw.shaded_pixels) + " shaded";
}

std::string measured_text(const MeasuredScene& measured) {
  const DrawMeasurement& all = measured.all_draws;
  std::string text = "measured: " + milliseconds_text(measured.frame_seconds) + " with " +
                     std::to_string(measured.threads) + (measured.threads == 1 ? " thread" : " threads") +
                     "\nleft out:\n";
  for (const LeftOutEffect& effect : measured.left_out) {
    text += "  " + name_of(effect) + " (";
    for (const EffectReason reason : effect.reasons)
      text += (reason == effect.reasons.front() ? "" : ", ") + std::string(code(reason));
    text += "): " + std::to_string(effect.draw_count) + " of " + std::to_string(measured.draws.size()) +
            (measured.draws.size() == 1 ? " draw, " : " draws, ") +
            percent_text(share(effect.draws.vertex_batches, all.vertex_batches)) + " of batches, " +
            percent_text(share(effect.draws.tiles, all.tiles)) + " of tiles, " +
            percent_text(share(effect.draws.fragments, all.fragments)) + " of covered and " +
            percent_text(share(effect.draws.shaded_pixels, all.shaded_pixels)) + " of shaded pixels\n";
  }
  if (measured.left_out.empty()) text += "  nothing\n";
  return text;
}

nlohmann::ordered_json measured_json(const DrawMeasurement& draw) {
  return {{"vertex_ms", 1e3 * draw.vertex_seconds},
          {"binning_ms", 1e3 * draw.binning_seconds},
          {"tile_ms", 1e3 * draw.tile_seconds},
          {"vertex_batches", draw.vertex_batches},
          {"tiles", draw.tiles},
          {"covered_pixels", draw.fragments},
          {"shaded_pixels", draw.shaded_pixels}};
}

nlohmann::ordered_json measured_json(const MeasuredScene& measured) {
  const DrawMeasurement& all = measured.all_draws;
  nlohmann::ordered_json json{{"threads", measured.threads},
                              {"instruction_set", name(measured.instruction_set)},
                              {"frame_ms", 1e3 * measured.frame_seconds},
                              {"all_draws", measured_json(all)}};
  json["left_out"] = nlohmann::ordered_json::array();
  for (const LeftOutEffect& effect : measured.left_out) {
    nlohmann::ordered_json entry{{"effect", code(effect.effect)}};
    if (effect.light >= 0) entry["light"] = effect.light;
    if (effect.back_faces) entry["back_faces"] = true;
    entry["reasons"] = nlohmann::ordered_json::array();
    for (const EffectReason reason : effect.reasons) entry["reasons"].push_back(code(reason));
    entry["draws"] = effect.draw_count;
    entry["share_of_draws"] = share(std::uint64_t{effect.draw_count}, std::uint64_t{measured.draws.size()});
    entry["share_of_batches"] = share(effect.draws.vertex_batches, all.vertex_batches);
    entry["share_of_tiles"] = share(effect.draws.tiles, all.tiles);
    entry["share_of_covered_pixels"] = share(effect.draws.fragments, all.fragments);
    entry["share_of_shaded_pixels"] = share(effect.draws.shaded_pixels, all.shaded_pixels);
    json["left_out"].push_back(entry);
  }
  return json;
}

}  // namespace tessera::program::cli
