#!/usr/bin/env python3
"""Tests of mark_unlabelled.py without its detector's weights."""

import unittest

import numpy as np

import mark_unlabelled as mark


def outputs_of(cell, score, distances):
    """What the detector gives for one object in a cell of stride 8."""
    outputs = []
    for stride in mark.STRIDES:
        cells = (mark.SIDE // stride) ** 2
        classes = np.zeros((1, cells, 80), np.float32)
        bins = np.zeros((1, cells, 4 * mark.BINS), np.float32)
        if stride == 8:
            classes[0, cell, 0] = score
            for side, distance in enumerate(distances):
                bins[0, cell, side * mark.BINS + distance] = 50  # nearly all of the weight
        outputs += [classes, bins]
    return outputs


class Decoding(unittest.TestCase):
    def test_box_of_a_cell(self):
        boxes, scores = mark.decoded(outputs_of(2 * 52 + 5, 0.8, (1, 2, 3, 4)), 0.4)
        np.testing.assert_allclose(boxes, [[44 - 8, 20 - 16, 32, 48]], atol=1e-3)
        np.testing.assert_allclose(scores, [0.8])

    def test_confidence(self):
        self.assertEqual(mark.decoded(outputs_of(7, 0.39, (1, 1, 1, 1)), 0.4), ([], []))


class Marking(unittest.TestCase):
    def test_only_what_no_annotation_explains(self):
        coco = {
            "images": [{"id": 1, "source": "street"}, {"id": 2, "source": "room"}],
            "annotations": [{"id": 7, "image_id": 1, "category_id": 1, "bbox": [10, 10, 20, 40]}],
            "categories": [{"id": 1, "name": "person"}],
        }
        found = {
            1: [[12, 8, 20, 40],  # the annotated person
                [14, 12, 6, 8],  # its head
                [60, 10, 20, 40]],  # another
            2: [],
        }
        self.assertEqual(mark.add_unlabelled(coco, lambda image: found[image["id"]]), {"street": 1})
        self.assertEqual(len(coco["annotations"]), 2)
        added = coco["annotations"][1]
        self.assertEqual((added["id"], added["image_id"], added["iscrowd"]), (8, 1, 1))
        self.assertEqual((added["bbox"], added["area"]), ([60, 10, 20, 40], 800))


if __name__ == "__main__":
    unittest.main()
