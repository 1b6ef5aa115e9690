// Displays by name: parsing, checking and listing of parameters, and the presets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "framebuffer/tessera/display.hpp"

namespace tessera::display_parameters_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string text_of(std::string_view view) { return std::string(view); }

/// The message of the error that find_display() throws; empty: none.
std::string error_of(const std::string& text) {
  try {
    find_display(text);
  } catch (const DisplayError& error) {
    return error.what();
  }
  return "";
}
std::string check_error(const Display& display) {
  try {
    check(display);
  } catch (const DisplayError& error) {
    return error.what();
  }
  return "";
}

/// All members in the order of the header; `subfields` last.
std::vector<double> members_of(const Display& display) {
  const auto& [kind, c, l, p, e, t] = display;
  std::vector<double> all{double(kind),
                          c.diagonal_in,
                          double(c.mask),
                          c.pitch_mm,
                          c.slot_height_mm,
                          c.beam_mm,
                          c.beam_growth,
                          c.bandwidth_mhz,
                          double(c.lines_per_row),
                          double(c.interlace),
                          c.convergence_mm,
                          c.halation,
                          c.halation_mm,
                          c.overscan,
                          double(c.primaries),
                          double(c.white),
                          c.gamma,
                          c.black,
                          double(c.phosphor),
                          c.exposure_ms,
                          l.diagonal_in,
                          double(l.stripes),
                          l.fill,
                          double(l.bits),
                          l.response_ms,
                          double(l.primaries),
                          double(l.white),
                          l.gamma,
                          l.black,
                          p.diagonal_in,
                          p.fill,
                          double(p.primaries),
                          double(p.white),
                          p.gamma,
                          p.black,
                          p.exposure_ms,
                          e.diagonal_in,
                          double(e.levels),
                          e.white,
                          e.black,
                          double(e.update),
                          e.ghost,
                          double(t.cable),
                          double(t.decoder),
                          t.luma_mhz,
                          t.chroma_mhz,
                          t.receiver_mhz,
                          t.phase_deg,
                          t.gain,
                          t.setup_ire};
  all.insert(all.end(), p.subfields.begin(), p.subfields.end());
  return all;
}
bool equal(const Display& a, const Display& b) { return members_of(a) == members_of(b); }

struct Case {
  NamedDisplayKind kind;
  DisplayParameter parameter;

  /// A display with this value, without a mask where phosphors require it.
  std::string with(const std::string& value) const {
    const bool excludes_masks = parameter.name == "phosphor";
    return text_of(kind.name) + (excludes_masks ? ":mask=none," : ":") + text_of(parameter.name) + "=" +
           value;
  }
};

/// Every parameter of every kind.
std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const NamedDisplayKind& kind : display_kinds())
    for (const DisplayParameter& parameter : display_parameters(kind.kind))
      cases.push_back({kind, parameter});
  return cases;
}

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + separator.size();
  }
  return parts;
}

/// The ends of "A to B", for lists those of each number.
bool has_range(const DisplayParameter& parameter, double& min, double& max) {
  const std::size_t at = parameter.values.rfind("each ");
  std::istringstream stream(parameter.values.substr(at == std::string::npos ? 0 : at + 5));
  std::string to;
  return static_cast<bool>(stream >> min >> to >> max) && to == "to";
}

std::string number(double value) {
  std::ostringstream stream;
  stream.precision(15);
  stream << value;
  return stream.str();
}

TEST(DisplayParameters, NamesOfKindsGiveTheirDefaults) {
  ASSERT_EQ(display_kinds().size(), 6u);
  for (const NamedDisplayKind& named : display_kinds()) {
    EXPECT_TRUE(equal(find_display(named.name), default_display(named.kind))) << named.name;
    EXPECT_EQ(find_display(named.name).kind, named.kind);
  }
  EXPECT_TRUE(equal(find_display("crt"), Display{}));
  EXPECT_TRUE(equal(find_display("eink"), Display{.kind = DisplayKind::eink}));
  EXPECT_EQ(find_display("ntsc").crt.primaries, DisplayPrimaries::smpte_c);
  EXPECT_EQ(find_display("pal").crt.primaries, DisplayPrimaries::ebu);
  EXPECT_EQ(find_display("pal").crt.mask, ShadowMask::slots);
}

