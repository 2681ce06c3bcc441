#!/usr/bin/env python3
"""Share of people found with an IoU of 0.5 or more: with the masks as they are, and cut by an
ellipse of the size of the true box, which is what a perfect window would do.

usage: mask_spill.py ANNOTATIONS.json RESULTS.json [SPLIT]   (results of mms segment)
"""
import json
import sys
from collections import defaultdict
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "training"))
from collect_data import decode_counts  # noqa: E402

PERSON = 1
SMALL, LARGE = 1 / 8, 1 / 3  # of the image's height
HALF_AXIS = 0.62  # of the ellipse, in sides of the box


def decoded(rle):
    """The mask of an RLE, compressed or not."""
    height, width = rle["size"]
    counts = rle["counts"]
    if isinstance(counts, str):
        counts = decode_counts(counts)
    values = np.repeat(np.arange(len(counts)) % 2 == 1, counts)
    return values.reshape(width, height).T


def mask_of(entry, image):
    """The mask of an annotation; None if only its box is known."""
    segmentation = entry["segmentation"]
    if isinstance(segmentation, dict):
        return decoded(segmentation)
    if not segmentation:
        return None
    picture = Image.new("1", (image["width"], image["height"]))
    for polygon in segmentation:
        ImageDraw.Draw(picture).polygon(polygon, fill=1, outline=1)
    return np.array(picture)


def ellipse(box, shape):
    x, y, width, height = box
    rows, columns = np.mgrid[: shape[0], : shape[1]]
    across = (columns - x - width / 2) / (HALF_AXIS * width)
    down = (rows - y - height / 2) / (HALF_AXIS * height)
    return across**2 + down**2 < 1


def overlap(a, b):
    """Intersection over union."""
    return (a & b).sum() / max(1, (a | b).sum())


def people_rows(annotations, results, split):
    """Height in the image, best IoU, best IoU of the cut masks; a row per person with a mask."""
    images = {
        image["id"]: image for image in annotations["images"]
        if split is None or image.get("split") == split
    }
    found = defaultdict(list)
    for result in results:
        if result["image_id"] in images and result["category_id"] == PERSON:
            found[result["image_id"]].append(decoded(result["segmentation"]))
    for entry in annotations["annotations"]:
        image = images.get(entry["image_id"])
        if image is None or entry["category_id"] != PERSON or entry.get("iscrowd"):
            continue
        mask = mask_of(entry, image)
        if mask is None or not mask.any():
            continue
        window = ellipse(entry["bbox"], mask.shape)
        masks = found[image["id"]]
        yield (
            entry["bbox"][3] / image["height"],
            max((overlap(mask, other) for other in masks), default=0),
            max((overlap(mask, other & window) for other in masks), default=0),
        )


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    annotations, results = (json.loads(Path(path).read_text()) for path in sys.argv[1:3])
    split = sys.argv[3] if len(sys.argv) == 4 else None
    rows = np.array(list(people_rows(annotations, results, split))).reshape(-1, 3)
    print("| height in the image | people | as they are | cut |\n| --- | --- | --- | --- |")
    for name, low, high in (("below an eighth", 0, SMALL), ("an eighth to a third", SMALL, LARGE),
                            ("above a third", LARGE, 9), ("all", 0, 9)):
        part = rows[(rows[:, 0] >= low) & (rows[:, 0] < high)]
        if len(part):
            shares = " | ".join(f"{100 * np.mean(part[:, i] >= 0.5):.0f} %" for i in (1, 2))
            print(f"| {name} | {len(part)} | {shares} |")


if __name__ == "__main__":
    main()
