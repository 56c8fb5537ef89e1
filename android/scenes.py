#!/usr/bin/env python3
"""Makes the scenes of the package: scenes.py FOLDER writes knots.glb, stairs.glb and hall.glb.

All in metres, Y up, right-handed. With --check it compares FOLDER with what it would write.
"""

import json
import math
import struct
import sys
import zlib
from pathlib import Path


class Scene:
    """A glTF 2.0 file: objects of one material each, lights, a camera."""

    def __init__(self, background):
        self.blob = bytearray()
        self.json = {
            "asset": {"version": "2.0", "generator": "glimpse scenes.py"},
            "scene": 0,
            "scenes": [{"nodes": [], "extras": {"background": background}}],
            "nodes": [], "meshes": [], "materials": [], "accessors": [], "bufferViews": [], "cameras": [],
            "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_transmission", "KHR_materials_ior",
                               "KHR_materials_volume"],
            "extensions": {"KHR_lights_punctual": {"lights": []}},
        }

    def _view(self, data, target=None):
        self.blob += b"\0" * (-len(self.blob) % 4)
        view = {"buffer": 0, "byteOffset": len(self.blob), "byteLength": len(data)}
        if target:
            view["target"] = target
        self.json["bufferViews"].append(view)
        self.blob += data
        return len(self.json["bufferViews"]) - 1

    def _accessor(self, values, kind, component, code, **more):
        flat = [part for value in values for part in (value if isinstance(value, tuple) else (value,))]
        view = self._view(struct.pack(f"<{len(flat)}{code}", *flat), 34963 if kind == "SCALAR" else 34962)
        self.json["accessors"].append(
            {"bufferView": view, "componentType": component, "count": len(values), "type": kind, **more})
        return len(self.json["accessors"]) - 1

    def _node(self, **node):
        self.json["nodes"].append(node)
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def material(self, name, colour, metallic=0.0, roughness=0.8, texture=None, glass=None):
        pbr = {"baseColorFactor": [*colour, 1.0], "metallicFactor": metallic, "roughnessFactor": roughness}
        if texture is not None:
            pbr["baseColorTexture"] = {"index": texture}
        material = {"name": name, "pbrMetallicRoughness": pbr}
        if glass:
            material["extensions"] = {
                "KHR_materials_transmission": {"transmissionFactor": 1.0},
                "KHR_materials_ior": {"ior": glass},
                "KHR_materials_volume": {"thicknessFactor": 1.0},
            }
        self.json["materials"].append(material)
        return len(self.json["materials"]) - 1

    def texture(self, name, width, height, pixel):
        rows = b"".join(b"\0" + bytes(c for x in range(width) for c in pixel(x, y)) for y in range(height))
        chunk = lambda kind, data: (struct.pack(">I", len(data)) + kind + data
                                    + struct.pack(">I", zlib.crc32(kind + data)))
        png = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
               + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))
        images = self.json.setdefault("images", [])
        images.append({"name": name, "bufferView": self._view(png), "mimeType": "image/png"})
        self.json.setdefault("textures", []).append({"source": len(images) - 1})
        return len(self.json["textures"]) - 1

    def mesh(self, name, material, positions, normals, indices, uvs=None):
        low = [min(p[i] for p in positions) for i in range(3)]
        high = [max(p[i] for p in positions) for i in range(3)]
        rounded = lambda corner: [struct.unpack("<f", struct.pack("<f", c))[0] for c in corner]
        attributes = {"POSITION": self._accessor(positions, "VEC3", 5126, "f", min=rounded(low), max=rounded(high))}
        if normals:
            attributes["NORMAL"] = self._accessor(normals, "VEC3", 5126, "f")
        if uvs:
            attributes["TEXCOORD_0"] = self._accessor(uvs, "VEC2", 5126, "f")
        short = len(positions) < 65535
        primitive = {"attributes": attributes, "material": material,
                     "indices": self._accessor(indices, "SCALAR", 5123 if short else 5125, "H" if short else "I")}
        self.json["meshes"].append({"name": name, "primitives": [primitive]})
        self._node(name=name, mesh=len(self.json["meshes"]) - 1)

    def light(self, position, intensity, colour=(1.0, 1.0, 1.0)):
        lights = self.json["extensions"]["KHR_lights_punctual"]["lights"]
        lights.append({"type": "point", "intensity": intensity, "color": list(colour)})
        self._node(translation=list(position), extensions={"KHR_lights_punctual": {"light": len(lights) - 1}})

    def camera(self, eye, target, yfov):
        forward = unit(sub(target, eye))
        right = unit(cross(forward, (0.0, 1.0, 0.0)))
        up = cross(right, forward)
        columns = [*right, 0.0, *up, 0.0, *(-f for f in forward), 0.0, *eye, 1.0]
        self.json["cameras"].append({"type": "perspective", "perspective": {"yfov": yfov, "znear": 0.01}})
        self._node(name="camera", matrix=columns, camera=len(self.json["cameras"]) - 1)

    def glb(self):
        self.blob += b"\0" * (-len(self.blob) % 4)
        self.json["buffers"] = [{"byteLength": len(self.blob)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        total = 28 + len(text) + len(self.blob)
        return (struct.pack("<4sII", b"glTF", 2, total) + struct.pack("<I4s", len(text), b"JSON") + text
                + struct.pack("<I4s", len(self.blob), b"BIN\0") + bytes(self.blob))


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def times(s, a):
    return tuple(s * x for x in a)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(sum(x * x for x in a))
    return tuple(x / length for x in a)


def tube(curve, radius, around, along):
    """A closed tube about a closed curve of t in 0..1."""
    positions, normals, indices = [], [], []
    for i in range(along):
        here, there = curve(i / along), curve((i + 0.5) / along)
        ahead = unit(sub(there, here))
        side = unit(cross(ahead, (0.0, 1.0, 0.01)))
        up = cross(side, ahead)
        for j in range(around):
            angle = 2 * math.pi * j / around
            normal = add(times(math.cos(angle), side), times(math.sin(angle), up))
            positions.append(add(here, times(radius, normal)))
            normals.append(normal)
    for i in range(along):
        for j in range(around):
            a, b = i * around + j, i * around + (j + 1) % around
            c, d = (i + 1) % along * around + j, (i + 1) % along * around + (j + 1) % around
            indices += [a, b, d, a, d, c]
    return positions, normals, indices


def lathe(profile, around, centre=(0.0, 0.0, 0.0)):
    """A surface of revolution about the Y axis: (radius, height) from the bottom up, flat along the profile."""
    positions, normals, indices = [], [], []
    for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
        base = len(positions)
        slope = unit((y1 - y0, r0 - r1, 0.0))
        for j in range(around + 1):
            angle = 2 * math.pi * j / around
            c, s = math.cos(angle), math.sin(angle)
            for r, y in ((r0, y0), (r1, y1)):
                positions.append(add(centre, (r * c, y, r * s)))
                normals.append((slope[0] * c, slope[1], slope[0] * s))
        for j in range(around):
            a = base + 2 * j
            indices += [a, a + 1, a + 3, a, a + 3, a + 2]
    return positions, normals, indices


def quad(corners, repeat):
    """A rectangle from four corners, counter-clockwise from its front."""
    normal = unit(cross(sub(corners[1], corners[0]), sub(corners[2], corners[1])))
    uvs = [(0.0, 0.0), (repeat[0], 0.0), (repeat[0], repeat[1]), (0.0, repeat[1])]
    return corners, [normal] * 4, [0, 1, 2, 0, 2, 3], uvs


def box(low, high):
    positions, normals, indices = [], [], []
    for axis in range(3):
        for side in (0, 1):
            corners = []
            for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
                bits = [0, 0, 0]
                bits[axis], bits[(axis + 1) % 3], bits[(axis + 2) % 3] = side, u, v
                corners.append(tuple((low, high)[bit][i] for i, bit in enumerate(bits)))
            base, sign = len(positions), 1.0 if side else -1.0
            positions += corners
            normals += [tuple(sign if i == axis else 0.0 for i in range(3))] * 4
            turn = [0, 1, 2, 0, 2, 3] if side else [0, 2, 1, 0, 3, 2]
            indices += [base + i for i in turn]
    return positions, normals, indices


def joined(parts):
    positions, normals, indices = [], [], []
    for p, n, i in parts:
        base = len(positions)
        positions, normals = positions + p, normals + n
        indices += [base + index for index in i]
    return positions, normals, indices


def checker(a, b):
    return lambda x, y: a if (x // 32 + y // 32) % 2 == 0 else b


def room(scene, material, low, high, sides):
    """Walls that look inwards."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    walls = {
        "back": [(x0, y0, z0), (x1, y0, z0), (x1, y1, z0), (x0, y1, z0)],
        "left": [(x0, y0, z1), (x0, y0, z0), (x0, y1, z0), (x0, y1, z1)],
        "right": [(x1, y0, z0), (x1, y0, z1), (x1, y1, z1), (x1, y1, z0)],
        "top": [(x0, y1, z0), (x1, y1, z0), (x1, y1, z1), (x0, y1, z1)],
        "front": [(x1, y0, z1), (x0, y0, z1), (x0, y1, z1), (x1, y1, z1)],
    }
    for side in sides:
        corners, normals, indices, _ = quad(walls[side], (1, 1))
        scene.mesh(f"wall {side}", material[side], corners, normals, indices)


def knots():
    """Two torus knots, mirror and glass, over a chequered floor that reflects a little."""
    scene = Scene([0.35, 0.45, 0.6])
    floor = scene.texture("chequers", 64, 64, checker((225, 220, 205), (60, 70, 90)))
    floor = scene.material("floor", (1, 1, 1), metallic=0.25, roughness=0.0, texture=floor)
    corners, normals, indices, uvs = quad([(-6, 0, 6), (6, 0, 6), (6, 0, -6), (-6, 0, -6)], (12, 12))
    scene.mesh("floor", floor, corners, normals, indices, uvs)

    def knot(p, q, centre, scale):
        def curve(t):
            angle = 2 * math.pi * t
            r = 2 + math.cos(q * angle)
            return add(centre, times(scale, (r * math.cos(p * angle), math.sin(q * angle), r * math.sin(p * angle))))
        return curve

    mirror = scene.material("mirror", (0.95, 0.75, 0.4), metallic=1.0, roughness=0.0)
    scene.mesh("trefoil", mirror, *tube(knot(2, 3, (-1.35, 0.95, 0.0), 0.42), 0.2, 16, 160))
    glass = scene.material("glass", (1, 1, 1), roughness=0.0, glass=1.5)
    scene.mesh("cinquefoil", glass, *tube(knot(2, 5, (1.35, 0.95, 0.4), 0.42), 0.15, 16, 200))
    matte = scene.material("matte", (0.75, 0.2, 0.2))
    scene.mesh("ring", matte, *tube(knot(1, 0, (0.0, 0.12, -1.6), 0.5), 0.12, 16, 96))
    scene.light((-3.0, 5.0, 3.5), 90.0)
    scene.light((4.0, 4.0, 1.0), 45.0, (1.0, 0.85, 0.7))
    scene.camera((0.0, 2.4, 5.6), (0.0, 0.7, 0.0), 0.75)
    return scene


def stairs():
    """A spiral staircase with a railing of thin bars: what a coarse grid of samples misses."""
    scene = Scene([0.0, 0.0, 0.0])
    wall = scene.material("wall", (0.8, 0.78, 0.72))
    room(scene, {s: wall for s in ("back", "left", "right", "top", "front")}, (-3, 0, -3), (3, 6, 3),
         ("back", "left", "right", "top", "front"))
    tiles = scene.texture("tiles", 64, 64, lambda x, y: (120, 110, 100) if min(x % 32, y % 32) < 2 else (200, 190, 175))
    tiles = scene.material("tiles", (1, 1, 1), texture=tiles)
    corners, normals, indices, uvs = quad([(-3, 0, 3), (3, 0, 3), (3, 0, -3), (-3, 0, -3)], (6, 6))
    scene.mesh("floor", tiles, corners, normals, indices, uvs)
    wood = scene.material("wood", (0.5, 0.3, 0.15))
    iron = scene.material("iron", (0.15, 0.15, 0.17), roughness=0.4)
    brass = scene.material("brass", (0.9, 0.7, 0.3), metallic=1.0, roughness=0.0)
    scene.mesh("pole", iron, *lathe([(0.1, 0.0), (0.1, 5.8)], 24))
    steps, bars = [], []
    count, rise, turn = 28, 0.2, 2 * math.pi / 16
    for i in range(count):
        y, a0, a1 = (i + 1) * rise, i * turn, (i + 1.15) * turn
        at = lambda r, a, h: (r * math.cos(a), h, r * math.sin(a))
        under, over = ([at(0.08, a0, h), at(1.5, a0, h), at(1.5, a1, h), at(0.08, a1, h)] for h in (y - 0.05, y))
        faces = [over[::-1], under] + [[under[k], under[(k + 1) % 4], over[(k + 1) % 4], over[k]][::-1] for k in range(4)]
        for face in faces:
            corners, normals, indices, _ = quad(face, (1, 1))
            steps.append((corners, normals, indices))
        for k in range(2):
            x, _, z = at(1.42, a0 + (k + 0.5) * 0.5 * turn, 0.0)
            bars.append(lathe([(0.008, y), (0.008, y + 0.9 + 0.1 * k)], 6, (x, 0.0, z)))
    scene.mesh("steps", wood, *joined(steps))
    scene.mesh("bars", iron, *joined(bars))
    rail = [lathe([(0.0, -0.03), (0.03, 0.0), (0.0, 0.03)], 8, (1.42 * math.cos(a), i * 0.25 * rise + 1.1, 1.42 * math.sin(a)))
            for i, a in ((i, i * 0.25 * turn) for i in range(4 * count))]
    scene.mesh("rail", brass, *joined(rail))
    scene.light((1.6, 5.0, 1.6), 26.0)
    scene.light((-0.9, 1.0, 2.0), 6.0, (1.0, 0.9, 0.75))
    scene.camera((2.6, 2.6, 2.7), (0.0, 2.3, 0.0), 1.15)
    return scene


def hall():
    """A hall of columns between a mirror at its end and windows of glass."""
    scene = Scene([0.5, 0.6, 0.8])
    stone = scene.material("stone", (0.75, 0.72, 0.66))
    room(scene, {s: stone for s in ("left", "top", "front")}, (-4, 0, -10), (4, 5, 10), ("left", "top", "front"))
    marble = scene.texture("marble", 128, 128, lambda x, y: tuple(
        int(c + 22 * math.sin(0.11 * x + 2.5 * math.sin(0.07 * y)) - (60 if min(x % 64, y % 64) < 2 else 0))
        for c in (200, 190, 178)))
    floor = scene.material("floor", (1, 1, 1), metallic=0.15, roughness=0.0, texture=marble)
    corners, normals, indices, uvs = quad([(-4, 0, 10), (4, 0, 10), (4, 0, -10), (-4, 0, -10)], (4, 10))
    scene.mesh("floor", floor, corners, normals, indices, uvs)
    mirror = scene.material("mirror", (0.9, 0.9, 0.92), metallic=1.0, roughness=0.0)
    corners, normals, indices, _ = quad([(-4, 0, -10), (4, 0, -10), (4, 5, -10), (-4, 5, -10)], (1, 1))
    scene.mesh("mirror", mirror, corners, normals, indices)
    shaft = [(0.42, 0.0), (0.42, 0.15), (0.34, 0.25), (0.34, 0.3), (0.3, 0.35), (0.26, 4.4), (0.34, 4.5), (0.42, 4.6), (0.42, 5.0)]
    for i, z in enumerate(range(-8, 10, 4)):
        for side, x in (("left", -2.4), ("right", 2.4)):
            scene.mesh(f"column {side} {i}", stone, *lathe(shaft, 48, (x, 0.0, float(z))))
    glass = scene.material("glass", (1, 1, 1), roughness=0.0, glass=1.5)
    lead = scene.material("lead", (0.2, 0.2, 0.22))
    for i, z in enumerate(range(-8, 8, 4)):
        z0, z1 = z + 0.5, z + 3.5
        scene.mesh(f"pane {i}", glass, *box((3.97, 1.0, z0), (4.0, 4.5, z1)))
        bars = [box((3.94, 1.0, z0 + 0.5 * k), (3.965, 4.5, z0 + 0.5 * k + 0.02)) for k in range(7)]
        bars += [box((3.94, 1.0 + 0.5 * k, z0), (3.965, 1.02 + 0.5 * k, z1)) for k in range(8)]
        scene.mesh(f"lattice {i}", lead, *joined(bars))
        scene.mesh(f"pier {i}", stone, *box((3.94, 0.0, z - 0.5), (4.2, 5.0, z0)))
    scene.mesh("parapet", stone, *box((3.94, 0.0, -10.0), (4.2, 1.0, 10.0)))
    scene.mesh("lintel", stone, *box((3.94, 4.5, -10.0), (4.2, 5.0, 10.0)))
    red = scene.material("red", (0.6, 0.08, 0.1))
    scene.mesh("carpet", red, *box((-0.9, 0.0, -9.0), (0.9, 0.02, 9.5)))
    for z in (-6.0, 0.0, 6.0):
        scene.light((0.0, 3.4, z), 20.0, (1.0, 0.92, 0.8))
    scene.camera((-0.8, 1.7, 9.0), (0.3, 1.9, -6.0), 1.0)
    return scene


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--check"]
    if len(arguments) != 1:
        raise SystemExit(__doc__)
    folder = Path(arguments[0])
    for make in (knots, stairs, hall):
        file, made = folder / f"{make.__name__}.glb", make().glb()
        if "--check" not in sys.argv:
            file.write_bytes(made)
        elif not file.exists() or file.read_bytes() != made:
            raise SystemExit(f"{file}: expected what scenes.py makes, found another file; run scenes.py {folder}")
        print(f"{file}: {len(made)} bytes")


if __name__ == "__main__":
    main()
