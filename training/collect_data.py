#!/usr/bin/env python3
"""Collects images of people and vehicles from cloned repositories for the training.

Writes below the output folder:
  train/        images and instances.json (COCO; categories person and agv)
  empty/        images of rooms without people
  empty_holdout/  500 of them, for evaluation only
  holdout/      images and instances.json (people in the wild), for evaluation only
  people.json   with --people: that file without images like a hold-out, and of COCO val
  near_pairs.csv  images that look like one of a hold-out

Repositories are folders 'owner+name': work trees, or bare git folders (also below 'repo').
"""

import argparse
import csv
import hashlib
import io
import json
import re
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from PIL import Image

PERSON, AGV = 1, 2
CATEGORIES = [{"id": PERSON, "name": "person"}, {"id": AGV, "name": "agv"}]
LONGEST_SIDE = 640
QUALITY = 90
SAME_DISTANCE = 10  # of perceptual hashes to a hold-out: dropped
NEAR_DISTANCE = 12  # listed in near_pairs.csv
TWIN_DISTANCE = 4  # to an image that is taken already: dropped
EMPTY_HOLDOUT = 500
WIDE_CROWD, TALL_CROWD = 3, 8  # people in a box that is one of a crowd; most people are tall
CROWD_PART = 0.35  # largest area of such a person relative to the box
PICTURES = (".jpg", ".jpeg", ".png")
COCO_LABELS = "insigh1+Interactive_ABCs_with_American_Sign_Language_using_Yolov5"
COCO_LABELS_COMMIT = "a10d74895"
COCO_SPLITS = "kelvinxu+arctic-captions"  # names of all images of COCO 2014
VOC_LABELS = "shihanghoney97+YOLO-SK"


# ---------------------------------------------------------------- repositories


class Repository:
    """The files of a work tree or of a commit in a bare git folder."""

    def __init__(self, folder, commit="HEAD"):
        places = [folder, folder / "repo", folder / "repo" / ".git"]
        if not any(place.is_dir() for place in places):
            raise FileNotFoundError(f"{folder.name}: not found in {folder.parent}")
        bare = [place for place in places if (place / "objects").is_dir()]
        if commit != "HEAD" and not bare:
            bare = [folder / ".git"]
        self._git = None
        self.folder = folder
        if bare:
            self._start_git(bare[0], commit)
        else:
            self.files = sorted(
                path.relative_to(folder).as_posix()
                for path in folder.rglob("*")
                if path.is_file() and ".git" not in path.parts
            )

    def _start_git(self, folder, commit):
        git = ["git", f"--git-dir={folder}"]
        tree = subprocess.run(
            [*git, "ls-tree", "-r", "-z", commit], capture_output=True, check=True
        ).stdout
        entries = [line.split("\t", 1) for line in tree.decode("utf-8", "replace").split("\0")[:-1]]
        self._blobs = {name: words.split()[2] for words, name in entries}
        self.files = sorted(self._blobs)
        self._git = subprocess.Popen(
            [*git, "cat-file", "--batch"], stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )

    def read(self, name):
        """The bytes of a file, or None if there are none."""
        if self._git is None:
            path = self.folder / name
            return path.read_bytes() if path.is_file() else None
        if name not in self._blobs:
            return None
        self._git.stdin.write(self._blobs[name].encode() + b"\n")
        self._git.stdin.flush()
        header = self._git.stdout.readline().split()
        if header[-1] == b"missing":
            return None
        data = self._git.stdout.read(int(header[2]))
        self._git.stdout.read(1)
        return data

    def json(self, name):
        data = self.read(name)
        if data is None:
            raise FileNotFoundError(f"{self.folder.name}: no file {name}")
        return json.loads(data)

    def below(self, folder, endings):
        return [n for n in self.files if n.startswith(folder) and n.lower().endswith(endings)]

    def close(self):
        if self._git is not None:
            self._git.stdin.close()
            self._git.stdout.close()
            self._git.wait()


# ---------------------------------------------------------------- masks


def decode_counts(text):
    """Run lengths of COCO's compressed RLE."""
    counts, at = [], 0
    while at < len(text):
        value, shift, more = 0, 0, True
        while more:
            byte = ord(text[at]) - 48
            value |= (byte & 31) << shift
            more = bool(byte & 32)
            at, shift = at + 1, shift + 5
            if not more and byte & 16:
                value -= 1 << shift
        counts.append(value + (counts[-2] if len(counts) > 2 else 0))
    return counts


def decode_rle(rle):
    height, width = rle["size"]
    counts = rle["counts"]
    if isinstance(counts, str):
        counts = decode_counts(counts)
    if sum(counts) != height * width:
        raise ValueError("RLE does not fill the image")
    values = np.arange(len(counts)) % 2 == 1
    return np.repeat(values, counts).reshape(width, height).T


def encode_rle(mask):
    flat = mask.T.reshape(-1)
    changes = np.flatnonzero(flat[1:] != flat[:-1]) + 1
    counts = np.diff(np.concatenate(([0], changes, [flat.size]))).tolist()
    if flat[0]:
        counts.insert(0, 0)
    return {"size": [mask.shape[0], mask.shape[1]], "counts": counts}


