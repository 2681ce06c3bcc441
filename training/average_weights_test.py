#!/usr/bin/env python3
"""Tests of average_weights.py."""

import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import average_weights as weights

SCRIPT = Path(__file__).with_name("average_weights.py")


class InFolder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, name, tensors, metadata=None):
        path = Path(self.folder.name) / name
        weights.write_weights(path, metadata or {"network.size": "nano"}, tensors)
        return str(path)


class Averaging(InFolder):
    def run_script(self, *arguments):
        output = Path(self.folder.name) / "out.safetensors"
        done = subprocess.run(
            [sys.executable, SCRIPT, *arguments, "-o", output], capture_output=True, text=True
        )
        return done, output

    def test_mixes_by_share(self):
        a = {"x": np.float32([[1, 2]]), "y": np.float16([8])}
        b = {"x": np.float32([[5, 2]]), "y": np.float16([0])}
        done, output = self.run_script(
            self.write("a", a), self.write("b", b), "--share", "0.25"
        )
        self.assertEqual(done.stderr, "")
        metadata, mixed = weights.tensors_of(output)
        self.assertEqual(metadata, {"network.size": "nano"})
        np.testing.assert_array_equal(mixed["x"], np.float32([[2, 2]]))
        np.testing.assert_array_equal(mixed["y"], np.float16([6]))
        self.assertEqual(mixed["y"].dtype, np.float16)

    def test_errors_name_the_tensor(self):
        a = self.write("a", {"x": np.float32([1])})
        for other in ({"x": np.float32([1, 2])}, {"z": np.float32([1])}):
            done, output = self.run_script(a, self.write("b", other))
            self.assertEqual(done.returncode, 1)
            self.assertIn("x: (1,) in one file", done.stderr)
            self.assertFalse(output.exists())
        more = self.write("b", {"x": np.float32([1]), "z": np.float32([1])})
        self.assertIn("z: is only in the second", self.run_script(a, more)[0].stderr)

    def test_errors_of_files(self):
        a = self.write("a", {"x": np.float32([1])})
        other = self.write("b", {"x": np.float32([1])}, {"network.size": "r18"})
        self.assertIn("different networks", self.run_script(a, other)[0].stderr)
        self.assertIn("allowed: 0 to 1", self.run_script(a, a, "--share", "2")[0].stderr)
        unwritable = str(Path(self.folder.name) / "none" / "out")
        done = subprocess.run(
            [sys.executable, SCRIPT, a, a, "-o", unwritable], capture_output=True, text=True
        )
        self.assertIn("cannot be written", done.stderr)

    def test_keeps_an_existing_file(self):
        a = self.write("a", {"x": np.float32([1])})
        done, output = self.run_script(a, a)
        self.assertEqual(done.returncode, 0)
        before = output.read_bytes()
        self.assertIn("exists already", self.run_script(a, a)[0].stderr)
        self.assertEqual(output.read_bytes(), before)

    def test_damaged_files_give_one_sentence(self):
        a = self.write("a", {"x": np.float32([1, 2])})
        content = Path(a).read_bytes()
        damaged = Path(self.folder.name) / "damaged"
        cases = [content[:length] for length in range(0, len(content), 7)]
        cases.append(content.replace(b"[2]", b"[9]"))
        cases.append(content.replace(b"dtype", b"dtypo"))
        cases.append(struct.pack("<Q", 2) + b"[]")
        for case in cases:
            damaged.write_bytes(case)
            done, output = self.run_script(a, damaged)
            self.assertEqual(done.returncode, 1)
            self.assertIn("cannot be read", done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)
            self.assertFalse(output.exists())


class ShiftedScores(InFolder):
    def test_adds_to_the_bias_of_the_class(self):
        given = self.write(
            "a", {"mask_head.conv_cls.bias": np.float16([-3, -4]), "x": np.float16([1])},
            {"classes": "person,agv"},
        )
        output = Path(self.folder.name) / "shifted.safetensors"
        script = SCRIPT.with_name("shift_scores.py")
        for name, code in (("cat", 1), ("agv", 0)):
            done = subprocess.run(
                [sys.executable, script, given, name, "-0.5", "-o", output],
                capture_output=True, text=True,
            )
            self.assertEqual(done.returncode, code, done.stderr)
        metadata, tensors = weights.tensors_of(output)
        self.assertEqual(metadata, {"classes": "person,agv"})
        np.testing.assert_array_equal(tensors["mask_head.conv_cls.bias"], np.float16([-3, -4.5]))
        np.testing.assert_array_equal(tensors["x"], np.float16([1]))


if __name__ == "__main__":
    unittest.main()
