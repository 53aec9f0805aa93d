#!/usr/bin/env python3
"""Makes flower.gltf: a flower whose stem sways (a skin), whose petals open (a morph target), and a butterfly."""
import base64
import json
import math
import struct
from pathlib import Path

FLOAT, SHORT, BYTE = 5126, 5123, 5121
SECONDS = 4
JOINTS, SPAN = 5, 0.44  # of the stem: how many, and how far apart
PETALS = 8


class File:
    def __init__(self):
        self.data = b""
        self.gltf = {"asset": {"version": "2.0", "generator": "scenes/meshes/flower.py"}, "scene": 0, "scenes": [{"nodes": []}],
                     "nodes": [], "meshes": [], "materials": [], "skins": [], "animations": [{"name": "bloom", "samplers": [],
                                                                                             "channels": []}],
                     "bufferViews": [], "accessors": []}

    def add(self, kind, item):
        self.gltf[kind].append(item)
        return len(self.gltf[kind]) - 1

    def accessor(self, rows, component=FLOAT, bounds=False):
        """Rows of the same length; those of one number may be numbers."""
        rows = [row if isinstance(row, (list, tuple)) else (row,) for row in rows]
        width = len(rows[0])
        raw = b"".join(struct.pack(f"<{width}{ {FLOAT: 'f', SHORT: 'H', BYTE: 'B'}[component] }", *row) for row in rows)
        view = self.add("bufferViews", {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(raw)})
        self.data += raw + b"\0" * (-len(raw) % 4)
        accessor = {"bufferView": view, "componentType": component, "count": len(rows),
                    "type": {1: "SCALAR", 3: "VEC3", 4: "VEC4", 16: "MAT4"}[width]}
        if bounds:
            rows = [struct.unpack(f"<{width}f", struct.pack(f"<{width}f", *row)) for row in rows]
            accessor |= {"min": [min(c) for c in zip(*rows)], "max": [max(c) for c in zip(*rows)]}
        return self.add("accessors", accessor)

    def mesh(self, material, positions, triangles, opened=None, joints=None, weights=None):
        attributes = {"POSITION": self.accessor(positions, bounds=True)}
        if joints:
            attributes |= {"JOINTS_0": self.accessor(joints, BYTE), "WEIGHTS_0": self.accessor(weights)}
        primitive = {"attributes": attributes, "material": material,
                     "indices": self.accessor([i for t in triangles for i in t], SHORT)}
        if opened:
            change = [[b - a for a, b in zip(p, q)] for p, q in zip(positions, opened)]
            primitive["targets"] = [{"POSITION": self.accessor(change, bounds=True)}]
        mesh = {"primitives": [primitive]} | ({"weights": [0]} if opened else {})
        return self.add("meshes", mesh)

    def material(self, name, color, roughness=0.6, metal=0.0):
        return self.add("materials", {"name": name, "doubleSided": True, "pbrMetallicRoughness": {
            "baseColorFactor": [*color, 1], "metallicFactor": metal, "roughnessFactor": roughness}})

    def move(self, node, path, interpolation, times, values):
        animation = self.gltf["animations"][0]
        animation["samplers"].append({"input": self.accessor(times, bounds=True), "output": self.accessor(values),
                                      "interpolation": interpolation})
        animation["channels"].append({"sampler": len(animation["samplers"]) - 1, "target": {"node": node, "path": path}})

    def spline(self, node, path, times, values):
        """Smoothly: tangents are the slopes between the neighbours, at the ends none."""
        rows = []
        for i, value in enumerate(values):
            inner = 0 < i < len(values) - 1
            slope = [(b - a) / (times[i + 1] - times[i - 1]) for a, b in zip(values[i - 1], values[i + 1])] if inner else [0] * len(value)
            rows += [slope, value, slope]
        self.move(node, path, "CUBICSPLINE", times, rows)

    def save(self, path):
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        path.write_text(json.dumps(self.gltf | {"buffers": [{"byteLength": len(self.data), "uri": uri}]}, separators=(",", ":")) + "\n")


