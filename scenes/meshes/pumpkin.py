#!/usr/bin/env python3
"""Makes pumpkin.ply: points of a pumpkin with normals and colours, as a scan has them."""
import math
import struct
from pathlib import Path

POINTS = 2500
GOLDEN_ANGLE = math.pi * (3 - math.sqrt(5))


def groove(u):
    """The depth of the grooves between ribs, from 0 to 1."""
    return (0.5 + 0.5 * math.cos(8 * u)) ** 3


def surface(u, v):
    """The point at longitude u and latitude v."""
    out = math.cos(v) * (1 - 0.1 * groove(u) * math.cos(v))
    return (out * math.cos(u), 0.72 * math.sin(v) * (1 - 0.35 * math.exp(-6 * (1 - math.sin(v)))), out * math.sin(u))


def normal(u, v):
    step = 1e-4
    a = [p - q for p, q in zip(surface(u, v + step), surface(u, v - step))]
    b = [p - q for p, q in zip(surface(u + step, v), surface(u - step, v))]
    n = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    length = math.hypot(*n)
    return tuple(x / length for x in n)


rows = []
for i in range(POINTS):
    v = math.asin(1 - (2 * i + 1) / POINTS)
    u = i * GOLDEN_ANGLE
    depth = groove(u)
    green = max(0.0, math.sin(v) - 0.93) / 0.07
    color = [int(x + (y - x) * green) for x, y in zip((245 - 50 * depth, 140 - 60 * depth, 25), (70, 110, 40))]
    rows.append(struct.pack("<6f3B", *surface(u, v), *normal(u, v), *color))
header = f"ply\nformat binary_little_endian 1.0\ncomment made by scenes/meshes/pumpkin.py\nelement vertex {POINTS}\n"
header += "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
header += "".join(f"property uchar {name}\n" for name in ("red", "green", "blue")) + "end_header\n"
Path(__file__).with_suffix(".ply").write_bytes(header.encode() + b"".join(rows))
