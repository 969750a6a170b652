"""The built program, driven from outside as a user would, with the standard library alone.

Run by CTest, which sets KOKSMA_PROGRAM; by hand:
    KOKSMA_PROGRAM=build/release/bin/koksma python3 tests/program/test_render.py
"""

import json
import os
import subprocess
import tempfile
import unittest

PROGRAM = os.path.abspath(os.environ["KOKSMA_PROGRAM"])

# A lamp over a floor with a box on it. `$bsdf` chooses what the box is made of.
SCENE = """<scene version="3.0.0">
    <default name="res" value="16"/>
    <default name="spp" value="4"/>
    <default name="bsdf" value="diffuse"/>
    <integrator type="path"><integer name="max_depth" value="6"/></integrator>
    <sensor type="perspective">
        <float name="fov" value="50"/>
        <transform name="to_world"><lookat origin="0, 1, 4" target="0, 0.7, 0" up="0, 1, 0"/></transform>
        <film type="hdrfilm">
            <integer name="width" value="$res"/>
            <integer name="height" value="$res"/>
            <rfilter type="box"/>
        </film>
        <sampler type="independent"><integer name="sample_count" value="$spp"/></sampler>
    </sensor>
    <shape type="rectangle">
        <transform name="to_world"><scale value="3"/><rotate x="1" angle="-90"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0.7, 0.6, 0.5"/></bsdf>
    </shape>
    <shape type="rectangle">
        <transform name="to_world"><scale value="0.5"/><rotate x="1" angle="90"/><translate y="3"/></transform>
        <emitter type="area"><rgb name="radiance" value="12, 11, 9"/></emitter>
    </shape>
    <shape type="cube">
        <transform name="to_world"><scale value="0.4"/><rotate y="1" angle="30"/><translate y="0.4"/></transform>
        <bsdf type="$bsdf"/>
    </shape>
</scene>
"""


class Result:
    def __init__(self, process):
        self.code, self.out, self.err = process.returncode, process.stdout, process.stderr

    def json(self):
        return json.loads(self.out)


class ProgramTest(unittest.TestCase):
    """Each test has an empty folder of its own with scene.xml, which is the working directory of what it runs."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="koksma-test-")
        self.addCleanup(folder.cleanup)
        self.dir = folder.name
        self.environment = dict(os.environ, KOKSMA_REFERENCE_DIR=self.path("references"), PYTHONDONTWRITEBYTECODE="1")
        self.write("scene.xml", SCENE)

    def path(self, *names):
        return os.path.join(self.dir, *names)

    def write(self, name, content):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "w") as file:
            file.write(content)

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def files(self):
        """All files and folders below the test's folder."""
        return sorted(os.path.relpath(os.path.join(root, name), self.dir)
                      for root, folders, names in os.walk(self.dir) for name in folders + names)

    def koksma(self, *arguments, timeout=300, **options):
        return Result(subprocess.run([PROGRAM, *arguments], cwd=self.dir, env=self.environment, timeout=timeout,
                                     stdout=options.pop("stdout", subprocess.PIPE), stderr=subprocess.PIPE, text=True, **options))

    def succeeds(self, *arguments, **options):
        result = self.koksma(*arguments, **options)
        self.assertEqual(result.code, 0, f"koksma {' '.join(arguments)}: {result.err}")
        return result

    def refuses(self, code, arguments, *words, **options):
        """The program ends with this code and one line on stderr that has all the words, and changes no file."""
        before = self.files()
        result = self.koksma(*arguments, timeout=60, **options)
        message = f"koksma {' '.join(arguments)}\nstdout: {result.out}\nstderr: {result.err}"
        self.assertEqual(result.code, code, message)
        self.assertEqual(result.err.count("\n"), 1, message)
        self.assertTrue(result.err.startswith("koksma: "), message)
        self.assertNotIn("json.exception", result.err, message)
        for word in words:
            self.assertIn(word, result.err, message)
        self.assertEqual(self.files(), before, message)
        return result
