"""Compares our dithers and palettes with those of ImageMagick and pngquant, by FLIP.

usage: compare.py [PART...]

Each part starts from our picture of 24 bits, which every program reduces to the same colours, or to as many:

  ordered  8x8 Bayer matrix at 3, 6, 12 and 15 bits           convert -ordered-dither o8x8
  fixed    Floyd-Steinberg with the palette of every mode     convert -dither FloydSteinberg -remap
  free     chosen palettes of 16 and 256 colours              pngquant --speed 1

Default: all. Prints the mean FLIP against 24 bits at 67.02 pixels per degree of each pair, then a line per kind.
Environment: TESSERA, the program; default: build/release/bin/tessera.
Exit codes: 0 success, whoever is nearer; 1 a failure; 77 ImageMagick or pngquant is not installed.
"""
import json
import os
import statistics
import subprocess
import sys
import tempfile

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
TESSERA = os.path.abspath(os.environ.get("TESSERA", os.path.join(ROOT, "build", "release", "bin", "tessera")))
SCENES = ["engine/program/scenes/shiny_teapot.json", "/usr/share/glmark2/models/bunny.obj"] + [
    f"tests/scenes/{name}.json" for name in ("builtin_meshes", "fx_moon_16_spots", "fx_reflection", "lights_four_coloured",
                                             "material_presets", "tex_builtin_meshes")]
SQUARE_PIXELS = {"width": 640, "height": 480, "pixel_aspect": [1, 1]}


def run(*command):
    """Standard output of a command that must succeed."""
    result = subprocess.run(command, capture_output=True, cwd=ROOT)
    if result.returncode != 0:
        sys.exit(f"compare.py: {' '.join(command)}: {result.stderr.decode().strip()}")
    return result.stdout


def find(name, version_option, version_text):
    """Path of a program whose version begins with a text: other programs are called convert, too. None: not found."""
    for folder in os.environ["PATH"].split(os.pathsep):
        program = os.path.join(folder, name)
        if os.access(program, os.X_OK):
            version = subprocess.run([program, version_option], capture_output=True).stdout
            if version.startswith(version_text):
                return program
    return None


def ratio_of(ours, theirs):
    """Ratio of two errors, which may be 0."""
    if ours == theirs:
        return 1.0
    return ours / theirs if theirs > 0 else float("inf")


def scene_name(scene):
    return os.path.splitext(os.path.basename(scene))[0]


def colors_of(ppm):
    """The set of colours of a binary PPM file without comments."""
    with open(ppm, "rb") as file:
        magic, size, maximum = (file.readline() for _ in range(3))
        assert magic == b"P6\n" and maximum == b"255\n", ppm
        width, height = map(int, size.split())
        pixels = file.read()
    assert len(pixels) == 3 * width * height, ppm
    return {pixels[i:i + 3] for i in range(0, len(pixels), 3)}


