"""Every eyeray command that a document shows is one: its words and options are those of --help, its scenes are there,
and those that write or print something without rendering are run. With --all every command runs, small, but for those of NOT_RUN. Then
a block that begins with its file's name as a comment (`# first.toml`) is written to that file, or with the word "continued" appended to it;
lines that begin with sed are run too; and `# exit code 1` behind a command is the exit code that it must have.
Usage: commands.py EYERAY [--all [DOCUMENT…]], from the source tree's root."""
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path.cwd()
EYERAY = str(pathlib.Path(sys.argv[1]).resolve())
RUN = {"check", "shaders", "completion", "manual", "new", "generate"}
SLOW = re.compile(r"terrain|000|--size-factor")
ALL = "--all" in sys.argv
ONLY = [each for each in sys.argv[2:] if not each.startswith("--")]
SMALL = {"-s": "24x18", "--spp": "1", "--triangles": "2000", "--frames": "0:1", "--turntable": "2"}  # replace the values in the document
SIZED = {"render", "verify", "probe"}  # commands that get SMALL's size and samples where they name none, …
UNSIZED = {"--record": {"-s", "--spp"}, "--classic": {"--spp"}}  # … but for those that an option excludes
# Files that a reader brings, by the document's name for them: copies of our own.
BROUGHT = {
    "model.glb": "scenes/showcase/chess.glb",
    "bunny.obj": "scenes/meshes/gem.obj",
    "gem.mtl": "scenes/meshes/gem.mtl",
    "scene.toml": "scenes/whitted.toml",
    "studio.hdr": "scenes/showcase/studio.hdr",
}
RENDERED = ("a.pfm", "b.pfm", "new.pfm", "old.pfm")  # brought, too
# Commands that --all does not run, and why. Each has to be in some document.
NOT_RUN = {
    r"^bench\b": "it measures for minutes",
    r"^dev\b": "it serves until somebody ends it",
    r"^slurm\b": "it needs a cluster; tests/slurm has one that is made up",
    r"^kernels .*--compare": "the shell writes its old.json",
    r"^verify scenes/( |$)": "it takes every scene, as the tests scene.* do",
    r"--video": "it needs ffmpeg",
    r"--checkpoint|--resume": "it is shown being interrupted; tests/cli/long_render.cpp does that",
}


class Words(list):
    """The words of a command, and the exit code that it must have."""

    code = 0


def blocks(text):
    """(language, text) of each block of code."""
    return re.findall(r"^```(\w*)\n(.*?)^```", text, re.MULTILINE | re.DOTALL)


def steps(text):
    """Commands, and between them (file, text, mode) of the files that a reader writes, and the lines of sed."""
    for language, block in blocks(text):
        named = re.match(r"(?:#|//) ([\w./-]+\.(?:toml|glsl|comp))(, continued)?\n", block)
        if named and language in ("toml", "glsl"):
            yield named[1], block, "a" if named[2] else "w"
        elif language in ("", "sh"):
            yield from commands(f"```{language}\n{block}```", ("sed",))


def commands(text, others=()):
    """The words after `eyeray` of each such line in blocks of shell, of eyeray-bench with the word bench before them; a line that ends with a
    backslash goes on. And the words of lines that begin with one of the others."""
    for language, block in blocks(text):
        if language not in ("", "sh"):
            continue
        for line in block.replace("\\\n", " ").splitlines():
            code = re.search(r"\s# exit code (\d+)$", line)
            line = re.sub(r"\s#.*", "", line.removeprefix("$ "))
            if line.split(" ")[0] in others:
                yield Words(shlex.split(line))
                continue
            for part in re.split(r"&&|\|\||;|\|(?= )", line):
                found = re.match(r"(?:[A-Z_]+=\S* )*(?:scripts/|build/release/)?eyeray(?: |-(?=bench\b))(.*)", part.strip())
                if found:
                    words = Words(shlex.split(re.split(r" \d?>", found[1])[0]))
                    words.code = int(code[1]) if code else 0
                    yield words