TEST(DisplayParameters, DefaultsReadBack) {
  EXPECT_EQ(all_cases().size(), 19u + 9 + 8 + 6 + 27 + 26);
  for (const Case& row : all_cases()) {
    const std::string text =
        text_of(row.kind.name) + ":" + text_of(row.parameter.name) + "=" + row.parameter.default_value;
    EXPECT_TRUE(equal(find_display(text), default_display(row.kind.kind))) << text;
    EXPECT_FALSE(row.parameter.description.empty()) << text;
    EXPECT_FALSE(row.parameter.source.empty()) << text;
  }
}

TEST(DisplayParameters, RangesIncludeTheirEndsAndNothingBeyond) {
  int ranges = 0;
  for (const Case& row : all_cases()) {
    double min = 0, max = 0;
    if (!has_range(row.parameter, min, max)) continue;
    ++ranges;
    for (const double end : {min, max}) {
      const Display display = find_display(row.with(number(end)));
      EXPECT_FALSE(equal(display, find_display(row.with(number((min + max) / 2))))) << row.with(number(end));
    }
    for (const std::string& value :
         {number(min - .0005), number(max + .0005), std::string("nan"), std::string("inf"),
          std::string("-inf"), std::string(), std::string("x"), number(max) + "x", " " + number(max),
          "+" + number(max), std::string("1e999")})
      EXPECT_THAT(error_of(row.with(value)), HasSubstr(text_of(row.parameter.name) + ": found \"" + value +
                                                       "\", expected " + row.parameter.values))
          << row.with(value);
  }
  EXPECT_GE(ranges, 60);
}

TEST(DisplayParameters, WordsAreAllDifferentValues) {
  int lists = 0;
  for (const Case& row : all_cases()) {
    double min = 0, max = 0;
    if (has_range(row.parameter, min, max)) continue;
    ++lists;
    const std::vector<std::string> words = split(row.parameter.values, ", ");
    EXPECT_GE(words.size(), 2u) << row.parameter.values;
    for (const std::string& word : words)
      for (const std::string& other : words)
        EXPECT_EQ(equal(find_display(row.with(word)), find_display(row.with(other))), word == other)
            << row.with(word) << " " << other;
    for (const std::string value : {"", "x", "3.5", "AUTO"})
      EXPECT_THAT(error_of(row.with(value)), HasSubstr(text_of(row.parameter.name) + ": found \"" + value +
                                                       "\", expected " + row.parameter.values));
  }
  EXPECT_GE(lists, 20);
}

TEST(DisplayParameters, AutoIsTheValueOutsideOfTheRange) {
  EXPECT_EQ(find_display("crt:beam=0.3,beam=auto").crt.beam_mm, 0);
  EXPECT_EQ(find_display("crt:scan_lines=2").crt.lines_per_row, 2);
  EXPECT_EQ(find_display("crt:scan_lines=auto").crt.lines_per_row, 0);
  EXPECT_EQ(find_display("ntsc:setup=0").television.setup_ire, 0);
  EXPECT_EQ(find_display("ntsc:setup=auto").television.setup_ire, -1);
  EXPECT_EQ(error_of("crt:beam=0"), "beam: found \"0\", expected 0.02 to 5 or auto (mm)");
  EXPECT_EQ(error_of("crt:pitch=auto"), "pitch: found \"auto\", expected 0.05 to 5 (mm)");
}

