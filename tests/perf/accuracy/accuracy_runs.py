"""Small scenes for the checks of tessera-accuracy, and its runs."""
import csv
import json
import os
import subprocess


def wall(quads, width=96, height=72):
    return {
        "tessera": 1, "title": f"a wall of {quads}x{quads} quads",
        "framebuffer": {"width": width, "height": height, "stencil": 0},
        "camera": {"eye": [0, 0, 3], "target": [0, 0, 0], "projection": {"fovy": 37, "near": 0.5, "far": 60}},
        "light_model": {"local_viewer": True},
        "lights": [{"position": [0.3, 0.2, 1.1, 1]}],
        "materials": {"shiny": {"ambient": [0.5, 0.3, 0.2, 1], "diffuse": [0.5, 0.3, 0.2, 1],
                                "specular": [0.6, 0.6, 0.6, 1], "shininess": 10}},
        "meshes": {"wall": {"builtin": "grid", "detail": quads}},
        "frame": [{"clear": {"color": [0.16, 0.18, 0.23, 1], "depth": 1}},
                  {"draw": "wall", "material": "shiny", "shading": "phong", "transform": [{"rotate": [10, 0, 1, 0.3]}]}]}


def write_scenes(folder, all_quads):
    """Writes wall-N.json for each N; returns the paths."""
    os.makedirs(folder, exist_ok=True)
    paths = []
    for quads in all_quads:
        paths.append(os.path.join(folder, f"wall-{quads}.json"))
        with open(paths[-1], "w") as file:
            json.dump(wall(quads), file)
    return paths


def run(program, output, scenes, *arguments):
    """Measures the scenes; returns the rows of results.csv as texts by column."""
    subprocess.run([program, "-o", output, "--scenes", "none", "--rounds", "3", *arguments, *scenes], check=True,
                   stdout=subprocess.DEVNULL)
    with open(os.path.join(output, "results.csv"), newline="") as file:
        return list(csv.DictReader(file))
