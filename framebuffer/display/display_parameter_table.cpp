#include "framebuffer/display/display_parameter_table.h"

#include <type_traits>

namespace tessera::detail {
namespace {

constexpr std::string_view kChoice = "choice";

/// The member of a part of Display: get_member<&Display::crt, &CrtTube::mask>.
template <auto Part, auto Member>
Numbers get_member(const Display& display) {
  const auto& value = display.*Part.*Member;
  if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Numbers>) return value;
  else return {static_cast<double>(value)};
}
template <auto Part, auto Member>
void set_member(Display& display, const Numbers& numbers) {
  auto& value = display.*Part.*Member;
  using Value = std::decay_t<decltype(value)>;
  if constexpr (std::is_same_v<Value, Numbers>) value = numbers;
  else value = static_cast<Value>(numbers.front());
}

template <auto Part, auto Member>
constexpr MemberAccess kMember{&get_member<Part, Member>, &set_member<Part, Member>};
template <auto Member>
constexpr MemberAccess kOfTube = kMember<&Display::crt, Member>;
template <auto Member>
constexpr MemberAccess kOfLcd = kMember<&Display::lcd, Member>;
template <auto Member>
constexpr MemberAccess kOfPlasma = kMember<&Display::plasma, Member>;
template <auto Member>
constexpr MemberAccess kOfEink = kMember<&Display::eink, Member>;
template <auto Member>
constexpr MemberAccess kOfSignal = kMember<&Display::television, Member>;

template <class Enum>
constexpr Word word(std::string_view text, Enum enumerator) {
  return {text, static_cast<double>(enumerator)};
}

constexpr Word kMasks[] = {word("none", ShadowMask::none), word("dots", ShadowMask::dots),
                           word("slots", ShadowMask::slots), word("grille", ShadowMask::grille)};
constexpr Word kScanLines[] = {{"auto", 0}, {"1", 1}, {"2", 2}, {"3", 3}, {"4", 4}};
constexpr Word kInterlace[] = {word("auto", Interlace::as_mode), word("off", Interlace::off),
                               word("on", Interlace::on)};
constexpr Word kPrimaries[] = {word("bt709", DisplayPrimaries::bt709),
                               word("smpte-c", DisplayPrimaries::smpte_c),
                               word("ebu", DisplayPrimaries::ebu),
                               word("ntsc-1953", DisplayPrimaries::ntsc_1953),
                               word("trinitron", DisplayPrimaries::trinitron),
                               word("hitachi", DisplayPrimaries::hitachi)};
constexpr Word kWhites[] = {word("6500", DisplayWhite::d65), word("9300", DisplayWhite::k9300),
                            word("c", DisplayWhite::c)};
constexpr Word kPhosphors[] = {word("p22", Phosphor::p22), word("p1", Phosphor::p1),
                               word("p4", Phosphor::p4),   word("p11", Phosphor::p11),
                               word("p31", Phosphor::p31), word("p39", Phosphor::p39)};
constexpr Word kStripes[] = {word("rgb", SubpixelOrder::rgb), word("bgr", SubpixelOrder::bgr)};
constexpr Word kBits[] = {{"6", 6}, {"8", 8}};
constexpr Word kGreys[] = {{"2", 2}, {"16", 16}};
constexpr Word kUpdates[] = {word("full", EinkUpdate::full), word("fast", EinkUpdate::fast)};
constexpr Word kCables[] = {word("composite", VideoCable::composite), word("svideo", VideoCable::svideo)};
constexpr Word kNtscDecoders[] = {word("auto", VideoDecoder::automatic), word("notch", VideoDecoder::notch),
                                  word("comb", VideoDecoder::comb)};
constexpr Word kPalDecoders[] = {word("auto", VideoDecoder::automatic), word("notch", VideoDecoder::notch),
                                 word("comb", VideoDecoder::comb), word("simple", VideoDecoder::simple),
                                 word("delay_line", VideoDecoder::delay_line)};

constexpr NumberRange from(double min, double max) { return {.min = min, .max = max}; }
constexpr NumberRange automatic_or(double min, double max, double automatic = 0) {
  return {.min = min, .max = max, .automatic = automatic};
}

constexpr Parameter kTube[] = {
    {"diagonal", "inches", from(1, 100), kOfTube<&CrtTube::diagonal_in>, "visible diagonal of the 4:3 screen",
     kChoice},
    {"mask", "", kMasks, kOfTube<&CrtTube::mask>,
     "none: monochrome tubes; dots: on a hexagonal grid; slots: upright, with bridges; grille: stripes",
     kChoice},
    {"pitch", "mm", from(.05, 5), kOfTube<&CrtTube::pitch_mm>,
     "distance of nearest phosphors of one colour; slots, grille: horizontal",
     "0.28: VGA monitors; 0.64: television sets, Microvitec CUB 1431"},
    {"slot_height", "mm", automatic_or(.05, 10), kOfTube<&CrtTube::slot_height_mm>,
     "height of a slot with its bridge; auto: 2.5 times the pitch", kChoice},
    {"beam", "mm", automatic_or(.02, 5), kOfTube<&CrtTube::beam_mm>,
     "width of the Gaussian beam at half its maximum; auto: half the distance of scan lines", kChoice},
    {"beam_growth", "", from(0, 3), kOfTube<&CrtTube::beam_growth>,
     "relative growth of the width from dark to full current", kChoice},
    {"bandwidth", "MHz", automatic_or(.1, 1000), kOfTube<&CrtTube::bandwidth_mhz>,
     "frequency at which the video amplifier, a single pole, passes 0.707 of the amplitude; auto: half the "
     "pixel clock",
     kChoice},
    {"scan_lines", "", kScanLines, kOfTube<&CrtTube::lines_per_row>,
     "scan lines per row of pixels; auto: as the mode", "modes: registers of the adapters"},
    {"interlace", "", kInterlace, kOfTube<&CrtTube::interlace>,
     "a frame is two fields of half of the lines; auto: as the mode", "modes: registers of the adapters"},
    {"convergence", "mm", from(-2, 2), kOfTube<&CrtTube::convergence_mm>,
     "distance of the red picture to the left and of the blue one to the right of the green one", kChoice},
    {"halation", "", from(0, .5), kOfTube<&CrtTube::halation>, "share of the light that the glass scatters",
     kChoice},
    {"halation_radius", "mm", from(.5, 50), kOfTube<&CrtTube::halation_mm>,
     "standard deviation of the scattered light", kChoice},
    {"overscan", "", from(0, .3), kOfTube<&CrtTube::overscan>,
     "share of the picture's width and height beyond the screen", kChoice},
    {"primaries", "", kPrimaries, kOfTube<&CrtTube::primaries>, "colours of the phosphors",
     "trinitron, hitachi: color.org; smpte-c: SMPTE RP 145; ebu: EBU Tech. 3213"},
    {"white", "", kWhites, kOfTube<&CrtTube::white>, "colour of white: D65, 9300 K, illuminant C", kChoice},
    {"gamma", "", from(1, 4), kOfTube<&CrtTube::gamma>, "exponent of light over signal", "ITU-R BT.1886"},
    {"black", "", from(0, .5), kOfTube<&CrtTube::black>, "light of signal 0 over that of signal 1", kChoice},
    {"phosphor", "", kPhosphors, kOfTube<&CrtTube::phosphor>,
     "p22: of the three primaries; all others are monochrome and require mask=none",
     "EIA TEP116; decay: secondary sources"},
    {"exposure", "ms", automatic_or(.01, 1000), kOfTube<&CrtTube::exposure_ms>,
     "time over which light is collected; less than a frame shows the travelling beam; auto: one frame",
     kChoice},
};

constexpr Parameter kLcd[] = {
    {"diagonal", "inches", from(1, 100), kOfLcd<&LcdPanel::diagonal_in>, "visible diagonal", kChoice},
    {"stripes", "", kStripes, kOfLcd<&LcdPanel::stripes>, "order of the subpixels from left to right",
     kChoice},
    {"fill", "", from(.2, 1), kOfLcd<&LcdPanel::fill>, "share of a subpixel's width and height that emits",
     kChoice},
    {"bits", "", kBits, kOfLcd<&LcdPanel::bits>,
     "bits per component; 6: with temporal dither over four frames", kChoice},
    {"response", "ms", from(0, 1000), kOfLcd<&LcdPanel::response_ms>,
     "time from 10 to 90 % of a change; twisted nematic: 30 to 50 in 1995, 8 to 16 in 2005", kChoice},
    {"primaries", "", kPrimaries, kOfLcd<&LcdPanel::primaries>, "colours of the subpixels", kChoice},
    {"white", "", kWhites, kOfLcd<&LcdPanel::white>, "colour of the backlight", kChoice},
    {"gamma", "", from(1, 4), kOfLcd<&LcdPanel::gamma>, "exponent of light over signal", kChoice},
    {"black", "", from(0, .5), kOfLcd<&LcdPanel::black>, "light of signal 0 over that of signal 1", kChoice},
};

constexpr NumberRange kWeights{.min = .001, .max = 10000, .max_count = 12};

constexpr Parameter kPlasma[] = {
    {"diagonal", "inches", from(1, 200), kOfPlasma<&PlasmaPanel::diagonal_in>, "visible diagonal", kChoice},
    {"fill", "", from(.2, 1), kOfPlasma<&PlasmaPanel::fill>, "share of a cell's width and height that emits",
     kChoice},
    {"subfields", "", kWeights, kOfPlasma<&PlasmaPanel::subfields>,
     "light of the subfields relative to each other, in the order of time", "choice: eight binary weights"},
    {"primaries", "", kPrimaries, kOfPlasma<&PlasmaPanel::primaries>, "colours of the phosphors", kChoice},
    {"white", "", kWhites, kOfPlasma<&PlasmaPanel::white>, "colour of white", kChoice},
    {"gamma", "", from(1, 4), kOfPlasma<&PlasmaPanel::gamma>,
     "exponent of the light that the nearest sum of subfields approximates", kChoice},
    {"black", "", from(0, .5), kOfPlasma<&PlasmaPanel::black>,
     "light of the priming discharges over that of white", kChoice},
    {"exposure", "ms", automatic_or(.01, 1000), kOfPlasma<&PlasmaPanel::exposure_ms>,
     "time over which light is collected; less than a frame shows single subfields; auto: one frame",
     kChoice},
};

constexpr Parameter kEink[] = {
    {"diagonal", "inches", from(1, 100), kOfEink<&EinkPanel::diagonal_in>, "visible diagonal", kChoice},
    {"levels", "", kGreys, kOfEink<&EinkPanel::levels>, "greys", "panel makers: 16 by full updates"},
    {"white", "", from(.1, 1), kOfEink<&EinkPanel::white>, "reflectance of white",
     "panel makers: 0.40 to 0.45"},
    {"black", "", from(.001, .3), kOfEink<&EinkPanel::black>, "reflectance of black, below that of white",
     "panel makers: 0.03 to 0.04"},
    {"update", "", kUpdates, kOfEink<&EinkPanel::update>,
     "full: flashes, and leaves no ghost; fast: a share of the frame before stays", kChoice},
    {"ghost", "", from(0, .5), kOfEink<&EinkPanel::ghost>,
     "share of the frame before that a fast update leaves", kChoice},
};

constexpr Parameter decoder_of(std::span<const Word> decoders, std::string_view description) {
  return {"decoder", "", decoders, kOfSignal<&Television::decoder>, description, kChoice};
}

constexpr Parameter kSignal[] = {
    {"cable", "", kCables, kOfSignal<&Television::cable>,
     "composite: luma and chroma share a wire; svideo: two wires, no crosstalk", kChoice},
    {"luma", "MHz", automatic_or(1, 8), kOfSignal<&Television::luma_mhz>,
     "bandwidth of luma (-6 dB); auto: 4.2 for NTSC, 5.0 for PAL", "SMPTE 170M; ITU-R BT.470"},
    {"chroma", "MHz", automatic_or(.1, 3), kOfSignal<&Television::chroma_mhz>,
     "bandwidth of each colour difference at the encoder (-3 dB); auto: 1.3", "SMPTE 170M; ITU-R BT.470"},
    {"receiver", "MHz", automatic_or(.1, 3), kOfSignal<&Television::receiver_mhz>,
     "bandwidth of each colour difference in the receiver (-3 dB); auto: 0.5 for NTSC, 1.0 for PAL",
     "NTSC: usual in sets; PAL: choice"},
    {"phase", "degrees", from(-180, 180), kOfSignal<&Television::phase_deg>,
     "error of the subcarrier's phase between burst and chroma", kChoice},
    {"gain", "", from(0, 4), kOfSignal<&Television::gain>,
     "chroma relative to luma between encoder and receiver", kChoice},
};

constexpr Parameter kNtsc[] = {
    decoder_of(kNtscDecoders, "separation of luma and chroma: notch filter (auto), or comb of two lines"),
    {"setup", "IRE", automatic_or(0, 10, -1), kOfSignal<&Television::setup_ire>, "level of black; auto: 7.5",
     "SMPTE 170M"},
};

constexpr Parameter kPal[] = {
    decoder_of(kPalDecoders,
               "separation of luma and chroma: notch filter, comb of lines two apart, simple (as notch), or "
               "delay_line (auto: notch, and chroma averaged over two lines)"),
};

}  // namespace

std::vector<Parameter> parameter_table(DisplayKind kind) {
  std::vector<Parameter> table;
  const auto add = [&table](std::span<const Parameter> rows) {
    table.insert(table.end(), rows.begin(), rows.end());
  };
  switch (kind) {
    case DisplayKind::crt: add(kTube); break;
    case DisplayKind::lcd: add(kLcd); break;
    case DisplayKind::plasma: add(kPlasma); break;
    case DisplayKind::eink: add(kEink); break;
    case DisplayKind::ntsc:
    case DisplayKind::pal:
      add(kTube);
      add(kSignal);
      add(kind == DisplayKind::ntsc ? std::span<const Parameter>(kNtsc) : kPal);
      break;
  }
  return table;
}

}  // namespace tessera::detail
