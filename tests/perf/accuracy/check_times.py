"""Checks the times of two runs on an idle machine: noise rows contain 1, intervals overlap, and layers of one fill lie
on a line.

usage: check_times.py PROGRAM FOLDER
"""
import csv
import json
import os
import subprocess
import sys


def layers(count):
    """A scene of blended full-window layers, each of which covers and shades every pixel."""
    draw = {"draw": "quad", "lighting": False, "blend": {}, "depth": False}
    return {"tessera": 1, "title": f"{count} layers", "framebuffer": {"width": 160, "height": 120, "stencil": 0},
            "camera": {"eye": [0, 0, 1], "target": [0, 0, 0],
                       "projection": {"type": "orthographic", "left": -1, "right": 1, "bottom": -1, "top": 1, "near": 0, "far": 2}},
            "meshes": {"quad": {"primitive": "quads", "positions": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]],
                                "colors": [[1, 0, 0, 0.1], [0, 1, 0, 0.1], [0, 0, 1, 0.1], [1, 1, 1, 0.1]]}},
            "frame": [{"clear": {"color": [0, 0, 0, 1], "depth": 1}}] + [draw] * count}


def run(program, output, scenes):
    subprocess.run([program, "-o", output, "--scenes", "wall-8", "--threads", "2", *scenes], check=True, stdout=subprocess.DEVNULL)
    with open(os.path.join(output, "results.csv"), newline="") as file:
        return [{name: float(text) if name.startswith(("time", "ms")) else text for name, text in row.items()}
                for row in csv.DictReader(file)]


def check_line(rows, threads):
    """The second difference of the three times is zero within their intervals."""
    times = [next(row for row in rows if row["scene"] == f"layers-{count}" and row["setting"] == "default" and row["threads"] == threads)
             for count in (16, 32, 48)]
    bend = times[0]["ms"] - 2 * times[1]["ms"] + times[2]["ms"]
    allowed = sum(factor * (row["ms_high"] - row["ms_low"]) for factor, row in zip((1, 2, 1), times))
    print(f"{threads} threads: {[row['ms'] for row in times]} ms, bend {bend:.4f}, intervals {allowed:.4f}")
    assert abs(bend) <= allowed


def main(program, folder):
    os.makedirs(folder, exist_ok=True)
    paths = []
    for count in 16, 32, 48:
        paths.append(os.path.join(folder, f"layers-{count}.json"))
        with open(paths[-1], "w") as file:
            json.dump(layers(count), file)
    first, second = (run(program, os.path.join(folder, name), paths) for name in ("first", "second"))
    noise = [row for row in first + second if row["setting"] == "default"]
    outside = [row for row in noise if not row["time_low"] <= 1.005 or not row["time_high"] >= 0.995]
    print(f"{len(noise) - len(outside)} of {len(noise)} noise rows contain 1.00")
    assert len(outside) <= len(noise) // 10, outside
    apart = [(a, b) for a, b in zip(first, second) if a["time_high"] < b["time_low"] or b["time_high"] < a["time_low"]]
    print(f"{len(first) - len(apart)} of {len(first)} intervals of two runs overlap")
    for a, b in apart:
        print(f"  {a['scene']}/{a['setting']}, {a['threads']} threads: {a['time_low']} to {a['time_high']}, {b['time_low']} to {b['time_high']}")
    for threads in "1", "2":
        check_line(first, threads)
    assert len(apart) <= len(first) / 20


if __name__ == "__main__":
    main(*sys.argv[1:])
