#!/usr/bin/env python3
"""Writes the large scenes that speed is measured on, into a folder of your choice:

    python3 bench/scenes/make_scenes.py FOLDER [--triangles N]

    terrain.xml   a landscape of a million triangles in the sun lamp's light
    glass.xml     a bumpy glass ball of 70 000 triangles on a floor, lit by an environment map
    sky.xml       the same ball of plaster
    terrain.ply, glass.ply, sky.hdr

About 25 MB. The same bytes on every machine and with every version of Python: nothing here is random, and nothing is left to
a library. They are made and not kept because a scene of 20 MB is no reading matter.
"""

import argparse
import array
import math
import pathlib
import struct
import sys

TERRAIN_TRIANGLES = 1_000_000
GLASS_TRIANGLES = 69_451  # about as many as the Stanford bunny

SCENE = """<!--
  purpose: {purpose}
  expect: nothing of samplers; it is here for its time
-->
<scene version="3.0.0">
    <default name="res" value="256"/>
    <default name="spp" value="16"/>
    <default name="max_depth" value="8"/>
    <integrator type="path"><integer name="max_depth" value="$max_depth"/></integrator>
    <sensor type="perspective">
        <float name="fov" value="{fov}"/>
        <float name="near_clip" value="0.01"/>
        <float name="far_clip" value="1000"/>
        <transform name="to_world"><lookat origin="{origin}" target="{target}" up="0, 1, 0"/></transform>
        <film type="hdrfilm">
            <integer name="width" value="$res"/>
            <integer name="height" value="$res"/>
            <string name="pixel_format" value="rgb"/>
            <rfilter type="box"/>
        </film>
        <sampler type="independent"><integer name="sample_count" value="$spp"/></sampler>
    </sensor>
{body}</scene>
"""

TERRAIN = """    <shape type="ply">
        <string name="filename" value="terrain.ply"/>
        <bsdf type="diffuse"><rgb name="reflectance" value="0.46, 0.42, 0.36"/></bsdf>
    </shape>
    <shape type="rectangle">
        <transform name="to_world"><scale value="2"/><rotate x="1" angle="90"/><translate x="-2" y="6" z="1"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0, 0, 0"/></bsdf>
        <emitter type="area"><rgb name="radiance" value="16, 15, 13"/></emitter>
    </shape>
"""

GLASS_BSDF = """<bsdf type="dielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1.0"/></bsdf>"""
PLASTER_BSDF = """<bsdf type="diffuse"><rgb name="reflectance" value="0.7, 0.69, 0.66"/></bsdf>"""

BALL = """    <shape type="ply">
        <string name="filename" value="glass.ply"/>
        {bsdf}
    </shape>
    <shape type="rectangle">
        <transform name="to_world"><scale value="6"/><rotate x="1" angle="-90"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0.6, 0.58, 0.54"/></bsdf>
    </shape>
    <emitter type="envmap"><string name="filename" value="sky.hdr"/></emitter>
"""


def write_ply(file, positions, triangles):
    """positions: flat x, y, z; triangles: flat index triples."""
    count = len(triangles) // 3
    header = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(positions) // 3}\nproperty float x\nproperty float y\nproperty float z\n"
              f"element face {count}\nproperty list uchar int vertex_indices\nend_header\n")
    vertices = array.array("f", positions)
    if sys.byteorder != "little":
        vertices.byteswap()
    face = struct.Struct("<B3i")
    with open(file, "wb") as out:
        out.write(header.encode())
        out.write(vertices.tobytes())
        out.write(b"".join(face.pack(3, *triangles[i:i + 3]) for i in range(0, 3 * count, 3)))


def terrain(count):
    """A square of 8 by 8 with hills of seven octaves, each turned against the last; two triangles a cell."""
    side = round(math.sqrt(count / 2))
    waves = [(2.0 ** k * math.cos(1.1 * k + 0.4), 2.0 ** k * math.sin(1.1 * k + 0.4), 0.35 * 0.5 ** k, 1.7 * k) for k in range(7)]
    positions, triangles = [], []
    for j in range(side + 1):
        z = 8.0 * j / side - 4.0
        for i in range(side + 1):
            x = 8.0 * i / side - 4.0
            height = 0.0
            for c, s, amplitude, phase in waves:
                height += amplitude * math.sin(c * x + s * z + phase) * math.cos(c * z - s * x + 2.3 * phase)
            positions += (x, height, z)
    for j in range(side):
        for i in range(side):
            a = j * (side + 1) + i
            b = a + side + 1
            triangles += (a, b, a + 1, a + 1, b, b + 1)
    return positions, triangles


