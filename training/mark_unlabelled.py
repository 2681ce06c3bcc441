#!/usr/bin/env python3
"""Finds people without annotation in a COCO file, with another detector.

NanoDet-m (Apache-2.0, trained on COCO; `nanodet_m.onnx` for 416x416 of the repository
hpc203/nanodet-opncv-dnn-cpp-python) detects people; it needs Debian's python3-opencv. Each one that
no annotation explains is added as a crowd: during training it counts neither as a person nor as
background.
"""

import argparse
import json
import sys
from pathlib import Path

import numpy as np

SIDE = 416  # of the detector's input [px]
STRIDES = (8, 16, 32)
BINS = 8  # of a distance to a side of the box
MEAN = np.array([103.53, 116.28, 123.675], np.float32)  # blue, green, red
DEVIATION = np.array([57.375, 57.12, 58.395], np.float32)
NMS_OVERLAP = 0.6
SAME_OVERLAP = 0.3  # intersection over union with an annotation that explains a detection
WITHIN = 0.6  # part of a detection within annotations that explains it


class Detector:
    """NanoDet-m for people."""

    def __init__(self, model, confidence):
        import cv2  # here: all but the detector works without it

        self.cv2 = cv2
        self.network = cv2.dnn.readNetFromONNX(str(model))
        self.outputs = self.network.getUnconnectedOutLayersNames()
        self.confidence = confidence

    def people_of(self, path):
        """Boxes [x, y, width, height] of the people in an image; None if it cannot be read."""
        image = self.cv2.imread(str(path))
        return None if image is None else self.people(image)

    def people(self, image):
        """The same of an image of blue, green and red."""
        height, width = image.shape[:2]
        scale = min(SIDE / height, SIDE / width)
        size = (int(width * scale), int(height * scale))
        canvas = np.zeros((SIDE, SIDE, 3), np.float32)
        small = self.cv2.resize(image, size, interpolation=self.cv2.INTER_AREA)
        canvas[: size[1], : size[0]] = (small - MEAN) / DEVIATION
        self.network.setInput(np.ascontiguousarray(canvas.transpose(2, 0, 1)[None]))
        boxes, scores = decoded(self.network.forward(self.outputs), self.confidence)
        if not boxes:
            return []
        kept = self.cv2.dnn.NMSBoxes(boxes, scores, self.confidence, NMS_OVERLAP)
        found = []
        for number in np.asarray(kept).reshape(-1):
            x, y, w, h = (value / scale for value in boxes[number])
            right, bottom = min(x + w, width), min(y + h, height)
            x, y = max(x, 0.0), max(y, 0.0)
            if right - x >= 1 and bottom - y >= 1:
                found.append([round(float(v), 2) for v in (x, y, right - x, bottom - y)])
        return found


def decoded(outputs, confidence):
    """Boxes [px of the input] and scores of class 0."""
    by_size = sorted((out.reshape(-1, out.shape[-1]) for out in outputs), key=len, reverse=True)
    boxes, scores = [], []
    for stride in STRIDES:
        cells = SIDE // stride
        level = [out for out in by_size if len(out) == cells * cells]
        classes = next(out for out in level if out.shape[1] != 4 * BINS)
        distances = next(out for out in level if out.shape[1] == 4 * BINS)
        for cell in np.nonzero(classes[:, 0] > confidence)[0]:
            weights = np.exp(distances[cell].reshape(4, BINS) - distances[cell].max())
            left, top, right, bottom = (
                weights @ np.arange(BINS) / weights.sum(axis=1) * stride
            )
            x, y = (cell % cells + 0.5) * stride, (cell // cells + 0.5) * stride
            boxes.append([float(v) for v in (x - left, y - top, left + right, top + bottom)])
            scores.append(float(classes[cell, 0]))
    return boxes, scores


def overlap(a, b):
    """Area that two boxes share."""
    width = min(a[0] + a[2], b[0] + b[2]) - max(a[0], b[0])
    height = min(a[1] + a[3], b[1] + b[3]) - max(a[1], b[1])
    return max(width, 0.0) * max(height, 0.0)


def is_explained(box, annotations):
    """Whether a detection is that of an annotated object, or a part of one."""
    area = box[2] * box[3]
    for entry in annotations:
        shared = overlap(box, entry)
        if shared > SAME_OVERLAP * (area + entry[2] * entry[3] - shared) or shared > WITHIN * area:
            return True
    return False


def add_unlabelled(coco, people_of, skipped=()):
    """Adds the detections without annotation; returns their number for each source.

    skipped: sources that stay as they are, such as pictures of statues
    """
    boxes, counts = {}, {}
    for entry in coco["annotations"]:
        boxes.setdefault(entry["image_id"], []).append(entry["bbox"])
    person = next(entry["id"] for entry in coco["categories"] if entry["name"] == "person")
    following = max((entry["id"] for entry in coco["annotations"]), default=0) + 1
    for image in coco["images"]:
        if image.get("source", "") in skipped or "person" in image.get("partial", []):
            continue
        for box in people_of(image):
            if is_explained(box, boxes.get(image["id"], [])):
                continue
            coco["annotations"].append({
                "id": following, "image_id": image["id"], "category_id": person, "bbox": box,
                "area": round(box[2] * box[3], 2), "segmentation": [], "box_only": True,
                "iscrowd": 1, "ignore": 1,
            })
            following += 1
            source = image.get("source", "")
            counts[source] = counts.get(source, 0) + 1
    return counts


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("annotations", type=Path, help="COCO file")
    parser.add_argument("images", type=Path, help="folder of the images")
    parser.add_argument("model", type=Path, help="nanodet_m.onnx")
    parser.add_argument("-o", "--output", type=Path, required=True, help="COCO file to write")
    parser.add_argument("--confidence", type=float, default=0.4, help="lowest one that counts")
    parser.add_argument("--skip", nargs="*", default=[], help="sources that stay as they are")
    options = parser.parse_args(arguments)
    detector = Detector(options.model, options.confidence)
    coco = json.loads(options.annotations.read_text())
    unreadable = 0

    def people_of(image):
        nonlocal unreadable
        found = detector.people_of(options.images / image["file_name"])
        if found is None:
            print(f"{image['file_name']}: image cannot be read", file=sys.stderr)
            unreadable += 1
        return found or []

    counts = add_unlabelled(coco, people_of, options.skip)
    options.output.write_text(json.dumps(coco, separators=(",", ":")))
    for source, count in sorted(counts.items()):
        print(f"{source}: {count} people without annotation")
    print(f"{unreadable} of {len(coco['images'])} images cannot be read")
    return 0


if __name__ == "__main__":
    sys.exit(main())
