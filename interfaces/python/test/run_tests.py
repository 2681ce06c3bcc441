#!/usr/bin/env python3
"""Runs the tests of the Python module: run_tests.py FOLDER_OF_MODULE PROGRAM. Exits with 77, which
ctest counts as skipped, where something is missing."""
import os
import sys
from pathlib import Path

try:
    import matplotlib  # noqa: F401, for the example
    import pytest
except ImportError as missing:
    print(f"skipped: {missing} (python3-pytest and python3-matplotlib are needed)")
    sys.exit(77)

os.environ["PYTHONPATH"] = sys.argv[1]
os.environ["MMS"] = sys.argv[2]
sys.path.insert(0, sys.argv[1])
sys.exit(pytest.main(["-q", "-p", "no:cacheprovider", str(Path(__file__).parent), *sys.argv[3:]]))