class Comparison:
    def __init__(self, folder):
        self.folder = folder
        self.convert = find("convert", "-version", b"Version: ImageMagick")
        self.pngquant = find("pngquant", "--version", b"")
        self.pairs = {}  # kind -> pairs of FLIP, ours and theirs

    def path(self, name):
        return os.path.join(self.folder, name)

    def exact(self, scene, mode):
        """Our picture at 24 bits, with the shape of a mode's pixels."""
        aspect = ":".join(map(str, mode["pixel_aspect"]))
        name = f"{mode['width']}x{mode['height']}x24:aspect={aspect}"
        file = self.path(f"{scene_name(scene)}-{name}.png".replace(":", "_"))
        if not os.path.exists(file):
            run(TESSERA, "render", scene, "--mode", name, "-o", file)
        return file

    def reduced(self, scene, mode_name, *options):
        file = self.path("ours.ppm")
        run(TESSERA, "render", scene, "--mode", mode_name, "--reduce", *options, "-o", file)
        return file

    def flip(self, picture, exact):
        return json.loads(run(TESSERA, "compare", "--json", picture, exact))["flip"]["mean"]

    def add(self, kind, scene, ours, theirs, exact):
        pair = (self.flip(ours, exact), self.flip(theirs, exact))
        self.pairs.setdefault(kind, []).append(pair)
        print(f"{kind:34} {scene_name(scene):22} {pair[0]:.4f} {pair[1]:.4f}", flush=True)

    def compare_ordered(self, scene):
        exact = self.exact(scene, SQUARE_PIXELS)
        for bits in (3, 6, 12, 15):
            levels = 2 ** (bits // 3)
            ours = self.reduced(scene, f"640x480x{bits}", "--dither", "bayer8")
            theirs = self.path("theirs.ppm")
            run(self.convert, exact, "-ordered-dither", f"o8x8,{levels}", "-depth", "8", theirs)
            for picture in (ours, theirs):
                assert len(colors_of(picture)) <= levels ** 3, picture
            self.add(f"ordered, {bits} bits", scene, ours, theirs, exact)

    def compare_fixed(self, scene):
        shown = set()
        for mode in json.loads(run(TESSERA, "modes", "--json"))["modes"]:
            look = (mode["width"], mode["height"], mode["color_bits"], mode["palette_component_bits"])
            if mode["color_mode"] != "index" or look in shown:
                continue
            shown.add(look)
            exact = self.exact(scene, mode)
            palette = self.palette(mode["name"])
            ours = self.reduced(scene, mode["name"], "--dither", "floyd_steinberg")
            theirs = self.path("theirs.ppm")
            run(self.convert, exact, "-dither", "FloydSteinberg", "-remap", palette, "-depth", "8", theirs)
            for picture in (ours, theirs):
                assert colors_of(picture) <= colors_of(palette), picture
            self.add(f"fixed, {mode['name']}", scene, ours, theirs, exact)

    def palette(self, mode_name):
        """The colours of a mode as a picture of one row, from the palette of an indexed file."""
        indexed, file = self.path("palette.png"), self.path("palette.ppm")
        run(TESSERA, "render", "--mode", mode_name, "-o", indexed)
        with open(indexed, "rb") as png:
            data = png.read()
        chunk = data.index(b"PLTE")
        entries = data[chunk + 4:chunk + 4 + int.from_bytes(data[chunk - 4:chunk], "big")]
        with open(file, "wb") as ppm:
            ppm.write(b"P6\n%d 1\n255\n" % (len(entries) // 3) + entries)
        return file

    def compare_free(self, scene):
        exact = self.exact(scene, SQUARE_PIXELS)
        for bits in (4, 8):
            ours = self.reduced(scene, f"640x480x{bits}", "--palette", "adaptive", "--dither", "floyd_steinberg")
            quantized, theirs = self.path("theirs.png"), self.path("theirs.ppm")
            run(self.pngquant, "--speed", "1", "--force", "--output", quantized, str(2 ** bits), exact)
            run(self.convert, quantized, "-depth", "8", theirs)
            for picture in (ours, theirs):
                assert len(colors_of(picture)) <= 2 ** bits, picture
            self.add(f"free, {2 ** bits} colours", scene, ours, theirs, exact)

    def summary(self):
        lines = ["", f"{'':34} {'median, ours':>12} {'theirs':>8} {'ratio':>8} {'of means':>8} {'worst':>8}   ours is nearer in"]
        for kind, pairs in self.pairs.items():
            ours, theirs = (statistics.median(column) for column in zip(*pairs))
            ratio = statistics.median(ratio_of(a, b) for a, b in pairs)
            mean_ratio = statistics.mean(a for a, _ in pairs) / statistics.mean(b for _, b in pairs)
            worst = max(ratio_of(a, b) for a, b in pairs)
            nearer = sum(a < b for a, b in pairs)
            lines.append(f"{kind:34} {ours:12.4f} {theirs:8.4f} {ratio:8.3f} {mean_ratio:8.3f} {worst:8.3f}   {nearer} of {len(pairs)} scenes")
        return "\n".join(lines)


def main():
    parts = sys.argv[1:] or ["ordered", "fixed", "free"]
    for part in parts:
        if part not in ("ordered", "fixed", "free"):
            sys.exit(f"compare.py: found part \"{part}\", expected ordered, fixed or free")
    with tempfile.TemporaryDirectory() as folder:
        comparison = Comparison(folder)
        if comparison.convert is None or comparison.pngquant is None:
            print("compare.py: skipped: ImageMagick or pngquant is not installed", file=sys.stderr)
            sys.exit(77)
        print(f"{'':34} {'scene':22} {'ours':6} theirs")
        for part in parts:
            for scene in SCENES:
                getattr(comparison, f"compare_{part}")(scene)
        print(comparison.summary())


main()
