"""Pictures as numpy arrays: not copied, and alive as long as anybody looks."""
import gc
import os
import pathlib
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


def test_transparent_pictures_have_an_alpha():
    picture = eyeray.render(eyeray.Scene.read(SMALL, defines=["image.transparent=true"]))
    assert picture.color.shape == (48, 64, 4) and picture.tonemapped().shape == (48, 64, 4)
    assert picture.color[0, 0].tolist() == [0, 0, 0, 0] and picture.color[24, 32, 3] == 1
    assert picture.tonemapped()[0, 0, 3] == 0 and picture.tonemapped()[24, 32, 3] == 255


def test_arrays_are_not_copied_and_outlive_the_picture():
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
    with pytest.raises(TypeError, match=r"^a crop must be \(x, y, width, height\) in whole pixels, not str$"):
        eyeray.render(scene, crop="all")
    with pytest.raises(ValueError, match="'cpu'"):
        eyeray.render(scene, backend="cpu")
    with pytest.raises(eyeray.InputError, match="did you mean 'depth'"):
        eyeray.render(scene, aovs=["depht"])
    for wrong, name in [("depth", "str"), (3, "int"), ([3], "list")]:
        with pytest.raises(TypeError, match=f"^aovs must be a list of names, not {name}$"):
            eyeray.render(scene, aovs=wrong)
    with pytest.raises(TypeError, match="^noise must be a number, not str$"):
        eyeray.render(scene, noise="little")
    with pytest.raises(TypeError, match="unexpected keyword argument 'crops'"):
        eyeray.render(scene, crops=None)


def test_files_equal_those_of_the_program(tmp_path):
    eyeray.render(eyeray.Scene.read(SMALL)).write(tmp_path / "ours.png")
    subprocess.run([os.environ["EYERAY_BINARY"], "render", SMALL, "-q", "-o", tmp_path / "theirs.png"], check=True)
    assert (tmp_path / "ours.png").read_bytes() == (tmp_path / "theirs.png").read_bytes()
    picture = eyeray.render(eyeray.Scene.read(SMALL))
    assert picture.png() == picture._repr_png_() == (tmp_path / "theirs.png").read_bytes()
    with pytest.raises(eyeray.InputError):
        eyeray.render(eyeray.Scene.read(SMALL)).write(tmp_path / "picture.jpeg")
    with pytest.raises(eyeray.FileError):
        eyeray.render(eyeray.Scene.read(SMALL)).write(tmp_path / "none" / "picture.png")


def test_colours_for_a_screen():
    shown = eyeray.render(eyeray.Scene.read(SMALL, defines=["image.exposure=1"])).tonemapped()
    assert (shown.shape, shown.dtype) == ((48, 64, 3), np.uint8)
    assert shown[0, 0].tolist() == [188, 255, 255]  # sRGB of 0.25, 0.5 and 0.75, twice as bright
    shown[0, 0] = 1  # it is a copy


def test_an_empty_picture_is_shown_as_none():
    cancellation = eyeray.Cancellation()
    cancellation.request()
    empty = eyeray.render(SMALL, cancellation=cancellation)
    assert empty.tonemapped().shape == (0, 0, 3) and empty._repr_png_() is None
    with pytest.raises(eyeray.InputError, match="cancelled"):
        empty.png()


def test_numpy_converts_a_picture_to_its_colours():
    picture = eyeray.render(SMALL)
    assert np.array_equal(np.asarray(picture), picture.color) and np.mean(picture) == np.mean(picture.color)
    assert np.asarray(picture, np.float64).dtype == np.float64
    assert np.array(picture).flags.writeable
    # The arguments that numpy 1 and numpy 2 pass.
    for dtype, copy, copied in [(None, None, False), (np.float32, None, False), (None, False, False),
                                ("f4", False, False), (None, True, True), (np.float64, None, True), (np.uint8, True, True)]:
        array = picture.__array__(dtype, copy=copy)
        assert array.dtype == np.dtype(dtype or np.float32)
        assert np.shares_memory(array, picture.color) == (not copied) == (not array.flags.writeable)
    with pytest.raises(ValueError, match="copy=False"):
        picture.__array__(np.float64, copy=False)


