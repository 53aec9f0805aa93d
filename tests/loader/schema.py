"""Every scene file passes docs/scene.schema.json, as an editor reads it, and wrong ones do not."""
import json
import pathlib
import sys
import tomllib

import jsonschema

schema = json.loads(pathlib.Path("docs/scene.schema.json").read_text())
validator_class = jsonschema.validators.validator_for(schema)
validator_class.check_schema(schema)
validator = validator_class(schema)

WRONG = {
    "a key that no sphere has": '[[sphere]]\ncentre = [0, 0, 0]\nradius = 1\nmaterial = "m"\n',
    "a table that no scene has": "[[ball]]\nradius = 1\n",
    "a vector of two": '[[sphere]]\ncenter = [0, 0]\nradius = 1\nmaterial = "m"\n',
    "a text in place of a number": '[camera]\nfov = "wide"\n',
    "a counter without a count": '[[light]]\ntype = "point"\nposition = [0, 0, 0]\nintensity = 1\nrepeat = { i = 0 }\n',
    "a texture of no kind": '[[material]]\nname = "m"\ntype = "diffuse"\ncolor = { marbel = {} }\n',
    "a material of no type": '[[material]]\nname = "m"\ntype = "difuse"\n',
    "an integrator of no name": '[render]\nintegrator = "paths"\n',
}

failures = []
scenes = sorted(pathlib.Path("scenes").rglob("*.toml"))
for scene in scenes:
    for error in validator.iter_errors(tomllib.loads(scene.read_text())):
        failures.append(f"{scene}: {error.json_path}: {error.message[:200]}")
for what, text in WRONG.items():
    if validator.is_valid(tomllib.loads(text)):
        failures.append(f"{what} passes")
if len(scenes) < 80:
    failures.append(f"only {len(scenes)} scenes are found")
sys.exit("\n".join(failures) or 0)
