#!/usr/bin/python3
"""Other compilers read the kernels that GPUs get: the validator for Vulkan 1.1, 1.2 and 1.3, and SPIRV-Cross, which writes the
languages of Metal, Direct3D and OpenGL ES. glslang then compiles the last. docs/gpus.md names the GPUs that these stand for.

  tests/kernels/translate.py EYERAY                    every scene
  tests/kernels/translate.py EYERAY scenes/spot.toml   these scenes

Prints each failure with its scene, kernel and reason."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
# The kernels of a GPU: the first as it is, the second for a GPU whose division and roots must be corrected.
WAYS = {"own division": ["profile=gpu", "division=own"], "exact division": ["profile=gpu", "division=exact"]}
# What they may ask of a device, as docs/gpus.md has it: capabilities, extensions of SPIR-V, and storage buffers.
CAPABILITIES = {"Shader", "DenormPreserve", "RoundingModeRTE", "SignedZeroInfNanPreserve"}
EXTENSIONS = {"SPV_KHR_float_controls"}
MOST_BUFFERS = 16

JUDGES = {
    "Vulkan 1.1": lambda spirv: ["spirv-val", "--target-env", "vulkan1.1", spirv],
    "Vulkan 1.2": lambda spirv: ["spirv-val", "--target-env", "vulkan1.2", spirv],
    "Vulkan 1.3": lambda spirv: ["spirv-val", "--target-env", "vulkan1.3", spirv],
    "MSL 2.3": lambda spirv: ["spirv-cross", spirv, "--msl", "--msl-version", "20300", "--output", f"{spirv}.metal"],
    "HLSL 6.0": lambda spirv: ["spirv-cross", spirv, "--hlsl", "--shader-model", "60", "--output", f"{spirv}.hlsl"],
    "GLSL 310 es": lambda spirv: ["spirv-cross", spirv, "--es", "--version", "310", "--output", f"{spirv}.comp"],
    "GLSL 310 es, compiled": lambda spirv: ["glslangValidator", f"{spirv}.comp"],
}


def judged(spirv):
    """The judges that refuse a kernel, with their reasons."""
    refusals = {}
    for judge, command in JUDGES.items():
        if judge == "GLSL 310 es, compiled" and "GLSL 310 es" in refusals:
            continue
        result = subprocess.run(command(spirv), capture_output=True, text=True)
        if result.returncode != 0:
            words = (result.stderr + result.stdout).split("\n")
            refusals[judge] = " ".join(line for line in words if line.strip())[:300] or f"exit code {result.returncode}"
    return refusals


def demands(spirv):
    """What a kernel asks of a device beyond the lists above."""
    text = subprocess.run(["spirv-dis", spirv], capture_output=True, text=True, check=True).stdout
    beyond = set(re.findall(r"OpCapability (\w+)", text)) - CAPABILITIES
    beyond |= set(re.findall(r'OpExtension "(\w+)"', text)) - EXTENSIONS
    buffers = len(re.findall(r"OpDecorate %\w+ Binding ", text))
    return sorted(beyond), buffers


def kernels_of(eyeray, scene, tunes, folder):
    folder.mkdir()
    options = [word for tune in tunes for word in ("--tune", tune)]
    result = subprocess.run([eyeray, "kernels", scene, "--timeout", "3600", "--spirv", folder, *options], capture_output=True, text=True, cwd=ROOT)
    if result.returncode != 0:
        return result.stderr.strip() or f"exit code {result.returncode}"
    return sorted(folder.glob("*.spv"))


def check_scene(eyeray, scene):
    """The number of kernels, the most buffers of one, and the failures."""
    count, most, failures = 0, 0, []
    with tempfile.TemporaryDirectory() as scratch:
        for way, tunes in WAYS.items():
            kernels = kernels_of(eyeray, scene, tunes, Path(scratch) / way.replace(" ", "-"))
            if not kernels or isinstance(kernels, str):
                failures.append(f"{scene}, {way}: no kernels: {kernels}")
                continue
            count += len(kernels)
            for kernel in kernels:
                beyond, buffers = demands(kernel)
                most = max(most, buffers)
                if beyond or buffers > MOST_BUFFERS:
                    failures.append(f"{scene}, {way}, {kernel.stem}: it has {buffers} buffers and asks for {', '.join(beyond) or 'nothing else'}")
                failures += [f"{scene}, {way}, {kernel.stem}: {judge}: {reason}" for judge, reason in judged(kernel).items()]
    return count, most, failures


def main():
    if len(sys.argv) < 2:
        sys.exit("usage: tests/kernels/translate.py EYERAY [SCENE...]")
    for tool, package in (("spirv-val", "spirv-tools"), ("spirv-cross", "spirv-cross"), ("glslangValidator", "glslang-tools")):
        if not shutil.which(tool):
            sys.exit(f"{tool} is missing: scripts/setup ci installs it (Debian: {package})")
    scenes = sys.argv[2:] or sorted(str(path.relative_to(ROOT)) for path in (ROOT / "scenes").rglob("*.toml") if "include" not in path.parts)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(lambda scene: check_scene(sys.argv[1], scene), scenes))
    failures = [failure for *_, some in results for failure in some]
    print(f"{sum(count for count, *_ in results)} kernels of {len(scenes)} scenes, at most {max(most for _, most, _ in results)} buffers; {len(JUDGES)} judges, {len(failures)} refusals")
    print("\n".join(failures))
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