def run(words, **options):
    program = [f"{EYERAY}-bench", *words[1:]] if words[0] == "bench" else [EYERAY, *words]
    return subprocess.run(program, capture_output=True, text=True, **options)


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
    while words and words[0] in options_of(command)[1] | ({"bench"} if not command else set()):
        command, words = (*command, words[0]), words[1:]
    if not command and words and re.fullmatch("[a-z]+", words[0]):
        return f"no command {words[0]}"
    for word in words:
        name = word.split("=")[0]
        if re.fullmatch(r"--?[a-zA-Z][\w-]*", name) and name not in options_of(command)[0]:
            return f"{' '.join(command) or 'eyeray'} has no option {name}"
        if word.startswith("scenes/") and not list(ROOT.glob(word)):
            return f"there is no {word}"
    return None


def can_run(words):
    line = " ".join(words)
    scenes = [word for word in words[1:] if word.startswith("scenes/")]
    return (words[0] in RUN and not SLOW.search(line) and not re.search(r"[A-Z]{3}|…|<|\$", line)
            and (words[0] != "check" or scenes or "--schema" in words or "--manual" in words))


def made_small(words):
    """The command with small sizes, and no pixel of a probe outside them."""
    words = list(words)
    for option, value in SMALL.items():
        if option == "--spp" and "--denoise" in words:
            value = "2"
        if option in words:
            words[words.index(option) + 1] = value
        elif words[0] in SIZED and option in {"-s", "--spp"}.difference(*(UNSIZED.get(word, ()) for word in words)):
            words += [option, value]
    if words[0] == "probe" and words[2].count(",") == 1:  # the pixel of a scene, and not the invocation of a kernel
        words[2] = "12,9"
    return words


def run_all(document, all_steps, used):
    """Does a document's steps one after the other in one scratch folder; returns the faults."""
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        here = pathlib.Path(folder)
        for folder_of_ours in ("scenes", "examples"):
            (here / folder_of_ours).symlink_to(ROOT / folder_of_ours)
        for name, source in BROUGHT.items():
            shutil.copy(ROOT / source, here / name)
        for name in RENDERED:
            run(["render", "scenes/whitted.toml", "-s", "24x18", "-o", name, "--quiet"], cwd=folder)
        for words in all_steps:
            if isinstance(words, tuple):
                name, text, mode = words
                (here / name).parent.mkdir(parents=True, exist_ok=True)
                with open(here / name, mode) as file:
                    file.write(text)
                continue
            if not words:
                continue
            if words[0] == "sed":
                done = subprocess.run(words, cwd=folder, capture_output=True, text=True)
                if done.returncode != 0:
                    faults.append(f"{document}: {shlex.join(words)}: ended with {done.returncode}: {done.stderr}")
                continue
            code = words.code
            reasons = [each for each in NOT_RUN if re.search(each, " ".join(words))]
            used.update(reasons)
            if reasons:
                continue
            words = made_small(words)
            if words[0] == "shaders":  # the folder is the document's to make
                shutil.rmtree(here / "my-shaders", ignore_errors=True)
            elif "my-shaders" in words and not (here / "my-shaders").exists():
                run(["shaders", "--export", "my-shaders"], cwd=folder)
            files = [found for word in words for found in (sorted(map(str, here.glob(word))) if "*" in word else [])]
            if files:
                words = [each for word in words for each in (files if "*" in word else [word])]
                words = [str(pathlib.Path(word).relative_to(here)) if word in files else word for word in words]
            done = run(words, cwd=folder)
            if done.returncode != code:
                faults.append(f"{document}: eyeray {shlex.join(words)}: ended with {done.returncode}, not {code}: {done.stderr[-600:]}")
    return faults


def main():
    seen, ran, faults, used = 0, set(), [], set()
    # Files that a page of docs/adding-*.md adds do not exist yet; tests/additions follows those pages.
    documents = [each for each in sorted((ROOT / "docs").glob("*.md")) if not each.name.startswith("adding-")]
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "scenes").symlink_to(ROOT / "scenes")
        for document in [ROOT / "README.md", *documents]:
            found = list(filter(None, commands(document.read_text())))
            if ONLY and str(document.relative_to(ROOT)) not in ONLY:
                continue
            if ALL:
                faults += run_all(document.relative_to(ROOT), steps(document.read_text()), used)
            for words in found:
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
    if ONLY:
        sys.exit("\n".join(faults) or 0)
    if ALL:
        faults += [f"no document has a command like {each}, which NOT_RUN lists" for each in NOT_RUN if each not in used]
    if seen < 70 or len(ran) < 5:
        faults.append("the documents show more commands than these")
    sys.exit("\n".join(faults) or 0)


main()