def resized_mask(mask, size):
    image = Image.fromarray(mask.astype(np.uint8) * 255).resize(size, Image.BOX)
    return np.asarray(image) >= 128


def polygon_area(points):
    x, y = np.array(points[0::2]), np.array(points[1::2])
    return abs(float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))) / 2


def box_of(mask):
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    x, y = int(columns[0]), int(rows[0])
    return [x, y, int(columns[-1]) + 1 - x, int(rows[-1]) + 1 - y]


def box_of_polygons(polygons):
    x = [value for points in polygons for value in points[0::2]]
    y = [value for points in polygons for value in points[1::2]]
    return [min(x), min(y), round(max(x) - min(x), 2), round(max(y) - min(y), 2)]


# ---------------------------------------------------------------- pictures and annotations


@dataclass
class Object:
    """An annotated object in pixels of its image. Its mask is polygons, an array or None."""

    what: str  # for messages
    category: int
    box: list
    polygons: list = field(default_factory=list)
    mask: np.ndarray | None = None
    crowd: bool = False


@dataclass
class Picture:
    name: str  # in its repository
    objects: object  # function of width and height to a list of objects


class Report:
    """Messages and counts of a source."""

    def __init__(self, source):
        self.source = source
        self.images = self.bad_images = self.annotations = self.bad_annotations = 0
        self.dropped = {}

    def bad_image(self, name, what):
        self.bad_images += 1
        print(f"{self.source}: {name}: {what}")

    def bad_annotation(self, name, what):
        self.annotations += 1
        self.bad_annotations += 1
        print(f"{self.source}: {name}: {what}")

    def drop(self, why):
        self.dropped[why] = self.dropped.get(why, 0) + 1

    def refusal(self):
        """Why the whole source is refused; empty if it is not."""
        if 2 * self.bad_images > self.images:
            return f"{self.bad_images} of {self.images} images are bad"
        if 2 * self.bad_annotations > self.annotations:
            return f"{self.bad_annotations} of {self.annotations} annotations are bad"
        return ""


def checked(objects, name, width, height, report):
    """The objects whose boxes have an area within the image, clipped to it."""
    good = []
    for entry in objects:
        x, y, w, h = entry.box
        left, top = max(x, 0.0), max(y, 0.0)
        right, bottom = min(x + w, width), min(y + h, height)
        inside = max(right - left, 0.0) * max(bottom - top, 0.0)
        if w <= 0 or h <= 0:
            report.bad_annotation(name, f"{entry.what}: box of zero area")
        elif inside < 0.5 * w * h:
            report.bad_annotation(name, f"{entry.what}: box outside of the image")
        else:
            report.annotations += 1
            entry.box = [left, top, right - left, bottom - top]
            good.append(entry)
    return good


def mark_crowds(objects):
    """Boxes around many people are of crowds, which count neither as a person nor as background."""
    for entry in objects:
        x, y, w, h = entry.box
        if entry.category != PERSON or entry.polygons or entry.mask is not None:
            continue
        inside = sum(
            x < other.box[0] + other.box[2] / 2 < x + w
            and y < other.box[1] + other.box[3] / 2 < y + h
            and other.box[2] * other.box[3] < CROWD_PART * w * h
            for other in objects
            if other is not entry and other.category == PERSON
        )
        entry.crowd |= inside >= (WIDE_CROWD if w > h else TALL_CROWD)


# ---------------------------------------------------------------- formats


def yolo_line(line, width, height):
    """Class, box and polygons of a line 'class x y w h' or 'class x1 y1 x2 y2 x3 y3 ...'."""
    index, *values = (float(word) for word in line.split())
    if len(values) != 4:
        points = scaled_points(values, width, height)
        return int(index), box_of_polygons([points]), [points]
    x, y, w, h = values
    return int(index), [(x - w / 2) * width, (y - h / 2) * height, w * width, h * height], []


def yolo_txt(repo, report, folder, classes, label_of, label_repo=None, unlabelled=True):
    """Pictures with text files of one object a line, relative to the image's size.

    unlabelled: whether a picture without such a file is an error, else it is not taken.
    """

    def objects_of(name, text, width, height):
        objects = []
        for number, line in enumerate(text.splitlines(), 1):
            if not line.strip():
                continue
            what = f"line {number}"
            try:
                index, box, polygons = yolo_line(line, width, height)
            except ValueError:
                report.bad_annotation(name, f"{what}: is neither 'class x y w h' nor a polygon")
                continue
            if not 0 <= index < len(classes):
                report.bad_annotation(name, f"{what}: no class {index}")
            elif classes[index]:
                objects.append(Object(what, classes[index], box, polygons))
        return objects

    for name in repo.below(folder, PICTURES):
        label = (label_repo or repo).read(label_of(name))
        if label is None and not unlabelled:
            continue
        if label is None:
            report.images += 1
            report.bad_image(name, "has no label file")
            continue
        text = label.decode("utf-8", "replace")
        yield Picture(name, lambda w, h, name=name, text=text: objects_of(name, text, w, h))


