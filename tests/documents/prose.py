"""Counts habits that make the prose hard to read, in documents and in comments of C++ and GLSL, file by file.

The counts may only fall: tests/documents/prose.txt records them. Error messages (tests/messages.txt) and the text of
--help have no allowance. docs/glossary.md lists the words that are not used, and what to write instead.

    prose.py [EYERAY] [--bless] [--list FILE…]

EYERAY: read its --help too. --bless: record the counts, unless one has risen. --list: print each finding of these files.
Run from the root of the source tree."""
import pathlib
import re
import subprocess
import sys

RECORD = pathlib.Path("tests/documents/prose.txt")
MESSAGES = pathlib.Path("tests/messages.txt")
HABITS = {  # its column in prose.txt: its name, and the cure
    "H1": ("a headless clause as a noun", "name the thing: \"the primary hits\", not \"what camera rays hit\""),
    "H2": ("a comment that begins with of", "write a full phrase: \"Radius of the gather sphere\""),
    "H3": ("fronting or inversion", "write subject, verb, object"),
    "H4": ("a word that docs/glossary.md lists as not used", ""),
    "long": ("a sentence of more than 35 words", "write a list, a table or two sentences"),
}
MOST_WORDS = 35
MOST_SHOWN = 5  # of a file's findings, where none is in a line that differs from the last commit
CODE = ("host", "shaders", "include", "benchmarks", "python", "examples", "tests")
OFF = ("<!-- prose off -->", "<!-- prose on -->")  # around the bad examples of CONTRIBUTING.md, and nowhere else

HEADLESS = re.compile(r"\bwhat(?:ever)?\b(?! to\b|(?<=ever) (?:the|their|its)\b)|(?<!\bsuch )\b(?:that|those) of which\b", re.IGNORECASE)
HEADLESS_COMMENT = re.compile(r"(?:What|Where|Whether|How|That|Which)\b(?! to\b)")
BE = r"(?:is|are|was|were|has|have|had|do|does|did|can|may|must|will|would)"
FRONTED = re.compile(rf"Of\b|(?:So|Nor|Neither|Then) {BE}\b(?! (?:a|an|no|one|two|\d+)\b)"
                     rf"|(?:Then|So) (?:go|goes|come|comes|follow|follows|stand|stands)\b|(?:Only|Not only) (?:then|there|so|here) {BE}\b")
INVERTED = re.compile(rf"(?:,|;| and| but) (?:so|nor|neither) {BE}\b(?! that\b)|\bof (?:which|whom|these|those) [a-z ]{{0,20}}\b(?:alone|only)\b")


class Word:
    """A row of the glossary's table: forms that are not used, the cure, and phrases in which the form is right."""

    def __init__(self, row):
        forms, self.cure, *rest = [cell.strip() for cell in row.strip("|\n ").split("|")]
        form = "|".join(sorted(re.findall(r"`([^`]+)`", forms), key=len, reverse=True))
        right = re.findall(r"`([^`]+)`", rest[0] if rest else "")
        self.form = re.compile(rf"\b(?:{form})\b", re.IGNORECASE)
        self.right = re.compile("|".join(rf"\b{each}\b" for each in right) or r"(?!)", re.IGNORECASE)

    def found(self, sentence):
        return self.form.findall(self.right.sub(" ", sentence))


def banned_words():
    text = pathlib.Path("docs/glossary.md").read_text()
    table = re.search(r"^## Words that are not used\n.*?\n\| --- .*?\n(.*?)(?:\n\n|\Z)", text, re.MULTILINE | re.DOTALL)
    if not table:
        sys.exit("docs/glossary.md has no table below the heading \"Words that are not used\"")
    return [Word(row) for row in table[1].splitlines()]


def plain(text):
    """The text without code, pictures, links' targets, addresses, HTML and emphasis: one space between words."""
    text = re.sub(r"`+[^`]*`+", "CODE", text)
    text = re.sub(r"!\[[^\]]*\]\([^)\s]*\)", " ", text)
    text = re.sub(r"\[[\w./-]+\.\w+\]\([^)\s]*\)", "CODE", text)  # a link that shows its file's name
    text = re.sub(r"\[([^\]]*)\]\([^)\s]*\)", r"\1", text)
    text = re.sub(r"<[^<>\n]{1,80}>|https?://\S+", "CODE", text)
    return re.sub(r"\s+", " ", text.replace("**", "").replace("*", " ")).strip()


def sentences(blocks):
    """From (line, text) yields (line, sentence), where line is the sentence's first line."""
    for line, text in blocks:
        start = 0
        for end in [*(each.end() for each in re.finditer(r"[.!?][)\"*]*\s+(?=[\"“*`(\[]*(?:[A-Z0-9`]|eyeray|lavapipe|gl(?:TF|slang|ibc)))", text)), len(text)]:
            sentence = plain(text[start:end])
            lead = len(text[start:end]) - len(text[start:end].lstrip())
            if re.search(r"[A-Za-z]", sentence):
                yield line + text.count("\n", 0, start + lead), sentence
            start = end


