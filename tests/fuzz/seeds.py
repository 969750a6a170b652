"""Small inputs of every kind that the loaders read, for the fuzzers to start from: seeds.py FOLDER."""

import struct
import sys
import zlib
from pathlib import Path

out = Path(sys.argv[1])


def write(name, data):
    path = out / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data if isinstance(data, bytes) else data.encode())


VERTICES = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]

# ---- meshes
head = "ply\nformat %s 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float color_0\nproperty float color_1\n"
head += "property float color_2\nelement face 1\nproperty list uchar int vertex_indices\n%send_header\n"
write("mesh/ascii.ply", head % ("ascii", "") + "".join(f"{x} {y} {z} .1 .2 .3\n" for x, y, z in VERTICES) + "3 0 1 2\n")
for order, name in ("<", "little"), (">", "big"):
    body = b"".join(struct.pack(order + "6f", *v, 0.1, 0.2, 0.3) for v in VERTICES)
    write(f"mesh/{name}.ply", (head % (f"binary_{name}_endian", "")).encode() + body + struct.pack(order + "B3i", 3, 0, 1, 2))
    write(f"mesh/{name}-face.ply", (head % (f"binary_{name}_endian", "property float weight_0\n")).encode() + body + struct.pack(order + "B3if", 3, 0, 1, 2, 0.5))
write("mesh/all.obj", "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\nf -1/-1/-1 -2/-2/-1 -3/-3/-1\n")


def serialized(flags, version, double):
    kind = "d" if double else "f"
    data = struct.pack("<I", flags | (0x2000 if double else 0x1000)) + (b"name\0" if version == 4 else b"") + struct.pack("<QQ", 3, 1)
    for bit, numbers in (0, 9), (1, 9), (2, 6), (8, 9):
        if bit == 0 or flags & bit:
            data += struct.pack(f"<{numbers}{kind}", *([0.0, 0.5, 1.0] * 3)[:numbers])
    return struct.pack("<HH", 0x041C, version) + zlib.compress(data + struct.pack("<3I", 0, 1, 2))


for version in 3, 4:
    first, second = serialized(0, version, False), serialized(0xB, version, True)
    table = struct.pack("<QQI" if version == 4 else "<III", 0, len(first), 2)
    write(f"mesh/v{version}.serialized", first + second + table)
    write(f"mesh/v{version}-colors.serialized", second)

write("mesh/cells.vol", b"VOL\x03" + struct.pack("<5i6f", 1, 2, 1, 3, 1, 0, 0, 0, 1, 1, 1) + struct.pack("<6f", *range(6)))

# ---- pictures
def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


for bits, colour, size in (8, 2, 3), (16, 2, 6), (8, 6, 4), (8, 0, 1):
    rows = b"".join(b"\0" + bytes(range(size * 2)) for _ in range(2))
    png = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 2, 2, bits, colour, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")
    write(f"image/{bits}-{colour}.png", png)
write("image/two.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n" + bytes([128, 64, 32, 129] * 4))
exr = struct.pack("<II", 20000630, 2)
channels = b"".join(c + b"\0" + struct.pack("<IIII", 2, 0, 1, 1) for c in (b"B", b"G", b"R")) + b"\0"
box = struct.pack("<4i", 0, 0, 1, 1)
for name, kind, value in (
    (b"channels", b"chlist", channels), (b"compression", b"compression", b"\0"), (b"dataWindow", b"box2i", box), (b"displayWindow", b"box2i", box),
    (b"lineOrder", b"lineOrder", b"\0"), (b"pixelAspectRatio", b"float", struct.pack("<f", 1)), (b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0)),
    (b"screenWindowWidth", b"float", struct.pack("<f", 1)),
):
    exr += name + b"\0" + kind + b"\0" + struct.pack("<I", len(value)) + value
exr += b"\0"
start = len(exr) + 16
line = lambda y: struct.pack("<ii6f", y, 24, *[0.5] * 6)
write("image/two.exr", exr + struct.pack("<QQ", start, start + 32) + line(0) + line(1))

# ---- scenes
write("scene/all.xml", """<scene version="3.0.0"><default name="n" value="4"/><integrator type="moment"><integrator type="direct"/></integrator>
<sensor type="thinlens"><float name="fov" value="40"/><float name="aperture_radius" value=".1"/><film type="hdrfilm"><integer name="width" value="$n"/>
<rfilter type="tent"/></film><sampler type="independent"><integer name="sample_count" value="$n"/></sampler></sensor>
<bsdf type="twosided" id="b"><bsdf type="diffuse"><spectrum name="reflectance" value="400:.1, 500:.2, 700:.3"/></bsdf></bsdf>
<shape type="cylinder"><point name="p1" x="1" y="2" z="3"/><ref id="b"/></shape><shape type="sphere"><emitter type="area"><rgb name="radiance" value="1 2 3"/></emitter></shape>
<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="30"/><lookat origin="1,2,3" target="0,0,0" up="0,1,0"/><matrix value="1 0 0 0 1 0 0 0 1"/></transform></shape>
<emitter type="spot"><float name="cutoff_angle" value="30"/><texture name="texture" type="checkerboard"/></emitter>
<emitter type="directional"><vector name="direction" value="0,0,1"/></emitter><emitter type="projector"/><emitter type="constant"/></scene>
""")
write("scene/media.xml", """<scene version="3.0.0"><integrator type="volpath"/><sensor type="perspective"><ref id="m"/><film type="hdrfilm"/></sensor>
<medium type="homogeneous" id="m"><rgb name="sigma_t" value="1 2 3"/><float name="scale" value="2"/><phase type="hg"><float name="g" value=".5"/></phase></medium>
<shape type="sphere"><bsdf type="null"/><ref name="interior" id="m"/><medium name="exterior" type="heterogeneous">
<volume name="sigma_t" type="gridvolume"><string name="filename" value="smoke/plume.vol"/><boolean name="use_grid_bbox" value="true"/></volume>
<volume name="albedo" type="constvolume"><float name="value" value=".5"/></volume></medium></shape></scene>
""")
