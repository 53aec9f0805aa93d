"""Text of files and names in Python: for any text, an error is eyeray's own, and names the file as open() takes it."""
import ast
import os
import pathlib
import re

import pytest

import eyeray

SMALL = pathlib.Path("tests/library/small.toml").read_text()


def nasty_strings():
    """The nasty strings of the C++ tests, as bytes."""
    text = pathlib.Path("tests/support/nasty_strings.hpp").read_text()
    listed = re.sub(r"^ *//.*$", "", text.split("nasty_strings = {")[1].split("\n};")[0], flags=re.MULTILINE)
    listed = re.sub(r'std::string\(("[^"]*"), \d+\)', r"\1", listed)
    return ast.literal_eval("[" + re.sub(r'"(?:\\.|[^"\\])*"', lambda match: "b" + match[0], listed) + "]")


NASTY = nasty_strings()


def test_there_are_forty():
    assert len(NASTY) == 40 and b"a\0b" in NASTY and b"\xc2\x9b31m" in NASTY and b"\xff\xfe\xc0\xaf" in NASTY


@pytest.mark.parametrize("text", NASTY)
def test_files_of_any_name(text, tmp_path):
    if b"\0" in text:
        return  # no name can contain it
    file = pathlib.Path(os.fsdecode(os.fsencode(tmp_path) + b"/x" + text + b".toml"))
    with pytest.raises(eyeray.FileError) as missing:
        eyeray.Scene.read(file)
    str(missing.value).encode()
    file.parent.mkdir(exist_ok=True)
    file.write_text(SMALL.replace("fov", "fow"))
    with pytest.raises(eyeray.InputError) as wrong:
        eyeray.Scene.read(file)
    str(wrong.value).encode()
    assert wrong.value.file == str(file) and "fow" in wrong.value.diagnostics[0].message
    file.write_text(SMALL)
    assert eyeray.Scene.read(file).width == 64


@pytest.mark.parametrize("text", NASTY)
def test_scenes_of_any_text(text):
    for scene in (SMALL.encode() + text, SMALL.encode() + b"\n[" + text + b"]\n", b'a = "' + text + b'"'):
        try:
            eyeray.Scene.parse(scene)
        except eyeray.InputError as error:
            for each in error.diagnostics:
                each.message.encode()
            str(error).encode()


@pytest.mark.parametrize("text", NASTY)
def test_values_of_any_text(text):
    value = text.decode(errors="replace")
    with pytest.raises(eyeray.InputError) as unknown:
        eyeray.Scene.build({"material": [{"name": "a", "type": value}]})
    assert len(str(unknown.value).splitlines()) >= 1
    with pytest.raises(eyeray.InputError):
        eyeray.Scene.build({"image": {value: 1}})