def document_blocks(text):
    """Paragraphs, items, headings and cells of tables, with their lines; blocks of code are left out."""
    text = re.sub(rf"{OFF[0]}.*?{OFF[1]}", lambda off: "\n" * off[0].count("\n"), text, flags=re.DOTALL)
    block, first, fence = [], 0, None
    for number, line in enumerate([*text.splitlines(), ""], 1):
        mark = re.match(r"\s*(```|~~~)", line)
        if fence or mark:
            fence = None if fence and mark else fence or mark[1]
            line = ""
        item = re.match(r"\s*(?:[-*+]|\d+\.) |#+ |\s*\||>", line)
        if block and (item or not line.strip()):
            yield first, "\n".join(block)
            block = []
        if re.match(r"\s*\|", line):
            for cell in re.split(r"(?<!\\)\|", line.strip().strip("|")):
                yield number, cell
        elif line.strip():
            if not block:
                first = number
            block.append(line[item.end():] if item else line)
            if line.startswith("#"):
                yield first, block.pop()


STRING = re.compile(r'"(?:\\.|[^"\\\n])*"')


def comment_blocks(text):
    """Comments of C++ and GLSL; lines of // that follow each other are one, as are those beside code."""
    block, first, column = [], 0, -1
    for number, line in enumerate([*text.splitlines(), ""], 1):
        bare = STRING.sub(lambda found: " " * len(found[0]), line)
        at = bare.find("//")
        if at >= 0 and block and at == column and (not bare[:at].strip() or bare[:at].strip() and beside):
            if not (beside and bare[:at].strip()):
                block.append(line[at:].lstrip("/< "))
                continue
        if block:
            yield first, "\n".join(block)
            block = []
        if at >= 0 and not line[at:].startswith(("// clang-format", "// NOLINT", "// @")):
            block, first, column, beside = [line[at:].lstrip("/< ")], number, at, bool(bare[:at].strip())


def findings_of(blocks, words, comment=False):
    """(line, habit, sentence, cure) of each habit found."""
    blocks = list(blocks)
    if comment:
        for line, text in blocks:
            begin = plain(text)
            if re.match(r"[Oo]f\b", begin):
                yield line, "H2", begin, ""
            elif HEADLESS_COMMENT.match(begin) and not begin.rstrip().endswith("?"):
                yield line, "H1", begin, ""
    for line, sentence in sentences(blocks):
        if not sentence.endswith("?"):
            for _ in HEADLESS.findall(sentence)[1 if comment and sentence.startswith("What") else 0:]:
                yield line, "H1", sentence, ""
        if FRONTED.match(sentence) and not (comment and sentence.startswith("Of ")) or INVERTED.search(sentence):
            yield line, "H3", sentence, ""
        for word in words:
            for form in word.found(sentence):
                yield line, "H4", sentence, f"\"{form}\": write {word.cure}"
        if len(re.findall(r"[\w’'./·-]*\w[\w’'./·-]*", sentence)) > MOST_WORDS:
            yield line, "long", sentence, ""


def files():
    for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md"):
        yield pathlib.Path(name)
    yield from sorted(pathlib.Path("docs").rglob("*.md"))
    for folder in CODE:
        for each in sorted(pathlib.Path(folder).rglob("*")):
            if each.suffix in (".cpp", ".hpp", ".h", ".glsl") and each.is_file():
                yield each


def findings():
    """The findings of each file with prose."""
    words, found = banned_words(), {}
    for path in files():
        if not path.exists():
            continue
        text = path.read_text(errors="replace")
        if OFF[0] in text and path.suffix == ".md" and path.name != "CONTRIBUTING.md":
            sys.exit(f"{path}: {OFF[0]} is for the bad examples of CONTRIBUTING.md alone")
        comment = path.suffix != ".md"
        found[str(path)] = list(findings_of((comment_blocks if comment else document_blocks)(text), words, comment))
    return found


def counts_of(found):
    return {habit: sum(each[1] == habit for each in found) for habit in HABITS}


def show(path, line, habit, sentence, cure):
    name, usual = HABITS[habit]
    sentence = sentence if len(sentence) < 400 else sentence[:400] + " …"
    return f"{path}:{line}: {habit}, {name}: \"{sentence}\"\n  {cure or usual}"


def recorded():
    rows = [line.split() for line in RECORD.read_text().splitlines() if line and not line.startswith("#")]
    return {path: dict(zip(HABITS, map(int, counts))) for path, *counts in rows}


