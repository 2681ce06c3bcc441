#!/usr/bin/env python3
"""Tests of collect_data.py on small example sources."""

import contextlib
import io
import json
import subprocess
import tempfile
import unittest
import unittest.mock
from pathlib import Path

import numpy as np
from PIL import Image

import collect_data as collect


def noise(seed, width=80, height=60):
    """An image that looks like no other: coarse noise."""
    pixels = np.random.default_rng(seed).integers(0, 256, (8, 8, 3)).astype(np.uint8)
    return Image.fromarray(pixels).resize((width, height), Image.BICUBIC)


def write(path, content):
    path.parent.mkdir(parents=True, exist_ok=True)
    if isinstance(content, Image.Image):
        content.save(path)
    else:
        path.write_text(content if isinstance(content, str) else json.dumps(content))


def coco(images, annotations):
    return {
        "images": [
            {"id": number, "file_name": name, "width": 80, "height": 60}
            for number, name in images
        ],
        "annotations": [
            {"id": number, "category_id": 1, "bbox": [10, 10, 20, 30], "iscrowd": 0,
             "segmentation": [[10, 10, 30, 10, 30, 40, 10, 40]], **entry}
            for number, entry in enumerate(annotations, 1)
        ],
        "categories": [{"id": 1, "name": "person"}, {"id": 2, "name": "dog"}],
    }


