"""Every error, warning, help text and progress line of eyeray is listed in tests/messages.txt.
Usage: messages.py [--bless], from the source tree's root. --bless writes the list anew.

A line is `FILE: TEXT`, in the order of the files' names and of the texts in a file. A text is a string literal of
at least two words. Adjacent literals are one text, and {} stands for a value. Texts that docs/scene-reference.md
repeats (descriptions of keys) are left out, and so is code: GLSL, shell, roff and headers of file formats."""
import ast
import pathlib
import re
import subprocess
import sys

LIST = pathlib.Path("tests/messages.txt")
# Files whose literals are code or tables of words.
CODE = {
    "host/cli/completion.cpp", "host/cli/man_page.cpp", "host/executors/formula_functions.cpp",
    "host/executors/registry_text.cpp", "host/executors/scene_constants.cpp", "host/executors/specialise.cpp",
    "host/executors/wavefront.cpp", "host/formula/kernel_text.cpp", "host/reading/foreign_words.cpp",
}
# Literals that are code in other files.
IS_CODE = re.compile(r"#(define|include|extension|version|if|endif)\b|\{\{|;\\n|^ply\\n|^property |^element |^#\?RADIANCE|"
                     r"^import |^\[image\]|^<\?xml|^ffconcat|^text/|^default-src|^return |^use strict$|var\(--|^badge |^[A-Z0-9]{4,}( [A-Z0-9]{4,})+$")
COMMENT_OR_SPACE = re.compile(r"(?:\s|//[^\n]*\n)*")
TWO_WORDS = re.compile(r"[A-Za-z]{2,}[,;:]? \(?[`'A-Za-z{]|[}'`] [a-z]{2,}")
TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"([^(\s]*)\(.*?\)\1"|"((?:[^"\\]|\\.)*)"|\'(?:[^\'\\]|\\.)\'', re.DOTALL)


def literals(text):
    """The string literals of a C++ text as (begin, end, value); adjacent ones are joined, raw ones left out."""
    joined = []
    for token in TOKEN.finditer(text):
        if token[2] is None:
            continue
        if joined and COMMENT_OR_SPACE.fullmatch(text, joined[-1][1], token.start()):
            begin, _, value = joined[-1]
            joined[-1] = (begin, token.end(), value + token[2])
        else:
            joined.append((token.start(), token.end(), token[2]))
    return joined


def is_shown(text, begin):
    """False for the name of an included file, and for the reason of an assertion at compile time."""
    before = text[:begin].rpartition("\n")[2].lstrip()
    return not before.startswith("#include") and "static_assert(" not in re.split("[;{}]", text[:begin])[-1]


def plain(text):
    """A text with single spaces and without escapes, as documents have it."""
    return re.sub(r"\s+", " ", text.replace("\\n", " ").replace('\\"', '"').replace("\\\\", "\\")).strip()


def of_cpp(text):
    return [value for begin, _, value in literals(text) if is_shown(text, begin)]


def of_python(text):
    """Strings outside of docstrings; {} stands for what an f-string computes."""
    tree = ast.parse(text)
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
    skipped = {id(node.body[0].value) for node in ast.walk(tree)
               if isinstance(node, documented) and node.body and isinstance(node.body[0], ast.Expr)}
    found = []
    for node in ast.walk(tree):
        if isinstance(node, ast.JoinedStr):
            skipped.update(id(part) for part in node.values)
            value = "".join(part.value if isinstance(part, ast.Constant) else "{}" for part in node.values)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in skipped:
            value = node.value
        else:
            continue
        found.append((node.lineno, node.col_offset, value))
    return [value for _, _, value in sorted(found)]


def of_web(text):
    """Text between tags, labels for screen readers, and strings of scripts."""
    page, _, script = text.partition("<script>") if "<!doctype" in text else ("", "", text)
    page = re.sub(r"<style>.*?</style>", "", page, flags=re.DOTALL)
    found = [(m.start(), m[1] or m[2]) for m in re.finditer(r'aria-label="([^"]*)"|>([^<>]+)(?=<)', page)]
    script = re.sub(r"^\s*//[^\n]*", lambda m: " " * len(m[0]), script, flags=re.MULTILINE)
    strings = r"'((?:[^'\\\n]|\\.)*)'|`((?:[^`\\]|\\.)*)`"
    found += [(len(page) + m.start(), re.sub(r"\$\{[^{}]*\}", "{}", m[1] or m[2] or ""))
              for m in re.finditer(strings, script)]
    return [value for _, value in sorted(found) if "$(" not in value and "<" not in value]


def of_shell(text):
    """Quoted texts that a script prints to standard error, itself or by its function `fail`; {} stands for a value."""
    shown = [line for line in text.split("\n") if re.search(r"\bfail \d?|>&2", line) and not line.lstrip().startswith("#")]
    quoted = [m[1] if m[1] is not None else m[2] for line in shown
              for m in re.finditer(r"'([^']*)'|\"((?:[^\"\\$]|\\.|\$\([^()]*\)|\$)*)\"", line)]
    return [re.sub(r"\$\([^()]*\)|\$\{[^{}]*\}|\$[\w*#]+", "{}", value.replace("%s", "{}")) for value in quoted
            if not value.startswith(("apt-get update -q", "apt-get install -q", "cd "))]


READERS = {".cpp": of_cpp, ".hpp": of_cpp, ".py": of_python, ".html": of_web, ".mjs": of_web}
SCRIPTS = {"#!/bin/sh": of_shell, "#!/usr/bin/python3": of_python}  # by the first line


def messages():
    reference = plain(pathlib.Path("docs/scene-reference.md").read_text() + pathlib.Path("docs/scene.schema.json").read_text())
    files = subprocess.run(["git", "ls-files", "host", "python", "scripts", ".ci"], capture_output=True, text=True, check=True).stdout
    for name in sorted(files.splitlines()):
        content = pathlib.Path(name).read_text()
        reader = READERS.get(pathlib.Path(name).suffix) or SCRIPTS.get(content.partition("\n")[0])
        if not reader or name in CODE:
            continue
        for value in reader(content):
            text = re.sub(r"\s*\n\s*", " ", value).strip()
            if not TWO_WORDS.search(text.replace("\\n", " ").replace('\\"', "'")) or IS_CODE.search(text):
                continue
            if len(plain(text)) > 8 and plain(text) in reference:
                continue
            yield f"{name}: {text}"


def main():
    listed = "".join(f"{line}\n" for line in messages())
    if "--bless" in sys.argv[1:]:
        LIST.write_text(listed)
        return 0
    if LIST.exists() and LIST.read_text() == listed:
        return 0
    before = set(LIST.read_text().splitlines()) if LIST.exists() else set()
    now = set(listed.splitlines())
    for mark, lines in (("-", before - now), ("+", now - before)):
        for line in sorted(lines):
            print(mark, line)
    print(f"{LIST} is not current. Read the new texts, then write the list anew: "
          "/usr/bin/python3 tests/documents/messages.py --bless")
    return 1


if __name__ == "__main__":
    sys.exit(main())
