"""Pictures as numpy arrays: not copied, and alive as long as anybody looks."""
import gc
import os
import subprocess

import numpy as np
import pytest

import eyeray

SMALL = "tests/library/small.toml"


def test_shapes_and_values():
    picture = eyeray.render(eyeray.Scene.read(SMALL), aovs=["depth", "normal", "shape"])
    assert picture.complete and picture.samples_done == 1 and picture.rays > 64 * 48 and picture.warnings == ()
    assert picture.aovs == ("depth", "normal", "shape")
    assert picture.color.shape == (48, 64, 3) and picture.color.dtype == np.float32
    assert picture.aov("depth").shape == (48, 64)
    assert picture.aov("normal").shape == (48, 64, 3)
    assert picture.aov("depth")[24, 32] == pytest.approx(3, rel=1e-3)
    assert np.isinf(picture.aov("depth")[0, 0]) and picture.aov("shape")[0, 0] == -1
    assert picture.color[0, 0].tolist() == [0.25, 0.5, 0.75]
    with pytest.raises(eyeray.InputError, match="no AOV 'uv'"):
        picture.aov("uv")


def test_nothing_is_copied_and_nothing_dies():
    picture = eyeray.render(eyeray.Scene.read(SMALL))
    first, second = picture.color, picture.color
    assert first.ctypes.data == second.ctypes.data and not first.flags.owndata
    assert not first.flags.writeable
    with pytest.raises(ValueError):
        first[0, 0] = 1
    before = first.copy()
    part = first[10:20, ::2]
    del picture, first, second
    gc.collect()
    for _ in range(3):  # what was freed would be written over
        eyeray.render(eyeray.Scene.read(SMALL, defines=["render.background=[9, 9, 9]"]))
    assert np.array_equal(part, before[10:20, ::2])


def test_backends_and_crop():
    scene = eyeray.Scene.read(SMALL)
    whole = eyeray.render(scene).color
    assert np.array_equal(eyeray.render(scene, backend="twin").color, whole)
    assert np.allclose(eyeray.render(scene, backend="reference").color, whole, atol=1e-3)
    assert np.array_equal(eyeray.render(scene, crop=(10, 20, 30, 5)).color, whole[20:25, 10:40])
    for wrong in [(60, 0, 10, 10), (0, 0, 0, 5)]:
        with pytest.raises(ValueError):
            eyeray.render(scene, crop=wrong)
    with pytest.raises(TypeError):
        eyeray.render(scene, crop="all")
    with pytest.raises(ValueError, match="'cpu'"):
        eyeray.render(scene, backend="cpu")
    with pytest.raises(eyeray.InputError, match="did you mean 'depth'"):
        eyeray.render(scene, aovs=["depht"])
    with pytest.raises(TypeError):
        eyeray.render(scene, aovs="depth")
    with pytest.raises(TypeError):
        eyeray.render("scene.toml")


def test_files_are_the_programs(tmp_path):
    eyeray.render(eyeray.Scene.read(SMALL)).write(tmp_path / "ours.png")
    subprocess.run([os.environ["EYERAY_BINARY"], "render", SMALL, "-q", "-o", tmp_path / "theirs.png"], check=True)
    assert (tmp_path / "ours.png").read_bytes() == (tmp_path / "theirs.png").read_bytes()
    with pytest.raises(eyeray.InputError):
        eyeray.render(eyeray.Scene.read(SMALL)).write(tmp_path / "picture.jpeg")
    with pytest.raises(eyeray.FileError):
        eyeray.render(eyeray.Scene.read(SMALL)).write(tmp_path / "none" / "picture.png")


def test_verify():
    scene = eyeray.Scene.read(SMALL)
    report = eyeray.verify(scene, crop=(0, 0, 32, 32))
    assert report and report.passed and report.failures == () and report.text.startswith("PASSED")
    with pytest.raises(eyeray.InputError):
        eyeray.verify(scene, backends=["reference"])
