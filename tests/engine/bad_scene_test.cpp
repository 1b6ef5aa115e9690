// Every mistake in a scene file gives one Error that names the file, the JSON pointer and what was expected.
#include <gtest/gtest.h>

#include <string>

#include "engine/scene/scene.h"

namespace tessera {
namespace {

struct BadScene {
  std::string text;      // a whole file if it starts with { or [ or blank, else what follows {"tessera": 1,
  std::string pointer;   // or line and column
  std::string fragment;  // of the rest of the message
};

std::string whole(const std::string& text) { return text.empty() || text[0] == '{' || text[0] == '[' || text[0] == ' ' ? text : "{\"tessera\": 1, " + text + "}"; }

std::string message_of(const std::string& text) {
  try {
    parse_scene(text, "bad.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "(no error)";
}

const std::string kPot = R"("meshes": {"pot": {"builtin": "cube"}}, "materials": {"red": {}}, )";
std::string draw(const std::string& keys) { return kPot + R"("frame": [{"draw": "pot", )" + keys + "}]"; }
std::string mesh(const std::string& keys) { return R"("meshes": {"m": {)" + keys + "}}"; }
std::string with_positions(const std::string& keys) { return mesh(R"("positions": [[0,0,0],[1,0,0],[0,1,0]], )" + keys); }
std::string index_buffer(const std::string& keys) { return R"("framebuffer": {"color": {"mode": "index", "bits": 8}, )" + keys + "}"; }
// A draw or another command into a frame buffer with those keys.
std::string draw_into(const std::string& buffer, const std::string& keys) { return R"("framebuffer": {)" + buffer + "}, " + draw(keys); }
std::string command(const std::string& text, const std::string& buffer = R"("accumulation": 16)") {
  return R"("framebuffer": {)" + buffer + R"(}, "frame": [{)" + text + "}]";
}
const std::string kIndex = R"("color": {"mode": "index", "bits": 8})";
std::string shadow(const std::string& keys) { return draw(R"("shadow_on": {)" + keys + "}"); }
std::string bitmap(const std::string& keys, const std::string& buffer = "") { return command(R"("bitmap": {"at": [0, 0], )" + keys + "}", buffer); }
std::string good_bitmap(const std::string& keys, const std::string& buffer = "") { return bitmap(R"("width": 8, "height": 1, "rows": ["fF"], )" + keys, buffer); }
std::string projection(const std::string& keys) { return R"("camera": {"projection": {)" + keys + "}}"; }

const BadScene kBadScenes[] = {
    // The file as a whole
    {" ", "line 1, column 2", "unexpected end of input"},
    {"{\n  \"tessera\": 1,\n  \"title\" \"x\"\n}", "line 3, column 13", "expected ':'"},
    {"{\"tessera\": 1,}", "line 1, column 15", "syntax error"},
    {"{\"tessera\": 1} x", "line 1, column 16", "syntax error"},
    {R"("light_model": {"ambient": [NaN, 0, 0, 1]})", "line 1, column 44", "syntax error"},
    {"[]", "(top level)", "found an empty array, expected an object"},
    {"{}", "(top level)", "key \"tessera\" is missing"},
    {R"({"tessera": 2})", "/tessera", "found 2, expected 1"},
    {R"({"tessera": "1"})", "/tessera", "found \"1\""},
    {R"("lihgts": [])", "/lihgts", "unknown key \"lihgts\"; did you mean \"lights\"?"},
    {R"("a/b~c": 1)", "/a~1b~0c", "unknown key"},
    {R"("title": 5)", "/title", "found 5, expected a string"},
    {R"("title": "a", "title": "b")", "/title", "the key \"title\" occurs twice"},
    {R"("lights": [{}, {"diffuse": [1,1,1,1], "diffuse": [1,1,1,1]}])", "/lights/1/diffuse", "occurs twice"},
    {R"("frame": [[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]]])",
     "/frame/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0/0", "nested deeper than 64"},
    {R"("light_model": {"ambient": [1e999, 0, 0, 1]})", "/light_model/ambient/0", "1e999"},
    {R"("light_model": {"ambient": [0, 1e999, 0, 1]})", "/light_model/ambient/1", "1e999"},

    // Frame buffer
    {R"("framebuffer": [640, 480])", "/framebuffer", "found an array of 2, expected an object"},
    {R"("framebuffer": {"width": 0})", "/framebuffer/width", "found 0, expected an integer from 1 to 16384"},
    {R"("framebuffer": {"height": 20000})", "/framebuffer/height", "found 20000, expected an integer from 1 to 16384"},
    {R"("framebuffer": {"width": 640.5})", "/framebuffer/width", "found 640.5, expected an integer"},
    {R"("framebuffer": {"width": "640"})", "/framebuffer/width", "found \"640\", expected a number"},
    {R"("framebuffer": {"widht": 640})", "/framebuffer/widht", "did you mean \"width\"?"},
    {R"("framebuffer": {"color": "rgb"})", "/framebuffer/color", "expected an object"},
    {R"("framebuffer": {"color": {"mode": "rbg"}})", "/framebuffer/color/mode", "expected one of \"rgb\", \"index\"; did you mean \"rgb\"?"},
    {R"("framebuffer": {"color": {"bits": 25}})", "/framebuffer/color/bits", "found 25, expected an integer from 1 to 24"},
    {R"("framebuffer": {"palette": "bw"})", "/framebuffer/palette", "\"mode\": \"index\""},
    {R"("framebuffer": {"color": {"mode": "index", "bits": 4}, "palette": "vga256"})", "/framebuffer/palette", "256"},
    {R"("framebuffer": {"color": {"mode": "index", "bits": 8}, "palette": "ega"})", "/framebuffer/palette", "found \"ega\", expected one of"},
    {R"("framebuffer": {"color": {"mode": "index", "bits": 8}, "palette": "adaptive"})", "/framebuffer/palette", "\"adaptive\" is part of the format but not supported"},
    {R"("framebuffer": {"color": {"mode": "index", "bits": 8}, "palette": []})", "/framebuffer/palette", "found an empty array, expected 1 to 256 entries"},
    {R"("framebuffer": {"color": {"mode": "index", "bits": 1}, "palette": [[0,0,0],[1,1,1],[1,0,0]]})", "/framebuffer/palette", "expected 1 to 2 entries for 1 bits"},
    {R"("framebuffer": {"color": {"mode": "index", "bits": 1}, "palette": [[0,0,0],[1,1,2]]})", "/framebuffer/palette/1/2", "found 2, expected a number from 0 to 1"},
    {R"("framebuffer": {"color": {"mode": "index", "bits": 1}, "palette": [[0,0,0,1]]})", "/framebuffer/palette/0", "expected [r, g, b]"},
    {R"("framebuffer": {"depth": "unorm8"})", "/framebuffer/depth", "expected one of \"none\""},
    {R"("framebuffer": {"stencil": 9})", "/framebuffer/stencil", "expected an integer from 0 to 8"},

    {R"("framebuffer": {"dither": "bayer5"})", "/framebuffer/dither", "found \"bayer5\", expected one of \"none\", \"bayer2\", \"bayer4\", \"bayer8\""},
    {R"("framebuffer": {"dither": 4})", "/framebuffer/dither", "found 4, expected one of \"none\""},
    {R"("framebuffer": {"dither": "blue_noise"})", "/framebuffer/dither", "\"blue_noise\" is part of the format but not supported"},
    {R"("framebuffer": {"dither": "floyd_steinberg"})", "/framebuffer/dither", "\"floyd_steinberg\" is part of the format but not supported"},
    {R"("framebuffer": {"dither": "jarvis"})", "/framebuffer/dither", "\"jarvis\" is part of the format but not supported"},
    {R"("framebuffer": {"dither": "pattern"})", "/framebuffer/dither", "\"pattern\" is part of the format but not supported"},
    {R"("framebuffer": {"alpha": 4})", "/framebuffer/alpha", "found 4, expected 0 or 8 bits"},
    {R"("framebuffer": {"alpha": true})", "/framebuffer/alpha", "found true, expected 0 or 8 bits"},
    {index_buffer(R"("alpha": 8)"), "/framebuffer/alpha", "an index buffer has no alpha planes"},
    {R"("framebuffer": {"accumulation": 24})", "/framebuffer/accumulation", "found 24, expected 0, 16 or 32 bits"},
    {R"("framebuffer": {"accumulation": "16"})", "/framebuffer/accumulation", "found \"16\", expected 0, 16 or 32 bits"},
    {index_buffer(R"("accumulation": 16)"), "/framebuffer/accumulation", "an index buffer does not accumulate"},
    {R"("framebuffer": {"samples": 3})", "/framebuffer/samples", "found 3, expected 1, 4 or 8"},
    {R"("framebuffer": {"samples": 0})", "/framebuffer/samples", "found 0, expected 1, 4 or 8"},
    {R"("framebuffer": {"samples": 16})", "/framebuffer/samples", "found 16, expected 1, 4 or 8"},
    {R"("framebuffer": {"samples": [4]})", "/framebuffer/samples", "found an array of 1, expected 1, 4 or 8"},
    {index_buffer(R"("samples": 4)"), "/framebuffer/samples", "an index buffer has one sample a pixel"},
    {R"("framebuffer": {"stencil": "8"})", "/framebuffer/stencil", "found \"8\", expected a number"},
    {R"("framebuffer": {"stencil": -1})", "/framebuffer/stencil", "found -1, expected an integer from 0 to 8"},
    {R"("framebuffer": {"depth": 24})", "/framebuffer/depth", "found 24, expected one of \"none\""},

    // Camera
    {R"("camera": {"eye": [0, 0]})", "/camera/eye", "found an array of 2, expected an array of 3 numbers"},
    {R"("camera": {"eye": [0, 0, "4"]})", "/camera/eye/2", "found \"4\", expected a number"},
    {R"("camera": {"eye": [0, 0, 0], "target": [0, 0, 0]})", "/camera", "eye and target must differ"},
    {R"("camera": {"up": [0, 0, 1]})", "/camera", "up must not lie along the view"},
    {R"("camera": {"reversed": true})", "/camera/reversed", "stands in \"projection\""},
    {R"("camera": {"view": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]})", "/camera", "key \"projection\" is missing"},
    {R"("camera": {"view": [1,2,3], "projection": [1,2,3]})", "/camera/view", "expected an array of 16 numbers"},
    {R"("camera": {"projection": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]})", "/camera", "\"view\""},
    {R"("camera": {"view": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1], "eye": [0,0,1]})", "/camera/eye", "unknown key"},
    {projection(R"("fovy": 180)"), "/camera/projection/fovy", "expected an angle above 0 and below 180"},
    {projection(R"("near": 0)"), "/camera/projection/near", "expected a distance above 0"},
    {projection(R"("near": 2, "far": 1)"), "/camera/projection/far", "expected a distance above near's 2"},
    {projection(R"("near": 200)"), "/camera/projection", "near is 200"},
    {projection(R"("far": "infinite")"), "/camera/projection/far", "expected a number or \"infinity\""},
    {projection(R"("type": "perspectiv")"), "/camera/projection/type", "did you mean \"perspective\"?"},
    {projection(R"("left": 1)"), "/camera/projection/left", "unknown key"},
    {projection(R"("type": "orthographic", "left": -1, "right": 1, "bottom": -1, "top": 1, "near": 1)"), "/camera/projection", "key \"far\" is missing"},
    {projection(R"("type": "orthographic", "left": -1, "right": 1, "bottom": -1, "top": 1, "near": 1, "far": "infinity")"), "/camera/projection/far", "finite"},
    {projection(R"("type": "frustum", "left": 1, "right": 1, "bottom": -1, "top": 1, "near": 1, "far": 2)"), "/camera/projection", "left is 1.000000 and right is 1.000000"},
    {projection(R"("far": 1e308)"), "/camera/projection", "the volume is too large or too thin"},
    {projection(R"("type": "orthographic", "left": -1e-320, "right": 1e-320, "bottom": -1, "top": 1, "near": 1, "far": 2)"), "/camera/projection", "the volume is too large or too thin"},
    {projection(R"("fovy": {"keys": [[0, 30], [0, 60]]})"), "/camera/projection/fovy/keys/1", "t must rise"},
    {projection(R"("fovy": {"keys": [[0, 30], [1]]})"), "/camera/projection/fovy/keys/1", "expected an array of 2 numbers"},
    {projection(R"("fovy": {"keys": []})"), "/camera/projection/fovy/keys", "expected a list of [t, value]"},
    {projection(R"("fovy": {"keys": [[0, 200], [1, 60]]})"), "/camera/projection/fovy", "expected an angle above 0 and below 180"},

    // Lights and materials
    {R"("light_model": {"specular": "blin"})", "/light_model/specular", "did you mean \"blinn\"?"},
    {R"("light_model": {"two_sided": 1})", "/light_model/two_sided", "found 1, expected true or false"},
    {R"("light_model": {"ambient": [1, 1, 1]})", "/light_model/ambient", "expected an array of 4 numbers"},
    {R"("light_model": {"ambient": [1e300, 1, 1, 1]})", "/light_model/ambient/0", "32-bit float"},
    {R"("lights": {})", "/lights", "expected an array"},
    {R"("lights": [{"position": [0, 0, 1]}])", "/lights/0/position", "expected an array of 4 numbers"},
    {R"("lights": [{"spot_cutoff": 100}])", "/lights/0/spot_cutoff", "found 100, expected 0 to 90 degrees, or 180"},
    {R"("lights": [{"spot_exponent": 20000}])", "/lights/0/spot_exponent", "expected a number from 0 to 16384"},
    {R"("lights": [{"attenuation": [1, 0]}])", "/lights/0/attenuation", "expected an array of 3 numbers"},
    {R"("materials": {"red": {"shininess": -1}})", "/materials/red/shininess", "expected a number from 0 to 16384"},
    {R"("materials": {"red": {"preset": "goldd"}})", "/materials/red/preset", "expected one of \"emerald\""},
    {R"("materials": {"red": {"color_indexes": [0, 1]}})", "/materials/red/color_indexes", "expected an array of 3 numbers"},
    {R"("materials": {"red": {"color_indexes": [0, 1, "x"]}})", "/materials/red/color_indexes/2", "expected a number"},
    {R"("textures": {"t": {"file": "x.png"}})", "/textures/t/file", "cannot read \"x.png\": No such file or directory"},
    {R"("textures": {"t": {"file": "x.ppm"}})", "/textures/t/file", "cannot read \"x.ppm\""},
    {R"("textures": {"t": {"file": "/dev/zero"}})", "/textures/t/file", "cannot read \"/dev/zero\": it is a device or a pipe, expected a file"},
    {R"("textures": {"t": {}})", "/textures/t", "key \"file\" is missing"},
    {R"("textures": {"t": {"file": "x.png", "filter": "linear"}})", "/textures/t/filter", "unknown key"},
    {R"("textures": {"t": {"file": "x.png", "mag": "linear_mipmap_linear"}})", "/textures/t/mag", "expected one of \"nearest\", \"linear\""},
    {R"("textures": {"t": {"file": "x.png", "min": "trilinear"}})", "/textures/t/min", "expected one of \"nearest\""},
    {R"("textures": {"t": {"file": "x.png", "wrap_s": "clamp"}})", "/textures/t/wrap_s", "expected one of \"repeat\""},
    {R"("textures": {"t": {"file": "x.png", "wrap_t": 1}})", "/textures/t/wrap_t", "expected one of \"repeat\""},
    {R"("textures": [])", "/textures", "expected an object"},
    {R"("textures": {"t": {"rows": ["00"]}})", "/textures/t", "key \"channels\" is missing"},
    {R"("textures": {"t": {"rows": ["00"], "channels": 5}})", "/textures/t/channels", "found 5, expected an integer from 1 to 4"},
    {R"("textures": {"t": {"rows": ["00"], "channels": 1, "file": "x.png"}})", "/textures/t/file", "unknown key"},
    {R"("textures": {"t": {"channels": 1}})", "/textures/t/channels", "unknown key"},
    {R"("textures": {"t": {"rows": [], "channels": 1}})", "/textures/t/rows", "expected a list of rows"},
    {R"("textures": {"t": {"rows": "00", "channels": 1}})", "/textures/t/rows", "expected a list of rows"},
    {R"("textures": {"t": {"rows": [0], "channels": 1}})", "/textures/t/rows/0", "expected a string"},
    {R"("textures": {"t": {"rows": ["0000"], "channels": 3}})", "/textures/t/rows/0", "expected at least 6 hexadecimal digits"},
    {R"("textures": {"t": {"rows": ["000000", "00000"], "channels": 3}})", "/textures/t/rows/1", "expected 6 hexadecimal digits"},
    {R"("textures": {"t": {"rows": ["00000000"], "channels": 3}})", "/textures/t/rows/0", "expected 6 hexadecimal digits"},
    {R"("textures": {"t": {"rows": ["0g"], "channels": 1}})", "/textures/t/rows/0", "expected 2 hexadecimal digits"},
    {"\"textures\": {\"t\": {\"rows\": [\"" + std::string(2 * 16385, '0') + "\"], \"channels\": 1}}", "/textures/t/rows", "16384"},

    // Meshes
    {mesh(R"("builtin": "teapott")"), "/meshes/m/builtin", "did you mean \"teapot\"?"},
    {mesh(R"("builtin": "sphere", "detail": 1)"), "/meshes/m/detail", "found 1, expected an integer from 2 to 1024"},
    {mesh(R"("builtin": "cube", "file": "x.obj")"), "/meshes/m/file", "unknown key"},
    {mesh(R"("bultin": "cube")"), "/meshes/m/bultin", "did you mean \"builtin\"?"},
    {mesh(R"("detail": 3)"), "/meshes/m/detail", "unknown key"},
    {mesh(""), "/meshes/m", "key \"positions\" is missing"},
    {mesh(R"("file": "no such file.obj")"), "/meshes/m/file", "cannot read \"no such file.obj\": No such file or directory"},
    {mesh(R"("file": "model.txt")"), "/meshes/m/file", "cannot read"},
    {mesh(R"("positions": [])"), "/meshes/m/positions", "found an empty array, expected at least 3 positions"},
    {mesh(R"("positions": [[0,0,0],[1,0,0]])"), "/meshes/m/positions", "expected a multiple of 3 positions, or \"indices\", for triangles"},
    {mesh(R"("positions": [[0,0,0],[1,0,0],[0,1]])"), "/meshes/m/positions/2", "expected an array of 3 numbers"},
    {mesh(R"("positions": [[0,0,0],[1,0,null],[0,1,0]])"), "/meshes/m/positions/1/2", "found null, expected a number"},
    {mesh(R"("positions": [[0,0,0],[1,0,1e39],[0,1,0]])"), "/meshes/m/positions/1/2", "32-bit float"},
    {with_positions(R"("normals": [[0,0,1]])"), "/meshes/m/normals", "expected one for each of the 3 positions"},
    {with_positions(R"("colors": [[1,0,0],[1,0,0],[1,0,0]])"), "/meshes/m/colors/0", "expected an array of 4 numbers"},
    {with_positions(R"("indices": [])"), "/meshes/m/indices", "expected a multiple of 3 indices, for triangles"},
    {with_positions(R"("indices": [0, 1, 2, 0])"), "/meshes/m/indices", "expected a multiple of 3 indices, for triangles"},
    {with_positions(R"("indices": [0, 1, 3])"), "/meshes/m/indices/2", "found 3, expected an integer from 0 to 2"},
    {with_positions(R"("indices": [0, -1, 2])"), "/meshes/m/indices/1", "found -1, expected an integer from 0 to 2"},
    {with_positions(R"("primitive": "quads")"), "/meshes/m/positions", "expected a multiple of 4 positions, or \"indices\", for quads"},
    {with_positions(R"("primitive": "quads", "indices": [0, 1, 2, 0, 1])"), "/meshes/m/indices", "expected a multiple of 4 indices, for quads"},
    {with_positions(R"("primitive": "quad_strip", "indices": [0, 1])"), "/meshes/m/indices", "expected 4, 6, 8, ... indices, for a quad strip"},
    {with_positions(R"("primitive": "lines")"), "/meshes/m/positions", "expected a multiple of 2 positions, or \"indices\", for lines"},
    {with_positions(R"("primitive": "line_loop", "indices": [0])"), "/meshes/m/indices", "expected 2 or more indices, for a line loop"},
    {mesh(R"("primitive": "points", "positions": [])"), "/meshes/m/positions", "expected at least 1 position"},
    {with_positions(R"("primitive": "triangle")"), "/meshes/m/primitive", "did you mean \"triangles\"?"},
    {with_positions(R"("texcoords": [[0,0],[1,0]])"), "/meshes/m/texcoords", "expected one for each of the 3 positions"},
    {with_positions(R"("texcoords": [[0,0],[1,0],[0,1,0]])"), "/meshes/m/texcoords/2", "expected an array of 2 numbers"},
    {with_positions(R"("color_indices": [0,1])"), "/meshes/m/color_indices", "expected one for each of the 3 positions"},
    {with_positions(R"("color_indices": [0,1,1e39])"), "/meshes/m/color_indices/2", "32-bit float"},

    // Frame
    {R"("frame": {})", "/frame", "expected an array"},
    {R"("frame": [5])", "/frame/0", "expected an object with one of \"clear\", \"draw\""},
    {R"("frame": [{}])", "/frame/0", "expected one of \"clear\", \"draw\""},
    {R"("frame": [{"claer": {}}])", "/frame/0/claer", "did you mean \"clear\"?"},
    {R"("frame": [{"bitmap": {"at": [0,0]}, "blend": {}}])", "/frame/0/blend", "unknown key \"blend\", expected one of \"clear\", \"draw\", \"bitmap\", \"image\""},
    {R"("frame": [{"bitmap": {"at": [0,0]}, "image": {}}])", "/frame/0", "found several commands in one object"},
    {R"("frame": [{"draw": "pot"}])", "/frame/0/draw", "found \"pot\", expected the name of a mesh (the scene has none)"},
    {kPot + R"("frame": [{"draw": "pott"}])", "/frame/0/draw", "did you mean \"pot\"?"},
    {kPot + R"("frame": [{"draw": 0}])", "/frame/0/draw", "expected a string"},
    {kPot + R"("frame": [{"clear": {}}, {"camera": {"eye": 1}}])", "/frame/1/camera/eye", "expected an array of 3 numbers"},
    {kPot + R"("frame": [{"lights": [{"diffuse": 1}]}])", "/frame/0/lights/0/diffuse", "expected an array of 4 numbers"},
    {draw(R"("material": "rde")"), "/frame/0/material", "expected the name of a material; did you mean \"red\"?"},
    {draw(R"("back_material": "blue")"), "/frame/0/back_material", "found \"blue\", expected the name of a material"},
    {draw(R"("shadng": "flat")"), "/frame/0/shadng", "did you mean \"shading\"?"},
    {draw(R"("shading": "gourad")"), "/frame/0/shading", "did you mean \"gouraud\"?"},
    {draw(R"("lighting": "off")"), "/frame/0/lighting", "found \"off\", expected true or false"},
    {draw(R"("transform": {"translate": [0,0,0]})"), "/frame/0/transform", "expected an array"},
    {draw(R"("transform": [{"translate": [0,0,0], "scale": [1,1,1]}])"), "/frame/0/transform/0", "expected an object with one of"},
    {draw(R"("transform": [{"rotate": [30, 0, 0, 0]}])"), "/frame/0/transform/0/rotate", "axis"},
    {draw(R"("transform": [{"scale": [1,1,1]}, {"matrix": [1]}])"), "/frame/0/transform/1/matrix", "expected an array of 16 numbers"},
    {draw(R"("depth": true)"), "/frame/0/depth", "expected false or an object"},
    {draw(R"("depth": 0.5)"), "/frame/0/depth", "found 0.5, expected false or an object"},
    {draw(R"("depth": {"test": "lower"})"), "/frame/0/depth/test", "expected one of \"never\""},
    {R"("framebuffer": {"depth": "none"}, )" + draw(R"("depth": {"test": "less"})"), "/frame/0/depth", "needs a depth buffer"},
    {draw(R"("depth_range": [0, 1.01])"), "/frame/0/depth_range/1", "expected a number from 0 to 1"},
    {draw(R"("color_mask": [true, true, true])"), "/frame/0/color_mask", "expected four of true and false"},
    {R"("framebuffer": {"color": {"bits": 2}}, )" + draw(R"("color_mask": [true, false, true, true])"), "/frame/0/color_mask", "all true or all false"},
    {draw(R"("plane_mask": 4294967296)"), "/frame/0/plane_mask", "expected an integer from 0 to 4294967295"},
    {draw(R"("viewport": [0, 0, -1, 10])"), "/frame/0/viewport/2", "found -1"},
    {draw(R"("scissor": [0, 0, 10])"), "/frame/0/scissor", "expected [x, y, width, height]"},
    {draw(R"("texture": "brick")"), "/frame/0/texture", "found \"brick\", expected the name of a texture (the scene has none)"},
    {draw(R"("texture": 1)"), "/frame/0/texture", "found 1, expected a string"},
    {draw(R"("texture_env": "modulated")"), "/frame/0/texture_env", "did you mean \"modulate\"?"},
    {draw(R"("texture_env_color": [0, 0, 0])"), "/frame/0/texture_env_color", "expected an array of 4 numbers"},
    {draw(R"("texture_env_color": [0, 0, 1e39, 0])"), "/frame/0/texture_env_color/2", "32-bit float"},
    {draw(R"("polygon_mode": "lines")"), "/frame/0/polygon_mode", "found \"lines\""},
    {draw(R"("polygon_mode": ["line"])"), "/frame/0/polygon_mode", "[front, back]"},
    {draw(R"("polygon_mode": ["line", 1])"), "/frame/0/polygon_mode/1", "found 1"},
    {draw(R"("point_size": 0)"), "/frame/0/point_size", "found 0, expected a number above 0"},
    {draw(R"("point_size": 1e39)"), "/frame/0/point_size", "found 1e+39"},
    {draw(R"("line_width": -1.5)"), "/frame/0/line_width", "found -1.5, expected a number above 0"},
    {draw(R"("line_width": "wide")"), "/frame/0/line_width", "found \"wide\""},
    {draw(R"("stages": [{"name": "zoom"}])"), "/frame/0/stages", "not supported"},

    // Shadows
    {draw(R"("shadow_on": true)"), "/frame/0/shadow_on", "found true, expected an object"},
    {draw(R"("shadow_on": {})"), "/frame/0/shadow_on", "key \"plane\" is missing"},
    {shadow(R"("plane": [0, 1, 0])"), "/frame/0/shadow_on/plane", "found an array of 3, expected an array of 4 numbers"},
    {shadow(R"("plane": [0, 1, 0, "1"])"), "/frame/0/shadow_on/plane/3", "found \"1\", expected a number"},
    {shadow(R"("plane": [0, 0, 0, 1])"), "/frame/0/shadow_on", "the plane is 0 0 0 1, its normal must not be 0 0 0"},
    {shadow(R"("plane": [0, 1, 0, 1])"), "/frame/0/shadow_on", "the light's direction 0 0 1 is parallel to the plane 0 1 0 1"},
    {R"("lights": [{"position": [1, 2, 3, 1]}], )" + shadow(R"("plane": [1, 0, 0, -1])"), "/frame/0/shadow_on", "the light at 1 2 3 lies in the plane 1 0 0 -1"},
    {shadow(R"("plane": [0, 0, 1, 0], "light": 1)"), "/frame/0/shadow_on/light", "found 1, expected an integer from 0 to 0"},
    {shadow(R"("plane": [0, 0, 1, 0], "light": -1)"), "/frame/0/shadow_on/light", "found -1, expected an integer from 0 to 0"},
    {shadow(R"("plane": [0, 0, 1, 0], "light": 0.5)"), "/frame/0/shadow_on/light", "found 0.5, expected an integer"},
    {R"("lights": [], )" + shadow(R"("plane": [0, 0, 1, 0])"), "/frame/0/shadow_on", "needs a light, and there are none"},
    {shadow(R"("plane": [0, 0, 1, 0], "color": [0, 0, 0])"), "/frame/0/shadow_on/color", "expected an array of 4 numbers"},
    {shadow(R"("plane": [0, 0, 1, 0], "colour": [0, 0, 0, 1])"), "/frame/0/shadow_on/colour", "did you mean \"color\"?"},
    {kPot + R"("frame": [{"lights": [{}, {}]}, {"draw": "pot", "shadow_on": {"plane": [0, 0, 1, 0], "light": 2}}])", "/frame/1/shadow_on/light", "found 2, expected an integer from 0 to 1"},

    // Bitmaps and images
    {command(R"("bitmap": [])"), "/frame/0/bitmap", "found an empty array, expected an object"},
    {command(R"("bitmap": {"width": 8, "height": 1, "rows": ["ff"]})"), "/frame/0/bitmap", "key \"at\" is missing"},
    {bitmap(R"("height": 1, "rows": ["ff"])"), "/frame/0/bitmap", "key \"width\" is missing"},
    {bitmap(R"("width": 8, "rows": ["ff"])"), "/frame/0/bitmap", "key \"height\" is missing"},
    {bitmap(R"("width": 8, "height": 1)"), "/frame/0/bitmap", "key \"rows\" is missing"},
    {command(R"("bitmap": {"at": [0], "width": 8, "height": 1, "rows": ["ff"]})"), "/frame/0/bitmap/at", "found an array of 1, expected [x, y]"},
    {command(R"("bitmap": {"at": [0, "0"], "width": 8, "height": 1, "rows": ["ff"]})"), "/frame/0/bitmap/at/1", "found \"0\", expected a number"},
    {bitmap(R"("width": 0, "height": 1, "rows": ["ff"])"), "/frame/0/bitmap/width", "found 0, expected an integer from 1 to 16384"},
    {bitmap(R"("width": 8, "height": 16385, "rows": ["ff"])"), "/frame/0/bitmap/height", "found 16385, expected an integer from 1 to 16384"},
    {bitmap(R"("width": 8, "height": 2, "rows": ["ff"])"), "/frame/0/bitmap/rows", "found an array of 1, expected one row for each of the bitmap's 2"},
    {bitmap(R"("width": 8, "height": 1, "rows": "ff")"), "/frame/0/bitmap/rows", "expected one row for each of the bitmap's 1"},
    {bitmap(R"("width": 9, "height": 1, "rows": ["ff"])"), "/frame/0/bitmap/rows/0", "found \"ff\", expected 4 hexadecimal digits"},
    {bitmap(R"("width": 8, "height": 2, "rows": ["ff", "0g"])"), "/frame/0/bitmap/rows/1", "found \"0g\", expected 2 hexadecimal digits"},
    {bitmap(R"("width": 8, "height": 1, "rows": [255])"), "/frame/0/bitmap/rows/0", "found 255, expected 2 hexadecimal digits"},
    {good_bitmap(R"("depth": 1.5)"), "/frame/0/bitmap/depth", "found 1.5, expected a number from 0 to 1"},
    {good_bitmap(R"("depth": true)"), "/frame/0/bitmap/depth", "found true, expected a number from 0 to 1, false or an object"},
    {good_bitmap(R"("depth": {"test": "lower"})"), "/frame/0/bitmap/depth/test", "expected one of \"never\""},
    {good_bitmap(R"("color": [1, 1, 1])"), "/frame/0/bitmap/color", "expected an array of 4 numbers"},
    {good_bitmap(R"("polygon_offset": [0, 0])"), "/frame/0/bitmap/polygon_offset", "unknown key \"polygon_offset\""},
    {good_bitmap(R"("depth_range": [0, 1])"), "/frame/0/bitmap/depth_range", "unknown key \"depth_range\""},
    {good_bitmap(R"("viewport": [0, 0, 1, 1])"), "/frame/0/bitmap/viewport", "unknown key \"viewport\""},
    {good_bitmap(R"("file": "x.png")"), "/frame/0/bitmap/file", "unknown key \"file\""},
    {good_bitmap(R"("blend": {"src": "alpha"})"), "/frame/0/bitmap/blend/src", "found \"alpha\", expected one of \"zero\", \"one\""},
    {good_bitmap(R"("blend": {}, "logic_op": "xor")"), "/frame/0/bitmap/blend", "a draw blends or has a logic operation, not both"},
    {good_bitmap(R"("stencil": {})", R"("stencil": 0)"), "/frame/0/bitmap/stencil", "needs a stencil buffer, and the frame buffer's \"stencil\" is 0"},
    {good_bitmap(R"("depth": {})", R"("depth": "none")"), "/frame/0/bitmap/depth", "needs a depth buffer, and the frame buffer's \"depth\" is \"none\""},
    {good_bitmap(R"("alpha_test": {})", kIndex), "/frame/0/bitmap/alpha_test", "an index buffer has no alpha to test"},
    {good_bitmap(R"("color_mask": [true, false, true, true])", kIndex), "/frame/0/bitmap/color_mask", "must be all true or all false"},
    {command(R"("image": {"at": [0, 0]})"), "/frame/0/image", "key \"file\" is missing"},
    {command(R"("image": {"file": "x.png"})"), "/frame/0/image", "key \"at\" is missing"},
    {command(R"("image": {"at": [0, 0], "file": 3})"), "/frame/0/image/file", "found 3, expected a string"},
    {command(R"("image": {"at": [0, 0], "file": "no such file.ppm"})"), "/frame/0/image/file", "cannot read \"no such file.ppm\": No such file or directory"},
    {command(R"("image": {"at": [0, 0], "file": "/dev/zero"})"), "/frame/0/image/file", "cannot read \"/dev/zero\": it is a device or a pipe, expected a file"},
    {command(R"("image": {"at": [0, 0], "file": "x.png", "zoom": 2})"), "/frame/0/image/zoom", "found 2, expected [x, y]"},
    {command(R"("image": {"at": [0, 0], "file": "x.png", "zoom": [2, null]})"), "/frame/0/image/zoom/1", "found null, expected a number"},
    {command(R"("image": {"at": [0, 0], "file": "x.png", "zoom": [1e999, 1]})"), "/frame/0/image/zoom/0", "1e999"},
    {command(R"("image": {"at": [0, 0], "file": "x.png", "color": [1, 1, 1, 1]})"), "/frame/0/image/color", "unknown key \"color\""},
    {command(R"("image": {"at": [0, 0], "file": "x.png", "depth": -1})"), "/frame/0/image/depth", "found -1, expected a number from 0 to 1"},

    // Clears
    {command(R"("clear": {"color": [0, 0, 0, 1.5]})"), "/frame/0/clear/color/3", "found 1.5, expected a number from 0 to 1"},
    {command(R"("clear": {"color": [0, 0, 0]})"), "/frame/0/clear/color", "found an array of 3, expected an array of 4 numbers"},
    {command(R"("clear": {"depth": -0.1})"), "/frame/0/clear/depth", "found -0.1, expected a number from 0 to 1"},
    {command(R"("clear": {"depth": true})"), "/frame/0/clear/depth", "found true, expected a number"},
    {command(R"("clear": {"stencil": 256})"), "/frame/0/clear/stencil", "found 256, expected an integer from 0 to 255"},
    {command(R"("clear": {"stencil": 0.5})"), "/frame/0/clear/stencil", "found 0.5, expected an integer from 0 to 255"},
    {command(R"("clear": {"index": 1})"), "/frame/0/clear/index", "needs an index buffer"},
    {command(R"("clear": {"index": -1})", kIndex), "/frame/0/clear/index", "found -1, expected an integer from 0"},
    {command(R"("clear": {"index": "red"})", kIndex), "/frame/0/clear/index", "found \"red\", expected a number"},
    {command(R"("clear": {"depth": 1})", R"("depth": "none")"), "/frame/0/clear/depth", "needs a depth buffer, and the frame buffer's \"depth\" is \"none\""},
    {command(R"("clear": {"stencil": 0})", R"("stencil": 0)"), "/frame/0/clear/stencil", "needs a stencil buffer, and the frame buffer's \"stencil\" is 0"},
    {command(R"("clear": {"accumulation": [0,0,0,0]})", R"("accumulation": 0)"), "/frame/0/clear/accumulation",
     "needs an accumulation buffer, and the frame buffer's \"accumulation\" is 0"},
    {command(R"("clear": {"accumulation": [0,0,0,-2]})"), "/frame/0/clear/accumulation/3", "found -2, expected a number from -1 to 1"},
    {command(R"("clear": {"accumulation": 0})"), "/frame/0/clear/accumulation", "found 0, expected an array of 4 numbers"},
    {command(R"("clear": {"scissor": [0, 0, 5, -1]})"), "/frame/0/clear/scissor/3", "found -1, expected an integer from 0"},

    // Accumulation
    {command(R"("accum": {"op": "load", "value": 1})", R"("accumulation": 0)"), "/frame/0/accum", "needs an accumulation buffer, and the frame buffer's \"accumulation\" is 0"},
    {command(R"("accum": {"op": "load", "value": 1})", kIndex), "/frame/0/accum", "an index buffer does not accumulate"},
    {command(R"("accum": {"op": "load"})"), "/frame/0/accum", "key \"value\" is missing"},
    {command(R"("accum": {"value": 1})"), "/frame/0/accum", "key \"op\" is missing"},
    {command(R"("accum": [])"), "/frame/0/accum", "found an empty array, expected an object"},
    {command(R"("accum": {"op": "sub", "value": 1})"), "/frame/0/accum/op", "found \"sub\", expected one of \"accum\", \"load\", \"add\", \"mult\", \"return\""},
    {command(R"("accum": {"op": "load", "value": "1"})"), "/frame/0/accum/value", "found \"1\", expected a number"},
    {command(R"("accum": {"op": "load", "value": 1, "scissor": [0, 0]})"), "/frame/0/accum/scissor", "found an array of 2, expected [x, y, width, height]"},
    {command(R"("accum": {"op": "load", "value": 1, "colour_mask": []})"), "/frame/0/accum/colour_mask", "did you mean \"color_mask\"?"},
    {command(R"("accum": {"op": "return", "value": 1, "color_mask": true})"), "/frame/0/accum/color_mask", "found true, expected four of true and false"},
    {command(R"("accum": {"op": "return", "value": 1, "color_mask": [true,false,true,true]})", R"("accumulation": 16, "color": {"bits": 1})"), "/frame/0/accum/color_mask",
     "must be all true or all false"},

    // Operations on fragments
    {draw(R"("polygon_offset": 1)"), "/frame/0/polygon_offset", "found 1, expected [factor, units]"},
    {draw(R"("polygon_offset": [1])"), "/frame/0/polygon_offset", "found an array of 1, expected [factor, units]"},
    {draw(R"("polygon_offset": [1, "1"])"), "/frame/0/polygon_offset/1", "found \"1\", expected a number"},
    {draw(R"("polygon_offset": [1e39, 0])"), "/frame/0/polygon_offset/0", "32-bit float"},
    {draw_into(R"("depth": "none")", R"("polygon_offset": [0, -1])"), "/frame/0/polygon_offset", "needs a depth buffer, and the frame buffer's \"depth\" is \"none\""},
    {draw(R"("alpha_test": true)"), "/frame/0/alpha_test", "found true, expected an object"},
    {draw(R"("alpha_test": {"func": "gt"})"), "/frame/0/alpha_test/func", "found \"gt\", expected one of \"never\", \"less\""},
    {draw(R"("alpha_test": {"ref": 1.25})"), "/frame/0/alpha_test/ref", "found 1.25, expected a number from 0 to 1"},
    {draw(R"("alpha_test": {"ref": null})"), "/frame/0/alpha_test/ref", "found null, expected a number"},
    {draw(R"("alpha_test": {"threshold": 0})"), "/frame/0/alpha_test/threshold", "unknown key \"threshold\", expected one of \"func\", \"ref\""},
    {draw_into(kIndex, R"("alpha_test": {})"), "/frame/0/alpha_test", "an index buffer has no alpha to test"},
    {draw_into(R"("stencil": 0)", R"("stencil": {})"), "/frame/0/stencil", "needs a stencil buffer, and the frame buffer's \"stencil\" is 0"},
    {draw(R"("stencil": [])"), "/frame/0/stencil", "found an empty array, expected an object"},
    {draw(R"("stencil": {"func": 3})"), "/frame/0/stencil/func", "found 3, expected one of \"never\""},
    {draw(R"("stencil": {"ref": 256})"), "/frame/0/stencil/ref", "found 256, expected an integer from 0 to 255"},
    {draw(R"("stencil": {"ref": -1})"), "/frame/0/stencil/ref", "found -1, expected an integer from 0 to 255"},
    {draw(R"("stencil": {"mask": 0.5})"), "/frame/0/stencil/mask", "found 0.5, expected an integer from 0 to 255"},
    {draw(R"("stencil": {"write_mask": "ff"})"), "/frame/0/stencil/write_mask", "found \"ff\", expected a number"},
    {draw(R"("stencil": {"write_mask": 256})"), "/frame/0/stencil/write_mask", "found 256, expected an integer from 0 to 255"},
    {draw(R"("stencil": {"fail": "increment"})"), "/frame/0/stencil/fail", "found \"increment\", expected one of \"keep\", \"zero\""},
    {draw(R"("stencil": {"zfail": "wrap_incr"})"), "/frame/0/stencil/zfail", "\"incr_wrap\", \"decr_wrap\""},
    {draw(R"("stencil": {"zpass": false})"), "/frame/0/stencil/zpass", "found false, expected one of \"keep\""},
    {draw(R"("stencil": {"pass": "keep"})"), "/frame/0/stencil/pass", "unknown key \"pass\""},
    {draw(R"("stencil": {"back": true})"), "/frame/0/stencil/back", "found true, expected an object"},
    {draw(R"("stencil": {"back": {"ref": 300}})"), "/frame/0/stencil/back/ref", "found 300, expected an integer from 0 to 255"},
    {draw(R"("stencil": {"back": {"back": {}}})"), "/frame/0/stencil/back/back", "unknown key \"back\""},
    {draw_into(kIndex, R"("blend": {})"), "/frame/0/blend", "an index buffer does not blend"},
    {draw(R"("blend": true)"), "/frame/0/blend", "found true, expected an object"},
    {draw(R"("blend": {"src": "alpha"})"), "/frame/0/blend/src", "found \"alpha\", expected one of \"zero\", \"one\""},
    {draw(R"("blend": {"src": null})"), "/frame/0/blend/src", "found null, expected one of \"zero\", \"one\""},
    {draw(R"("blend": {"dst": "one_minus_srcalpha"})"), "/frame/0/blend/dst", "did you mean \"one_minus_src_alpha\"?"},
    {draw(R"("blend": {"src_alpha": 1})"), "/frame/0/blend/src_alpha", "found 1, expected one of \"zero\", \"one\""},
    {draw(R"("blend": {"dst_alpha": "two"})"), "/frame/0/blend/dst_alpha", "found \"two\", expected one of \"zero\", \"one\""},
    {draw(R"("blend": {"equation": "multiply"})"), "/frame/0/blend/equation", "found \"multiply\", expected one of \"add\", \"subtract\", \"reverse_subtract\", \"min\", \"max\""},
    {draw(R"("blend": {"color": [0, 0, 0]})"), "/frame/0/blend/color", "found an array of 3, expected an array of 4 numbers"},
    {draw(R"("blend": {"color": [0, 0, 1.5, 0]})"), "/frame/0/blend/color/2", "found 1.5, expected a number from 0 to 1"},
    {draw(R"("blend": {"color": [0, -0.5, 0, 0]})"), "/frame/0/blend/color/1", "found -0.5, expected a number from 0 to 1"},
    {draw(R"("blend": {"factor": 1})"), "/frame/0/blend/factor", "unknown key \"factor\""},
    {draw(R"("blend": {}, "logic_op": "xor")"), "/frame/0/blend", "a draw blends or has a logic operation, not both"},
    {draw(R"("logic_op": "exor")"), "/frame/0/logic_op", "found \"exor\", expected one of \"clear\", \"and\""},
    {draw(R"("logic_op": true)"), "/frame/0/logic_op", "found true, expected one of \"clear\", \"and\""},
    {draw(R"("logic_op": "and_")"), "/frame/0/logic_op", "did you mean \"and\"?"},
};

// What may stand beside each other, and looks as if it might not.
const std::string kGoodScenes[] = {
    draw_into(R"("depth": "none")", R"("polygon_offset": [0, 0], "depth": false)"),
    draw(R"("blend": {"src_alpha": null, "dst_alpha": null}, "logic_op": "copy")"),
    draw(R"("stencil": {"back": null}, "alpha_test": {})"),
    draw_into(kIndex, R"("logic_op": "xor", "stencil": {}, "polygon_offset": [1, 1])"),
    draw_into(R"("stencil": 0, "alpha": 8, "accumulation": 32, "samples": 8, "dither": "bayer8")", R"("blend": {})"),
    index_buffer(R"("alpha": 0, "accumulation": 0, "samples": 1, "dither": "bayer2")"),
    command(R"("clear": {"index": 255, "color": [1, 1, 1, 1]})", kIndex),
    good_bitmap(R"("depth": 0.5, "stencil": {"back": null}, "logic_op": "xor", "scissor": [0, 0, 1, 1])", kIndex),
    good_bitmap(R"("depth": 0.5, "blend": {}, "alpha_test": {})", R"("depth": "none")"),
    good_bitmap(R"("depth": {"test": "always", "write": false}, "color": [2, -1, 0, 0.5], "plane_mask": 0)"),
    R"("lights": [], )" + kPot + R"("frame": [{"lights": [{}]}, {"draw": "pot", "shadow_on": {"plane": [0, 0, -2, 1], "color": [0, 0, 0, 0.5]}, "lighting": true}])",
};

TEST(BadScene, EachMistakeNamesFilePointerAndExpectation) {
  for (const BadScene& bad : kBadScenes) {
    const std::string message = message_of(whole(bad.text));
    EXPECT_TRUE(message.starts_with("bad.json: " + bad.pointer + ": ")) << bad.text << "\n" << message;
    EXPECT_NE(message.find(bad.fragment), std::string::npos) << bad.text << "\n" << message << "\nlacks " << bad.fragment;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(BadScene, WhatFitsTogetherIsNoMistake) {
  for (const std::string& good : kGoodScenes) EXPECT_EQ(message_of(whole(good)), "(no error)") << good;
}

TEST(BadScene, MissingFileAndFolderAreNamed) {
  for (const char* path : {"/no such folder/scene.json", "/"}) {
    try {
      load_scene(path);
      FAIL();
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(std::string("cannot read \"") + path), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace tessera