TABLES = {"camera": {"eye": [0, 1, 4], "target": [0, 1, 0]}, "render": {"background": np.array([0.25, 0.5, 0.75])}}


def test_fireflies_are_rejected():
    box = "scenes/path/cornell_box.toml"
    picture = eyeray.render(box, size=(48, 32), spp=4, reject_fireflies=True)
    assert picture.color.max() <= eyeray.render(box, size=(48, 32), spp=4).color.max()
    with pytest.raises(eyeray.InputError, match="^only random paths make fireflies: "):
        eyeray.render(SMALL, reject_fireflies=True)


def test_denoised_pictures_equal_those_of_the_program(tmp_path):
    box = "scenes/path/cornell_box.toml"
    picture = eyeray.render(box, size=(48, 32), spp=4, denoise=True)
    picture.write(tmp_path / "ours.pfm")
    subprocess.run([os.environ["EYERAY_BINARY"], "render", box, "-s", "48x32", "--spp", "4", "--denoise", "-q",
                    "-o", tmp_path / "theirs.pfm"], check=True)
    assert (tmp_path / "ours.pfm").read_bytes() == (tmp_path / "theirs.pfm").read_bytes()
    assert picture.aovs == ()
    with pytest.raises(eyeray.InputError, match="^only pictures by random paths are denoised: "):
        eyeray.render(SMALL, denoise=True)


def test_files_and_dicts_are_rendered_directly(tmp_path):
    for scene in (SMALL, pathlib.Path(SMALL), TABLES):
        picture = eyeray.render(scene, size=(32, np.int64(16)), spp=4, backend="twin")
        assert picture.color.shape == (16, 32, 3) and picture.samples_done == 4
        assert picture.color[0, 0].tolist() == [0.25, 0.5, 0.75]
    assert np.array_equal(eyeray.render(SMALL).color, eyeray.render(eyeray.Scene.read(SMALL)).color)
    assert eyeray.verify(SMALL, size=(16, 12))


@pytest.mark.parametrize("kind, words, scene, options", [
    (ValueError, "^size: width and height must be whole numbers from 1 on, not 0$", SMALL, {"size": (0, 1)}),
    (TypeError, "^size: width and height must be whole numbers from 1 on, not float$", SMALL, {"size": (2.5, 1)}),
    (TypeError, r"^size must be \(width, height\), not 64$", SMALL, {"size": 64}),
    (TypeError, r"^size must be \(width, height\), not \(64,\)$", SMALL, {"size": (64,)}),
    (TypeError, r"^size must be \(width, height\), not '64'$", SMALL, {"size": "64"}),
    (ValueError, "^`defines` image.width=65537: error: `width` must be", SMALL, {"size": (65537, 1)}),
    (ValueError, "^spp: the samples a pixel must be a whole number from 1 on, not -1$", SMALL, {"spp": -1}),
    (TypeError, "from 1 on, not bool$", SMALL, {"spp": True}),
    (ValueError, "must be a square number; the nearest to 3 are 1 and 4", TABLES, {"spp": 3}),
    (ValueError, "unknown key `eyes`", {"camera": {"eyes": 3}}, {}),
    (TypeError, "^camera must be a dict, or a list of dicts$", {"camera": 3}, {}),
    (TypeError, "^camera: a key must be a str, not int$", {"camera": {3: 4}}, {}),
    (TypeError, "^a scene must be an eyeray.Scene, the name of a file, or a dict, not list$", [], {}),
    (eyeray.FileError, "missing.toml", "missing.toml", {}),
    (TypeError, "^size and spp need a file or a dict: a Scene has its own$", eyeray.Scene.read(SMALL), {"spp": 4}),
])
def test_wrong_scenes_and_sizes(kind, words, scene, options):
    for call in (eyeray.render, eyeray.verify):
        with pytest.raises(kind, match=words):
            call(scene, **options)


def test_verify():
    scene = eyeray.Scene.read(SMALL)
    report = eyeray.verify(scene, crop=(0, 0, 32, 32))
    assert report and report.passed and report.failures == () and report.text.startswith("PASSED")
    with pytest.raises(eyeray.InputError):
        eyeray.verify(scene, backends=["reference"])
