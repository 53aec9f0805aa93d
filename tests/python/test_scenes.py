"""Scenes from Python: read, parsed, built of dicts and arrays; what is wrong is an exception that says where."""
import ast
import pathlib

import numpy as np
import pytest

import eyeray

SMALL = "tests/library/small.toml"
TABLES = {
    "image": {"width": 64, "height": 48},
    "camera": {"eye": [0, 1, 4], "target": (0, 1, 0), "fov": 60},
    "render": {"background": np.array([0.25, 0.5, 0.75]), "ambient": [0.2, 0.2, 0.2]},
    "light": [{"type": "point", "position": [3, 5, 4], "intensity": np.full(3, 20)}],
    "material": [{"name": "matte", "type": "phong", "diffuse": [0.8, 0.4, 0.2]}],
    "sphere": [{"center": [0, 1, 0], "radius": np.float64(1), "material": "matte"}],
}
QUAD = np.array([[-3, 0, -3], [3, 0, -3], [3, 0, 3], [-3, 0, 3]], np.float32)
CORNERS = np.array([[0, 2, 1], [0, 3, 2]], np.uint32)


def with_mesh(**arrays):
    return eyeray.Scene.build(TABLES | {"mesh": [{"material": "matte"} | arrays]})


def test_dicts_equal_their_file():
    scene = eyeray.Scene.build(TABLES)
    assert (scene.width, scene.height, scene.samples) == (64, 48, 1)
    assert np.array_equal(eyeray.render(scene).color, eyeray.render(eyeray.Scene.read(SMALL)).color)
    assert not np.array_equal(
        eyeray.render(eyeray.Scene.build(TABLES, defines={"sphere.0.radius": 0.5})).color, eyeray.render(scene).color)


def test_defines():
    scene = eyeray.Scene.read(pathlib.Path(SMALL), defines=["image.width=32", "image.height=16"])
    assert (scene.width, scene.height) == (32, 16)
    assert eyeray.Scene.read(SMALL, defines={"image.width": 33}).width == 33
    with pytest.raises(TypeError):
        eyeray.Scene.read(SMALL, defines="image.width=32")


