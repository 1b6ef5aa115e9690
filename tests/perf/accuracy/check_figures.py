"""Computes the errors of a run anew from its PNG files, and compares runs with other threads and instruction sets.

usage: check_figures.py PROGRAM FOLDER
"""
import glob
import math
import os
import sys

from accuracy_runs import run, write_scenes
from png_pixels import read_png

ERROR_COLUMNS = ["rms_unrounded", "max_unrounded", "max", "rms", "psnr", "share_over_1", "share_over_2", "flip", "flip_p99"]


def figures(result, reference):
    """The texts of largest error, RMS, PSNR and shares, as in results.csv."""
    differences = [abs(a - b) for a, b in zip(result, reference)]
    rms = math.sqrt(sum(d * d for d in differences) / len(differences))
    worst = [max(differences[i:i + 3]) for i in range(0, len(differences), 3)]

    def share(levels):
        return f"{sum(1 for d in worst if d > levels) / len(worst):.6f}"

    return {"max": str(max(differences)), "rms": f"{rms:.4f}",
            "psnr": "inf" if rms == 0 else f"{20 * math.log10(255 / rms):.3f}",
            "share_over_1": share(1), "share_over_2": share(2)}


def check_pictures(folder, rows):
    pictures = {}

    def picture(path):
        if path not in pictures:
            pictures[path] = read_png(path)[2]
        return pictures[path]

    for row in rows:
        stem = os.path.join(folder, "pictures", row["scene"])
        result = picture(os.path.join(stem, row["setting"] + ".result.png"))
        for kind in "point", "area":
            reference = picture(os.path.join(stem, f"reference_{kind}.png"))
            for name, text in figures(result, reference).items():
                found = row[f"{kind}_{name}"]
                assert found == text, f"{row['scene']}/{row['setting']}: {kind}_{name} is {found}, expected {text}"
            [path] = glob.glob(os.path.join(glob.escape(stem), glob.escape(row["setting"]) + f".difference_{kind}_x*.png"))
            gain = int(path[path.rindex("_x") + 2:-4])
            expected = bytes(gain * abs(a - b) for a, b in zip(result, reference))
            assert picture(path) == expected, f"{path} is not {gain} times the difference"


def errors_of(rows):
    """The error columns of all rows on one thread."""
    columns = [f"{kind}_{name}" for kind in ("point", "area") for name in ERROR_COLUMNS]
    return [[row["scene"], row["setting"]] + [row[column] for column in columns] for row in rows if row["threads"] == "1"]


def check_wall(rows):
    """The error of linear interpolation is quadratic: half the distance of vertices, a quarter of the error."""
    rms = {row["scene"]: float(row["point_rms_unrounded"]) for row in rows if row["setting"] == "gouraud"}
    for coarse, fine in ("wall-4", "wall-8"), ("wall-8", "wall-16"):
        assert 3 <= rms[coarse] / rms[fine] <= 4.5, f"{coarse} {rms[coarse]}, {fine} {rms[fine]}"


def main(program, folder):
    scenes = write_scenes(folder, [4, 8, 16])
    rows = run(program, folder + "/first", scenes, "--threads", "2")
    assert {row["threads"] for row in rows} == {"1", "2"}
    check_pictures(folder + "/first", rows)
    check_wall(rows)
    for row in rows:
        if row["setting"] == "default":
            assert int(row["point_max"]) <= 1, row
    again = run(program, folder + "/again", scenes[:2], "--threads", "3")
    scalar = run(program, folder + "/scalar", scenes[:2], "--threads", "1", "--isa", "scalar")
    first = [errors for errors in errors_of(rows) if errors[0] != "wall-16"]
    assert errors_of(again) == first, "another run on other threads has other errors"
    assert errors_of(scalar) == first, "another instruction set has other errors"
    print(f"{len(rows)} rows agree with their pictures")


if __name__ == "__main__":
    main(*sys.argv[1:])
