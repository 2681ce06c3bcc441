#!/usr/bin/env python3
"""Checks that the tests exist that docs/formats.md names for the layouts of recordings.

usage: layouts_test.py SOURCE_DIR
"""

import re
import sys
from pathlib import Path

source = Path(sys.argv[1])
text = (source / "docs/formats.md").read_text()
table = text.split("### All layouts, and their tests")[1].split("\n## ")[0]
named = re.findall(r"`(\w+\.\w+)` \|$", table, re.MULTILINE)
code = "".join(path.read_text() for path in (source / "tests").glob("*/*_test.cpp"))
tests = {f"{suite}.{name}" for suite, name in re.findall(r"^TEST\w*\((\w+),\s*(\w+)\)", code, re.M)}
missing = [name for name in named if name not in tests]
assert len(named) >= 25, f"{len(named)} layouts, expected at least 25"
assert not missing, f"docs/formats.md names tests that do not exist: {', '.join(missing)}"
print(f"{len(named)} layouts, all with a test")
