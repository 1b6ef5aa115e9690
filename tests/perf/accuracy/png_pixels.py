"""Reads PNG files of 8-bit RGB with the standard library alone."""
import struct
import zlib


def read_png(path):
    """Returns width, height and the bytes of all pixels, rows from the top."""
    with open(path, "rb") as file:
        data = file.read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    width = height = None
    compressed = b""
    at = 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        content = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, color, _, _, interlace = struct.unpack(">IIBBBBB", content)
            assert (depth, color, interlace) == (8, 2, 0), f"{path}: found another kind of PNG than 8-bit RGB"
        elif kind == b"IDAT":
            compressed += content
        at += 12 + length
    return width, height, unfiltered(zlib.decompress(compressed), height, 3 * width)


def unfiltered(raw, height, stride):
    """Undoes the filters of the rows [PNG, section 9]."""
    pixels = bytearray()
    above = bytearray(stride)
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left = row[i - 3] if i >= 3 else 0
            corner = above[i - 3] if i >= 3 else 0
            row[i] = (row[i] + (0, left, above[i], (left + above[i]) // 2, paeth(left, above[i], corner))[kind]) & 255
        pixels += row
        above = row
    return bytes(pixels)


def paeth(a, b, c):
    p = a + b - c
    return min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
