#!/usr/bin/env python3
"""Compares docs/dependencies.md with packages.txt, the copyright files of installed packages, the
libraries that the program loads, the packages of the viewer, and the SBOM.

usage: dependencies_test.py MMS SOURCE_DIR SBOM

Exits with 1 and one line per fault. What is not installed, or not of Debian, is not compared.
"""
import json
import re
import subprocess
import sys
from pathlib import Path

# What a Debian copyright file says of a license.
WORDS = {
    "Apache-2.0": "Apache", "Apache-2.0 WITH LLVM-exception": "LLVM|Apache",
    "BSD-2-Clause": "BSD-2|2-clause BSD|Redistribution and use",
    "BSD-3-Clause": "BSD|Redistribution and use", "BSL-1.0": "boost",
    "GPL-2.0-only": "GPL|General Public", "GPL-2.0-or-later": "GPL|General Public",
    "GPL-3.0-or-later WITH GCC-exception-3.1": "GPL|General Public", "HPND": "Permission to use",
    "LGPL-2.1-or-later": "LGPL|Lesser General Public",
    "MIT": "MIT|Expat|X11|Permission is hereby granted", "MPL-2.0": "MPL|Mozilla Public",
    "blessing": "public.domain", "bzip2-1.0.6": "BSD-variant|Julian Seward", "libpng-2.0": "libpng",
    "PSF-2.0": "PSF|Python Software Foundation|PYTHON SOFTWARE FOUNDATION",
}
# The compiler's own libraries.
OF_COMPILER = {"libc6", "libstdc++6", "libgcc-s1", "libgomp1", "libatomic1"}
# Sanitizers are not part of a program that is distributed.
OF_SANITIZERS = re.compile(r"lib(asan|ubsan|tsan|lsan)\d")


def output_of(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout


def tables_of(page):
    """Package -> license of each section."""
    tables = {}
    for line in page.splitlines():
        if line.startswith("## "):
            table = tables.setdefault(line[3:], {})
        row = re.fullmatch(r"\| ([a-z][a-z0-9+.-]+) \| ([^|]+) \| ([^|]+) \|", line)
        if row:
            table[row[1]] = row[2]
    return tables


def check_packages(listed, debian):
    for package in sorted(listed - debian):
        yield f"packages.txt has {package}, docs/dependencies.md does not"
    for package in sorted(debian - listed):
        yield f"docs/dependencies.md has {package}, packages.txt does not"


def check_licenses(debian):
    for package, license_name in debian.items():
        if license_name not in WORDS:
            yield f"{package}: '{license_name}' is not a license of this test"
            continue
        copyright_file = Path("/usr/share/doc", package, "copyright")
        if not copyright_file.is_file():
            continue
        text = copyright_file.read_text(encoding="utf-8", errors="replace")
        if not re.search(WORDS[license_name], text, re.I):
            yield f"{package}: nothing in {copyright_file} says {license_name}"


def sources_of(packages):
    """Source packages of the installed ones of the packages."""
    lines = output_of("dpkg-query", "-W", "-f", "${source:Package}\n", *packages)
    return set(lines.split())


def check_libraries(program, debian):
    """Each library that the program names belongs to a package, or one built from its source."""
    known = sources_of(debian)
    needed = re.findall(r"NEEDED.*\[(.+)\]", output_of("readelf", "-d", program))
    places = dict(re.findall(r"(\S+) => (\S+)", output_of("ldd", program)))
    for library in needed:
        place = str(Path(places.get(library, "/nowhere")).resolve())
        owner = output_of("dpkg-query", "-S", place).split(":")[0]
        if not owner or owner in OF_COMPILER or OF_SANITIZERS.match(owner):
            continue
        if not sources_of([owner]) <= known:
            yield f"{program} loads {library} of {owner}, which docs/dependencies.md does not name"


def check_viewer(source, npm):
    given = json.loads((source / "viewer/package.json").read_text())["dependencies"]
    lock = json.loads((source / "viewer/package-lock.json").read_text())["packages"]
    if set(given) != set(npm):
        yield f"the viewer's packages are {sorted(given)}, in docs/dependencies.md {sorted(npm)}"
    for name in given:
        license_name = lock[f"node_modules/{name}"]["license"]
        if npm.get(name) != license_name:
            yield f"{name}: the license is {license_name}, in docs/dependencies.md {npm.get(name)}"


def check_sbom(file, own, npm):
    bom = json.loads(file.read_text())
    if bom["bomFormat"] != "CycloneDX" or bom["specVersion"] != "1.5":
        yield f"{file} is not a CycloneDX 1.5 SBOM"
    found = {part["name"]: part for part in bom["components"]}
    if len(found) != len(bom["components"]):
        yield f"{file} has a component twice"
    for name, license_name in {**own, **npm}.items():
        installed = output_of("dpkg-query", "-W", "-f", "${Version}", name)
        if name not in found:
            if installed or name in npm:
                yield f"{file} has no {name}"
            continue
        if found[name]["licenses"] != [{"license": {"id": license_name}}]:
            yield f"{file}: {name} has another license than docs/dependencies.md"
        if installed and found[name]["version"] != installed:
            yield f"{file}: {name} has version {found[name]['version']}, installed is {installed}"
    for name in found.keys() - {**own, **npm}.keys():
        yield f"{file} has {name}, which is not in the program"


def main():
    program, source, sbom = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    tables = tables_of((source / "docs/dependencies.md").read_text())
    own = {**tables["In the program"], **tables["Required by them"]}
    npm = tables["In the viewer's page"]
    debian = {**own, **tables["For building and testing"]}
    listed = set(re.findall(r"(?m)^(?![#\[\s])(\S+)", (source / "packages.txt").read_text()))
    faults = [*check_packages(listed, debian.keys() - tables["Required by them"].keys()),
              *check_licenses(debian), *check_libraries(program, debian),
              *check_viewer(source, npm), *check_sbom(sbom, own, npm)]
    for fault in faults:
        print(fault)
    print(f"{len(debian)} Debian packages, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