class Sources(unittest.TestCase):
    """Repositories in a temporary folder; every test adds files to its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name) / "repositories"
        self.output = Path(folder.name) / "out"
        for source in [*collect.TRAINING, *collect.EMPTY, *collect.HOLDOUT]:
            (self.root / source.repository).mkdir(parents=True, exist_ok=True)
        (self.root / collect.VOC_LABELS).mkdir()
        nothing = coco([], [])
        for name, files in {
            "Obmutescence+COCO-MINI": ["annotations/instances_train2017.json"],
            "zzowenzz+COCO_Tiny": ["annotations/instances_train2017.json"],
            "MatrixLeung+Borrat-Teacher-Occlusion-Dataset":
                [f"{part}/_annotations.coco.json" for part in ("train", "valid")],
            "Julito22+Mask-R-CNN-PFG": ["annotations/person_keypoints_train2017.json"],
            "KhiemCE22+Application-PPE": ["train/_annotations.coco.json"],
            "NguyenManhDung27+BAV_classroom_monitoring_CV":
                [f"Dataset for Detection/{part}/_annotations.coco.json"
                 for part in ("train", "valid", "test")],
            "katiehur5+cafe-people-detection":
                [f"data/annotations/{part}.json" for part in ("train", "valid", "test")],
            "mchoccie+DeepDataMiningLearning":
                [f"data/annotations/instances_{part}2017.json" for part in ("train", "val")],
            "developer0hye+COCO128": ["annotations/instances_train2017.json"],
            "lizhogn+tiny_coco_dataset": ["tiny_coco/annotations/instances_train2017.json"],
        }.items():
            for file in files:
                write(self.root / name / file, nothing)
        self.labels = self.root / collect.COCO_LABELS
        write(self.labels / "coco/labels/val2017/000000000139.txt", "0 0.5 0.5 0.2 0.2\n")
        for part in ("restval", "val", "test"):
            names = f"COCO_{part}2014_000000000041.jpg\nCOCO_val2014_000000000042.jpg\n"
            write(self.root / collect.COCO_SPLITS / f"splits/coco_{part}.txt", names)
        boxes = "0 0.5 0.5 0.25 0.5\n16 0 0 1 1"
        write(self.labels / "coco/labels/train2017/000000000036.txt", boxes)
        patch = unittest.mock.patch.object(collect, "COCO_LABELS_COMMIT", "HEAD")
        patch.start()
        self.addCleanup(patch.stop)

    def at(self, repository, name, content):
        write(self.root / repository / name, content)

    def collect(self, *options):
        """Runs the script; gives its messages."""
        text = io.StringIO()
        with contextlib.redirect_stdout(text), contextlib.redirect_stderr(text):
            self.status = collect.main([str(self.root), "-o", str(self.output), *options])
        return text.getvalue().splitlines()

    def result(self, part="train"):
        return json.loads((self.output / part / "instances.json").read_text())

    def forklift(self, number, label, image=None):
        folder = "data/forklift_data"
        repository = "AkkapakaManikanta+yolov5_forklift"
        image = image or noise(100 + number)
        self.at(repository, f"{folder}/images/train/{number}.jpg", image)
        if label is not None:
            self.at(repository, f"{folder}/labels/train/{number}.txt", label)


class Formats(Sources):
    def test_yolo_boxes_and_polygons(self):
        self.forklift(1, "0 0.5 0.5 0.25 0.5\n1 0.25 0.25 0.5 0.25 0.5 0.75\n")
        self.collect()
        box, polygon = self.result()["annotations"]
        self.assertEqual(
            box,
            {"id": 1, "image_id": 1, "category_id": 2, "bbox": [30, 15, 20, 30], "iscrowd": 0,
             "area": 600, "segmentation": [], "box_only": True},
        )
        self.assertEqual(polygon["category_id"], 1)
        self.assertEqual(polygon["bbox"], [20, 15, 20, 30])
        self.assertEqual(polygon["segmentation"], [[20, 15, 40, 15, 40, 45]])
        self.assertEqual(polygon["area"], 300)

    def test_pictures_with_boxes_in_another_repository(self):
        for seed, name in enumerate(["2008_000008", "2008_000009", "ca1"]):
            self.at("mateusrafael4+Atividade_programacao_pose_estimation", f"images/{name}.jpg",
                    noise(80 + seed))
        for name, text in {"2008_000008": "3 0.5 0.5 0.25 0.5", "2008_000009": "4 0 0 1 1"}.items():
            self.at(collect.VOC_LABELS, f"data/labels/train/{name}.txt", text)
        self.collect()
        self.assertEqual(
            [image["origin"] for image in self.result()["images"]],
            ["images/2008_000008.jpg", "images/2008_000009.jpg"],
        )
        person, = self.result()["annotations"]
        self.assertEqual(person["bbox"], [30, 15, 20, 30])

    def test_corners_in_pixels(self):
        repository = "BernieChen96+ImageClassification"
        for number, text in enumerate(["car 1 2 30 40\nperson 10 5 40 50 \n", "cat 1 1 9 9\n", "car 1"]):
            self.at(repository, f"JPEGImages/00000{number}.jpg", noise(90 + number))
            self.at(repository, f"HandledText/initTxt/00000{number}.txt", text)
        self.assertIn(
            "traffic: JPEGImages/000002.jpg: line 1: is not 'class left top right bottom'",
            self.collect(),
        )
        self.assertEqual(len(self.result()["images"]), 3)
        self.assertEqual([e["bbox"] for e in self.result()["annotations"]], [[10, 5, 30, 45]])

    def test_boxes_around_many_people_are_crowds(self):
        people = "".join(f"1 {0.2 + 0.2 * i} 0.5 0.1 0.3\n" for i in range(3))
        self.forklift(1, f"{people}1 0.4 0.5 0.8 0.5\n")
        self.forklift(2, f"{people}1 0.4 0.5 0.6 0.9\n")  # taller than wide: a person in front
        self.forklift(3, f"{people}0 0.4 0.5 0.8 0.5\n")  # a vehicle
        self.collect()
        crowds = [e["id"] for e in self.result()["annotations"] if e["iscrowd"]]
        self.assertEqual(crowds, [4])

    def test_large_images_are_scaled_with_their_annotations(self):
        self.forklift(1, "0 0.5 0.5 0.25 0.5\n", noise(1, 896, 448))
        self.collect()
        image, = self.result()["images"]
        self.assertEqual((image["width"], image["height"]), (640, 320))
        with Image.open(self.output / "train/images" / image["file_name"]) as picture:
            self.assertEqual(picture.size, (640, 320))
        self.assertEqual(self.result()["annotations"][0]["bbox"], [240, 80, 160, 160])

    def test_coco_polygons_crowds_and_other_classes(self):
        crowd = {"size": [60, 80], "counts": [0, 120, 4680]}
        self.at(
            "Obmutescence+COCO-MINI", "annotations/instances_train2017.json",
            coco([(7, "000000000007.jpg")],
                 [{"image_id": 7}, {"image_id": 7, "category_id": 2},
                  {"image_id": 7, "iscrowd": 1, "segmentation": crowd, "bbox": [0, 0, 2, 60]}]),
        )
        self.at("Obmutescence+COCO-MINI", "train2017/000000000007.jpg", noise(7))
        self.collect()
        image, = self.result()["images"]
        self.assertEqual(image["file_name"], "coco_mini_000000000007.jpg")
        self.assertEqual((image["source"], image["coco_id"]), ("coco_mini", 7))
        person, many = self.result()["annotations"]
        self.assertEqual(person["segmentation"], [[10, 10, 30, 10, 30, 40, 10, 40]])
        self.assertEqual((person["area"], person["iscrowd"]), (600, 0))
        self.assertEqual((many["iscrowd"], many["ignore"]), (1, 1))
        self.assertEqual(many["segmentation"], crowd)

    def test_compressed_rle(self):
        self.assertEqual(collect.decode_counts("04T1"), [0, 4, 36])
        self.assertEqual(collect.decode_counts("5552"), [5, 5, 5, 7])

    def test_mask_pictures(self):
        mask = np.zeros((60, 80), np.uint8)
        mask[20:50, 30:40] = 255
        repository = "VikramShenoy97+Human-Segmentation-Dataset"
        self.at(repository, "Training_Images/1.jpg", noise(1))
        self.at(repository, "Ground_Truth/1.png", Image.fromarray(mask))
        self.collect()
        annotation, = self.result()["annotations"]
        self.assertEqual(annotation["bbox"], [30, 20, 10, 30])
        self.assertEqual(annotation["area"], 300)
        self.assertTrue((collect.decode_rle(annotation["segmentation"]) == (mask > 0)).all())

    def test_classes_without_annotation_are_marked(self):
        self.at("VarunBal+forklift-detector", "dataset/train_data/1.jpg", noise(1))
        self.at("VarunBal+forklift-detector", "dataset/train_data/1.txt", "0 0.5 0.5 0.5 0.5")
        self.collect()
        self.assertEqual(self.result()["images"][0]["partial"], ["person"])

    def test_bare_git_repository(self):
        repository = "AkkapakaManikanta+yolov5_forklift"
        self.forklift(1, "0 0.5 0.5 0.25 0.5\n")
        folder = self.root / repository
        git = ["git", "-C", str(folder), "-c", "user.name=a", "-c", "user.email=a@b"]
        subprocess.run([*git, "init", "-q"], check=True)
        subprocess.run([*git, "add", "."], check=True)
        subprocess.run([*git, "commit", "-q", "-m", "a"], check=True)
        (self.root / "bare").mkdir()
        (folder / ".git").rename(self.root / "bare" / "repo")
        subprocess.run(["rm", "-r", str(folder)], check=True)
        (self.root / "bare").rename(folder)
        self.collect()
        self.assertEqual(len(self.result()["annotations"]), 1)


class NeverTrainedOn(Sources):
    def setUp(self):
        super().setUp()
        self.at(
            "developer0hye+COCO128", "annotations/instances_train2017.json",
            coco([(9, "000000000009.jpg")], [{"image_id": 9}]),
        )
        self.at("developer0hye+COCO128", "train2017/000000000009.jpg", noise(9))

    def human(self, name, image):
        repository = "brianhuster+human-dataset"
        self.at(repository, f"train/images/{name}.jpg", image)
        self.at(repository, f"train/labels/{name}.txt", "0 0.5 0.5 0.5 0.5")

    def count_line(self, messages, source):
        line, = [m for m in messages if m.startswith(f"{source}: ") and m.count(";") == 4]
        return line

    def test_holdout_is_copied_as_it_is(self):
        self.collect()
        image, = self.result("holdout")["images"]
        self.assertEqual(image["file_name"], "000000000009.jpg")
        source = self.root / "developer0hye+COCO128/train2017/000000000009.jpg"
        copy = self.output / "holdout/images/000000000009.jpg"
        self.assertEqual(copy.read_bytes(), source.read_bytes())
        self.assertEqual(self.result("holdout")["annotations"][0]["area"], 600)

    def test_drops_val_ids_holdout_ids_and_copies(self):
        self.human("000000000139_jpg.rf.1", noise(1))
        self.human("000000000042_jpg.rf.1", noise(5))
        self.human("000000000009_jpg.rf.1", noise(2))
        self.human("000000000040_jpg.rf.1", noise(3))
        self.human("000000000040_jpg.rf.2", noise(4))
        self.human("renamed", noise(9))
        self.human("renamed_and_mirrored", collect.mirrored(noise(9)))
        self.human("twin", noise(3))
        for number, name in enumerate(["DJI_1", "-12-_jpg.rf.1", "img_1", "person_1"]):
            self.human(name, noise(50 + number))
        line = self.count_line(self.collect(), "human")
        self.assertEqual(
            line,
            "human: 1; 1, 0; 0; 0, 0; 2 COCO val, 1 altered copy of Penn-Fudan, 1 collage, "
            "2 drone, 1 id of hold-out, 1 id taken already, 1 looks like another, "
            "2 looks like hold-out",
        )
        pairs = (self.output / "near_pairs.csv").read_text().splitlines()
        self.assertEqual(pairs[0], "distance,image,holdout")
        self.assertEqual(len(pairs), 3)

    def test_drops_further_holdouts(self):
        folder = self.output.parent / "people"
        write(folder / "images/a.jpg", noise(20))
        write(folder / "images/b.jpg", noise(21))
        images = [{"id": 1, "file_name": "a.jpg", "split": "holdout"},
                  {"id": 2, "file_name": "b.jpg", "split": "train"}]
        write(folder / "instances.json", {"images": images})
        self.human("a", noise(20))
        self.human("b", noise(21))
        messages = self.collect("--holdout", str(folder / "instances.json"))
        self.assertEqual(
            self.count_line(messages, "human"),
            "human: 1; 1, 0; 0; 0, 0; 1 looks like hold-out",
        )

    def test_people_without_val_and_hold_outs(self):
        folder = self.output.parent / "people"
        images = []
        for number, (split, source) in enumerate(
            [("train", "a"), ("train", "coco_val_single"), ("holdout", "a"), ("train", "a")], 1
        ):
            file = f"{number}.jpg"
            write(folder / "images" / file, noise(30 if number == 4 else 20 + number))
            images.append({"id": number, "file_name": file, "split": split, "source": source})
        write(folder / "instances.json",
              {"images": images, "annotations": [{"image_id": 1}, {"image_id": 2}]})
        self.at("developer0hye+COCO128", "train2017/000000000030.jpg", noise(30))
        write(self.root / "developer0hye+COCO128/annotations/instances_train2017.json",
              coco([(30, "000000000030.jpg")], [{"image_id": 30}]))
        messages = self.collect("--people", str(folder / "instances.json"))
        people = json.loads((self.output / "people.json").read_text())
        self.assertEqual([image["id"] for image in people["images"]], [1])
        self.assertEqual(people["annotations"], [{"image_id": 1}])
        self.assertIn("people.json: 1 images", messages)

    def test_boxes_of_coco(self):
        self.at("yuanyl00+miniCOCO", "COCO/train2017/000000000036.jpg", noise(36))
        self.collect()
        person, = self.result()["annotations"]
        self.assertEqual(person["bbox"], [30, 15, 20, 30])

    def test_empty_rooms(self):
        for number in range(130):
            self.at("emanhamed+Houses-dataset", f"Houses Dataset/{number}_kitchen.jpg",
                    noise(1000 + number))
        self.at("emanhamed+Houses-dataset", "Houses Dataset/1_frontal.jpg", noise(50))
        left_out = self.output.parent / "left_out.txt"
        left_out.write_text("houses/Houses Dataset/7_kitchen.jpg\n")
        messages = self.collect("--leave-out", str(left_out))
        self.assertIn("empty_holdout: 129", messages)
        self.assertEqual(len(list((self.output / "empty_holdout/images").iterdir())), 129)
        with unittest.mock.patch.object(collect, "EMPTY_HOLDOUT", 29):
            messages = self.collect("--leave-out", str(left_out))
        self.assertEqual(
            self.count_line(messages, "houses"), "houses: 100; 0, 0; 0; 0, 0; 1 left out by list"
        )
        first = sorted(path.name for path in (self.output / "empty_holdout/images").iterdir())
        with unittest.mock.patch.object(collect, "EMPTY_HOLDOUT", 29):
            self.collect("--leave-out", str(left_out))
        again = sorted(path.name for path in (self.output / "empty_holdout/images").iterdir())
        self.assertEqual(first, again)


    def test_pictures_of_animals_are_without_people(self):
        for seed, name in enumerate(["ant/1.jpg", "Faces/1.jpg"]):
            self.at("MachineLearning2020+Homework2-Caltech101", f"101_ObjectCategories/{name}",
                    noise(70 + seed))
        self.collect()
        image, = self.result()["images"]
        self.assertEqual(image["origin"], "101_ObjectCategories/ant/1.jpg")
        self.assertEqual(self.result()["annotations"], [])


class BadInput(Sources):
    PATH = "data/forklift_data/images/train"

    def setUp(self):
        super().setUp()
        for number in range(10, 20):
            self.forklift(number, "0 0.5 0.5 0.25 0.5\n")

    def test_bad_lines(self):
        self.forklift(1, "0 1.5 0.5 0.5 0.5\n0 0.5 0.5 0 0.5\n7 0.5 0.5 0.1 0.1\n0 0.5 word\n"
                         "0 0.5 0.5 0.25 0.5\n")
        messages = self.collect()
        for line in [
            "line 1: box outside of the image",
            "line 2: box of zero area",
            "line 3: no class 7",
            "line 4: is neither 'class x y w h' nor a polygon",
        ]:
            self.assertIn(f"forklift: {self.PATH}/1.jpg: {line}", messages)
        self.assertIn("forklift: 11; 0, 0; 11; 0, 4; none", messages)
        self.assertEqual(self.status, 0)

    def test_bad_images(self):
        self.forklift(1, None)
        self.forklift(2, "0 0.5 0.5 0.25 0.5\n")
        (self.root / "AkkapakaManikanta+yolov5_forklift" / self.PATH / "2.jpg").write_text("no")
        messages = self.collect()
        self.assertIn(f"forklift: {self.PATH}/1.jpg: has no label file", messages)
        self.assertIn(f"forklift: {self.PATH}/2.jpg: image cannot be read", messages)
        self.assertIn("forklift: 10; 0, 0; 10; 2, 0; none", messages)

    def test_bad_coco_file(self):
        data = coco(
            [(1, "a.jpg"), (2, "b.jpg")],
            [{"image_id": 1}, {"image_id": 1, "category_id": 9}, {"image_id": 8},
             {"image_id": 1, "segmentation": [[1, 2, 3]]},
             {"image_id": 1, "bbox": [1, 2, "x", 4]},
             {"image_id": 1, "bbox": [100, 10, 20, 20]}, {"image_id": 1, "bbox": [9, 9, 0, 9]},
             {"image_id": 1}, {"image_id": 1}, {"image_id": 1}, {"image_id": 1},
             {"image_id": 1}, {"image_id": 1}],
        )
        file = "annotations/person_keypoints_train2017.json"
        self.at("Julito22+Mask-R-CNN-PFG", file, data)
        self.at("Julito22+Mask-R-CNN-PFG", "train2017/a.jpg", noise(1))
        messages = self.collect()
        for line in [
            f"{file}: annotation 2: no category 9",
            f"{file}: annotation 3: no image 8",
            "a.jpg: annotation 4: mask cannot be read",
            "a.jpg: annotation 5: box cannot be read",
            "train2017/a.jpg: annotation 6: box outside of the image",
            "train2017/a.jpg: annotation 7: box of zero area",
            "train2017/b.jpg: image is missing",
        ]:
            self.assertIn(f"pfg: {line}", messages)
        self.assertIn("pfg: 1; 7, 7; 0; 1, 6; none", messages)

    def test_bad_masks(self):
        repository = "VikramShenoy97+Human-Segmentation-Dataset"
        full = Image.new("L", (80, 60), 255)
        for number, mask in enumerate([full, full, full, full, Image.new("L", (60, 80), 255),
                                       Image.new("L", (80, 60)), None]):
            self.at(repository, f"Training_Images/{number}.jpg", noise(number))
            if mask:
                self.at(repository, f"Ground_Truth/{number}.png", mask)
        self.at(repository, "Training_Images/7.jpg", noise(7))
        self.at(repository, "Ground_Truth/7.png", "no image")
        messages = self.collect()
        for line in ["4.jpg: mask is 60x80, the image 80x60", "5.jpg: mask: box of zero area",
                     "6.jpg: has no mask file", "7.jpg: mask cannot be read"]:
            self.assertIn(f"human_masks: Training_Images/{line}", messages)
        self.assertIn("human_masks: 4; 4, 4; 0; 1, 3; 3 without objects", messages)

    def test_refuses_a_set_with_more_than_half_bad(self):
        for number in range(1, 12):
            self.forklift(number, "0 1.5 0.5 0.5 0.5\n")
        for number in range(20, 25):
            self.forklift(number, "0 1.5 0.5 0.5 0.5\n")
        self.at("VarunBal+forklift-detector", "dataset/train_data/1.jpg", noise(1))
        self.at("VarunBal+forklift-detector", "dataset/train_data/1.txt", "0 0.5 0.5 0.5 0.5")
        messages = self.collect()
        self.assertIn("forklift: refused: 16 of 24 annotations are bad", messages)
        self.assertEqual(self.status, 1)
        image, = self.result()["images"]
        self.assertEqual(image["source"], "forklift_only")
        self.assertEqual(len(list((self.output / "train/images").iterdir())), 1)

    def test_missing_repository(self):
        (self.root / "emanhamed+Houses-dataset").rmdir()
        message, = self.collect()[-1:]
        self.assertEqual(
            message, f"emanhamed+Houses-dataset: not found in {self.root}"
        )
        self.assertEqual(self.status, 1)


if __name__ == "__main__":
    unittest.main()