def turn(axis, degrees):
    half = math.radians(degrees) / 2
    return [*(math.sin(half) * x for x in axis), math.cos(half)]


def after(b, a):
    """What turning by a, then by b, makes."""
    (x, y, z, w), (i, j, k, l) = b, a
    return [w * i + x * l + y * k - z * j, w * j - x * k + y * l + z * i, w * k + x * j - y * i + z * l, w * l - x * i - y * j - z * k]


def grid(rows, columns, point, closed=False):
    """Points point(i, k), and the triangles between them."""
    points = [point(i, k) for i in range(rows) for k in range(columns)]
    triangles = []
    for i in range(rows - 1):
        for k in range(columns if closed else columns - 1):
            a, b = i * columns + k, i * columns + (k + 1) % columns
            triangles += [(a, a + columns, b), (b, a + columns, b + columns)]
    return points, triangles


def tube(radius, rows, columns, height):
    """About y; radius(h) for h from 0 to 1."""
    def point(i, k):
        phi, h = 2 * math.pi * k / columns, i / (rows - 1)
        return (radius(h) * math.cos(phi), height * h, -radius(h) * math.sin(phi))
    return grid(rows, columns, point, closed=True)


def ball(radius, squeeze=1.0):
    def point(i, k):
        theta, phi = math.pi * (0.02 + 0.96 * i / 8), 2 * math.pi * k / 12
        return (radius * math.sin(theta) * math.cos(phi), squeeze * radius * -math.cos(theta), -radius * math.sin(theta) * math.sin(phi))
    return grid(9, 12, point, closed=True)


def petals(bend):
    """`bend` in degrees: how far out they lean from where they begin to their tips."""
    points, triangles = [], []
    for petal in range(PETALS):
        phi = 2 * math.pi * (petal + 0.5 * (petal % 2) * 0.1) / PETALS
        rise, out = [0.0], [0.1]
        for i in range(6):
            lean = math.radians(bend[0] + (bend[1] - bend[0]) * i / 5)
            rise.append(rise[-1] + 0.14 * math.cos(lean))
            out.append(out[-1] + 0.14 * math.sin(lean))

        def point(i, k):
            width = 0.25 * math.sin(math.pi * (0.12 + 0.84 * i / 6)) * (k / 4 - 0.5) * 2
            across = out[i] - 0.25 * width * width / 0.25
            return (across * math.cos(phi) + width * math.sin(phi), rise[i], -across * math.sin(phi) + width * math.cos(phi))
        part, corners = grid(7, 5, point)
        triangles += [tuple(c + len(points) for c in corner) for corner in corners]
        points += part
    return points, triangles


def leaf():
    def point(i, k):
        t = i / 6
        side = 0.17 * math.sin(math.pi * (0.06 + 0.9 * t)) * (k / 2 - 1)
        return (0.75 * t, 0.34 * t - 0.5 * t * t + 0.6 * abs(side), side)
    return grid(7, 5, point)


def wing():
    """Along x, of two lobes."""
    def point(i, k):
        t, s = i / 8, k / 3
        front = 0.34 * math.sin(math.pi * min(1, 0.1 + 0.9 * t)) + 0.16 * t
        back = -0.30 * math.sin(math.pi * min(1, 0.12 + 0.95 * t))
        return (0.5 * t, 0.03 * math.sin(math.pi * t), back + (front - back) * s)
    return grid(9, 4, point)