def corners_txt(repo, report, folder, classes, label_of):
    """Pictures with text files of lines 'class left top right bottom' [px]."""

    def objects_of(name, text):
        objects = []
        for number, line in enumerate(text.splitlines(), 1):
            if not line.strip():
                continue
            try:
                word, *corners = line.split()
                left, top, right, bottom = (float(value) for value in corners)
            except ValueError:
                report.bad_annotation(name, f"line {number}: is not 'class left top right bottom'")
                continue
            if word in classes:
                box = [left, top, right - left, bottom - top]
                objects.append(Object(f"line {number}", classes[word], box))
        return objects

    for name in repo.below(folder, PICTURES):
        label = repo.read(label_of(name))
        if label is None:
            report.images += 1
            report.bad_image(name, "has no label file")
            continue
        text = label.decode("utf-8", "replace")
        yield Picture(name, lambda w, h, name=name, text=text: objects_of(name, text))


def coco_json(repo, report, file, folder, classes):
    """Pictures of a COCO file; classes: category by name."""
    data = repo.json(file)
    names = {entry["id"]: entry["name"] for entry in data["categories"]}
    images = {entry["id"]: entry for entry in data["images"]}
    annotations = {}
    for entry in data["annotations"]:
        what = f"annotation {entry['id']}"
        if entry["image_id"] not in images:
            report.bad_annotation(file, f"{what}: no image {entry['image_id']}")
        elif entry["category_id"] not in names:
            report.bad_annotation(file, f"{what}: no category {entry['category_id']}")
        elif names[entry["category_id"]] in classes:
            annotations.setdefault(entry["image_id"], []).append(entry)

    def objects_of(image, width, height):
        sx, sy = width / image["width"], height / image["height"]
        objects = []
        for entry in annotations.get(image["id"], []):
            what, shape = f"annotation {entry['id']}", entry.get("segmentation") or []
            category, mask, polygons = classes[names[entry["category_id"]]], None, []
            try:
                if isinstance(shape, dict):
                    mask = resized_mask(decode_rle(shape), (width, height))
                else:
                    polygons = [scaled_points(points, sx, sy) for points in shape]
            except (ValueError, IndexError):
                report.bad_annotation(image["file_name"], f"{what}: mask cannot be read")
                continue
            try:
                x, y, w, h = (float(value) for value in entry["bbox"])
            except (TypeError, ValueError):
                report.bad_annotation(image["file_name"], f"{what}: box cannot be read")
                continue
            box = [x * sx, y * sy, w * sx, h * sy]
            crowd = bool(entry.get("iscrowd", 0))
            objects.append(Object(what, category, box, polygons, mask, crowd))
        return objects

    for image in sorted(data["images"], key=lambda entry: entry["file_name"]):
        name = folder + image["file_name"]
        yield Picture(name, lambda w, h, image=image: objects_of(image, w, h))


def mask_png(repo, report, folder, mask_of, every=1):
    """Pictures of one person each with black and white masks of the same shape."""

    def objects_of(name, data, width, height):
        try:
            mask = np.asarray(Image.open(io.BytesIO(data)).convert("L")) >= 128
        except OSError:
            report.bad_annotation(name, "mask cannot be read")
            return []
        if abs(mask.shape[1] * height - mask.shape[0] * width) > 0.02 * mask.shape[1] * height:
            found = f"{mask.shape[1]}x{mask.shape[0]}"
            report.bad_annotation(name, f"mask is {found}, the image {width}x{height}")
            return []
        mask = resized_mask(mask, (width, height))
        if not mask.any():
            report.bad_annotation(name, "mask: box of zero area")
            return []
        return [Object("mask", PERSON, box_of(mask), mask=mask)]

    for name in repo.below(folder, PICTURES)[::every]:
        data = repo.read(mask_of(name))
        if data is None:
            report.images += 1
            report.bad_image(name, "has no mask file")
            continue
        yield Picture(name, lambda w, h, name=name, data=data: objects_of(name, data, w, h))


def plain(repo, folder, share=1.0):
    """Pictures without annotations; share: how many of them, chosen by name."""
    for name in repo.below(folder, PICTURES):
        if int(name_hash(name), 16) < share * 16**12:
            yield Picture(name, lambda w, h: [])


def scaled_points(points, sx, sy):
    if len(points) < 6 or len(points) % 2:
        raise ValueError("not a polygon")
    scale = (sx, sy)
    return [value * scale[i % 2] for i, value in enumerate(points)]


def plain_of(repo, folder, classes):
    """Pictures without annotations in folders of these names."""
    for name in classes:
        yield from plain(repo, f"{folder}{name}/")


# ---------------------------------------------------------------- sources


def beside(old, new):
    """The name of a label file: in another folder, with the ending .txt."""
    return lambda name: re.sub(r"\.\w+$", ".txt", name.replace(old, new, 1))


def coco_label(name):
    return f"coco/labels/train2017/{coco_id(name):012d}.txt"


CONSTRUCTION = [0] * 8 + [PERSON] + [0] * 16
EVERYBODY = {
    name: PERSON
    for name in (
        "Eating_Drinking Focusing Lecturer Looking_at_Documents Not_Identify "
        "Turning_Head Unknown_Distraction Using_PC Using_mobile_phone"
    ).split()
}


