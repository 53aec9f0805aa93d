#!/usr/bin/env python3
"""Makes chess.glb: six pieces turned on a lathe, and a board, as glTF 2.0. Writes it beside itself."""
import json
import math
import struct
from pathlib import Path

SEGMENTS = 32

# Radius over height, bottom up; a piece's own turning.
BASE = [(0, 0), (0.42, 0), (0.44, 0.04), (0.44, 0.12), (0.40, 0.17), (0.40, 0.20), (0.34, 0.27), (0.26, 0.34)]
PROFILES = {
    "pawn": BASE + [(0.17, 0.50), (0.14, 0.68), (0.15, 0.74), (0.24, 0.77), (0.24, 0.80), (0.15, 0.81)]
    + [(0.235 * math.sin(a), 1.00 - 0.235 * math.cos(a)) for a in (0.8, 1.2, 1.6, 2.0, 2.4, 2.8)] + [(0, 1.235)],
    "rook": BASE + [(0.22, 0.55), (0.20, 0.85), (0.22, 0.92), (0.31, 0.97), (0.31, 1.22), (0.22, 1.22), (0.22, 1.12), (0, 1.12)],
    "bishop": BASE + [(0.18, 0.60), (0.14, 0.92), (0.24, 0.98), (0.24, 1.02), (0.16, 1.06), (0.23, 1.20), (0.24, 1.30),
                      (0.20, 1.44), (0.12, 1.56), (0.05, 1.63), (0.075, 1.67), (0.06, 1.73), (0, 1.76)],
    "queen": BASE + [(0.20, 0.62), (0.15, 1.05), (0.27, 1.12), (0.27, 1.17), (0.17, 1.22), (0.20, 1.42), (0.30, 1.66),
                     (0.27, 1.68), (0.20, 1.63), (0.16, 1.70), (0.07, 1.76), (0.10, 1.82), (0.07, 1.90), (0, 1.92)],
    "king": BASE + [(0.21, 0.62), (0.16, 1.12), (0.28, 1.19), (0.28, 1.24), (0.18, 1.29), (0.21, 1.50), (0.28, 1.76),
                    (0.27, 1.82), (0.10, 1.88), (0.06, 1.92), (0.11, 2.00), (0.11, 2.06), (0.06, 2.14), (0, 2.16)],
}


def smooth(profile):
    """Catmull and Rom's spline through the points, but where two are so near that they are an edge."""
    points = []
    for i in range(len(profile) - 1):
        a, b = profile[i], profile[i + 1]
        before, after = profile[max(i - 1, 0)], profile[min(i + 2, len(profile) - 1)]
        steps = 1 if math.dist(a, b) < 0.07 or b[0] == 0 or a[0] == 0 else 2
        for k in range(steps):
            t = k / steps
            points.append(tuple(
                0.5 * (2 * q + (r - p) * t + (2 * p - 5 * q + 4 * r - s) * t * t + (3 * q - p - 3 * r + s) * t**3)
                for p, q, r, s in zip(before, a, b, after)))
    return points + [profile[-1]]


def lathe(profile):
    """Positions, normals and triangles of what a profile turns to."""
    profile = smooth(profile)
    positions, normals, triangles = [], [], []
    for i, (r, y) in enumerate(profile):
        (r0, y0), (r1, y1) = profile[max(i - 1, 0)], profile[min(i + 1, len(profile) - 1)]
        out, up = y1 - y0, r0 - r1
        length = math.hypot(out, up)
        for s in range(SEGMENTS):
            phi = 2 * math.pi * s / SEGMENTS
            positions.append((max(r, 0) * math.cos(phi), y, max(r, 0) * math.sin(phi)))
            normals.append((out / length * math.cos(phi), up / length, out / length * math.sin(phi)))
    for i in range(len(profile) - 1):
        for s in range(SEGMENTS):
            a, b = i * SEGMENTS + s, i * SEGMENTS + (s + 1) % SEGMENTS
            c, d = a + SEGMENTS, b + SEGMENTS
            if profile[i][0] > 0:
                triangles.append((a, d, b))
            if profile[i + 1][0] > 0:
                triangles.append((a, c, d))
    return positions, normals, triangles


def slab(x0, y0, z0, x1, y1, z1):
    """A box with a face's normals at its corners."""
    positions, normals, triangles = [], [], []
    for axis in range(3):
        for side in (0, 1):
            n = [0, 0, 0]
            n[axis] = 2 * side - 1
            u, v = (axis + 1) % 3, (axis + 2) % 3
            first = len(positions)
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                p = [0, 0, 0]
                p[axis], p[u], p[v] = side, a, b
                positions.append((x0 + p[0] * (x1 - x0), y0 + p[1] * (y1 - y0), z0 + p[2] * (z1 - z0)))
                normals.append(n)
            order = (0, 1, 2, 0, 2, 3) if side else (0, 2, 1, 0, 3, 2)
            triangles += [tuple(first + k for k in order[:3]), tuple(first + k for k in order[3:])]
    return positions, normals, triangles


