#!/usr/bin/env python3
"""Checks README and docs: runs their commands and checks links, words, lines and files.

usage: commands_test.py PROGRAM SOURCE_DIR

Every ```sh block is run by bash in a temporary folder of its page, with PROGRAM first in the PATH.
A block after a comment `<!-- not run: REASON -->` is not run; its options are still compared with
the program's help, its presets, scripts and tests with the repository. Exits with 1 and one line per fault.
"""
import json
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from words import check_words

MAX_LINE = 100  # characters of a line of text
MAX_WORDS = 25  # of a sentence
BLOCK_TIMEOUT = 300  # seconds
ROOT_PAGES = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")
GENERATED = ("cli.md", "configuration.md")
SOURCE_FOLDERS = ("mms", "apps", "interfaces", "benchmarks", "examples", "tests", "config",
                  "weights", "docs", "viewer", "packaging", "cmake")


class Page:
    """A page, split into code blocks and lines of text."""

    def __init__(self, path):
        self.path = path
        self.blocks = []  # (line number, language, text, reason it is not run or None)
        self.text = []  # (line number, line) outside of code blocks
        fence, language, start, code, comment = None, "", 0, [], None
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if fence is None and (match := re.match(r"(```+)(\w*)", line)):
                fence, language, start, code = match[1], match[2], number, []
            elif fence is not None and line.startswith(fence):
                self.blocks.append((start, language, "\n".join(code), comment))
                fence, comment = None, None
            elif fence is not None:
                code.append(line)
            else:
                self.text.append((number, line))
                if match := re.match(r"<!--\s*not run: (.+?)\s*-->", line):
                    comment = match[1]
                elif line.strip():
                    comment = None

    def prose(self):
        """Paragraphs and list items as (line number, text), without tables, headings, comments."""
        parts, number, words = [], 0, []

        def finish():
            if words:
                parts.append((number, " ".join(words)))
            words.clear()

        for at, line in self.text:
            bare = line.strip()
            item = re.match(r"(?:[-*]|\d+\.)\s+", bare)
            if not bare or bare[0] in "|#<!>" or item:
                finish()
            if not bare or bare[0] in "|#<!>":
                continue
            if not words:
                number = at
            words.append(bare[item.end():] if item else bare)
        finish()
        return parts


def plain(text):
    """Text with code spans as one word and links as their label."""
    text = re.sub(r"`[^`]*`", "CODE", text)
    return re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)


def check_lines(name, page, faults):
    for number, line in page.text:
        bare = re.sub(r"\]\([^)]*\)", "]", line)
        exempt = line.startswith(("|", "!", "<!--"))
        if not exempt and len(bare) > MAX_LINE:
            faults.append(f"{name}:{number}: {len(bare)} characters, at most {MAX_LINE}")


def check_sentences(name, page, faults):
    for number, text in page.prose():
        for sentence in re.split(r"(?<=[.!?:;])[)\"*]*\s+", plain(text)):
            words = re.findall(r"[^\s()]*\w[^\s()]*", sentence)
            if len(words) > MAX_WORDS:
                faults.append(f"{name}:{number}: {len(words)} words in '{sentence[:50]}...'")


def anchors(page):
    names = set()
    for _, line in page.text:
        if match := re.match(r"#+\s+(.*)", line):
            heading = re.sub(r"[^\w\- ]", "", plain(match[1]).replace("CODE", "").lower()
                             if "`" not in match[1] else match[1].replace("`", "").lower())
            names.add(heading.strip().replace(" ", "-"))
    return names


