// Displays with a name, as data. Values without a source are choices within the usual ones of their time.
#include "framebuffer/tessera/display.hpp"

namespace tessera {
namespace {

constexpr DisplayPreset kPresets[] = {
    {"mono12", "crt:diagonal=11.5,mask=none,phosphor=p39", "hercules",
     "monochrome monitor with slow green phosphor, like IBM's 5151",
     "IBM 5151: 11.5 inches, P39, no mask (secondary sources)"},
    {"cga", "crt:diagonal=13,pitch=0.43,scan_lines=1,primaries=hitachi", "cga",
     "monitor of 200 lines, like IBM's 5153",
     "IBM 5153: 0.43 mm dots (secondary source); white of 6500 K and primaries: choice"},
    {"ega", "crt:diagonal=13,pitch=0.31,primaries=hitachi", "ega", "monitor of 350 lines, like IBM's 5154",
     "IBM 5154: 0.31 mm dots (not confirmed); white of 6500 K and primaries: choice"},
    {"vga14", "crt:diagonal=14,pitch=0.28", "vga", "VGA monitor of 14 inches",
     "0.28 mm dots: IBM 8513 (not confirmed) and the class of VGA monitors; all else: choice"},
    {"trinitron17", "crt:diagonal=17,mask=grille,pitch=0.25,white=9300", "xga",
     "Trinitron monitor of 17 inches, bluish white as delivered",
     "primaries: Sony GDM-17SE1 (color.org); 9300 K: default of computer monitors; all else: choice"},
    {"1084s", "crt:diagonal=13,mask=slots,pitch=0.42,primaries=ebu", "amiga",
     "RGB monitor of home computers, like Commodore's 1084S",
     "Commodore 1084S: 0.42 mm slots, 13 inches visible; primaries: choice"},
    {"tv-ntsc", "ntsc:overscan=0.05", "amiga-ntsc", "North American television of 20 inches",
     "primaries: SMPTE RP 145; 20 inches, 0.64 mm slots, overscan: choice"},
    {"tv-pal", "pal:overscan=0.05", "amiga", "European television of 20 inches",
     "primaries: EBU Tech. 3213; 20 inches, 0.64 mm slots, overscan: choice"},
    {"cga-composite", "ntsc:diagonal=13,pitch=0.43,mask=dots,scan_lines=1,decoder=notch", "cga-hi",
     "CGA on a composite monitor: patterns of pixels become colours", "choice"},
    {"lcd-office", "lcd:diagonal=15,response=16", "xga", "office panel of 2005",
     "response of twisted nematic panels of 2005: 8 to 16 ms; all else: choice"},
    {"lcd-laptop", "lcd:diagonal=10.4,fill=0.6,bits=6,response=40,black=0.01", "640x480x8",
     "laptop panel of 1995: 6 bits, slow",
     "response of twisted nematic panels of 1995: 30 to 50 ms; all else: choice"},
    {"plasma-tv", "plasma:diagonal=42", "852x480x24", "plasma television of 42 inches", "choice"},
    {"e-reader", "eink:diagonal=6", "gray4", "reader with 16 greys and full updates",
     "reflectances and greys: panel makers' notes; 6 inches: choice"},
};

}  // namespace

std::span<const DisplayPreset> display_presets() { return kPresets; }

}  // namespace tessera
