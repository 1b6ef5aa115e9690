// A scene for each reason that `tessera explain` gives, and the change that makes the reason disappear.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "engine/tessera/tessera.hpp"

namespace tessera::test {

/// A scene with one draw of a square. Its parts have short names: "framebuffer", "lights", "light_model",
/// "quality", "material", "textures", "mesh", "clear" (may be null), "command", the draw, and "last_clear"
/// after it.
nlohmann::json scene_parts();
/// The scene file.
std::string scene_file(const nlohmann::json& parts);

/// The place of a field that a cause names: "lights[1].spot_cutoff" is "/lights/1/spot_cutoff".
nlohmann::json::json_pointer place_of_cause(const std::string& cause);
/// Replaces the value at a place. Null removes it.
void set_value(nlohmann::json& parts, const nlohmann::json::json_pointer& place, const nlohmann::json& value);

struct ReasonCase {
  EffectReason reason;
  const char* effect;   ///< code
  const char* scene;    ///< JSON merge patch of scene_parts()
  const char* cause;    ///< expected; names the field that is changed
  const char* changed;  ///< its new value, JSON; null removes it
};
inline std::ostream& operator<<(std::ostream& out, const ReasonCase& of) { return out << code(of.reason); }
/// One or more per reason.
std::vector<ReasonCase> reason_cases();

struct BufferReasonCase {
  BufferReason reason;
  const char* buffer;
  const char* scene;    ///< JSON merge patch of scene_parts()
  const char* place;    ///< JSON pointer to the field that is changed
  const char* changed;  ///< its new value, JSON
};
inline std::ostream& operator<<(std::ostream& out, const BufferReasonCase& of) {
  return out << code(of.reason);
}
std::vector<BufferReasonCase> buffer_reason_cases();

}  // namespace tessera::test