def links(page):
    for number, line in page.text:
        for match in re.finditer(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", line)):
            if not re.match(r"[a-z]+:", match[1]):
                yield number, match[1]


def check_links(root, pages, faults):
    """Relative links resolve, and README links to every page, directly or not."""
    targets = {path: set() for path in pages}
    for path, page in pages.items():
        for number, link in links(page):
            file, _, anchor = link.partition("#")
            target = (path.parent / file).resolve() if file else path
            if not target.exists():
                faults.append(f"{path.relative_to(root)}:{number}: link {link} has no target")
            elif target in pages:
                targets[path].add(target)
                if anchor and anchor not in anchors(pages[target]):
                    faults.append(f"{path.relative_to(root)}:{number}: no heading for {link}")
    reached, queue = set(), [root / "README.md"]
    while queue:
        path = queue.pop()
        if path not in reached:
            reached.add(path)
            queue += targets[path]
    for path in sorted(set(pages) - reached):
        faults.append(f"{path.relative_to(root)}: no link from README leads here")


def check_files(root, page, name, faults):
    """Files of the repository that the text names exist, with or without extension."""
    for number, line in page.text:
        for span in re.findall(r"`([\w.-]+/[\w./-]*\w)`", line):
            if span.split("/")[0] not in SOURCE_FOLDERS:
                continue
            if not (root / span).exists() and not list(root.glob(span + ".*")):
                faults.append(f"{name}:{number}: the repository has no {span}")


def check_build(root, page, name, faults):
    """Presets, scripts and test programs in shell blocks exist."""
    presets = json.loads((root / "CMakePresets.json").read_text(encoding="utf-8"))
    names = {preset["name"] for preset in presets["configurePresets"]}
    for number, language, text, _ in page.blocks:
        if language != "sh":
            continue
        folders = set(re.findall(r"-B build/(\w+)", text))
        for preset in re.findall(r"(?:--preset |\bbuild/)(\w+)", text):
            if preset not in names | folders:
                faults.append(f"{name}:{number}: there is no preset {preset}")
        for script in re.findall(r"(?<!\S)(?:\./)?([\w./-]+\.(?:sh|py))\b", text):
            if not (root / script).exists():
                faults.append(f"{name}:{number}: the repository has no {script}")
        for test in re.findall(r"\b(\w+)_test\b(?!\.)", text):
            if not (root / "tests" / test).is_dir():
                faults.append(f"{name}:{number}: there are no tests/{test}")


class Help:
    """Help of the program and its commands."""

    def __init__(self, program):
        self.program = program
        self.texts = {}
        self.visit(())

    def visit(self, command):
        result = subprocess.run([self.program, *command, "--help"], capture_output=True, text=True,
                                check=False)
        if result.returncode != 0:
            if command == ("train",):  # mms-torch is not part of every build
                return
            sys.exit(f"mms {' '.join(command)} --help: {result.stderr}")
        self.texts[command] = result.stdout
        below = re.search(r"^Subcommands:\n((?:[ \n].*\n?)*)", result.stdout, re.M)
        for name in re.findall(r"^  ([a-z][\w-]*)", below[1] if below else "", re.M):
            self.visit((*command, name))

    def check(self, where, call, faults):
        """`call`: the arguments after "mms" on a command line."""
        words = call.split()
        if not words or not re.fullmatch(r"[a-z][\w-]*", words[0]):
            return
        if words[0] == "train":
            return
        command = ()
        while words and (*command, words[0]) in self.texts:
            command = (*command, words.pop(0))
        if not command:
            faults.append(f"{where}: there is no command 'mms {words[0]}'")
            return
        for option in re.findall(r"(?<=\s)--[a-z][\w-]*", " " + " ".join(words)):
            if not re.search(re.escape(option) + r"(?![\w-])", self.texts[command]):
                faults.append(f"{where}: mms {' '.join(command)} has no option {option}")


def calls(text):
    """Calls of mms in a shell text, each without the program's name."""
    text = re.sub(r"\\\n", " ", text)
    for line in text.splitlines():
        line = re.sub(r"(^|\s)#.*", "", line)
        for part in re.split(r"[;|&]+(?=(?:[^\"]*\"[^\"]*\")*[^\"]*$)", line):
            if match := re.match(r"\s*(?:\S*/)?mms\s+(.*)", part):
                yield match[1]


def check_calls(name, page, program_help, faults):
    for number, language, text, _ in page.blocks:
        if language == "sh":
            for call in calls(text):
                program_help.check(f"{name}:{number}", call, faults)
    for number, line in page.text:
        for span in re.findall(r"`(mms [^`]+)`", line):
            for call in calls(span):
                program_help.check(f"{name}:{number}", call, faults)


class Settings:
    """The settings of the program, and checks of texts that name them."""

    def __init__(self, program):
        self.program = program
        dump = subprocess.run([program, "config", "dump"], capture_output=True, text=True,
                              check=True).stdout
        self.names, path = set(), []
        for line in dump.splitlines():
            if match := re.match(r"( *)([a-z0-9_]+):", line):
                path = [*path[:len(match[1]) // 2], match[2]]
                self.names.add(".".join(path))
        self.groups = {name for name in self.names if "." not in name}

    def check_yaml(self, where, text, faults):
        """A settings file; one with a placeholder, as in `long_side: N`, cannot be checked."""
        first = re.match(r"([a-z_]+):", text)
        if not first or first[1] not in self.groups or re.search(r"\b[A-Z]\b", text):
            return
        with tempfile.NamedTemporaryFile("w", suffix=".yaml") as file:
            file.write(text + "\n")
            file.flush()
            result = subprocess.run([self.program, "config", "check", file.name],
                                    capture_output=True, text=True, check=False)
        if result.returncode != 0 or "warning" in result.stderr:
            faults.append(f"{where}: {(result.stdout + result.stderr).strip()}")

    def check_page(self, name, page, faults):
        for number, language, text, _ in page.blocks:
            if language == "yaml":
                self.check_yaml(f"{name}:{number}", text, faults)
        for number, line in page.text:
            for span in re.findall(r"`([^`]+)`", line):
                where = f"{name}:{number}"
                dotted = re.fullmatch(r"([a-z_]+)\.[a-z0-9_.]+", span)
                is_file = span.endswith((".tum", ".ply", ".pcd", ".csv", ".txt"))
                if dotted and dotted[1] in self.groups and not is_file and span not in self.names:
                    faults.append(f"{where}: there is no setting {span}")
                self.check_yaml(where, span, faults)


def commands_of(text):
    joined = re.sub(r"\\\n", " ", text)
    return [line for line in joined.splitlines() if line.strip() and line.strip()[0] != "#"]


def run_page(name, page, program, faults):
    """Runs the page's commands.

    Returns the numbers of commands run and marked.
    """
    ran, marked = 0, 0
    environment = dict(os.environ, PATH=f"{Path(program).parent}:{os.environ['PATH']}")
    with tempfile.TemporaryDirectory(prefix="mms_docs_") as folder:
        for number, language, text, reason in page.blocks:
            if language != "sh":
                continue
            count = len(commands_of(text))
            if reason is not None:
                marked += count
                continue
            ran += count
            try:
                result = subprocess.run(["bash", "-euo", "pipefail", "-c", text], cwd=folder,
                                        env=environment, capture_output=True, text=True,
                                        stdin=subprocess.DEVNULL, timeout=BLOCK_TIMEOUT,
                                        check=False)
            except subprocess.TimeoutExpired:
                faults.append(f"{name}:{number}: takes more than {BLOCK_TIMEOUT} s")
                continue
            if result.returncode != 0:
                output = (result.stdout + result.stderr).strip()[-600:]
                faults.append(f"{name}:{number}: exit code {result.returncode}: {output}")
    return ran, marked


def check_generated(root, program, faults):
    with tempfile.TemporaryDirectory(prefix="mms_docs_") as folder:
        subprocess.run([root / "docs/generate.sh", program, folder], check=True)
        for name in GENERATED:
            fresh = (Path(folder) / name).read_text(encoding="utf-8")
            if fresh != (root / "docs" / name).read_text(encoding="utf-8"):
                faults.append(f"docs/{name}: differs from the program: run docs/generate.sh")


def check_architecture(root, faults):
    """The tables of modules and folders are those of the architecture test."""
    rules = (root / "tests/architecture/include_rules.cpp").read_text(encoding="utf-8")
    page = (root / "docs/architecture.md").read_text(encoding="utf-8")
    split = rules.index("rules.folders = {")
    for part, row in ((rules[:split], "| `{}` | {} |"), (rules[split:], "| {} | {} |")):
        for name, targets in re.findall(r'\{"(\w+)",\s*\{([^{}]*)\}\}', part):
            names = [target or "." for target in re.findall(r'"([^"]*)"', targets)]
            shown = "apps/mms" if name == "apps" else name
            line = row.format(shown, ", ".join(names) or "-")
            if line not in page:
                faults.append(f"docs/architecture.md: the table has to have the row {line}")


def check_page(root, path, page, program, faults):
    """`program`: its help and its settings."""
    program_help, settings = program
    name = str(path.relative_to(root))
    check_lines(name, page, faults)
    check_files(root, page, name, faults)
    check_build(root, page, name, faults)
    if path.name == "CHANGELOG.md":  # has the former names
        return
    check_calls(name, page, program_help, faults)
    settings.check_page(name, page, faults)
    if path.name in GENERATED:  # the program's output is checked
        return
    check_words(name, enumerate(path.read_text(encoding="utf-8").splitlines(), 1), faults)
    check_sentences(name, page, faults)
    first = page.prose()[:1]
    if path.parent == root / "docs" and not (first and first[0][1].startswith("For ")):
        faults.append(f"{name}: the first paragraph has to say who needs the page: 'For ...'")


def check_output(program, program_help, faults):
    """Words of the help of every command, of all settings, and of a short run."""
    for command, text in program_help.texts.items():
        name = " ".join(("mms", *command, "--help"))
        check_words(name, enumerate(text.splitlines(), 1), faults)
    run = ("run", "sim:warehouse_loop", "--frames", "3", "--segmenter", "masks", "-o", "out")
    with tempfile.TemporaryDirectory(prefix="mms_docs_") as folder:
        for arguments in (("config", "dump"), ("simulate", "crowd", "--print"), run):
            result = subprocess.run([program, *arguments], cwd=folder, capture_output=True,
                                    text=True, check=True)
            name = " ".join(("mms", *arguments))
            lines = (result.stdout + result.stderr).splitlines()
            check_words(name, enumerate(lines, 1), faults)


def main(program, root):
    start, faults = time.monotonic(), []
    program_help = Help(program)
    paths = [*(root / name for name in ROOT_PAGES), *sorted((root / "docs").glob("*.md"))]
    pages = {path: Page(path) for path in paths}
    check_links(root, pages, faults)
    settings = Settings(program)
    for path, page in pages.items():
        check_page(root, path, page, (program_help, settings), faults)
    check_output(program, program_help, faults)
    check_generated(root, program, faults)
    check_architecture(root, faults)
    ran, marked = 0, 0
    for path, page in pages.items():
        counts = run_page(str(path.relative_to(root)), page, program, faults)
        ran, marked = ran + counts[0], marked + counts[1]
    if ran == 0:
        faults.append("no command was run")
    for fault in faults:
        print(fault)
    print(f"{len(pages)} pages, {ran} commands run, {marked} marked as not run, "
          f"{len(faults)} faults, {time.monotonic() - start:.0f} s")
    return 1 if faults else 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(os.path.realpath(sys.argv[1]), Path(sys.argv[2]).resolve()))
