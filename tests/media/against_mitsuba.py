#!/usr/bin/env python3
"""Scenes with media, rendered by Koksma and by Mitsuba 3, compared. Run by hand; needs the Python packages mitsuba and numpy.

    python3 tests/media/against_mitsuba.py build/release/bin/koksma [samples per pixel] [integrator]

For each scene: mean colour of both, the relative difference and its standard error over 8 replicates of each, and z scores of 16 blocks of the image.
`integrator` is Mitsuba's, volpath by default: its volpathmis (3.9.1) is biased at depths beyond rr_depth.
"""

import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")
REPLICATES, BLOCKS = 8, 4

HEAD = """<scene version="3.0.0"><default name="integrator" value="volpath"/><integrator type="$integrator"><integer name="max_depth" value="%s"/></integrator>
<sensor type="perspective"><float name="fov" value="45"/><transform name="to_world"><lookat origin="0,0.8,-4" target="0,0,0" up="0,1,0"/></transform>%s
<film type="hdrfilm"><integer name="width" value="32"/><integer name="height" value="32"/><rfilter type="box"/></film><sampler type="independent"/></sensor>
"""
FLOOR = '<shape type="rectangle"><transform name="to_world"><scale value="4"/><rotate x="1" angle="-90"/><translate y="-1.2"/></transform><bsdf type="diffuse"/></shape>'
LAMP = (
    '<shape type="rectangle"><transform name="to_world"><scale value="0.7"/><rotate x="1" angle="90"/><translate y="2.5"/></transform>'
    '<emitter type="area"><rgb name="radiance" value="9,8,7"/></emitter></shape>'
)
SKY = '<emitter type="constant"><rgb name="radiance" value="0.1,0.2,0.3"/></emitter>'
NULL_CUBE = '<shape type="cube"><transform name="to_world"><scale value="%g"/></transform><bsdf type="null"/><ref id="m" name="interior"/></shape>'


def coloured(scale, g):
    return (
        '<medium id="m" type="homogeneous"><rgb name="sigma_t" value="0.9,0.5,0.2"/><float name="scale" value="%g"/><rgb name="albedo" value="0.9,0.8,0.95"/>'
        '<phase type="hg"><float name="g" value="%g"/></phase></medium>' % (scale, g)
    )


def cloud(volume):
    return '<medium id="m" type="heterogeneous">%s<rgb name="albedo" value="0.9,0.7,0.5"/><float name="scale" value="3"/></medium>' % volume


def sheet(angle, x, y, bsdf):
    return (
        f'<shape type="rectangle"><transform name="to_world"><scale value="0.8"/><rotate x="1" angle="{angle}"/><translate x="{x}" y="{y}"/></transform>'
        f'<ref id="{bsdf}"/></shape>'
    )


def point(x, y, z, red, rest):
    return f'<emitter type="point"><point name="position" x="{x}" y="{y}" z="{z}"/><rgb name="intensity" value="{red},{rest},{rest}"/></emitter>'


