"""prose.py finds each habit in a tree made for it, and --bless lets no count rise.
Usage: prose_fails.py, from the root of the source tree."""
import pathlib
import shutil
import subprocess
import sys
import tempfile

SCRIPT = pathlib.Path("tests/documents/prose.py").resolve()
LONG = "This sentence " + "and one more word " * 9 + "is long."
PLANTED = [  # file, text that is added, where and what is found (None: nothing)
    ("docs/a.md", "\nThe picture shows what is drawn.\n", "docs/a.md:3: H1"),
    ("docs/a.md", "\nOf the rays one is traced.\n", "docs/a.md:3: H3"),
    ("docs/a.md", "\nThe pixel has no ray, nor has it a colour.\n", "docs/a.md:3: H3"),
    ("docs/a.md", "\nA lamp shines.\n", "docs/a.md:3: H4"),
    ("docs/a.md", f"\n| a | b |\n| --- | --- |\n| c | {LONG} |\n", "docs/a.md:5: long"),
    ("host/a.cpp", "// Of the sphere, in metres.\n", "host/a.cpp:1: H2"),
    ("host/a.cpp", "double radius;  // of the sphere, in metres\n", "host/a.cpp:1: H2"),
    ("shaders/a.glsl", "float a;  // What the lamp sends.\n", "shaders/a.glsl:1: H1"),
    ("tests/messages.txt", "# Messages.\nhost/a.cpp: the lamp is broken\n", "tests/messages.txt:2: H4"),
    ("docs/a.md", "\n```\nThe lamp shows what is drawn.\n```\n`lamp`, [light](lamp.md), in place of it.\n", None),
    ("host/a.cpp", 'auto a = "// Of a lamp";\n', None),
    ("docs/a.md", "\nWhat is a pixel?\n", None),
]


def run(root, *words):
    return subprocess.run([sys.executable, SCRIPT, *words], cwd=root, capture_output=True, text=True)


def main():
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for each in ("docs", "host", "shaders", "tests/documents"):
            (root / each).mkdir(parents=True)
        shutil.copy("docs/glossary.md", root / "docs")
        (root / "docs/a.md").write_text("A page.\n")
        if (done := run(root, "--bless")).returncode != 0:
            wrong.append(f"--bless without a record: {done}")
        record = (root / "tests/documents/prose.txt").read_text()
        for name, text, finding in PLANTED:
            path = root / name
            before = path.read_text() if path.exists() else None
            path.write_text((before or "") + text)
            for words in ([], ["--bless"]):
                done = run(root, *words)
                if (done.returncode == 0) != (finding is None) or (finding or "") not in done.stderr:
                    wrong.append(f"{text!r}, {words}: ended with {done.returncode}: {done.stderr}")
            if (root / "tests/documents/prose.txt").read_text() != record:
                wrong.append(f"{text!r}: --bless wrote a record")
            path.unlink() if before is None else path.write_text(before)
        # A page that is split takes its counts along, and no more.
        (root / "docs/a.md").write_text("A lamp shines. A lamp is dark.\n")
        (root / "tests/documents/prose.txt").unlink()
        run(root, "--bless").check_returncode()
        (root / "docs/a.md").rename(root / "docs/b.md")
        if (done := run(root)).returncode != 0:
            wrong.append(f"a page that moved: {done}")
        (root / "docs/c.md").write_text("A third lamp.\n")
        if "docs/c.md:1: H4" not in (done := run(root)).stderr:
            wrong.append(f"a page that moved, and one more: {done}")
    sys.exit("\n".join(wrong) or 0)


main()
