// Shared by tests of invalid scene files: short scenes and their errors.
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <string_view>

#include "engine/program/scene/scene.h"

namespace tessera::test {
using namespace program;

struct BadScene {
  std::string text;      ///< see whole()
  std::string pointer;   ///< JSON pointer, or line and column
  std::string fragment;  ///< part of the rest of the message
};

/// The text of a scene file: `text` if it is empty or starts with {, [ or a blank; otherwise an object with
/// `text` after its first member.
inline std::string whole(const std::string& text) {
  const bool is_whole = text.empty() || std::string_view("{[ ").find(text[0]) != std::string_view::npos;
  return is_whole ? text : "{\"tessera\": 1, " + text + "}";
}

/// The message of the Error that the scene causes.
inline std::string message_of(const std::string& text) {
  try {
    parse_scene(text, "bad.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "(no error)";
}

inline const std::string kPot = R"("meshes": {"pot": {"builtin": "cube"}}, "materials": {"red": {}}, )";
inline std::string draw(const std::string& keys) {
  return kPot + R"("frame": [{"draw": "pot", )" + keys + "}]";
}
inline std::string mesh(const std::string& keys) { return R"("meshes": {"m": {)" + keys + "}}"; }
inline std::string with_positions(const std::string& keys) {
  return mesh(R"("positions": [[0,0,0],[1,0,0],[0,1,0]], )" + keys);
}
inline std::string index_buffer(const std::string& keys) {
  return R"("framebuffer": {"color": {"mode": "index", "bits": 8}, )" + keys + "}";
}
/// A scene with one draw, and a frame buffer with these keys.
inline std::string draw_into(const std::string& buffer, const std::string& keys) {
  return R"("framebuffer": {)" + buffer + "}, " + draw(keys);
}
/// A scene with one command, and a frame buffer with these keys.
inline std::string command(const std::string& text, const std::string& buffer = R"("accumulation": 16)") {
  return R"("framebuffer": {)" + buffer + R"(}, "frame": [{)" + text + "}]";
}
inline const std::string kIndex = R"("color": {"mode": "index", "bits": 8})";
inline std::string shadow(const std::string& keys) { return draw(R"("shadow_on": {)" + keys + "}"); }
inline std::string bitmap(const std::string& keys, const std::string& buffer = "") {
  return command(R"("bitmap": {"at": [0, 0], )" + keys + "}", buffer);
}
inline std::string good_bitmap(const std::string& keys, const std::string& buffer = "") {
  return bitmap(R"("width": 8, "height": 1, "rows": ["fF"], )" + keys, buffer);
}
inline std::string projection(const std::string& keys) {
  return R"("camera": {"projection": {)" + keys + "}}";
}

inline void expect_errors(std::span<const BadScene> scenes) {
  for (const BadScene& bad : scenes) {
    const std::string message = message_of(whole(bad.text));
    EXPECT_TRUE(message.starts_with("bad.json: " + bad.pointer + ": ")) << bad.text << "\n" << message;
    EXPECT_NE(message.find(bad.fragment), std::string::npos) << bad.text << "\n"
                                                             << message << "\nlacks " << bad.fragment;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

}  // namespace tessera::test