HUMAN_WITHOUT = {
    "DJI_": "drone", r"-\d+-_jpg": "drone", "img_": "altered copy of Penn-Fudan",
    "person_": "collage",
}


# Of Caltech 101: those in whose pictures are hardly any people.
ANIMALS = (
    "Leopards ant beaver brontosaurus butterfly cougar_body cougar_face crab crayfish "
    "crocodile_head dalmatian dolphin dragonfly elephant emu flamingo flamingo_head hedgehog ibis "
    "kangaroo lobster mayfly octopus okapi panda pigeon platypus rhino rooster scorpion sea_horse "
    "starfish stegosaurus tick trilobite wild_cat"
).split()
THINGS = (
    "bonsai ceiling_fan chair chandelier ewer joshua_tree lotus menorah nautilus scissors sunflower "
    "water_lilly windsor_chair wrench"
).split()


@dataclass
class Source:
    """A part of a repository. partial: classes of which it has objects without annotation."""

    name: str
    repository: str
    read: object  # function of repository, report and the repository with COCO's box labels
    coco: bool = False  # its file names begin with ids of COCO
    partial: tuple = ()
    keep_empty: bool = False  # images without objects too
    without: dict = field(default_factory=dict)  # beginnings of file names: why they are dropped


def person_json(file, folder, classes=None):
    return lambda repo, report, _: coco_json(
        repo, report, file, folder, classes or {"person": PERSON}
    )


def pascal_voc(repo, report, _):
    """Pictures of PASCAL VOC, of which another repository has the boxes."""
    labels = Repository(repo.folder.parent / VOC_LABELS)
    yield from yolo_txt(
        repo, report, "images/", [0] * 3 + [PERSON] + [0] * 16,
        lambda name: f"data/labels/train/{Path(name).stem}.txt", labels, unlabelled=False,
    )
    labels.close()


TRAINING = [
    Source(
        "coco_mini", "Obmutescence+COCO-MINI",
        person_json("annotations/instances_train2017.json", "train2017/"),
        coco=True, keep_empty=True,
    ),
    Source(
        "coco_tiny", "zzowenzz+COCO_Tiny",
        person_json("annotations/instances_train2017.json", "train2017/"),
        coco=True, keep_empty=True,
    ),
    Source(
        "minicoco", "yuanyl00+miniCOCO",
        lambda repo, report, labels: yolo_txt(
            repo, report, "COCO/train2017/", [PERSON] + [0] * 79, coco_label, labels
        ),
        coco=True, keep_empty=True,
    ),
    *(
        Source(
            "coco_street", "mchoccie+DeepDataMiningLearning",
            person_json(f"data/annotations/instances_{part}2017.json", "data/images/"),
            coco=True, keep_empty=True,
        )
        for part in ("train", "val")  # both of train2017
    ),
    Source(
        "vqa", "ManaviAgrawal+VQA",
        lambda repo, report, labels: yolo_txt(
            repo, report, "train2014/", [PERSON] + [0] * 79, coco_label, labels
        ),
        coco=True, keep_empty=True,
    ),
    *(
        Source(
            "human", "brianhuster+human-dataset",
            lambda repo, report, _, part=part: yolo_txt(
                repo, report, f"{part}/images/", [PERSON, PERSON],
                beside("/images/", "/labels/"),
            ),
            coco=True, without=HUMAN_WITHOUT,
        )
        for part in ("train", "valid", "test")
    ),
    *(
        Source(
            "borrat", "MatrixLeung+Borrat-Teacher-Occlusion-Dataset",
            person_json(f"{part}/_annotations.coco.json", f"{part}/", {"human": PERSON}),
            partial=("person",),
        )
        for part in ("train", "valid")
    ),
    Source(
        "pfg", "Julito22+Mask-R-CNN-PFG",
        person_json("annotations/person_keypoints_train2017.json", "train2017/"),
        partial=("person",),
    ),
    Source(
        "human_masks", "VikramShenoy97+Human-Segmentation-Dataset",
        lambda repo, report, _: mask_png(
            repo, report, "Training_Images/",
            lambda name: re.sub(r"\w+$", "png", name.replace("Training_Images", "Ground_Truth")),
        ),
        partial=("person",),
    ),
    *(
        Source(
            "davis", "MathLee+EOR-VOS",
            lambda repo, report, _, video=video: mask_png(
                repo, report, f"DAVIS/JPEGImages/480p/{video}/",
                lambda name: name.replace("JPEGImages", "Annotations").replace(".jpg", ".png"),
                every=3,
            ),
            partial=("person",),
        )
        for video in ("breakdance", "dance-twirl", "parkour")
    ),
    *(
        Source(
            "construction", "Avatar2001+Construction-Site-Safety",
            lambda repo, report, _, part=part: yolo_txt(
                repo, report, f"Dataset/{part}/images/", CONSTRUCTION,
                beside("/images/", "/labels/"),
            ),
        )
        for part in ("train", "valid", "test")
    ),
    Source(
        "workers", "Krupakar-Reddy-S+Syook_CV_Assignment",
        lambda repo, report, _: yolo_txt(
            repo, report, "datasets/voc_original/images/", [PERSON] + [0] * 9,
            beside("/voc_original/images/", "/yolo_annotations/"),
        ),
    ),
    Source(
        "factory", "KhiemCE22+Application-PPE",
        person_json("train/_annotations.coco.json", "train/"), keep_empty=True,
    ),
    *(
        Source(
            "classroom", "NguyenManhDung27+BAV_classroom_monitoring_CV",
            person_json(
                f"Dataset for Detection/{part}/_annotations.coco.json",
                f"Dataset for Detection/{part}/", EVERYBODY,
            ),
        )
        for part in ("train", "valid", "test")
    ),
    *(
        Source(
            "cafe", "katiehur5+cafe-people-detection",
            person_json(
                f"data/annotations/{part}.json", f"data/images/{part}/", {"people": PERSON}
            ),
        )
        for part in ("train", "valid", "test")
    ),
    *(
        Source(
            "forklift", "AkkapakaManikanta+yolov5_forklift",
            lambda repo, report, _, part=part: yolo_txt(
                repo, report, f"data/forklift_data/images/{part}/", [AGV, PERSON],
                beside("/images/", "/labels/"),
            ),
        )
        for part in ("train", "val", "test")
    ),
    Source(
        "objects", "MachineLearning2020+Homework2-Caltech101",
        lambda repo, *_: plain_of(repo, "101_ObjectCategories/", ANIMALS + THINGS),
        keep_empty=True,
    ),
    Source(
        "forklift_only", "VarunBal+forklift-detector",
        lambda repo, report, _: yolo_txt(
            repo, report, "dataset/train_data/", [AGV], beside("\0", "\0")
        ),
        partial=("person",),
    ),
    Source(
        "animals", "mateusrafael4+Atividade_programacao_pose_estimation", pascal_voc,
        keep_empty=True,
    ),
    Source(  # boxes of people in wheelchairs contain these
        "wheelchair", "lexra+wheelchair",
        lambda repo, report, _: yolo_txt(
            repo, report, "datasets/", [PERSON, PERSON], beside("\0", "\0"), unlabelled=False
        ),
        partial=("person",),
    ),
    Source(
        "coco_people",
        "michallaufer+Robust-Human-Detection-and-Pose-Estimation-"
        "Under-Surveillance-Camera-Degradation",
        lambda repo, report, labels: yolo_txt(
            repo, report, "data/yolo_pose/images/train/", [PERSON] + [0] * 79, coco_label, labels
        ),
        coco=True,
    ),
    *(
        Source(
            "hard_hat", "Especializacion-IA+yolov8-hard-hat_test",
            lambda repo, report, _, part=part: yolo_txt(
                repo, report, f"dataset/{part}/images/", [0, 0, 0, PERSON],
                beside("/images/", "/labels/"),
            ),
        )
        for part in ("train", "valid", "test")
    ),
    *(
        Source(  # half of it: statues and mannequins
            "statues", "nishamurthy-22+Pedestrian_yolo",
            lambda repo, report, _, part=part: yolo_txt(
                repo, report, f"data/images/{part}/", [PERSON, 0], beside("/images/", "/labels/")
            ),
            keep_empty=True,
        )
        for part in ("train", "val")
    ),
    Source(  # cars, cats, trains and people, from PASCAL VOC 2007
        "traffic", "BernieChen96+ImageClassification",
        lambda repo, report, _: corners_txt(
            repo, report, "JPEGImages/", {"person": PERSON},
            beside("JPEGImages/", "HandledText/initTxt/"),
        ),
        keep_empty=True,
    ),
]

