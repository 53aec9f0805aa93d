"""A thousand renders leave nothing behind."""
import ctypes
import gc
import resource

import numpy as np

import eyeray

TABLES = {
    "image": {"width": 64, "height": 48},
    "camera": {"eye": [0, 1, 4], "target": [0, 1, 0]},
    "light": [{"type": "directional", "direction": [0, -1, -1], "intensity": [1, 1, 1]}],
}
ROUND = np.linspace(0, 2 * np.pi, 400, endpoint=False)
RING = np.stack([np.cos(ROUND), np.sin(ROUND) + 1, 0 * ROUND], axis=1)
FAN = np.stack([0 * np.arange(398), np.arange(1, 399), np.arange(2, 400)], axis=1)


def resident():
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    with open("/proc/self/statm") as statm:
        return int(statm.read().split()[1]) * resource.getpagesize()


def render_once(renderer):
    scene = eyeray.Scene.build(TABLES | {"mesh": [{"vertices": RING, "triangles": FAN}]})
    picture = renderer.render(scene, aovs=["depth"])
    assert picture.color.shape == (48, 64, 3) and picture.aov("depth").shape == (48, 64)


def test_a_thousand_renders(capsys):
    renderer = eyeray.Renderer()
    for _ in range(200):  # caches and pools fill
        render_once(renderer)
    # malloc keeps memory that it may need again, and more at random. A leak grows with every quarter.
    growth, before = [], resident()
    for _ in range(4):
        for _ in range(250):
            render_once(renderer)
        now = resident()
        growth.append(now - before)
        before = now
    with capsys.disabled():
        print(f" [250 renders: {', '.join(f'{each / 1024:.0f}' for each in growth)} KiB]", end="")
    # A picture and its depth alone are 48 KiB, a scene's arrays 20: one of them kept each time would be MiB.
    assert min(growth) < 1 << 20