TEST(DisplayParameters, ValuesReachTheirMembers) {
  const Display tube = find_display("crt:diagonal=17,mask=grille,pitch=0.25,white=9300,primaries=smpte-c");
  EXPECT_EQ(tube.crt.diagonal_in, 17);
  EXPECT_EQ(tube.crt.mask, ShadowMask::grille);
  EXPECT_EQ(tube.crt.pitch_mm, .25);
  EXPECT_EQ(tube.crt.white, DisplayWhite::k9300);
  EXPECT_EQ(tube.crt.primaries, DisplayPrimaries::smpte_c);
  const Display panel = find_display("lcd:bits=6,response=35,stripes=bgr");
  EXPECT_EQ(panel.lcd.bits, 6);
  EXPECT_EQ(panel.lcd.response_ms, 35);
  EXPECT_EQ(panel.lcd.stripes, SubpixelOrder::bgr);
  EXPECT_THAT(find_display("plasma:subfields=1+2+4.5").plasma.subfields, ElementsAre(1, 2, 4.5));
  EXPECT_THAT(find_display("plasma:subfields=7").plasma.subfields, ElementsAre(7));
  const Display paper = find_display("eink:levels=2,update=fast,ghost=0.2");
  EXPECT_EQ(paper.eink.levels, 2);
  EXPECT_EQ(paper.eink.update, EinkUpdate::fast);
  EXPECT_EQ(paper.eink.ghost, .2);
  const Display television =
      find_display("pal:decoder=simple,phase=-30,cable=svideo,luma=3,halation_radius=9");
  EXPECT_EQ(television.television.decoder, VideoDecoder::simple);
  EXPECT_EQ(television.television.phase_deg, -30);
  EXPECT_EQ(television.television.cable, VideoCable::svideo);
  EXPECT_EQ(television.television.luma_mhz, 3);
  EXPECT_EQ(television.crt.halation_mm, 9);
}

/// The member that two displays have different.
std::size_t changed_member(const Display& a, const Display& b) {
  const std::vector<double> before = members_of(a), after = members_of(b);
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i)
    if (before[i] != after[i]) changed.push_back(i);
  EXPECT_EQ(changed.size(), 1u);
  return changed.empty() ? 0 : changed.front();
}

// Parameters of tubes, liquid crystals and paper are listed in the order of the members.
TEST(DisplayParameters, EachParameterSetsOneMember) {
  for (const NamedDisplayKind& kind : display_kinds()) {
    std::vector<std::size_t> members;
    for (const DisplayParameter& parameter : display_parameters(kind.kind)) {
      const Case row{kind, parameter};
      double min = 0, max = 0;
      const std::vector<std::string> words = split(parameter.values, ", ");
      const std::string other =
          words.front() == parameter.default_value ? words[words.size() - 1] : words.front();
      const std::string value = has_range(parameter, min, max) ? number(max) : other;
      const Display before = find_display(row.with(parameter.default_value));
      members.push_back(changed_member(before, find_display(row.with(value))));
    }
    const bool is_panel = kind.kind == DisplayKind::lcd || kind.kind == DisplayKind::eink;
    if (kind.kind == DisplayKind::crt || is_panel) {
      EXPECT_TRUE(std::is_sorted(members.begin(), members.end())) << kind.name;
    }
    EXPECT_EQ(std::set<std::size_t>(members.begin(), members.end()).size(), members.size()) << kind.name;
  }
}

TEST(DisplayParameters, ListsOfWeightsAreLimited) {
  EXPECT_EQ(find_display("plasma:subfields=1+2+3+4+5+6+7+8+9+10+11+12").plasma.subfields.size(), 12u);
  for (const std::string weights : {"1+2+3+4+5+6+7+8+9+10+11+12+13", "1+0", "1+", "+1", "1++2", "1,2"})
    EXPECT_NE(error_of("plasma:subfields=" + weights), "") << weights;
}

TEST(DisplayParameters, ErrorsNameWhatWasFoundAndExpected) {
  const struct {
    const char* text;
    const char* message;
  } kRows[] = {
      {"", "found display \"\", expected one of crt, lcd, plasma, eink, ntsc, pal, mono12, cga"},
      {"CRT", "found display \"CRT\", expected one of crt"},
      {"crt:", "found \"\", expected NAME=VALUE with a parameter of crt: diagonal, mask, pitch"},
      {"crt:pitch", "pitch: found \"\", expected 0.05 to 5 (mm)"},
      {"crt:pich=0.3", "found \"pich=0.3\", expected NAME=VALUE with a parameter of crt: diagonal"},
      {"crt:pitch=0.3,", "found \"\", expected NAME=VALUE with a parameter of crt"},
      {"lcd:pitch=0.3", "expected NAME=VALUE with a parameter of lcd: diagonal, stripes, fill"},
      {"vga14:stripes=rgb", "with a parameter of crt: diagonal"},
      {"crt:mask=dot", "mask: found \"dot\", expected none, dots, slots, grille"},
      {"lcd:bits=7", "bits: found \"7\", expected 6, 8"},
      {"crt:phosphor=p39", "phosphor: found a monochrome one with a shadow mask, expected p22 or mask=none"},
      {"eink:white=0.1,black=0.1", "black: found 0.1, expected less than white, which is 0.1"},
      {"ntsc:decoder=delay_line", "decoder: found \"delay_line\", expected auto, notch, comb"},
      {"pal:setup=7.5", "with a parameter of pal"},
      {"crt:gain=1", "with a parameter of crt"},
  };
  for (const auto& [text, message] : kRows) {
    EXPECT_THAT(error_of(text), HasSubstr(message)) << text;
    EXPECT_EQ(error_of(text).find('\n'), std::string::npos) << text;
  }
  EXPECT_EQ(error_of("crt:phosphor=p39,mask=none"), "");
  EXPECT_EQ(error_of("crt:phosphor=p22,mask=none"), "");
}