EMPTY = [
    Source(
        "houses", "emanhamed+Houses-dataset",
        lambda repo, *_: (
            entry for entry in plain(repo, "Houses Dataset/") if "frontal" not in entry.name
        ),
    ),
    Source(
        "rooms", "SilviuBR24+room-classification",
        lambda repo, *_: (  # entrance halls are full of people
            entry for entry in plain(repo, "dataset/", 0.072) if "entrance_hall" not in entry.name
        ),
    ),
    Source(
        "interiors", "GalkaKG+indoor-scene-segmentation",
        lambda repo, *_: plain(repo, "data/pinterest/"),
    ),
    Source("doors", "MiguelARD+DoorDetect-Dataset", lambda repo, *_: plain(repo, "images/")),
]

HOLDOUT = [
    Source(
        "coco128", "developer0hye+COCO128",
        person_json("annotations/instances_train2017.json", "train2017/"), coco=True,
    ),
    Source(
        "tiny_coco", "lizhogn+tiny_coco_dataset",
        person_json("tiny_coco/annotations/instances_train2017.json", "tiny_coco/train2017/"),
        coco=True,
    ),
    Source(
        "coco128_yolo", "lightly-ai+coco128_yolo",
        lambda repo, report, _: yolo_txt(
            repo, report, "images/train2017/", [PERSON] + [0] * 79,
            beside("images/", "object_detection/labels/"),
        ),
        coco=True,
    ),
]


# ---------------------------------------------------------------- what must not be trained on


def coco_id(name):
    """The COCO id in a file name of 12 digits; None without one."""
    found = re.match(r"(?:COCO_(?:train|val)2014_)?(\d{12})(?!\d)", Path(name).name)
    return int(found.group(1)) if found else None


