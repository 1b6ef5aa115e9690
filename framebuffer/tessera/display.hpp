// Displays: plain descriptions of tubes, panels and televisions. Part of the library tessera::display.
//
//   using namespace tessera;
//   Display display = find_display("crt:pitch=0.31,mask=grille");
//   Screen screen(display, {.width = 640, .height = 480});                 // <tessera/screen.hpp>
//   std::vector<std::uint8_t> image(3u * screen.width() * screen.height());
//   screen.show({.rgb = pixels}, 0, {.rgb = image.data()});
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "display_export.h"

namespace tessera {

/// The exception type of tessera::display. what() names the value found and the values expected.
class TESSERA_DISPLAY_API DisplayError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

enum class DisplayKind : std::uint8_t {
  crt,     ///< cathode ray tube: beam, shadow mask, phosphor
  lcd,     ///< liquid crystal: stripes of subpixels that respond slowly
  plasma,  ///< cells that flash in subfields
  eink,    ///< reflective particles: few greys, a ghost of the frame before
  ntsc,    ///< tube behind an NTSC-M signal
  pal      ///< tube behind a PAL-B/G signal
};

/// Arrangement of the phosphors of a colour tube.
enum class ShadowMask : std::uint8_t {
  none,   ///< no structure: monochrome tubes
  dots,   ///< round dots; dots of one colour form a hexagonal grid
  slots,  ///< upright slots with bridges; neighbouring triads are shifted by half a slot
  grille  ///< continuous upright stripes
};

/// Phosphors by their JEDEC numbers (EIA TEP116). All but p22 are monochrome: the picture is its luma.
enum class Phosphor : std::uint8_t {
  p22,  ///< red, green and blue, of the tube's primaries
  p1,   ///< green; 10 % of the light after 24 ms
  p4,   ///< white, short
  p11,  ///< blue, short
  p31,  ///< green, short
  p39   ///< yellowish green; 10 % of the light after 150 ms
};

/// Sets of primaries; <tessera/rgb_primaries.hpp> has the values.
enum class DisplayPrimaries : std::uint8_t { bt709, smpte_c, ebu, ntsc_1953, trinitron, hitachi };

/// White of a display.
enum class DisplayWhite : std::uint8_t { d65, k9300, c };

enum class Interlace : std::uint8_t { as_mode, off, on };

/// Cathode ray tube with a 4:3 screen.
struct CrtTube {
  double diagonal_in = 14;  ///< visible diagonal, inches, 1 to 100
  ShadowMask mask = ShadowMask::dots;
  double pitch_mm =
      0.28;  ///< distance of nearest phosphors of one colour, 0.05 to 5; grille, slots: horizontal
  double slot_height_mm = 0;  ///< height of a slot with its bridge, 0.05 to 10; 0: 2.5 times the pitch
  /// Width of the beam at half its maximum, 0.02 to 5; the profile is Gaussian. 0: half the distance of
  /// lines.
  double beam_mm = 0;
  double beam_growth = 0;  ///< relative growth of the width from dark to full current, 0 to 3
  /// Frequency at which the video amplifier, a single pole, passes 0.707 of the amplitude, 0.1 to 1000.
  /// 0: half the pixel clock.
  double bandwidth_mhz = 0;
  int lines_per_row = 0;  ///< scan lines per row of pixels, 1 to 4; 0: as the mode says
  Interlace interlace = Interlace::as_mode;
  double convergence_mm = 0;  ///< distance of the red picture to the left and of the blue one to the right of
                              ///< the green one, -2 to 2
  double halation = 0;        ///< share of the light that the glass scatters, 0 to 0.5
  double halation_mm = 4;     ///< standard deviation of the scattered light, 0.5 to 50
  double overscan = 0;        ///< share of the picture's width and height beyond the screen, 0 to 0.3
  DisplayPrimaries primaries = DisplayPrimaries::trinitron;
  DisplayWhite white = DisplayWhite::d65;
  double gamma = 2.4;    ///< exponent of BT.1886, 1 to 4
  double black = 0.001;  ///< light of signal 0 over that of signal 1, 0 to 0.5
  Phosphor phosphor = Phosphor::p22;
  /// Time over which light is collected, milliseconds, 0.01 to 1000 and at most one frame; shorter times show
  /// the travelling beam. 0: one frame.
  double exposure_ms = 0;
};

/// Order of subpixels from left to right.
enum class SubpixelOrder : std::uint8_t { rgb, bgr };

/// Liquid crystal panel with the pixels of the mode.
struct LcdPanel {
  double diagonal_in = 15;  ///< visible diagonal, inches, 1 to 100
  SubpixelOrder stripes = SubpixelOrder::rgb;
  double fill = 0.8;       ///< share of a subpixel's width and height that emits, 0.2 to 1
  int bits = 8;            ///< 8, or 6 with temporal dither over four frames: 253 levels
  double response_ms = 0;  ///< time from 10 to 90 % of a change, 0 to 1000
  DisplayPrimaries primaries = DisplayPrimaries::bt709;
  DisplayWhite white = DisplayWhite::d65;  ///< white of the backlight
  double gamma = 2.2;                      ///< light over signal, 1 to 4
  double black = 0.0025;                   ///< light of signal 0 over that of signal 1, 0 to 0.5
};

/// Plasma panel with the pixels of the mode.
struct PlasmaPanel {
  double diagonal_in = 42;  ///< visible diagonal, inches, 1 to 200
  double fill = 0.75;       ///< share of a cell's width and height that emits, 0.2 to 1
  /// Light of the subfields relative to each other, 1 to 12 weights, each 0.001 to 10000.
  std::vector<double> subfields{1, 2, 4, 8, 16, 32, 64, 128};
  DisplayPrimaries primaries = DisplayPrimaries::bt709;
  DisplayWhite white = DisplayWhite::d65;
  double gamma = 2.2;    ///< light that the nearest sum of subfields approximates, over signal, 1 to 4
  double black = 0.001;  ///< light of the priming discharges over that of white, 0 to 0.5
  /// Time over which light is collected, milliseconds, as of a tube; shorter times show single subfields.
  double exposure_ms = 0;
};

enum class EinkUpdate : std::uint8_t {
  full,  ///< flashes the pixels; no ghost
  fast   ///< drives pixels directly; a share of the frame before stays
};

/// Electrophoretic panel with the pixels of the mode.
struct EinkPanel {
  double diagonal_in = 6;  ///< visible diagonal, inches, 1 to 100
  int levels = 16;         ///< greys: 16 or 2
  double white = 0.42;     ///< reflectance of white, 0.1 to 1
  double black = 0.035;    ///< reflectance of black, 0.001 to 0.3, below white
  EinkUpdate update = EinkUpdate::full;
  double ghost = 0.08;  ///< share of the frame before that a fast update leaves, 0 to 0.5
};

enum class VideoCable : std::uint8_t {
  composite,  ///< luma and chroma share one wire
  svideo      ///< two wires: no crosstalk
};

/// How a receiver separates luma and chroma, and demodulates.
enum class VideoDecoder : std::uint8_t {
  automatic,  ///< ntsc: notch, pal: delay_line
  notch,      ///< a filter takes the chroma band from the luma; on PAL as `simple`
  /// Half the difference of neighbouring lines (NTSC: one line apart, PAL: two) is chroma. Signals whose
  /// subcarrier does not turn by half a cycle over this distance, such as CGA's, are decoded as by `notch`.
  comb,
  simple,  ///< PAL without delay line: notch; a phase error turns the hues of lines to either side in turns
  delay_line  ///< PAL: notch, and chroma averaged with the line before, so that a phase error costs
              ///< saturation
};

/// Composite signal and receiver of ntsc and pal.
/// - A mode whose line rate is within 3 % of the system's is sent with its own timing: CGA has 228 cycles of
///   the subcarrier per line. Rows of other modes are the lines of an interlaced frame of 525 or 625 lines.
///   Each frame of the mode is one frame of the signal.
struct Television {
  VideoCable cable = VideoCable::composite;
  VideoDecoder decoder = VideoDecoder::automatic;
  double luma_mhz = 0;  ///< bandwidth of luma (-6 dB), 1 to 8; 0: 4.2 for NTSC, 5.0 for PAL
  /// Bandwidth of each colour difference at the encoder (-3 dB), 0.1 to 3; 0: 1.3
  double chroma_mhz = 0;
  /// Bandwidth of each colour difference in the receiver (-3 dB), 0.1 to 3; 0: 0.5 for NTSC, 1.0 for PAL. The
  /// notch takes as much from the luma on either side of the subcarrier.
  double receiver_mhz = 0;
  double phase_deg = 0;   ///< error of the subcarrier's phase between burst and chroma, -180 to 180
  double gain = 1;        ///< chroma relative to luma between encoder and receiver, 0 to 4
  double setup_ire = -1;  ///< NTSC: level of black, 0 to 10; -1: 7.5. The receiver is adjusted to it.
};

/// A display. Only the members of its kind are used; ntsc and pal use `crt` and `television`.
/// @code
/// Display display = find_display("vga");  // a preset, or "crt:pitch=0.31,mask=grille"
/// display.crt.mask = ShadowMask::slots;
/// check(display);
/// Screen screen(display, {.width = 640, .height = 480});
/// @endcode
struct Display {
  DisplayKind kind = DisplayKind::crt;
  CrtTube crt{};
  LcdPanel lcd{};
  PlasmaPanel plasma{};
  EinkPanel eink{};
  Television television{};
};

/// A kind with its name.
struct NamedDisplayKind {
  DisplayKind kind;
  std::string_view name;  ///< "crt"
  std::string_view description;
};

/// All kinds. The table is constant.
TESSERA_DISPLAY_API std::span<const NamedDisplayKind> display_kinds();

/// The display that the name of a kind means without parameters.
/// - Members have the defaults of their types, except that ntsc and pal have the tube of a television: 20
///   inches, slots of 0.64 mm, and the primaries smpte_c or ebu.
TESSERA_DISPLAY_API Display default_display(DisplayKind kind);

/// A display by name with parameters after a colon: "crt:diagonal=15,pitch=0.25,mask=grille".
/// - Names: the kinds (crt, lcd, plasma, eink, ntsc, pal), and those of display_presets().
/// - Parameters: those of display_parameters() for the kind; later ones replace earlier ones, and all replace
///   those of a preset.
/// - The result has passed check().
/// @throws DisplayError  for unknown names and values out of range
TESSERA_DISPLAY_API Display find_display(std::string_view text);

/// Checks that all values of a display's kind are in their ranges and fit together.
/// - Monochrome phosphors require ShadowMask::none.
/// - The black of paper is below its white.
/// - VideoDecoder::simple and VideoDecoder::delay_line are for PAL.
/// - An exposure longer than a frame is refused by Screen, which knows the mode.
/// @throws DisplayError
TESSERA_DISPLAY_API void check(const Display& display);

/// A parameter that find_display() reads.
struct DisplayParameter {
  std::string_view name;      ///< "pitch"
  std::string_view unit;      ///< "mm"; empty: a plain number or a word
  std::string values;         ///< "0.05 to 5", "0.02 to 5 or auto", or "none, dots, slots, grille"
  std::string default_value;  ///< "0.28"; of default_display()
  std::string_view description;
  std::string_view source;  ///< "choice" if the default has no source
};

/// The parameters of a kind.
TESSERA_DISPLAY_API std::vector<DisplayParameter> display_parameters(DisplayKind kind);

/// A display with a name.
struct DisplayPreset {
  std::string_view name;        ///< "vga14"
  std::string_view definition;  ///< as find_display() takes it: "crt:diagonal=14,pitch=0.28"
  std::string_view mode;        ///< a typical display mode: "vga"
  std::string_view description;
  std::string_view source;
};

/// All presets. The table is constant.
TESSERA_DISPLAY_API std::span<const DisplayPreset> display_presets();

}  // namespace tessera
