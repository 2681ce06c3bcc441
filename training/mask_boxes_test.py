#!/usr/bin/env python3
"""Tests of mask_boxes.py; with the program and weights, also of the masks it gives.

usage: mask_boxes_test.py [MMS WEIGHTS]
"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import mask_boxes
from collect_data import decode_rle, encode_rle

PROGRAM = sys.argv[1:3]


class Windows(unittest.TestCase):
    def test_the_box_is_in_the_middle(self):
        left, top, right, bottom = mask_boxes.window((300, 200, 20, 78), 2, (640, 480))
        self.assertEqual((left, right), (310 - 104, 310 + 104))
        self.assertEqual((top, bottom), (239 - 78, 239 + 78))

    def test_it_ends_at_the_image(self):
        self.assertEqual(mask_boxes.window((0, 0, 400, 300), 2, (500, 320)), (0, 0, 500, 320))


    def test_boxes_that_cannot_be_used(self):
        image = {"width": 100, "height": 80}
        self.assertTrue(mask_boxes.is_usable((0, 0, 100.4, 80), image))
        small, outside, empty = (0, 0, 30, 10), (90, 10, 30, 30), (5, 5, 0, 30)
        for box in (small, outside, empty, (float("nan"), 0, 30, 30)):
            self.assertFalse(mask_boxes.is_usable(box, image))


class Masks(unittest.TestCase):
    shape = (100, 120)

    def result(self, cut, rows, columns, category=1):
        """A result of what was cut out, of twice its size, from rows and columns of the image."""
        mask = np.zeros((2 * (cut[3] - cut[1]), 2 * (cut[2] - cut[0])), bool)
        rows = slice(2 * (rows[0] - cut[1]), 2 * (rows[1] - cut[1]))
        mask[rows, 2 * (columns[0] - cut[0]) : 2 * (columns[1] - cut[0])] = True
        return {"category_id": category, "segmentation": encode_rle(mask)}

    def test_the_mask_that_fills_the_box_is_taken(self):
        cut, box = (20, 10, 100, 70), (40, 20, 20, 40)
        wrong = self.result(cut, (20, 40), (40, 60))
        right = self.result(cut, (20, 60), (40, 60))
        vehicle = self.result(cut, (20, 60), (40, 60), category=2)
        filled, mask, left, top = mask_boxes.best_mask([vehicle, wrong, right], cut, box, self.shape)
        self.assertEqual((filled, left, top), (1.0, 40, 20))
        whole = mask_boxes.whole(mask, left, top, self.shape)
        expected = np.zeros(self.shape, bool)
        expected[20:60, 40:60] = True
        np.testing.assert_array_equal(whole, expected)

    def test_what_is_beyond_the_box_is_cut(self):
        cut, box = (20, 10, 100, 70), (40, 20, 20, 40)
        spilled = self.result(cut, (12, 66), (30, 90))
        filled, mask, _, _ = mask_boxes.best_mask([spilled], cut, box, self.shape)
        self.assertEqual((filled, mask.shape, mask.all()), (1.0, (40, 20), True))

    def test_both_must_fill_the_box_and_agree(self):
        body = np.zeros((40, 20), bool)
        body[:, 5:15] = True
        other = np.zeros((40, 20), bool)
        other[:, 10:20] = True
        mask = mask_boxes.agreed_mask([(0.9, body, 1, 2), (0.8, body, 1, 2)])
        self.assertEqual(mask[1:], (1, 2))
        self.assertIsNone(mask_boxes.agreed_mask([(0.9, body, 1, 2), (0.7, body, 1, 2)]))
        self.assertIsNone(mask_boxes.agreed_mask([(0.9, body, 1, 2), (0.9, other, 1, 2)]))
        self.assertIsNone(mask_boxes.agreed_mask([(0.9, body, 1, 2), None]))


@unittest.skipUnless(PROGRAM, "needs the program and weights")
class OfTheNetwork(unittest.TestCase):
    def test_simulated_people(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            subprocess.run(
                [PROGRAM[0], "simulate", "training-set", "--images", "30", "--seed", "5",
                 "-o", folder / "set"], check=True, capture_output=True)
            content = json.loads((folder / "set" / "annotations.json").read_text())
            person = next(c["id"] for c in content["categories"] if c["name"] == "person")
            truth = {}
            for entry in content["annotations"]:
                if entry["category_id"] == person and not entry.get("iscrowd"):
                    truth[entry["id"]] = entry["segmentation"]
                    entry.update(segmentation=[], box_only=True)
            (folder / "boxes.json").write_text(json.dumps(content))
            command = [sys.executable, mask_boxes.__file__, folder / "boxes.json"]
            command += [folder / "set", PROGRAM[1], "-o", folder / "masks.json"]
            subprocess.run(command + ["--mms", PROGRAM[0]], check=True, capture_output=True)
            masked = json.loads((folder / "masks.json").read_text())
            overlaps = [
                mask_boxes.overlap(decode_rle(entry["segmentation"]), decode_rle(truth[entry["id"]]))
                for entry in masked["annotations"] if entry.get("mask_by_network")
            ]
            self.assertGreater(len(overlaps), len(truth) / 4)
            self.assertGreater(np.mean(overlaps), 0.6)
            again = subprocess.run(
                command + ["--mms", PROGRAM[0]], capture_output=True, text=True, check=False)
            self.assertNotEqual(again.returncode, 0)
            self.assertIn("exists already", again.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