def stem(file, green):
    """The joints, from the root up, and what they hold."""
    height = SPAN * (JOINTS - 1)
    positions, triangles = tube(lambda h: 0.075 - 0.03 * h, 17, 9, height)
    joints, weights = [], []
    for _, y, _ in positions:
        position = min(y / SPAN, JOINTS - 1.001)
        below = int(position)
        share = position - below
        joints.append((below, below + 1, 0, 0))
        weights.append((1 - share, share, 0, 0))
    chain = [file.add("nodes", {"name": f"stem {i}"} | ({"translation": [0, SPAN, 0]} if i else {})) for i in range(JOINTS)]
    for below, above in zip(chain, chain[1:]):
        file.gltf["nodes"][below]["children"] = [above]
    inverse = file.accessor([[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -SPAN * i, 0, 1] for i in range(JOINTS)])
    skin = file.add("skins", {"joints": chain, "inverseBindMatrices": inverse})
    shown = file.add("nodes", {"mesh": file.mesh(green, positions, triangles, joints=joints, weights=weights), "skin": skin})
    times = [SECONDS * i / 16 for i in range(17)]
    for i, joint in enumerate(chain):
        sway = [turn((math.sin(0.6), 0, -math.cos(0.6)), (4 + 2.5 * i) * math.sin(2 * math.pi * t / SECONDS - 0.5 * i)) for t in times]
        file.spline(joint, "rotation", times, sway)
    return chain, shown


def below(file, parent, **node):
    child = file.add("nodes", node)
    file.gltf["nodes"][parent].setdefault("children", []).append(child)
    return child


def main():
    file = File()
    green = file.material("green", (0.16, 0.42, 0.1))
    chain, shown = stem(file, green)
    file.gltf["scenes"][0]["nodes"] = [chain[0], shown]

    leaves = file.mesh(green, *leaf())
    below(file, chain[0], mesh=leaves, translation=[0, 0.3, 0], rotation=turn((0, 1, 0), 25))
    below(file, chain[1], mesh=leaves, translation=[0, 0.2, 0], rotation=turn((0, 1, 0), 190), scale=[0.85, 0.85, 0.85])

    bud, corners = petals((-14, 16))
    flower, _ = petals((38, 98))
    blossom = below(file, chain[-1], mesh=file.mesh(file.material("petals", (0.85, 0.2, 0.35), 0.5), bud, corners, opened=flower),
                    rotation=after(turn((0, 0, 1), -12), turn((1, 0, 0), 48)))
    file.spline(blossom, "weights", [0.4, 1.6, 2.4, 4], [[0], [0.95], [1.0], [0.85]])
    below(file, blossom, mesh=file.mesh(file.material("pollen", (0.95, 0.68, 0.1), 0.9), *ball(0.14, 0.5)), translation=[0, 0.07, 0])

    # It comes down to the blossom and beats its wings: straight from key to key.
    butterfly = file.add("nodes", {"name": "butterfly", "scale": [1.3, 1.3, 1.3], "children": []})
    file.gltf["scenes"][0]["nodes"].append(butterfly)
    file.spline(butterfly, "translation", [0, 1, 2, 3, 4],
                [[-1.65, 2.5, -0.3], [-1.3, 1.7, 0.5], [-0.85, 2.5, 0.6], [0.6, 2.75, 0.5], [1.35, 2.1, 0.6]])
    file.move(butterfly, "rotation", "LINEAR", [0, 1.2, 2.2, 4], [after(turn((0, 0, 1), d), turn((1, 0, 0), 55)) for d in (40, -35, 25, -50)])
    below(file, butterfly, mesh=file.mesh(file.material("body", (0.1, 0.07, 0.06)), *ball(0.055, 1)), scale=[1, 1, 4])
    wings = file.mesh(file.material("wings", (0.95, 0.5, 0.06), 0.5), *wing())
    right = below(file, butterfly, mesh=wings)
    mirrored = below(file, butterfly, scale=[-1, 1, 1])
    left = below(file, mirrored, mesh=wings)
    beats = [0.25 * i for i in range(17)]
    for side in (right, left):
        file.move(side, "rotation", "LINEAR", beats, [turn((0, 0, 1), 68 if i % 2 else -12) for i in range(17)])

    # A drop of dew on a leaf, until it falls.
    dew = file.add("nodes", {"name": "dew", "mesh": file.mesh(file.material("dew", (0.8, 0.9, 1), 0.05, 1), *ball(0.06)),
                             "translation": [0.42, 0.42, -0.2]})
    file.gltf["scenes"][0]["nodes"].append(dew)
    file.move(dew, "scale", "STEP", [0, 1.5], [[1, 1, 1], [0, 0, 0]])

    file.save(Path(__file__).with_suffix(".gltf"))


main()