def val2014_ids(repo):
    """Ids of COCO val2014, most of which are in train2017, too."""
    names = []
    for part in ("restval", "val", "test"):
        file = f"splits/coco_{part}.txt"
        data = repo.read(file)
        if data is None:
            raise FileNotFoundError(f"{repo.folder.name}: no file {file}")
        names += data.decode().split()
    repo.close()
    return {coco_id(name) for name in names if name.startswith("COCO_val2014_")}


def name_hash(name):
    return hashlib.sha1(name.encode()).hexdigest()[:12]


def cosines(count, size):
    k, x = np.arange(count)[:, None], np.arange(size)[None, :]
    return np.cos(np.pi * k * (2 * x + 1) / (2 * size))


def perceptual_hash(image):
    """64 bits: which low frequencies of the brightness exceed their median."""
    pixels = np.asarray(image.convert("L").resize((32, 32), Image.BOX), float)
    basis = cosines(8, 32)
    values = (basis @ pixels @ basis.T).reshape(-1)
    return np.packbits(values > np.median(values[1:])).view(">u8")[0].astype(np.uint64)


def mirrored(image):
    return image.transpose(Image.FLIP_LEFT_RIGHT)


BIT_COUNTS = np.array([bin(value).count("1") for value in range(256)], np.uint8)


class KnownImages:
    """Hashes of images, to find one that looks the same."""

    def __init__(self):
        self.names, self._hashes = [], np.zeros(1024, np.uint64)

    def add(self, name, image):
        self.add_hashes(name, [perceptual_hash(image), perceptual_hash(mirrored(image))])

    def add_hashes(self, name, hashes):
        for value in hashes:
            if len(self.names) == len(self._hashes):
                self._hashes = np.concatenate((self._hashes, np.zeros_like(self._hashes)))
            self._hashes[len(self.names)] = value
            self.names.append(name)

    def nearest(self, value):
        if not self.names:
            return 64, ""
        differences = (self._hashes[: len(self.names)] ^ value).view(np.uint8).reshape(-1, 8)
        distances = BIT_COUNTS[differences].sum(axis=1)
        at = int(distances.argmin())
        return int(distances[at]), self.names[at]


# ---------------------------------------------------------------- writing


def annotation_of(entry, scale, size):
    """COCO annotation of an object in an image that is scaled to the size."""
    box = [round(value * s, 2) for value, s in zip(entry.box, scale * 2)]
    result = {"category_id": entry.category, "bbox": box, "iscrowd": int(entry.crowd)}
    if entry.crowd:
        result["ignore"] = 1
    if entry.mask is not None:
        mask = resized_mask(entry.mask, size)
        if not mask.any():
            return None
        result.update(bbox=box_of(mask), area=int(mask.sum()), segmentation=encode_rle(mask))
    elif entry.polygons:
        polygons = [
            [round(v, 2) for v in scaled_points(points, *scale)] for points in entry.polygons
        ]
        area = round(sum(polygon_area(points) for points in polygons), 2)
        result.update(bbox=box_of_polygons(polygons), area=area, segmentation=polygons)
    else:
        area = round(box[2] * box[3], 2)
        result.update(area=area, segmentation=[], box_only=True)
    return result if result["area"] > 0 else None


def write_csv(path, head, rows):
    with open(path, "w", newline="") as out:
        csv.writer(out, lineterminator="\n").writerows([head, *rows])


class CocoFile:
    """Images and annotations of a COCO file."""

    def __init__(self):
        self.images, self.annotations = [], []

    def add(self, image, annotations):
        image["id"] = len(self.images) + 1
        self.images.append(image)
        for entry in annotations:
            self.annotations.append(
                {"id": len(self.annotations) + 1, "image_id": image["id"], **entry}
            )

    def write(self, path):
        content = {
            "images": self.images, "annotations": self.annotations, "categories": CATEGORIES
        }
        path.write_text(json.dumps(content, separators=(",", ":")))