def test_defines_that_name_files(tmp_path):
    sky = tmp_path / "sky.hdr"
    sky.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x80\x80\x81")
    toml = "\n".join(line for line in pathlib.Path(SMALL).read_text().splitlines() if "background" not in line)
    (tmp_path / "scene.toml").write_text(toml)
    (tmp_path / "alone.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    for name in ("sky.hdr", "./sky.hdr", str(sky)):
        for file in ("scene.toml", "alone.obj"):
            eyeray.Scene.read(tmp_path / file, defines={"environment.image": name})
        for scene in (lambda defines: eyeray.Scene.parse(toml, defines=defines),
                      lambda defines: eyeray.Scene.build(TABLES, defines=defines)):
            with pytest.raises(eyeray.Error, match="only a scene in a file can have images"):
                scene({"environment.image": name})
    with pytest.raises(eyeray.Error, match="missing.hdr"):
        eyeray.Scene.read(tmp_path / "alone.obj", defines=["environment.image=missing.hdr"])


def test_a_mesh_of_arrays():
    plain = eyeray.render(with_mesh(vertices=QUAD, triangles=CORNERS), aovs=["depth"])
    assert np.isfinite(plain.aov("depth")[-1]).all()  # the floor
    # float64, lists, other integers and other strides are the same mesh.
    for vertices, triangles in [
            (QUAD.astype(np.float64), CORNERS.astype(np.int64)), (QUAD.tolist(), CORNERS.tolist()),
            (np.asfortranarray(QUAD), np.repeat(CORNERS, 2, axis=0)[::2])]:
        same = eyeray.render(with_mesh(vertices=vertices, triangles=triangles))
        assert np.array_equal(same.color, plain.color)
    tilted = np.tile(np.float32([0.6, 0.8, 0]), (4, 1))
    bent = eyeray.render(with_mesh(vertices=QUAD, triangles=CORNERS, normals=tilted, uv=QUAD[:, ::2]), aovs=["uv"])
    assert not np.array_equal(bent.color, plain.color)
    assert bent.aov("uv").min() < -1


@pytest.mark.parametrize("kind, words, arrays", [
    (ValueError, r"mesh\.0\.vertices has the shape \(4, 2\), not \(n, 3\)", {"vertices": QUAD[:, :2]}),
    (ValueError, r"shape \(12,\)", {"vertices": QUAD.ravel()}),
    (TypeError, "of numbers, not of complex64", {"vertices": QUAD.astype(np.complex64)}),
    (TypeError, "of numbers, not of <U", {"vertices": QUAD.astype(str)}),
    (TypeError, "an array, not str", {"vertices": "many"}),
    (TypeError, "of integers, not of float32", {"triangles": CORNERS.astype(np.float32)}),
    (ValueError, "-1 is not the index", {"triangles": [[0, 1, -1]]}),
    (ValueError, r"shape \(2, 2\)", {"triangles": CORNERS[:, :2]}),
    (ValueError, r"shape \(4, 2\)", {"normals": QUAD[:, :2]}),
    (eyeray.InputError, "normals have 9 numbers, not 12", {"normals": QUAD[:3]}),
    (eyeray.InputError, "uv have 4 numbers, not 8", {"uv": QUAD[:2, :2]}),
    (eyeray.InputError, "", {"triangles": [[0, 1, 4]]}),
    (eyeray.InputError, "", {"vertices": np.where(QUAD == 3, np.nan, QUAD)}),
    (eyeray.InputError, "", {"vertices": QUAD[:0], "triangles": CORNERS}),
])
def test_wrong_arrays(kind, words, arrays):
    with pytest.raises(kind, match=words):
        with_mesh(**({"vertices": QUAD, "triangles": CORNERS} | arrays))


def test_vertices_without_triangles():
    with pytest.raises(ValueError, match="no triangles"):
        with_mesh(vertices=QUAD)


@pytest.mark.parametrize("tables, words", [
    ({"sphere": [{"radius": None}]}, r"sphere\.0\.radius: NoneType"),
    ({"sphere": [{"radius": {1, 2}}]}, r"sphere\.0\.radius: set"),
    ({"sphere": 3}, "sphere must be a dict, or a list of dicts"),
    ({"sphere": [3]}, r"sphere\.0 must be a dict"),
    ({"camera": {3: 4}}, "a key must be a str, not int"),
])
def test_values_that_no_scene_can_hold(tables, words):
    with pytest.raises(TypeError, match=words):
        eyeray.Scene.build(tables)


def test_errors_have_positions(tmp_path):
    file = tmp_path / "bad.toml"
    file.write_text("[[sphere]]\ncenter = [0, 0, 0]\nradius = -1\nradios = 2\n")
    with pytest.raises(eyeray.InputError) as caught:
        eyeray.Scene.read(file)
    error = caught.value
    assert isinstance(error, ValueError)
    assert error.file == str(file)
    assert {(each.line, each.column) for each in error.diagnostics} >= {(3, 10)}
    assert any("radius" in each.message for each in error.diagnostics)
    assert "radius = -1" in str(error)
    with pytest.raises(eyeray.InputError) as caught:
        eyeray.Scene.build({"sphere": [{"center": [0, 0, 0], "radius": -1, "material": "none"}]})
    assert (caught.value.file, caught.value.line) == ("scene built in Python", 3)
    with pytest.raises(eyeray.FileError) as caught:
        eyeray.Scene.read(tmp_path / "none.toml")
    assert isinstance(caught.value, OSError) and caught.value.line is None


def test_strings_cannot_leave_their_quotes():
    name = 'a"\n[[sphere]]\\\x07é'
    with pytest.raises(eyeray.InputError) as caught:
        eyeray.Scene.build({"sphere": [{"center": [0, 0, 0], "radius": 1, "material": name}]})
    assert [each.line for each in caught.value.diagnostics] == [4]


def test_stubs_match_the_module():
    stub = ast.parse(pathlib.Path("python/eyeray/_eyeray.pyi").read_text())
    named = {each.name: each for each in stub.body if isinstance(each, (ast.ClassDef, ast.FunctionDef))}
    native = eyeray._eyeray
    assert set(named) == {each for each in dir(native) if not each.startswith("_")}
    for name, each in named.items():
        if isinstance(each, ast.ClassDef):
            members = {one.name for one in each.body if isinstance(one, ast.FunctionDef)}
            own = {one for one in vars(getattr(native, name)) if not one.startswith("_")}
            assert {one for one in members if not one.startswith("_")} == own, name
            for function in each.body:
                given = [one.arg for one in function.args.args + function.args.kwonlyargs if one.arg != "self"]
                words = getattr(getattr(native, name), function.name).__doc__ or ""
                assert all(f"{one}:" in words for one in given), (name, function.name)


def test_cyclic_and_very_deep_values_are_refused():
    ring = []
    ring.append(ring)
    loop = {}
    loop["x"] = loop
    deep = 1.0
    for _ in range(100_000):
        deep = [deep]
    for value in (ring, loop, deep):
        with pytest.raises(ValueError, match="nested more than 64 deep"):
            eyeray.Scene.build({"camera": {"eye": value}})
        with pytest.raises(ValueError, match="nested more than 64 deep"):
            eyeray.Scene.parse("", defines={"camera.eye": value})
