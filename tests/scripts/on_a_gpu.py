#!/usr/bin/python3
"""scripts/on-a-gpu on the machine's CPU device, and with programs that fail or never end. Usage: on_a_gpu.py EYERAY"""
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
EYERAY = Path(sys.argv.pop(1)).resolve()
STEPS = ["devices", "self-test", "pictures", "time-slices", "rays", "verify", "benchmarks", "kernels", "dev"]


def run(folder, *options, eyeray=EYERAY):
    return subprocess.run([ROOT / "scripts/on-a-gpu", "--device", "cpu", "--small", "-o", folder, *options], env={**os.environ, "EYERAY": str(eyeray)},
                          capture_output=True, text=True)


def verdicts(folder):
    page = (Path(folder) / "README.md").read_text()
    return dict(re.findall(r"^\| \[?([\w-]+)\]?(?:\(#[\w-]+\))? \| (passed|partly|failed|not reached) \|", page, re.MULTILINE)), page


class OnAGpu(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name) / "results"
        self.programs = Path(scratch.name) / "programs"
        self.programs.mkdir()

    def stand_in(self, text):
        """Programs that run `text` first, then the real ones."""
        for name in ("eyeray", "eyeray-bench"):
            (self.programs / name).write_text(f'#!/bin/sh\n{text}\nexec {EYERAY.with_name(name)} "$@"\n')
            (self.programs / name).chmod(0o755)
        return self.programs / "eyeray"

    def test_every_step_passes(self):
        result = run(self.folder, "--minutes", "60")
        found, page = verdicts(self.folder)
        self.assertEqual(found, {step: "passed" for step in STEPS}, result.stderr + page)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.strip(), str(self.folder / "README.md"))
        self.assertIn("2 of 2 scenes passed every gate. gpu and twin have the same bits in 2, and different ones in 0.", page)
        for link in re.findall(r"\]\(([\w.-]+)\)", page):
            self.assertTrue((self.folder / link).exists(), link)

    def test_failed_steps_are_named_and_do_not_stop_the_others(self):
        result = run(self.folder, "--minutes", "60", eyeray=self.stand_in(
            'case "$1" in devices | --version) ;; *) echo "eyeray: error: no luck" >&2; exit 3 ;; esac'))
        found, page = verdicts(self.folder)
        self.assertEqual(result.returncode, 1)
        self.assertEqual(list(found), STEPS)
        self.assertEqual([step for step in STEPS if found[step] == "passed"], ["devices", "self-test"])
        self.assertIn("ended with exit code 3: eyeray: error: no luck", page)

    def test_a_step_that_never_ends_costs_its_share_of_the_time(self):
        result = run(self.folder, "--minutes", "0.2", eyeray=self.stand_in(
            'case "$1" in devices | --version) ;; verify) sleep 1000 & sleep 1000 ;; *) exit 3 ;; esac'))
        found, page = verdicts(self.folder)
        self.assertEqual(list(found), STEPS, result.stderr)
        self.assertRegex(page, r"`eyeray verify [^`]*` took longer than its share of the time")

    def test_wrong_options(self):
        self.folder.mkdir()
        (self.folder / "file").touch()
        result = run(self.folder)
        self.assertEqual(result.returncode, 2)
        self.assertIn("is not empty: choose another folder with -o", result.stderr)
        result = run(self.folder / "new", "--device", "no such device")
        self.assertEqual(result.returncode, 3)
        self.assertIn("there is no device 'no such device'. `eyeray devices` lists these: ", result.stderr)


if __name__ == "__main__":
    unittest.main()
