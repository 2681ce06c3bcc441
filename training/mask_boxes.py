#!/usr/bin/env python3
"""Gives masks to people of whom a COCO file has boxes only, by a trained network.

Each person is cut out twice, with less and with more around, and enlarged to the network's input.
So the network sees a person of the size it knows best. Its masks are cut by the box. A person gets
a mask if both masks fill the box and agree; all others keep their box alone.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image

sys.path.insert(0, str(Path(__file__).resolve().parent))
from collect_data import decode_rle, encode_rle  # noqa: E402

PERSON = 1
INPUT = (416, 312)  # width, height of the network's input [px]
CONTEXT = (1.35, 2.2)  # sides of what is cut out, in sides of the box
MIN_HEIGHT = 20  # of a box [px]; smaller people have no outline
FILLED = 0.75  # least IoU of the box with the box around the mask within it
AGREED = 0.8  # least IoU of both masks
SCORE = 0.1  # least score of a mask; its box tells that there is a person
CHUNK = 3000  # people per run of the network


def window(box, context, size):
    """What is cut out around a box: left, top, right, bottom in whole pixels of the image."""
    x, y, width, height = box
    scale = context * max(width / INPUT[0], height / INPUT[1])
    half = (scale * INPUT[0] / 2, scale * INPUT[1] / 2)
    middle = (x + width / 2, y + height / 2)
    return (
        max(0, int(middle[0] - half[0])),
        max(0, int(middle[1] - half[1])),
        min(size[0], int(np.ceil(middle[0] + half[0]))),
        min(size[1], int(np.ceil(middle[1] + half[1]))),
    )


def picture_of(path, image):
    """The picture of an entry of the COCO file."""
    try:
        picture = Image.open(path).convert("RGB")
    except OSError as error:
        sys.exit(f"cannot read {path}: {error}")
    if picture.size != (image["width"], image["height"]):
        sys.exit(f"{path} has {picture.size} pixels, not those of its entry")
    return picture


def is_usable(box, image):
    """Whether a box is large enough, and within its image but for rounding."""
    x, y, width, height = box
    return (
        height >= MIN_HEIGHT and width >= 1 and x >= -1 and y >= -1
        and x + width <= image["width"] + 1 and y + height <= image["height"] + 1
    )


def enlarged(picture, cut):
    """That part of a picture, as large as the network's input allows."""
    width, height = cut[2] - cut[0], cut[3] - cut[1]
    scale = min(INPUT[0] / width, INPUT[1] / height)
    size = (max(1, round(width * scale)), max(1, round(height * scale)))
    return picture.resize(size, Image.BICUBIC, box=cut)


def overlap(a, b):
    """Intersection over union of masks."""
    return (a & b).sum() / max(1, (a | b).sum())


def box_overlap(mask, box):
    """IoU of the box around a mask with a box."""
    rows, columns = np.flatnonzero(mask.any(1)), np.flatnonzero(mask.any(0))
    if not len(rows):
        return 0.0
    x, y, width, height = box
    left, top, right, bottom = columns[0], rows[0], columns[-1] + 1, rows[-1] + 1
    across = min(right, x + width) - max(left, x)
    down = min(bottom, y + height) - max(top, y)
    if across <= 0 or down <= 0:
        return 0.0
    common = across * down
    return common / ((right - left) * (bottom - top) + width * height - common)


def within_box(mask, cut, box, shape):
    """A mask of what was cut out, as one of the box's pixels: mask, left, top in the image."""
    x, y, width, height = box
    left, top = max(0, int(np.floor(x))), max(0, int(np.floor(y)))
    right = min(shape[1], int(np.ceil(x + width)))
    bottom = min(shape[0], int(np.ceil(y + height)))
    size = (cut[2] - cut[0], cut[3] - cut[1])
    small = Image.fromarray(mask.astype(np.uint8) * 255).resize(size, Image.BILINEAR)
    full = np.zeros((bottom - top, right - left), bool)
    part = np.asarray(small) > 127
    # The box may reach beyond what was cut out only by rounding.
    rows = slice(max(top, cut[1]), min(bottom, cut[3]))
    columns = slice(max(left, cut[0]), min(right, cut[2]))
    full[rows.start - top : rows.stop - top, columns.start - left : columns.stop - left] = part[
        rows.start - cut[1] : rows.stop - cut[1], columns.start - cut[0] : columns.stop - cut[0]
    ]
    return full, left, top


def best_mask(results, cut, box, shape):
    """The mask that fills the box best: IoU with the box, mask, left, top; None without any."""
    best = None
    for result in results:
        if result["category_id"] != PERSON:
            continue
        mask, left, top = within_box(decode_rle(result["segmentation"]), cut, box, shape)
        filled = box_overlap(mask, (box[0] - left, box[1] - top, box[2], box[3]))
        if best is None or filled > best[0]:
            best = (filled, mask, left, top)
    return best


