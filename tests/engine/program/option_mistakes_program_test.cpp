// Mistakes on the command line: each gives one line that names what was typed, and the documented exit code.
#ifdef TESSERA_PROGRAM
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/engine/program/mistakes.h"

namespace tessera::option_mistakes_program_test {
namespace {

/// A folder with two pictures, a scene in which nothing moves, and files that are neither.
class OptionMistakes : public Mistakes {
 protected:
  OptionMistakes() {
    write("a.ppm", "P6 8 8 255 " + std::string(192, 'a'));
    write("b.ppm", "P6 4 4 255 " + std::string(48, 'b'));
    write("bad.ppm", "P6 8 8 255 abc");
    write("notes.txt", "hello");
    write("bad.obj", "v 0 0 0\nf 1 2 3\n");
    write("still.json", R"({"tessera": 1, "framebuffer": {"width": 8, "height": 8}})");
    write("blend.json", R"({"tessera": 1, "framebuffer": {"width": 8, "height": 8},
      "meshes": {"a": {"builtin": "cube"}}, "frame": [{"draw": "a", "blend": {}}]})");
  }
};

TEST_F(OptionMistakes, NamesUnknownWords) {
  const Mistake kRows[] = {
      {"rendr", 2, R"(unknown command "rendr"; did you mean "render"?)"},
      {"render.json", 2, R"(unknown command "render.json")"},
      {"--verbose", 2, R"(unexpected argument "--verbose")"},
      {"render --colour-bits 4", 2, R"(unexpected argument "--colour-bits"; did you mean "--color-bits"?)"},
      {"render a.json b.json", 2, R"(unexpected argument "b.json")"},
      {"explain still.json --frames 2", 2, R"(unexpected argument "--frames")"},
      {"info x", 2, R"(unexpected argument "x")"},
      {"formats --json", 2, R"(unexpected argument "--json")"},
      {"man render", 2, R"(unexpected argument "render")"},
      {"help rendr", 2, R"(unknown command "rendr"; did you mean "render"?)"},
      {"help render explain", 2, R"(unexpected argument "explain")"},
  };
  for (const Mistake& row : kRows) expect_one_line(row);
}

TEST_F(OptionMistakes, NamesWrongValues) {
  const Mistake kRows[] = {
      {"render ''", 2, R"(input: found "", expected a scene's or a model's name)"},
      {"render --size 640", 2, R"(--size: found "640", expected WIDTHxHEIGHT, each 1 to 16384)"},
      {"render --size 0x480", 2, R"(--size: found "0x480", expected WIDTHxHEIGHT, each 1 to 16384)"},
      {"render --size 640*480", 2, R"(--size: found "640*480", expected WIDTHxHEIGHT, each 1 to 16384)"},
      {"render --shading gourad", 2,
       R"(--shading: found "gourad", expected one of flat, gouraud, phong; did you mean "gouraud"?)"},
      {"render --quality speed=1", 2,
       R"(--quality: found key "speed", expected one of shading, renormalize, viewer, interpolation,)"},
      {"render --quality shading=fast", 2,
       R"(--quality: found shading "fast", expected one of as_asked, phong_2x2, phong_4x4, gouraud, flat)"},
      {"render --quality light_threshold=2", 2,
       R"(--quality: found light_threshold "2", expected a number from 0 to 1)"},
      {"render --color-bits 25", 2, R"(--color-bits: found "25", expected an integer from 1 to 24)"},
      {"render --palette ega", 2,
       R"(--palette: found "ega", expected one of bw, gray, ega16, vga256, web216, adaptive, ramps)"},
      {"render --dither bayer5", 2,
       R"(--dither: found "bayer5", expected one of none, bayer2, bayer4, bayer8, blue_noise,)"},
      {"render --dither-gamma 9 --dither bayer4 --dither-in light", 2,
       R"(--dither-gamma: found "9", expected a number from 1 to 4)"},
      {"render --mode cgaa", 2, R"(--mode: mode "cgaa" is unknown, expected one of)"},
      {"render --mode cga:palete=1", 2,
       R"(--mode: "cga" has no parameter "palete", expected palette, intensity, background)"},
      {"render --mode cga:palette=7", 2, R"(--mode: "cga": palette is "7", expected one of 0, 1, mode5)"},
      {"render --mode 640x480x99", 2, R"(--mode: "640x480x99" has 99 bits per pixel, must be 1 to 24)"},
      {"render --display crtt", 2, R"(--display: found display "crtt", expected one of)"},
      {"render --display crt:pich=0.3", 2, R"(--display: found "pich=0.3", expected NAME)"},
      {"render --display crt:pitch=9", 2, R"(--display: pitch: found "9", expected 0.05 to 5 (mm))"},
      {"render --display vga14 --part 1,2,3", 2,
       R"(--part: found "1,2,3", expected X,Y,W,H in millimetres: the upper left corner, at least 0,)"},
      {"render --display vga14 --scale 0", 2, R"(--scale: found "0", expected a number above 0)"},
      {"render --display vga14 --gain 0", 2, R"(--gain: found "0", expected a number from 0.01 to 100)"},
      {"render --camera 1,2,3", 2,
       R"(--camera: found "1,2,3", expected EX,EY,EZ,TX,TY,TZ[,FOVY]: eye, target, vertical angle in)"},
      {"render --camera 1,2,3,1,2,3", 2,
       "--camera: found eye and target both at 1,2,3, expected two different points"},
      {"render --camera 1,2,3,0,0,0,180", 2,
       "--camera: found the vertical angle 180, expected an angle above 0 and below 180 degrees"},
      {"render --light 1,2", 2,
       R"(--light: found "1,2", expected X,Y,Z[,W]: a position, or with W = 0 a direction)"},
      {"render --light 0,0,0,0", 2, "--light: found the direction 0,0,0, expected a direction with a length"},
      {"render --background 2,0,0", 2,
       R"(--background: found "2,0,0", expected none, #RRGGBB, or R,G,B, each 0 to 1)"},
      {"render --background '#12345'", 2,
       R"(--background: found "#12345", expected none, #RRGGBB, or R,G,B, each 0 to 1)"},
      {"render --samples 2", 2, R"(--samples: found "2", expected one of 1, 4, 8)"},
      {"render --up w", 2, R"(--up: found "w", expected one of x, y, z, -x, -y, -z)"},
      {"render --frames 0", 2, R"(--frames: found "0", expected an integer from 1 to 1000000)"},
      {"render --repeat -1", 2, R"(--repeat: found "-1", expected an integer from 1 to 1000000)"},
      {"render --threads 0", 2, R"(--threads: found "0", expected an integer from 1 to 1024)"},
      {"render --threads 5000", 2, R"(--threads: found "5000", expected an integer from 1 to 1024)"},
      {"render --tile-size 48", 2, R"(--tile-size: found "48", expected one of 32, 64, 128)"},
      {"render --isa sse", 2, R"(--isa: found "sse", expected one of scalar, avx2, avx512)"},
      {"render --elide maybe", 2, R"(--elide: found "maybe", expected one of on, off)"},
      {"render --stats=xml", 2, R"(--stats: found "xml", expected one of text, json)"},
      {"render --progress sometimes", 2,
       R"(--progress: found "sometimes", expected one of auto, always, never)"},
      {"render --log error", 2, R"(--log: found "error", expected one of debug, info, warning)"},
      {"render still.json --dump x.bin", 2,
       "--dump writes the memory of a display mode, and the scene has none; name one with --mode"},
      {"compare a.ppm a.ppm --ppd 0", 2, R"(--ppd: found "0", expected a number from 1 to 1000)"},
      {"modes --modes cga,egga -o out", 2, R"(--modes: mode "egga" is unknown, expected one of)"},
      {"modes --dithers bayer -o out", 2,
       R"(--dithers: found "bayer", expected one of none, bayer2, bayer4, bayer8, blue_noise,)"},
      {"color 1 1 1 --to labb", 2, R"(--to: found "labb", expected one of)"},
      {"color 1 1 x --to lab", 2,
       R"(VALUES: found "x", expected a number from -1e6 to 1e6 or a colour as #RRGGBB)"},
      {"color '#12' --to lab", 2,
       R"(VALUES: found "#12", expected # and six hexadecimal digits, as in #80ff00)"},
      {"display a.ppm --display ntsc -o x.ppm --signal s.txt", 2,
       R"(--signal: found "s.txt", expected a name that ends in .pfm)"},
      {"display --presets -o -", 2, R"(-o: found "-", expected a folder)"},
      {"display --presets -o out --near 2,2", 2,
       R"(--near: found "2,2", expected X,Y from 0 to 1: shares of the screen's width and height)"},
      {"completion csh", 2, R"(shell: found "csh", expected one of bash, zsh, fish; did you mean "zsh"?)"},
  };
  for (const Mistake& row : kRows) expect_one_line(row);
}

TEST_F(OptionMistakes, NamesContradictions) {
  const Mistake kRows[] = {
      {"render --palette ega16 --color-bits 3 -o x.ppm", 2,
       "palette: ega16 has 16 entries, 3 bits hold at most 8"},
      {"render --palette web216 --mode cga -o x.ppm", 2,
       "palette: web216 has 216 entries, 2 bits hold at most 4"},
      {"render --mode cga --size 8x8", 2, R"(the size is that of display mode "cga" and cannot be set)"},
      {"render --mode cga --color-bits 2", 2,
       R"(the color bits are those of display mode "cga" and cannot be set)"},
      {"render --reduce", 2,
       "colors are reduced to those of a display mode, and the scene has none; name one with --mode"},
      {"render --samples 4 --palette ega16", 2,
       "4 samples per pixel need RGB colors, and the frame buffer holds palette indices, which have no mean"},
      {"render --frames 3 --turntable 3", 2, "--frames excludes --turntable"},
      {"render --turntable 3 -o x.ppm", 2,
       R"(-o: 3 frames would overwrite "x.ppm"; put {frame} into the name, or write an animated .png)"},
      {"render --turntable 3 -o 'x{frame}.png' --delay 40", 2,
       "--delay: is for animated PNG files: several frames, -o FILE.png without {frame}"},
      {"render still.json -o - --stats=json", 2,
       "the picture and --stats=json cannot both go to the standard output"},
      {"render blend.json --palette ega16", 2,
       "blend.json: /frame/0: Frame::draw: blending is asked for, but the frame buffer holds indices, which "
       "do not blend"},
      {"modes --diagonal 17 --pitch 0.28 -o out", 2, "--diagonal: finds the mode of a screen, excludes -o"},
      {"display a.ppm --display crt -o x.ppm --signal s.pfm", 2,
       "--signal: the display has no signal, expected one of kind ntsc or pal"},
      {"display a.ppm b.ppm --display crt -o x.ppm", 2,
       R"(2 pictures would overwrite "x.ppm" with every frame; put {frame} into the name)"},
  };
  for (const Mistake& row : kRows) expect_one_line(row);
}

TEST_F(OptionMistakes, NamesOptionsWithoutEffect) {
  const Mistake kRows[] = {
      {"render --frames 3", 2,
       "--frames: needs a scene in which something moves, and nothing does; all frames would be equal"},
      {"render --threshold 3", 2, "--threshold: needs --compare, the reference"},
      {"render still.json --input-format json", 2,
       "--input-format: is for the input -, standard input, alone"},
      {"explain --threads 2", 2, "--threads: needs --measure"},
      {"modes still.json", 2, R"(still.json: needs -o DIR, the folder for pictures and tables)"},
      {"modes --diagonal 17", 2, "--diagonal: needs --pitch, the distance of the screen's dots"},
      {"color '#123456' --from lab --to rgb", 2,
       R"(VALUES: found "#123456", but #RRGGBB is for spaces of R'G'B'; expected three numbers of lab)"},
      {"color --list 1 1 1", 2, "values: has no effect with --list"},
      {"display --list --gain 2", 2, "--gain: has no effect with --list"},
      {"display --json", 2, "--json: needs --list"},
      {"display --presets -o out --gain 2", 2,
       "--gain: excludes --presets, which chooses displays, modes and views"},
      {"selftest --hashes --expect none.txt", 2,
       "--expect: has no effect with --hashes, which compares nothing"},
      {"render --compression 3 -o a.ppm", 2, "--compression: is for PNG files, and the picture is none"},
      {"render --palette adaptive --palette-over frame", 2,
       "--palette-over: needs --frames or --turntable with more than one picture"},
      {"render --turntable 1", 2, "--turntable: needs at least 2 pictures, one alone shows no turn"},
      {"render --scale 3", 2, "--scale: needs --display"},
      {"render --part 0,0,9,9", 2, "--part: needs --display"},
      {"render --gain 2", 2, "--gain: needs --display"},
      {"render --frame-ms 20", 2, "--frame-ms: needs --display"},
      {"render --display crt --frame-ms 20", 2,
       "--frame-ms: needs --frames or --turntable with more than one picture"},
      {"render --import-memory 100", 2,
       "--import-memory: limits reading a model, and the built-in scene has none"},
      {"render still.json --import-seconds 9", 2,
       "--import-seconds: limits reading a model, and the scene has none"},
      {"render --up z", 2, "--up: is for models, and the input is a scene"},
      {"render still.json --shading flat", 2, "--shading: needs a scene that draws a mesh"},
      {"render still.json --wireframe", 2, "--wireframe: needs a scene that draws a mesh"},
      {"render still.json --light 0,0,1", 2, "--light: needs a draw with lighting, and the scene has none"},
      {"render --dither-in light", 2,
       "--dither-in: needs a dither, and the frame buffer has none; name one with --dither"},
      {"render --dither-gamma 2", 2,
       "--dither-gamma: needs a dither, and the frame buffer has none; name one with --dither"},
      {"render --dither bayer4 --dither-gamma 2", 2, "--dither-gamma: needs --dither-in light"},
      {"explain still.json --shading flat", 2, "--shading: needs a scene that draws a mesh"},
      {"selftest --hashes --threads 2", 2, "--threads: has no effect with --hashes"},
      {"modes --dithers none --dither-in light -o out", 2, "--dither-in: has no effect with --dithers none"},
      {"modes --import-memory 100 -o out", 2,
       "--import-memory: limits reading a model, and the built-in scene has none"},
      {"modes --threads 2", 2, "--threads: needs -o DIR, the folder for pictures and tables"},
      {"color --list --json --from lab", 2, "--from: has no effect with --list"},
      {"display a.ppm --display crt -o x.png --frame-ms 3", 2, "--frame-ms: needs more than one picture"},
      {"display a.ppm --display crt -o x.ppm --compression 3", 2,
       "--compression: is for PNG files, and the image is none"},
      {"display a.ppm --display crt -o x.png --near 0,0", 2, "--near: needs --presets"},
  };
  for (const Mistake& row : kRows) expect_one_line(row);
}

TEST_F(OptionMistakes, NamesWhatIsMissing) {
  const Mistake kRows[] = {
      {"render -o", 2, "--output: found no value, expected FILE"},
      {"render --size", 2, "--size: found no value, expected WIDTHxHEIGHT"},
      {"render -", 2, "--input-format: found none, the input - needs one, such as stl"},
      {"compare a.ppm", 2, "B is required"},
      {"color 1 1", 2, "--to: found no space, expected one of"},
      {"color 1 1 1", 2, "--to: found no space, expected one of"},
      {"display", 2, "PICTURE: found none, expected a picture, frames in order, or --list"},
      {"display a.ppm", 2,
       "--display: found none, expected a kind or a preset; tessera display --list has all"},
      {"display a.ppm --display crt", 2, "-o: found none, expected a file"},
      {"display --presets", 2, "-o: found none, expected a folder"},
      {"scene", 2, "model is required"},
      {"completion", 2, "shell is required"},
  };
  for (const Mistake& row : kRows) expect_one_line(row);
}

TEST_F(OptionMistakes, NamesFiles) {
  const Mistake kRows[] = {
      {"render --compare none.json", 1, R"(cannot read "none.json": No such file or directory)"},
      {"render --compare still.json -o x.ppm", 1,
       R"(cannot read "still.json": it is no picture of a known format; "tessera formats" lists them)"},
      {"render --compare bad.ppm -o x.ppm", 1, R"(cannot read "bad.ppm": it ends before its last pixel)"},
      {"render --compare b.ppm -o x.ppm", 1,
       "the picture is 640x480, the reference 4x4; both must have the same size"},
      {"render - --input-format xyz </dev/null", 1,
       R"(standard input: the file name extension is ".xyz", expected one of those listed by "tessera)"},
      {"render still.json -o still.json", 1,
       R"(the picture "still.json" would overwrite the input "still.json"; name another file with -o)"},
      {"render still.json -o none/x.png", 1, R"(cannot write "none/x.png": there is no folder "none")"},
      {"render still.json -o x", 1,
       R"(cannot write "x": the name has no extension, expected one such as .png or .ppm)"},
      {"render still.json -o x.xyz", 1,
       R"(cannot write "x.xyz": OpenImageIO does not support the format .xyz)"},
      {"render still.json -o x.pbm", 1,
       R"(cannot write "x.pbm": a .pbm file holds 1 bit per pixel; write a .png or .ppm, or the planes)"},
      {"render still.json --planes still.json -o x.ppm", 1,
       R"(cannot make the folder "still.json": Not a directory)"},
      {"explain none.json", 1, R"(cannot read "none.json": No such file or directory)"},
      {"compare a.ppm b.ppm", 1, R"("a.ppm" is 8x8, "b.ppm" is 4x4; both must have the same size)"},
      {"compare a.ppm none.ppm", 1, R"(cannot read "none.ppm": No such file or directory)"},
      {"compare a.ppm a.ppm --map still.xyz", 1,
       R"(cannot write "still.xyz": OpenImageIO does not support the format .xyz)"},
      {"compare a.ppm a.ppm --map a.ppm", 1,
       R"(the picture "a.ppm" would overwrite the input "a.ppm"; name another file with --map)"},
      {"display a.ppm --mode cga --display crt -o x.ppm", 1,
       R"("a.ppm" is 8x8, expected 320x200, the size of display mode "cga")"},
      {"scene still.json -o x.json", 1, R"("still.json" is a scene already, expected a model)"},
      {"scene none.obj -o x.json", 1, R"(cannot read "none.obj": No such file or directory)"},
      {"scene bad.obj -o x.txt", 1, R"(the scene file is "x.txt", its name must end in .json)"},
      {"selftest --expect none.txt", 1, R"(cannot read "none.txt": No such file or directory)"},
      {"selftest --expect notes.txt", 1,
       "notes.txt:1: expected a scene's name and four hashes of 16 hexadecimal digits, separated by single "
       "blanks"},
      {"render none.obj", 1, R"(cannot read "none.obj": No such file or directory)"},
  };
  for (const Mistake& row : kRows) expect_one_line(row);
}

// Options whose effect another option or the input makes possible.
TEST_F(OptionMistakes, AcceptsOptionsWithEffect) {
  write("move.json", R"({"tessera": 1, "framebuffer": {"width": 8, "height": 8},
    "frame": [{"clear": {"color": [{"keys": [[0, 0], [1, 1]]}, 0, 0, 1]}}]})");
  for (const char* arguments :
       {"render move.json --frames 2 -o 'm{frame}.ppm'", "render still.json --frames 1 -o x.ppm",
        "render still.json --display eink --scale 1 --frames 2 --frame-ms 20 -o 's{frame}.ppm'",
        "render still.json -o x.png --compression 9",
        "render still.json -o x.ppm --compare x.png --threshold 2",
        "render --size 8x8 --dither bayer4 --dither-in light --dither-gamma 2 --color-bits 3 -o x.ppm",
        "explain --measure --threads 2", "color --list --json", "display --list --json"}) {
    const Result result = run(arguments);
    EXPECT_EQ(result.code, 0) << arguments << "\n" << result.err;
  }
}

}  // namespace
}  // namespace tessera::option_mistakes_program_test
#endif