class Model:
    def __init__(self):
        self.bytes = b""
        self.gltf = {"asset": {"version": "2.0", "generator": "scenes/showcase/chess.py"}, "scene": 0,
                     "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "materials": [], "accessors": [],
                     "bufferViews": [], "buffers": []}

    def accessor(self, data, count, component, kind, **more):
        self.gltf["bufferViews"].append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data + b"\0" * (-len(data) % 4)
        self.gltf["accessors"].append({"bufferView": len(self.gltf["bufferViews"]) - 1, "componentType": component,
                                       "count": count, "type": kind, **more})
        return len(self.gltf["accessors"]) - 1

    def material(self, name, color, roughness, metallic=0, **extensions):
        entry = {"name": name, "pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "roughnessFactor": roughness,
                                                        "metallicFactor": metallic}}
        if extensions:
            entry["extensions"] = extensions
            used = set(self.gltf.get("extensionsUsed", [])) | set(extensions)
            self.gltf["extensionsUsed"] = sorted(used)
        self.gltf["materials"].append(entry)
        return len(self.gltf["materials"]) - 1

    def shape(self, geometry):
        positions, normals, triangles = geometry
        low = [min(p[i] for p in positions) for i in range(3)]
        high = [max(p[i] for p in positions) for i in range(3)]
        pack = lambda rows: b"".join(struct.pack("<3f", *row) for row in rows)
        to_float = lambda values: list(struct.unpack("<3f", struct.pack("<3f", *values)))
        return {"attributes": {"POSITION": self.accessor(pack(positions), len(positions), 5126, "VEC3",
                                                         min=to_float(low), max=to_float(high)),
                               "NORMAL": self.accessor(pack(normals), len(normals), 5126, "VEC3")},
                "indices": self.accessor(b"".join(struct.pack("<3H", *t) for t in triangles), 3 * len(triangles), 5123,
                                         "SCALAR")}

    def mesh(self, shape, material):
        self.gltf["meshes"].append({"primitives": [{**shape, "material": material}]})
        return len(self.gltf["meshes"]) - 1

    def place(self, mesh, x, y, z):
        self.gltf["nodes"].append({"mesh": mesh, "translation": [x, y, z]})
        self.gltf["scenes"][0]["nodes"].append(len(self.gltf["nodes"]) - 1)

    def write(self, path):
        self.gltf["buffers"] = [{"byteLength": len(self.bytes)}]
        text = json.dumps(self.gltf, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        path.write_bytes(struct.pack("<3I", 0x46546C67, 2, 28 + len(text) + len(self.bytes))
                         + struct.pack("<2I", len(text), 0x4E4F534A) + text
                         + struct.pack("<2I", len(self.bytes), 0x004E4942) + self.bytes)


def main():
    model = Model()
    lacquer = {"KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.04}}
    ivory = model.material("ivory", (0.80, 0.70, 0.52), 0.35, **lacquer)
    ebony = model.material("ebony", (0.035, 0.02, 0.016), 0.4, **lacquer)
    gold = model.material("gold", (1.0, 0.77, 0.34), 0.18, 1)
    light = model.material("maple", (0.62, 0.46, 0.28), 0.3, **lacquer)
    dark = model.material("walnut", (0.13, 0.062, 0.032), 0.3, **lacquer)
    frame = model.material("frame", (0.055, 0.03, 0.02), 0.25, **lacquer)

    square = model.shape(slab(0, -0.08, 0, 1, 0, 1))
    squares = (model.mesh(square, dark), model.mesh(square, light))
    for i in range(8):
        for j in range(8):
            model.place(squares[(i + j) % 2], i - 4, 0, j - 4)
    for x0, z0, x1, z1 in ((-4.5, -4.5, 4.5, -4), (-4.5, 4, 4.5, 4.5), (-4.5, -4, -4, 4), (4, -4, 4.5, 4)):
        model.place(model.mesh(model.shape(slab(x0, -0.3, z0, x1, 0.03, z1)), frame), 0, 0, 0)

    shapes = {name: model.shape(lathe(profile)) for name, profile in PROFILES.items()}
    made = {}
    # An ending: the gilded king is mated.
    for name, material, column, row in (
            ("king", gold, 6, 1), ("rook", ebony, 5, 0), ("pawn", ebony, 5, 2), ("pawn", ebony, 6, 2), ("pawn", ebony, 7, 2),
            ("bishop", ebony, 2, 3), ("queen", ivory, 6, 4), ("rook", ivory, 4, 1), ("bishop", ivory, 3, 5),
            ("king", ivory, 4, 6), ("pawn", ivory, 2, 5), ("pawn", ivory, 5, 6), ("pawn", ivory, 6, 6), ("pawn", ebony, 1, 3),
            ("rook", ebony, 0, 2), ("pawn", ivory, 1, 5)):
        key = (name, material)
        if key not in made:
            made[key] = model.mesh(shapes[name], material)
        model.place(made[key], column - 3.5, 0, row - 3.5)
    model.write(Path(__file__).with_name("chess.glb"))


main()