def record(counts):
    lines = [f"{path} {' '.join(map(str, each.values()))}" for path, each in counts.items() if any(each.values())]
    RECORD.write_text(f"# Findings of prose.py, file by file: {', '.join(HABITS)}. They may only fall.\n" + "\n".join(lines) + "\n")


def risen(counts, allowed):
    """(path, habit) of each count that rose. A new file may take over the counts that other files lost, as when a page is split."""
    zero, new = dict.fromkeys(HABITS, 0), {path for path in counts if path not in allowed}
    rose = [(path, habit) for path in counts if path not in new for habit in HABITS if counts[path][habit] > allowed[path][habit]]
    for habit in HABITS:
        lost = sum(max(0, allowed[path][habit] - counts.get(path, zero)[habit]) for path in allowed)
        if sum(counts[path][habit] for path in new) > lost:
            rose += [(path, habit) for path in new if counts[path][habit]]
    return rose


def lines_changed(path):
    """The lines of a file that differ from the last commit, where there is one."""
    diff = subprocess.run(["git", "diff", "-U0", "HEAD", "--", path], capture_output=True, text=True).stdout
    spans = re.findall(r"^@@ -\S+ \+(\d+)(?:,(\d+))? @@", diff, re.MULTILINE)
    return {line for first, count in spans for line in range(int(first), int(first) + int(count or 1))}


def help_texts(eyeray, command=()):
    """(command, text) of --help, of each command and those below it."""
    text = subprocess.run([eyeray, *command, "--help"], capture_output=True, text=True, check=True).stdout
    yield " ".join(["eyeray", *command, "--help"]), text
    if "\nSubcommands:" in text:
        for names in re.findall(r"^  ([a-z]+(?:, [a-z]+)*)  ", text.split("\nSubcommands:")[1].split("\n\n")[0], re.MULTILINE):
            yield from help_texts(eyeray, (*command, names.split(", ")[0]))


def without_allowance(eyeray):
    """The findings in messages and --help, which have no allowance."""
    words, wrong = banned_words(), []
    if MESSAGES.exists():
        for number, line in enumerate(MESSAGES.read_text().splitlines(), 1):
            source, _, text = line.partition(": ")
            if line.strip() and not line.startswith("#"):
                text = text if "/" in source and " " not in source else line
                # A line that begins with spaces shows a command.
                blocks = [(number, each) for each in text.split("\\n") if not each.startswith("  ")]
                wrong += [show(MESSAGES, number, *each[1:]) for each in findings_of(blocks, words)]
    for command, text in help_texts(eyeray) if eyeray else ():
        # Each option is a block: its names, then two spaces or more and its description, which goes on below.
        blocks = re.split(r"\n(?= {0,6}\S)|\n\s*\n|(?<=\S)   *(?=[A-Za-z])", text)
        wrong += [show(command, 1, *each[1:]) for each in findings_of([(1, block) for block in blocks], words)]
    return list(dict.fromkeys(wrong))


def main():
    arguments = sys.argv[1:]
    if "--list" in arguments:
        found, names = findings(), arguments[arguments.index("--list") + 1:]
        sys.exit("\n".join(show(path, *each) for path in names for each in found[path]) or 0)
    eyeray = next((each for each in arguments if not each.startswith("--")), None)
    found = findings()
    counts = {path: counts_of(each) for path, each in found.items()}
    if not RECORD.exists() and "--bless" not in arguments:
        sys.exit(f"there is no {RECORD}: --bless makes it")
    allowed = recorded() if RECORD.exists() else counts
    rose, wrong = risen(counts, allowed), without_allowance(eyeray)
    for path, habit in rose:
        some = [each for each in found[path] if each[1] == habit]
        changed = lines_changed(path)
        shown = [each for each in some if each[0] in changed] or some[:MOST_SHOWN]
        wrong += [show(path, *each) for each in shown]
        if len(shown) < len(some):
            wrong.append(f"{path}: {len(some) - len(shown)} more of {habit}: --list {path} prints them")
        before = allowed.get(path, {}).get(habit, 0)
        wrong.append(f"{path}: {habit} rose from {before} to {counts[path][habit]}; rewrite one of these sentences for each")
    if "--bless" in arguments and not rose:
        record(counts)
    total = {habit: sum(each[habit] for each in counts.values()) for habit in HABITS}
    if "--bless" not in arguments and any(counts.get(path, {}).get(habit, 0) < each[habit] for path, each in allowed.items() for habit in HABITS):
        print("some counts have fallen: record that by --bless")
    print(f"{len(counts)} files: " + ", ".join(f"{habit} {total[habit]}" for habit in HABITS))
    sys.exit("\n".join(wrong) or 0)


if __name__ == "__main__":
    main()
