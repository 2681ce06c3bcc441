#!/usr/bin/env python3
"""Checks comments, string literals and identifiers of the source code for former words.

usage: words_test.py SOURCE_DIR

Exits with 1 and one line per fault.
"""
import re
import sys
from pathlib import Path

from words import check_names, check_words

FOLDERS = ("mms", "apps", "interfaces", "benchmarks", "examples", "packaging", "cmake",
           "viewer/src")
C_LIKE = (".cpp", ".hpp", ".ts")
WITH_HASH = (".sh", ".cmake", ".py", ".yaml", ".msg", ".in", "CMakeLists.txt", ".bash-completion")
# Lines that read or name former settings, options and commands.
FORMER = re.compile(r"former|Former|is now called|residue|--ride|--bytes")

# String literals; comments, consecutive ones of whole lines as one.
C_TEXT = re.compile(r'''R"(?P<end>[^()\s]*)\(.*?\)(?P=end)"|"(?:\\.|[^"\\\n])*"|/\*.*?\*/'''
                    r"""|//[^\n]*(?:\n[ \t]*//[^\n]*)*|'(?:\\.|[^'\\\n]){2,}'|`[^`]*`""", re.S)
HASH_TEXT = re.compile(r"""(?m)(?:^|(?<=\s))#[^\n]*(?:\n[ \t]*#[^\n]*)*|"[^"\n]*"|'[^'\n]*'""")
ADJACENT_STRINGS = re.compile(r'"\s*\n\s*"')


def texts_of(source, is_c):
    """Comments and string literals as (line number, text); adjacent strings are one."""
    if is_c:
        source = ADJACENT_STRINGS.sub("\n", source)
    for match in (C_TEXT if is_c else HASH_TEXT).finditer(source):
        if re.fullmatch(r"""["'`]\w*["'`]""", match[0]):  # a key or a former setting
            continue
        text = re.sub(r"\s*\n[\s/*#]*", " ", match[0].replace("\\n", " "))
        yield source.count("\n", 0, match.start()) + 1, text


def files(root):
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.is_file() and path.name.endswith(C_LIKE + WITH_HASH):
                yield path


def main(root):
    faults, count = [], 0
    for path in files(root):
        count += 1
        name = str(path.relative_to(root))
        lines = path.read_text(encoding="utf-8").splitlines()
        source = "\n".join("" if FORMER.search(line) else line for line in lines)
        check_words(name, texts_of(source, path.name.endswith(C_LIKE)), faults)
        check_names(name, enumerate(source.splitlines(), 1), faults)
    for fault in faults:
        print(fault)
    print(f"{count} files, {len(faults)} faults")
    return 1 if faults or count == 0 else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(Path(sys.argv[1]).resolve()))
