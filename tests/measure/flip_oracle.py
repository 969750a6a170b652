"""What the published FLIP evaluator says of the three image pairs of test_flip.cpp. Its values are stored there; to make them again:

    python3 -m venv venv && venv/bin/pip install flip-evaluator==1.7 numpy && venv/bin/python tests/measure/flip_oracle.py
"""

import numpy
from flip_evaluator import evaluate

WIDTH, HEIGHT = 61, 47


def hashed(x, y, c, seed):
    """[0, 1) in steps of 2^-16."""
    h = (x * 73856093 ^ y * 19349663 ^ c * 83492791 ^ seed * 2654435761) & 0xFFFFFFFF
    h = (h ^ (h >> 15)) * 2246822519 & 0xFFFFFFFF
    h = (h ^ (h >> 13)) * 3266489917 & 0xFFFFFFFF
    return (h >> 16) / 65536


def image(name, is_test):
    out = numpy.zeros((HEIGHT, WIDTH, 3), numpy.float32)
    for y in range(HEIGHT):
        for x in range(WIDTH):
            for c in range(3):
                if name == "noise":  # a coloured ramp and relative noise
                    v = 0.1 + 0.8 * x / WIDTH * (1 - 0.3 * c * y / HEIGHT)
                    v *= 0.7 + 0.6 * hashed(x, y, c, 1) if is_test else 1
                elif name == "edge":  # a bright box on dark ground, moved by two pixels
                    inside = 20 <= x - (2 if is_test else 0) < 40 and 12 <= y < 30
                    v = (0.9 - 0.2 * c) if inside else 0.02 + 0.01 * c
                else:  # high dynamic range with fireflies
                    v = 0.01 * 2 ** (12 * x // WIDTH) * (1 + 0.25 * c)
                    v = v * (0.5 + hashed(x, y, 0, 2)) + (200 if hashed(x, y, 0, 3) > 0.98 else 0) if is_test else v
                out[y, x, c] = v
    return out


for name in ("noise", "edge", "fireflies"):
    reference, test = image(name, False), image(name, True)
    ldr = evaluate(numpy.clip(reference, 0, 1), numpy.clip(test, 0, 1), "LDR", inputsRGB=False, applyMagma=False)
    hdr = evaluate(reference, test, "HDR", inputsRGB=False, applyMagma=False)
    print(f'{{"{name}", {ldr[1]:.7f}, {hdr[1]:.7f}, {ldr[0][11, 23].item():.7f}, {hdr[0][11, 23].item():.7f}, {hdr[2]["startExposure"]:.5f}, '
          f'{hdr[2]["stopExposure"]:.5f}, {hdr[2]["numExposures"]}}},')
