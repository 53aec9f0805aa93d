"""scripts/check-commits accepts good messages and refuses each bad one, in a repository made for it.
Usage: check_commits.py, from the root of the source tree."""
import os
import pathlib
import subprocess
import sys
import tempfile

SCRIPT = pathlib.Path("scripts/check-commits").resolve()
CASES = [  # subject, body, the file that changes and its new text, a piece of the complaint (None: accepted)
    ("Add a file", "Another one needs it.", "a.cpp", "int a;\n", None),
    ("verify: compare one more pixel", "The last one was left out.", "a.cpp", "int aa;\n", None),
    ("Bless the texts", "They changed with the kernels.", "a.cpp", "int a;\n", None),
    ("Indent by two", "", "a.cpp", "  int a;\n", None),
    ("Name the comment's subject", "", "a.cpp", "// A number.\n  int a;\n", None),
    ("Describe the file", "", "a.md", "A file.\n", None),
    ("Remove what nobody needs", "", "a.cpp", "int b;\n", "there is no body"),
    ("Added a file", "Another one needs it.", "b.cpp", "int b;\n", "use the imperative"),
    ("Adds a file", "Another one needs it.", "c.cpp", "int c;\n", "use the imperative"),
    ("add a file", "Another one needs it.", "d.cpp", "int d;\n", "small letter"),
    ("Add a file.", "Another one needs it.", "e.cpp", "int e;\n", "full stop"),
    ("Add " + "a" * 69, "Another one needs it.", "f.cpp", "int f;\n", "73 characters"),
    ("Add a script", "", "g", "# What it does.\nexit\n", "there is no body"),
]
ENVIRONMENT = {**os.environ, "GIT_CONFIG_GLOBAL": "/dev/null", "GIT_CONFIG_SYSTEM": "/dev/null",
               **{f"GIT_{who}_{what}": "a@b.c" for who in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}}


def run(folder, *words):
    return subprocess.run(words, cwd=folder, env=ENVIRONMENT, capture_output=True, text=True)


def main():
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        for words in (["init", "-q", "-b", "main"], ["commit", "-q", "--allow-empty", "-m", "Begin"]):
            run(folder, "git", *words).check_returncode()
        if (done := run(folder, SCRIPT)).returncode != 0 or "no origin/main" not in done.stdout:
            wrong.append(f"without origin/main: {done}")
        for subject, body, name, text, complaint in CASES:
            (pathlib.Path(folder) / name).write_text(text)
            run(folder, "git", "add", name)
            run(folder, "git", "commit", "-q", "-m", subject, *(["-m", body] if body else [])).check_returncode()
            done = run(folder, SCRIPT, "HEAD~1")
            if (done.returncode == 0) != (complaint is None) or (complaint or "") not in done.stderr:
                wrong.append(f"{subject!r}: ended with {done.returncode}: {done.stderr}")
        # All of them are new where origin/main is the first commit.
        run(folder, "git", "update-ref", "refs/remotes/origin/main", run(folder, "git", "rev-list", "--max-parents=0", "HEAD").stdout.strip())
        if f"{len(CASES)} commits checked" not in (done := run(folder, SCRIPT)).stdout or done.returncode != 1:
            wrong.append(f"from origin/main: {done}")
    sys.exit("\n".join(wrong) or 0)


main()
