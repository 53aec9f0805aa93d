#!/usr/bin/python3
"""Kernels of an AMD GPU hold their budgets: RADV compiles the kernels of some scenes for navi21, which the machine need
not have. budgets.txt records what they need, which may only get better.

  tests/kernels/budgets.py EYERAY            compares with the table
  tests/kernels/budgets.py EYERAY --bless    writes the table, better or worse"""
import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
TABLE = Path(__file__).with_name("budgets.txt")
# Kernels as a GPU gets them, with corrected division, and one scene of each kind.
SCENES = ["whitted", "textures", "path/cornell_box", "sppm/box"]
# More of these is worse, fewer waves are.
FIGURES = ["spilled_vgprs", "scratch_bytes", "waves"]
COLUMNS = ["driver", "scene", "kernel", *FIGURES]


def measured(eyeray):
    rows = {}
    for scene in SCENES:
        command = [eyeray, "kernels", f"scenes/{scene}.toml", "--family", "navi21", "--json"]
        answer = json.loads(subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout)
        # Without the distribution's own suffix, as in "Mesa 25.0.7-2+deb13u1".
        driver = answer["driver_version"].split("-")[0].replace(" ", "-")
        for kernel in answer["kernels"]:
            statistics = kernel["programs"][0]["statistics"]
            rows[driver, scene, kernel["name"]] = [statistics[figure] for figure in FIGURES]
    return rows


def recorded():
    lines = [line.split() for line in TABLE.read_text().splitlines()[1:]]
    return {tuple(line[:3]): [int(figure) for figure in line[3:]] for line in lines}


def write(rows):
    lines = [COLUMNS] + [[*key, *map(str, figures)] for key, figures in sorted(rows.items())]
    widths = [max(len(line[i]) for line in lines) for i in range(len(COLUMNS))]
    TABLE.write_text("".join("  ".join(f"{cell:<{width}}" for cell, width in zip(line, widths)).rstrip() + "\n" for line in lines))


def worse(now, before):
    """The figures that a kernel exceeds, as text."""
    exceeded = [now[0] > before[0], now[1] > before[1], now[2] < before[2]]
    return [f"{FIGURES[i]} {now[i]} instead of {before[i]}" for i in range(3) if exceeded[i]]


def main():
    rows = measured(sys.argv[1])
    drivers = {driver for driver, _, _ in rows}
    old = recorded() if TABLE.exists() else {}
    if "--bless" in sys.argv:
        write({key: figures for key, figures in old.items() if key[0] not in drivers} | rows)
        return 0
    if not drivers <= {driver for driver, _, _ in old}:
        print(f"there are no budgets for {', '.join(drivers)}: --bless writes them")
        return 0
    failures = [f"{' '.join(key)}: {text}" for key, figures in rows.items() if key in old for text in worse(figures, old[key])]
    failures += [f"{' '.join(key)}: not in the table" for key in rows if key not in old]
    for failure in failures:
        print(failure)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