TEST(DisplayParameters, CheckFindsValuesOutOfRange) {
  Display display;
  display.crt.pitch_mm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(check_error(display), HasSubstr("pitch: found nan, expected 0.05 to 5 (mm)"));
  display = {.kind = DisplayKind::crt, .crt = {.beam_mm = .01}};
  EXPECT_EQ(check_error(display), "beam: found 0.01, expected 0.02 to 5 or auto (mm)");
  display = {.kind = DisplayKind::crt, .crt = {.mask = static_cast<ShadowMask>(9)}};
  EXPECT_EQ(check_error(display), "mask: found 9, expected none, dots, slots, grille");
  display = {.kind = DisplayKind::crt, .crt = {.lines_per_row = 5}};
  EXPECT_EQ(check_error(display), "scan_lines: found 5, expected auto, 1, 2, 3, 4");
  display = {.kind = DisplayKind::plasma, .plasma = {.subfields = {}}};
  EXPECT_THAT(check_error(display), HasSubstr("subfields: found none, expected 1 to 12 numbers joined by +"));
  display = {.kind = DisplayKind::plasma, .plasma = {.subfields = {1, 0}}};
  EXPECT_THAT(check_error(display), HasSubstr("subfields: found 1+0, expected 1 to 12 numbers"));
  display = {.kind = DisplayKind::ntsc, .television = {.decoder = VideoDecoder::simple}};
  EXPECT_THAT(check_error(display), HasSubstr("decoder: found 3, expected auto, notch, comb"));
  display.kind = DisplayKind::pal;
  EXPECT_EQ(check_error(display), "");
  display = {.kind = static_cast<DisplayKind>(6)};
  EXPECT_EQ(check_error(display), "kind is 6, expected 0 to 5");
}

TEST(DisplayParameters, CheckIgnoresPartsOfOtherKinds) {
  Display display{.kind = DisplayKind::lcd};
  display.crt.pitch_mm = -1;
  display.crt.phosphor = Phosphor::p1;
  display.eink.black = 7;
  EXPECT_EQ(check_error(display), "");
}

TEST(DisplayPresets, ParseAndHaveDistinctNames) {
  std::set<std::string> names;
  for (const NamedDisplayKind& kind : display_kinds()) names.insert(text_of(kind.name));
  for (const DisplayPreset& preset : display_presets()) {
    EXPECT_TRUE(names.insert(text_of(preset.name)).second) << preset.name;
    const Display display = find_display(preset.name);
    EXPECT_TRUE(equal(display, find_display(preset.definition))) << preset.name;
    EXPECT_NO_THROW(check(display)) << preset.name;
    EXPECT_FALSE(preset.mode.empty() || preset.description.empty() || preset.source.empty()) << preset.name;
  }
  EXPECT_GE(display_presets().size(), 13u);
}

TEST(DisplayPresets, ParametersReplaceThoseOfThePreset) {
  const Display display = find_display("trinitron17:white=6500,beam=0.2");
  EXPECT_EQ(display.crt.mask, ShadowMask::grille);
  EXPECT_EQ(display.crt.white, DisplayWhite::d65);
  EXPECT_EQ(display.crt.beam_mm, .2);
  EXPECT_EQ(find_display("mono12").crt.phosphor, Phosphor::p39);
  EXPECT_EQ(error_of("mono12:mask=dots"),
            "phosphor: found a monochrome one with a shadow mask, expected p22 or mask=none");
}

}  // namespace
}  // namespace tessera::display_parameters_test