class Collection:
    """Everything that is written."""

    def __init__(self, repositories, output, left_out):
        self.repositories, self.output, self.left_out = repositories, output, left_out
        self.holdout = KnownImages()
        self.taken, self.taken_ids = KnownImages(), set()
        self.holdout_ids = set()
        self.near, self.reports, self.refused = [], [], []
        for part in ("train", "empty", "empty_holdout", "holdout"):
            (output / part / "images").mkdir(parents=True, exist_ok=True)
            for old in (output / part / "images").iterdir():
                old.unlink()
        self.labels = Repository(repositories / COCO_LABELS, COCO_LABELS_COMMIT)
        self.val_ids = {coco_id(n) for n in self.labels.below("coco/labels/val2017/", (".txt",))}
        self.val2014_ids = val2014_ids(Repository(repositories / COCO_SPLITS))

    def pictures(self, source, report):
        """Readable pictures of a source: picture, bytes, image."""
        repo = Repository(self.repositories / source.repository)
        for picture in source.read(repo, report, self.labels):
            report.images += 1
            data = repo.read(picture.name)
            if data is None:
                report.bad_image(picture.name, "image is missing")
                continue
            try:
                image = Image.open(io.BytesIO(data)).convert("RGB")
            except (OSError, ValueError, SyntaxError):
                report.bad_image(picture.name, "image cannot be read")
                continue
            yield picture, data, image
        repo.close()

    def unwanted(self, source, name):
        """Why an image is not taken, judged by its name; empty if it is."""
        number = coco_id(name) if source.coco else None
        if f"{source.name}/{name}" in self.left_out:
            return "left out by list"
        for beginning, why in source.without.items():
            if re.match(beginning, Path(name).name):
                return why
        if number is None:
            return ""
        if number in self.val_ids or number in self.val2014_ids:
            return "COCO val"
        if number in self.holdout_ids:
            return "id of hold-out"
        if number in self.taken_ids:
            return "id taken already"
        return ""

    def looks_unwanted(self, file, image):
        """The same, judged by what the image looks like."""
        value = perceptual_hash(image)
        distance, other = self.holdout.nearest(value)
        if distance <= NEAR_DISTANCE:
            self.near.append([distance, file, other])
        if distance <= SAME_DISTANCE:
            return "looks like hold-out"
        if self.taken.nearest(value)[0] <= TWIN_DISTANCE:
            return "looks like another"
        self.taken.add_hashes(file, [value])
        return ""

    def report(self, source):
        for report in self.reports:
            if report.source == source.name:
                return report
        self.reports.append(Report(source.name))
        return self.reports[-1]

    def add_known(self, file):
        """Adds the hold-out images of a COCO file, which lie beside it or in images/."""
        file = Path(file)
        for entry in json.loads(file.read_text())["images"]:
            if entry.get("split", "holdout") != "holdout":
                continue
            paths = [file.parent / entry["file_name"], file.parent / "images" / entry["file_name"]]
            path = next((p for p in paths if p.is_file()), None)
            if path is None:
                print(f"{file.name}: {entry['file_name']}: image is missing")
                continue
            self.holdout.add(entry["file_name"], Image.open(path).convert("RGB"))

    def collect_people(self, file):
        """A COCO file's images for training that are neither of COCO val nor like a hold-out."""
        content = json.loads(file.read_text())
        kept = []
        for entry in content["images"]:
            if entry.get("split") == "holdout" or entry.get("source", "").startswith("coco_val"):
                continue
            path = file.parent / "images" / entry["file_name"]
            if not path.is_file():
                print(f"{file.name}: {entry['file_name']}: image is missing")
                continue
            value = perceptual_hash(Image.open(path).convert("RGB"))
            if self.holdout.nearest(value)[0] > SAME_DISTANCE:
                kept.append(entry)
        ids = {entry["id"] for entry in kept}
        annotations = [e for e in content["annotations"] if e["image_id"] in ids]
        content.update(images=kept, annotations=annotations)
        (self.output / "people.json").write_text(json.dumps(content, separators=(",", ":")))
        print(f"people.json: {len(kept)} images")

    def collect_holdout(self):
        """Copies images and annotations as they are."""
        coco = CocoFile()
        for source in HOLDOUT:
            report = self.report(source)
            for picture, data, image in self.pictures(source, report):
                number = coco_id(picture.name)
                if number in self.val_ids or number in self.holdout_ids:
                    report.drop("COCO val" if number in self.val_ids else "id taken already")
                    continue
                self.holdout_ids.add(number)
                file = f"{number:012d}.jpg"
                (self.output / "holdout" / "images" / file).write_bytes(data)
                self.holdout.add(file, image)
                objects = picture.objects(*image.size)
                good = checked(objects, picture.name, *image.size, report)
                found = [annotation_of(entry, (1.0, 1.0), image.size) for entry in good]
                coco.add(
                    {"file_name": file, "width": image.width, "height": image.height,
                     "split": source.name, "source": source.name, "origin": picture.name},
                    [entry for entry in found if entry],
                )
        coco.write(self.output / "holdout" / "instances.json")
        return coco

    def small_image(self, source, name, image):
        """Name and image at the size that is written."""
        scale = min(1.0, LONGEST_SIDE / max(image.size))
        size = tuple(max(1, round(side * scale)) for side in image.size)
        small = image if size == image.size else image.resize(size, Image.BICUBIC, None, 2.0)
        number = coco_id(name) if source.coco else None
        return (name_hash(name) if number is None else f"{number:012d}"), small

    def collect_empty(self):
        """Reads all, takes the hold-out by hash of the names, drops what looks like it."""
        folder = self.output / "empty" / "images"
        found = []
        for source in EMPTY:
            report = self.report(source)
            for picture, _, image in self.pictures(source, report):
                why = self.unwanted(source, picture.name)
                if why:
                    report.drop(why)
                    continue
                key, small = self.small_image(source, picture.name, image)
                file = f"{source.name}_{key}.jpg"
                small.save(folder / file, quality=QUALITY)
                found.append((source, file, picture.name))
            if report.refusal():
                self.refuse(report)
                found = [entry for entry in found if entry[0].name != source.name]
        held = self.hold_out_empty(found)
        kept = []
        for source, file, name in found:
            if file in held:
                continue
            why = self.looks_unwanted(f"{source.name}/{name}", Image.open(folder / file))
            if why:
                self.report(source).drop(why)
                (folder / file).unlink()
                continue
            kept.append([source.name, file, name])
        held_rows = [[source.name, file, name] for source, file, name in found if file in held]
        for part, rows in [("empty", kept), ("empty_holdout", held_rows)]:
            write_csv(self.output / part / "images.csv", ["source", "file", "origin"], rows)
        return kept, held

    def hold_out_empty(self, found):
        """Moves the same number of images of each source to the hold-out."""
        held, sources = set(), sorted({source.name for source, _, _ in found})
        for name in sources:
            files = [file for source, file, _ in found if source.name == name]
            held.update(sorted(files, key=name_hash)[: EMPTY_HOLDOUT // len(sources)])
        for file in sorted(held):
            path = self.output / "empty_holdout" / "images" / file
            (self.output / "empty" / "images" / file).rename(path)
            self.holdout.add(file, Image.open(path).convert("RGB"))
        return held

    def collect_training(self):
        found = {}
        for source in TRAINING:
            report = self.report(source)
            for picture, _, image in self.pictures(source, report):
                entry = self.training_image(source, picture, image, report)
                if entry:
                    found.setdefault(source.name, []).append(entry)
        coco = CocoFile()
        for report in self.reports:
            entries = found.get(report.source, [])
            if entries and report.refusal():
                self.refuse(report)
                for image, _ in entries:
                    (self.output / "train" / "images" / image["file_name"]).unlink()
                continue
            for image, annotations in entries:
                coco.add(image, annotations)
        coco.write(self.output / "train" / "instances.json")
        return coco

    def training_image(self, source, picture, image, report):
        why = self.unwanted(source, picture.name)
        if why:
            report.drop(why)
            return None
        objects = checked(
            picture.objects(*image.size), picture.name, *image.size, report
        )
        mark_crowds(objects)
        key, small = self.small_image(source, picture.name, image)
        scale = (small.width / image.width, small.height / image.height)
        found = [annotation_of(entry, scale, small.size) for entry in objects]
        annotations = [entry for entry in found if entry]
        if not annotations and not source.keep_empty:
            report.drop("without objects")
            return None
        why = self.looks_unwanted(f"{source.name}/{picture.name}", small)
        if why:
            report.drop(why)
            return None
        file = f"{source.name}_{key}.jpg"
        small.save(self.output / "train" / "images" / file, quality=QUALITY)
        entry = {"file_name": file, "width": small.width, "height": small.height,
                 "split": source.name, "source": source.name, "origin": picture.name}
        if source.partial:
            entry["partial"] = list(source.partial)
        if source.coco and coco_id(picture.name) is not None:
            entry["coco_id"] = coco_id(picture.name)
            self.taken_ids.add(entry["coco_id"])
        return entry, annotations

    def refuse(self, report):
        self.refused.append(report.source)
        print(f"{report.source}: refused: {report.refusal()}")


# ---------------------------------------------------------------- main


def print_counts(collection, coco_files, empty):
    """One line for each source."""
    images, objects, masks = {}, {}, {}
    for coco in coco_files:
        source_of = {image["id"]: image["source"] for image in coco.images}
        for source in source_of.values():
            images[source] = images.get(source, 0) + 1
        for entry in coco.annotations:
            key = (source_of[entry["image_id"]], entry["category_id"])
            objects[key] = objects.get(key, 0) + 1
            masks[key] = masks.get(key, 0) + bool(entry["segmentation"])
    for name, _, _ in empty:
        images[name] = images.get(name, 0) + 1
    print("source: images; people, of these with mask; vehicles; bad images, annotations; dropped")
    for report in collection.reports:
        name = report.source
        dropped = ", ".join(f"{n} {why}" for why, n in sorted(report.dropped.items())) or "none"
        print(
            f"{name}: {images.get(name, 0)}; {objects.get((name, PERSON), 0)}, "
            f"{masks.get((name, PERSON), 0)}; {objects.get((name, AGV), 0)}; "
            f"{report.bad_images}, {report.bad_annotations}; {dropped}"
        )


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("repositories", type=Path, help="folder of the repositories")
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument(
        "--leave-out", type=Path, help="file of lines 'source/name' of images that are not taken"
    )
    parser.add_argument(
        "--holdout", action="append", default=[], metavar="JSON",
        help="COCO file whose images (of the split 'holdout') must not be trained on",
    )
    parser.add_argument(
        "--people", type=Path, metavar="JSON", help="COCO file of other people, beside images/"
    )
    options = parser.parse_args(arguments)
    left_out = set(options.leave_out.read_text().splitlines()) if options.leave_out else set()
    try:
        collection = Collection(options.repositories, options.output, left_out)
        for file in options.holdout:
            collection.add_known(file)
        wild = collection.collect_holdout()
        if options.people:
            collection.collect_people(options.people)
        empty, held = collection.collect_empty()
        training = collection.collect_training()
    except FileNotFoundError as error:
        print(error, file=sys.stderr)
        return 1
    near = sorted(collection.near)
    write_csv(options.output / "near_pairs.csv", ["distance", "image", "holdout"], near)
    print_counts(collection, [wild, training], empty)
    print(f"empty_holdout: {len(held)}")
    collection.labels.close()
    return 1 if collection.refused else 0


if __name__ == "__main__":
    sys.exit(main())