def bumpy_ball(count):
    """A closed sphere of latitudes and longitudes, dented; its normals point outwards."""
    side = round(math.sqrt(count / 2))
    rings, around = side, side
    positions, triangles = [0.0, 2.05, 0.0], []

    def radius(theta, phi):
        return 1.0 + math.sin(theta) * (0.04 * math.sin(5.0 * theta) * math.sin(6.0 * phi) + 0.004 * math.sin(17.0 * theta) * math.sin(19.0 * phi))

    for ring in range(1, rings):
        theta = math.pi * ring / rings
        for k in range(around):
            phi = 2.0 * math.pi * k / around
            r = radius(theta, phi)
            positions += (r * math.sin(theta) * math.cos(phi), 1.05 + r * math.cos(theta), r * math.sin(theta) * math.sin(phi))
    positions += (0.0, 0.05, 0.0)
    last = len(positions) // 3 - 1

    def at(ring, k):
        return 1 + (ring - 1) * around + k % around

    for k in range(around):
        triangles += (0, at(1, k + 1), at(1, k))
        triangles += (last, at(rings - 1, k), at(rings - 1, k + 1))
    for ring in range(1, rings - 1):
        for k in range(around):
            a, b, c, d = at(ring, k), at(ring, k + 1), at(ring + 1, k), at(ring + 1, k + 1)
            triangles += (a, b, c, b, d, c)
    return positions, triangles


def write_sky(file, width=512, height=256):
    """A gradient, clouds and a sun, in Radiance's format without compression."""
    sun = (0.45, 0.62, 0.64)
    rows = []
    for y in range(height):
        theta = math.pi * (y + 0.5) / height
        for x in range(width):
            phi = 2.0 * math.pi * (x + 0.5) / width
            d = (math.sin(theta) * math.cos(phi), math.cos(theta), math.sin(theta) * math.sin(phi))
            up = max(d[1], 0.0)
            cloud = 0.5 + 0.5 * math.sin(5.0 * phi + 3.0 * math.sin(4.0 * theta)) * math.sin(11.0 * theta)
            towards_sun = sum(a * b for a, b in zip(d, sun)) / math.sqrt(sum(a * a for a in sun))
            glow = 400.0 if towards_sun > 0.9985 else 2.0 * max(towards_sun, 0.0) ** 64
            if d[1] < 0.0:
                rgb = (0.20, 0.18, 0.16)
            else:
                rgb = tuple(base * (1.0 - 0.6 * up) + 0.5 * cloud * up + glow * tint for base, tint in zip((0.9, 1.0, 1.2), (1.0, 0.9, 0.7)))
            rows.append(rgbe(rgb))
    with open(file, "wb") as out:
        out.write(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode())
        out.write(b"".join(rows))


def rgbe(rgb):
    """Source: Ward 1991, "Real pixels", Graphics Gems II."""
    largest = max(rgb)
    mantissa, exponent = math.frexp(largest)
    scale = mantissa * 256.0 / largest
    return bytes([*(int(v * scale) for v in rgb), exponent + 128])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--triangles", type=int, default=TERRAIN_TRIANGLES, help="of the terrain (default: a million)")
    arguments = parser.parse_args()
    if arguments.triangles < 2:
        parser.error("--triangles: expected 2 or more")
    folder = arguments.folder
    folder.mkdir(parents=True, exist_ok=True)
    write_ply(folder / "terrain.ply", *terrain(arguments.triangles))
    write_ply(folder / "glass.ply", *bumpy_ball(GLASS_TRIANGLES))
    write_sky(folder / "sky.hdr")
    (folder / "terrain.xml").write_text(SCENE.format(purpose="A landscape whose BVH fits no cache, under one lamp.", fov=42, origin="0.5, 2.6, 6.5",
                                                     target="0, -0.2, 0", body=TERRAIN))
    for name, purpose, bsdf in (("glass", "Glass of many triangles under an environment map with a sun.", GLASS_BSDF),
                                ("sky", "Plaster of many triangles under an environment map with a sun.", PLASTER_BSDF)):
        (folder / f"{name}.xml").write_text(SCENE.format(purpose=purpose, fov=36, origin="0, 2.2, 5", target="0, 0.9, 0", body=BALL.format(bsdf=bsdf)))


if __name__ == "__main__":
    main()
