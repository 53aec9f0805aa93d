"""Every eyeray command that a document shows is one: its words and options are those of --help, its scenes are there,
and what writes or tells something without rendering is run. Usage: commands.py EYERAY, from the source tree's root."""
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path.cwd()
EYERAY = str(pathlib.Path(sys.argv[1]).resolve())
RUN = {"check", "shaders", "completion", "manual", "new", "generate"}
SLOW = re.compile(r"terrain|000|--size-factor")
HIDDEN = {"--inject-fault"}  # of which no --help tells


def commands(text):
    """The words after `eyeray` of each such line in blocks of shell; a line that ends with a backslash goes on."""
    for language, block in re.findall(r"^```(\w*)\n(.*?)^```", text, re.MULTILINE | re.DOTALL):
        if language not in ("", "sh"):
            continue
        for line in block.replace("\\\n", " ").splitlines():
            line = re.sub(r"\s#.*", "", line.removeprefix("$ "))
            for part in re.split(r"&&|\|\||;|\|(?= )", line):
                found = re.match(r"(?:[A-Z_]+=\S* )*(?:scripts/|build/release/)?eyeray (.*)", part.strip())
                if found:
                    yield shlex.split(re.split(r" \d?>", found[1])[0])


def run(words, **options):
    return subprocess.run([EYERAY, *words], capture_output=True, text=True, **options)


def options_of(command, known={}):
    """The names that the help of a command has, and the commands below it."""
    if command not in known:
        text = run([*command, "--help"]).stdout
        below = set()
        if "\nSubcommands:" in text:
            lines = text.split("\nSubcommands:")[1].split("\n\n")[0]
            for names in re.findall(r"^  ([a-z]+(?:, [a-z]+)*)  ", lines, re.MULTILINE):
                below |= set(names.split(", "))
        known[command] = (set(re.findall(r"(?<![\w-])--?[a-zA-Z][\w-]*", text)), below)
    return known[command]


def fault(words):
    """What no eyeray would understand of a command line, or None."""
    command = ()
    while words and words[0] in options_of(command)[1]:
        command, words = (*command, words[0]), words[1:]
    if not command and words and re.fullmatch("[a-z]+", words[0]):
        return f"no command {words[0]}"
    for word in words:
        name = word.split("=")[0]
        if re.fullmatch(r"--?[a-zA-Z][\w-]*", name) and name not in options_of(command)[0] | HIDDEN:
            return f"{' '.join(command) or 'eyeray'} has no option {name}"
        if word.startswith("scenes/") and not list(ROOT.glob(word)):
            return f"there is no {word}"
    return None


def can_run(words):
    line = " ".join(words)
    scenes = [word for word in words[1:] if word.startswith("scenes/")]
    return (words[0] in RUN and not SLOW.search(line) and not re.search(r"[A-Z]{3}|…|<|\$", line)
            and (words[0] != "check" or scenes or "--schema" in words or "--manual" in words))


def main():
    seen, ran, faults = 0, set(), []
    # What a page of docs/adding-*.md adds is not there yet; tests/additions follows those.
    documents = [each for each in sorted((ROOT / "docs").glob("*.md")) if not each.name.startswith("adding-")]
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "scenes").symlink_to(ROOT / "scenes")
        for document in [ROOT / "README.md", *documents]:
            for words in filter(None, commands(document.read_text())):
                seen += 1
                line = f"{document.relative_to(ROOT)}: eyeray {shlex.join(words)}"
                if wrong := fault(words):
                    faults.append(f"{line}: {wrong}")
                elif can_run(words) and tuple(words) not in ran:
                    ran.add(tuple(words))
                    done = run(words, cwd=folder)
                    if done.returncode != 0:
                        faults.append(f"{line}: ended with {done.returncode}: {done.stderr}")
    print(f"{seen} commands, {len(ran)} of them run")
    if seen < 70 or len(ran) < 5:
        faults.append("the documents show more commands than these")
    sys.exit("\n".join(faults) or 0)


main()