def whole(mask, left, top, shape):
    """The mask of an image, from that of the box's pixels."""
    full = np.zeros(shape, bool)
    full[top : top + mask.shape[0], left : left + mask.shape[1]] = mask
    return full


def start_network(program, weights, pictures, folder):
    """Starts the network on pictures; one thread."""
    (folder / "images").mkdir(parents=True)
    images = []
    for number, picture in enumerate(pictures):
        name = f"{number:06d}.jpg"
        picture.save(folder / "images" / name, quality=95)
        size = {"width": picture.width, "height": picture.height}
        images.append({"id": number, "file_name": name} | size)
    classes = [{"id": PERSON, "name": "person"}]
    listed = {"images": images, "annotations": [], "categories": classes}
    (folder / "list.json").write_text(json.dumps(listed))
    command = [program, "segment", folder / "images", "--annotations", folder / "list.json"]
    command += ["--weights", weights, "--json-only", "-o", folder / "found", "--threads", "1"]
    command += ["--set", f"segmentation.decoder.score={SCORE}"]
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def segmented(program, weights, pictures):
    """The network's masks of pictures, a list per picture; a process per core."""
    cores = min(os.cpu_count() or 1, len(pictures))
    with tempfile.TemporaryDirectory() as folder:
        folders = [Path(folder) / str(core) for core in range(cores)]
        started = [
            start_network(program, weights, pictures[core::cores], folders[core])
            for core in range(cores)
        ]
        found = [[] for _ in pictures]
        for core, process in enumerate(started):
            message = process.communicate()[1]
            if process.returncode != 0:
                sys.exit(message.strip().splitlines()[-1])
            for result in json.loads((folders[core] / "found" / "results.json").read_text()):
                found[result["image_id"] * cores + core].append(result)
    return found


def agreed_mask(masks):
    """Mask, left and top of the first one, if both fill the box and agree; else None."""
    if None in masks or min(mask[0] for mask in masks) < FILLED:
        return None
    return masks[0][1:] if overlap(masks[0][1], masks[1][1]) >= AGREED else None


def mask_people(people, images, folder, program, weights):
    """Gives masks to annotations; yields how many of each part of the list got one."""
    people = sorted(people, key=lambda entry: entry["image_id"])
    for start in range(0, len(people), CHUNK):
        part = people[start : start + CHUNK]
        pictures, cuts, opened = [], [], (None, None)
        for entry in part:
            name = images[entry["image_id"]]["file_name"]
            if opened[0] != name:
                opened = (name, picture_of(folder / name, images[entry["image_id"]]))
            for context in CONTEXT:
                cuts.append(window(entry["bbox"], context, opened[1].size))
                pictures.append(enlarged(opened[1], cuts[-1]))
        found = segmented(program, weights, pictures)
        got = 0
        for number, entry in enumerate(part):
            image = images[entry["image_id"]]
            shape = (image["height"], image["width"])
            both = range(len(CONTEXT) * number, len(CONTEXT) * (number + 1))
            masks = [best_mask(found[at], cuts[at], entry["bbox"], shape) for at in both]
            agreed = agreed_mask(masks)
            if agreed is None:
                continue
            mask, left, top = agreed
            entry["segmentation"] = encode_rle(whole(mask, left, top, shape))
            entry["area"] = int(mask.sum())
            entry["mask_by_network"] = True
            entry.pop("box_only", None)
            got += 1
        yield len(part), got


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("annotations", type=Path, help="COCO file")
    parser.add_argument("images", type=Path, help="folder of its images")
    parser.add_argument("weights", type=Path, help="of the network, as mms segment takes them")
    parser.add_argument("-o", "--output", type=Path, required=True, help="COCO file to write")
    parser.add_argument("--skip", nargs="*", default=[], metavar="SPLIT", help="left as they are")
    parser.add_argument("--mms", default="mms", help="the program (default: mms)")
    options = parser.parse_args()
    if options.output.exists():
        sys.exit(f"{options.output} exists already")
    content = json.loads(options.annotations.read_text())
    images = {image["id"]: image for image in content["images"]}
    people = [
        entry for entry in content["annotations"]
        if entry.get("box_only") and entry["category_id"] == PERSON and not entry.get("iscrowd")
        and is_usable(entry["bbox"], images[entry["image_id"]])
        and images[entry["image_id"]].get("split") not in options.skip
    ]
    done = masked = 0
    for size, got in mask_people(people, images, options.images, options.mms, options.weights):
        done, masked = done + size, masked + got
        print(f"{done} of {len(people)} people, {masked} with a mask", flush=True)
    options.output.write_text(json.dumps(content))


if __name__ == "__main__":
    main()
