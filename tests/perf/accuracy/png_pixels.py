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
        if kind == 1:
            for i in range(3, stride):
                row[i] = (row[i] + row[i - 3]) & 255
        elif kind == 2:
            row = bytearray((value + up) & 255 for value, up in zip(row, above))
        elif kind == 3:
            for i in range(stride):
                left = row[i - 3] if i >= 3 else 0
                row[i] = (row[i] + (left + above[i]) // 2) & 255
        elif kind == 4:
            for i in range(stride):
                left, corner = (row[i - 3], above[i - 3]) if i >= 3 else (0, 0)
                row[i] = (row[i] + paeth(left, above[i], corner)) & 255
        else:
            assert kind == 0, f"filter {kind}"
        pixels += row
        above = row
    return bytes(pixels)


def paeth(a, b, c):
    """The one of left, above and upper left that is nearest to left + above - upper left."""
    to_a, to_b, to_c = abs(b - c), abs(a - c), abs(a + b - 2 * c)
    if to_a <= to_b and to_a <= to_c:
        return a
    return b if to_b <= to_c else c