CENTRED = '<transform name="to_world"><translate x="-0.5" y="-0.5" z="-0.5"/><scale value="2"/></transform>'
SCENES = {  # name: (max_depth, what is in the sensor, the rest)
    "coloured medium in glass": (-1, "", coloured(3, 0.7) + FLOOR + LAMP + '<shape type="sphere"><bsdf type="dielectric"/><ref id="m" name="interior"/></shape>'),
    "camera in fog": (
        12,
        '<ref id="m"/>',
        coloured(0.4, 0.3) + FLOOR + SKY + LAMP + '<shape type="sphere"><float name="radius" value="2.4"/><transform name="to_world"><translate z="-3"/></transform>'
        '<bsdf type="null"/><ref id="m" name="interior"/></shape>',
    ),
    "turned coloured grid": (
        -1,
        "",
        '<medium id="m" type="heterogeneous"><volume name="sigma_t" type="gridvolume"><string name="filename" value="s3.vol"/><boolean name="use_grid_bbox" value="true"/>'
        '<transform name="to_world"><rotate x="0.6" y="0.8" angle="35"/></transform></volume><volume name="albedo" type="gridvolume"><string name="filename" value="a3.vol"/>'
        '<string name="wrap_mode" value="mirror"/></volume><float name="scale" value="2"/><phase type="hg"><float name="g" value="-0.5"/></phase></medium>' + FLOOR + LAMP + NULL_CUBE % 1.3,
    ),
    "masks and blends": (
        3,
        "",
        FLOOR + LAMP + '<bsdf type="mask" id="mk"><float name="opacity" value="0.4"/><bsdf type="twosided"><bsdf type="diffuse"/></bsdf></bsdf>'
        '<bsdf type="blendbsdf" id="bl"><float name="weight" value="0.7"/><bsdf type="null"/><bsdf type="roughplastic"/></bsdf>'
        + sheet(-80, -0.5, 0.5, "mk") + sheet(-100, 0.1, 1, "mk") + sheet(-70, 0.5, 0, "bl") + sheet(-95, 0.2, -0.5, "bl") + point(1, 2, 0, 1, 1),
    ),
    "nested boundaries": (
        -1,
        "",
        coloured(1, -0.6) + '<medium id="n" type="homogeneous"><float name="sigma_t" value="0.8"/><float name="scale" value="4"/><float name="albedo" value="0.9"/></medium>' + FLOOR + LAMP
        + '<shape type="sphere"><float name="radius" value="1.1"/><bsdf type="thindielectric"/><ref id="m" name="interior"/></shape><shape type="cube"><transform name="to_world">'
        '<scale value="0.5"/><rotate y="1" angle="30"/></transform><bsdf type="null"/><ref id="n" name="interior"/><ref id="m" name="exterior"/></shape>',
    ),
    "grid in rough glass": (
        8,
        "",
        cloud('<volume name="sigma_t" type="gridvolume"><string name="filename" value="s1.vol"/>' + CENTRED + "</volume>") + FLOOR + LAMP
        + '<shape type="sphere"><bsdf type="roughdielectric"/><ref id="m" name="interior"/></shape><emitter type="directional"><vector name="direction" x="0.3" y="-1" z="0.2"/></emitter>',
    ),
    "20 lamps": (
        -1,
        "",
        coloured(0.6, 0.5) + FLOOR + SKY + NULL_CUBE % 1.1
        + "".join(point(2.2 * np.cos(i), 1.3 + 0.1 * i % 1.5, 2.2 * np.sin(i), 0.05 * i, 0.3) for i in range(20)),
    ),
    "nearest cells": (
        -1,
        "",
        cloud('<volume name="sigma_t" type="gridvolume"><string name="filename" value="s1.vol"/><string name="filter_type" value="nearest"/>' + CENTRED + "</volume>") + FLOOR + LAMP + SKY
        + NULL_CUBE % 1,
    ),
    "no shadow rays in the medium": (
        -1, "", cloud('<rgb name="sigma_t" value="0.9,0.2,0.5"/><boolean name="sample_emitters" value="false"/>') + FLOOR + LAMP + SKY + NULL_CUBE % 1.1,
    ),
}


def write_volumes(folder):
    rng = np.random.default_rng(1)

    def write(name, values, box=(0, 0, 0, 1, 1, 1)):
        z, y, x, channels = values.shape
        (folder / name).write_bytes(b"VOL\x03" + struct.pack("<5i6f", 1, x, y, z, channels, *box) + values.astype(np.float32).tobytes())

    write("s1.vol", rng.random((5, 4, 6, 1)) ** 2 * 2)
    write("s3.vol", rng.random((5, 4, 6, 3)) ** 2 * 2, (-1, -0.5, -1, 1, 1, 1))
    write("a3.vol", rng.random((3, 4, 2, 3)))


def ours(program, file, spp, seed):
    out = file.with_suffix(".exr")
    subprocess.run([program, "render", file, "-o", out, "--sampler", "random", "--spp", str(spp), "--seed", str(seed)], check=True, capture_output=True)
    return np.array(mi.Bitmap(str(out)).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False), dtype=np.float64)


def main():
    program, spp, integrator = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 512, sys.argv[3] if len(sys.argv) > 3 else "volpath"
    folder = Path(tempfile.mkdtemp())
    write_volumes(folder)
    for name, (depth, sensor, body) in SCENES.items():
        file = folder / "scene.xml"
        file.write_text(HEAD % (depth, sensor) + body + "</scene>")
        scene = mi.load_file(str(file), integrator=integrator)
        a = np.array([ours(program, file, spp // REPLICATES, r + 1) for r in range(REPLICATES)])
        b = np.array([np.array(mi.render(scene, spp=spp // REPLICATES, seed=r + 100), dtype=np.float64)[..., :3] for r in range(REPLICATES)])
        mean = [x.mean((1, 2)) for x in (a, b)]
        blocks = [x.reshape(REPLICATES, BLOCKS, 32 // BLOCKS, BLOCKS, 32 // BLOCKS, 3).mean((2, 4)) for x in (a, b)]
        difference = lambda x, y: (x.mean(0) - y.mean(0), np.sqrt((x.var(0, ddof=1) + y.var(0, ddof=1)) / REPLICATES + 1e-12))
        d, error = difference(*mean)
        z, z_error = difference(*blocks)
        print(
            f"{name:28} koksma {mean[0].mean(0).round(5)} mitsuba {mean[1].mean(0).round(5)} relative {(d / mean[1].mean(0)).round(4)} +- {(error / mean[1].mean(0)).round(4)}"
            f" blocks: largest z {np.abs(z / z_error).max():.1f}, rms {np.sqrt(((z / z_error) ** 2).mean()):.2f}",
            flush=True,
        )


if __name__ == "__main__":
    main()
