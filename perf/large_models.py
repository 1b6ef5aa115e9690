"""Writes large STL and PLY files, for measuring how models are read: a bumpy torus.

  python3 perf/large_models.py stl|ply|ply-text|points COUNT FILE

COUNT is the number of triangles, or twice that of points, rounded up to a grid. Ten million take minutes.
"""
import array
import math
import struct
import sys


def torus(rows, columns):
    """Positions x y z of rows * columns points."""
    points = array.array("f")
    for row in range(rows):
        u = 2 * math.pi * row / rows
        for column in range(columns):
            v = 2 * math.pi * column / columns
            radius = 1 + 0.02 * math.sin(20 * u) * math.sin(40 * v)
            from_axis = 3 + radius * math.cos(u)
            points.extend((from_axis * math.cos(v), radius * math.sin(u), from_axis * math.sin(v)))
    return points


def triangles(rows, columns):
    """Indices of the corners of each triangle, counter-clockwise from outside."""
    for row in range(rows):
        below = (row + 1) % rows * columns
        for column in range(columns):
            beside = (column + 1) % columns
            a, b, c, d = row * columns + column, below + column, below + beside, row * columns + beside
            yield a, c, b
            yield a, d, c


def normal(a, b, c):
    u, v = [[q - p for p, q in zip(a, corner)] for corner in (b, c)]
    n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    length = math.hypot(*n) or 1
    return [x / length for x in n]


def write_stl(file, points, faces, count):
    file.write(b"binary".ljust(80) + struct.pack("<I", count))
    for face in faces:
        corners = [points[3 * i:3 * i + 3] for i in face]
        file.write(struct.pack("<12fH", *normal(*corners), *corners[0], *corners[1], *corners[2], 0))


def ply_header(form, vertices, more):
    xyz = "".join(f"property float {name}\n" for name in "xyz")
    return f"ply\nformat {form} 1.0\nelement vertex {vertices}\n{xyz}{more}end_header\n".encode()


def main(kind, count, path):
    rows = round(math.sqrt(count / 2))
    columns = -(-count // (2 * rows))
    points, vertices, count = torus(rows, columns), rows * columns, 2 * rows * columns
    faces = triangles(rows, columns)
    face_header = f"element face {count}\nproperty list uchar int vertex_indices\n"
    with open(path, "wb") as file:
        if kind == "stl":
            write_stl(file, points, faces, count)
        elif kind == "ply":
            file.write(ply_header("binary_little_endian", vertices, face_header))
            points.tofile(file)
            for face in faces:
                file.write(struct.pack("<B3i", 3, *face))
        elif kind == "ply-text":
            file.write(ply_header("ascii", vertices, face_header))
            for i in range(vertices):
                file.write(b"%g %g %g\n" % tuple(points[3 * i:3 * i + 3]))
            for face in faces:
                file.write(b"3 %d %d %d\n" % face)
        else:
            colors = "".join(f"property uchar {name}\n" for name in ("red", "green", "blue"))
            file.write(ply_header("binary_little_endian", vertices, colors))
            for i in range(vertices):
                color = i * 255 // vertices, 128, i % columns * 255 // columns
                file.write(struct.pack("<3f3B", *points[3 * i:3 * i + 3], *color))


if __name__ == "__main__":
    if len(sys.argv) != 4 or sys.argv[1] not in ("stl", "ply", "ply-text", "points"):
        sys.exit(__doc__)
    main(sys.argv[1], int(sys.argv[2]), sys.argv[3])
