"""Rendered captures as samples to train on."""

import json
import os
from dataclasses import dataclass
from typing import Optional

import numpy as np
from PIL import Image

from layers import CLASS_NAMES

KEPT_HEIGHT = 360  # rows that a sample keeps: enough for 240 after turning and enlarging
FIRST_ITEM, LAST_ITEM = 2, 199
CARD = 255


@dataclass
class Sample:
    """One view. `allowed` has a bit for each class that a pixel may be: without kinds_N.png a dish may be glaze
    or rim, and what has no label table, cutlery or napkin."""

    name: str
    picture: np.ndarray  # H x W x 3 bytes, RGB
    allowed: np.ndarray  # H x W bytes
    items: np.ndarray  # H x W bytes: labels of items, 0 elsewhere
    foods: dict  # name of each item's food
    bare: Optional["Sample"] = None  # the same view of the same scene without food


def bits(*names):
    return sum(1 << CLASS_NAMES.index(name) for name in names)


ANYTHING = bits(*CLASS_NAMES)  # what a pixel may be that shows nothing known


def allowed_by_labels(labels):
    table = np.full(256, bits("glaze", "rim"), np.uint8)  # dishes: 1, 201 to 249
    table[0] = bits("table", "cutlery", "napkin")
    table[FIRST_ITEM : LAST_ITEM + 1] = bits("food")
    table[CARD] = bits("card")
    return table[labels]


def allowed_by_kinds(kinds):
    """Pixels that show nothing (0) may be anything."""
    table = np.full(256, ANYTHING, np.uint8)
    for index in range(len(CLASS_NAMES)):
        table[index + 1] = 1 << index
    return table[kinds]


def read_reduced(path, size, resampling):
    with Image.open(path) as picture:
        return np.asarray(picture.convert("RGB" if resampling == Image.BOX else "L").resize(size, resampling))


def read_capture(folder):
    with open(os.path.join(folder, "capture.json"), encoding="utf-8") as stream:
        description = json.load(stream)
    foods = {}
    truth = os.path.join(folder, "truth.json")
    if os.path.exists(truth):
        with open(truth, encoding="utf-8") as stream:
            foods = {item["label"]: item["name"] for item in json.load(stream)["items"]}
    samples = []
    for index, view in enumerate(description["views"]):
        if "labels" not in view:
            continue
        picture_file = os.path.join(folder, view["image"])
        with Image.open(picture_file) as picture:
            width, height = picture.size
        size = (round(KEPT_HEIGHT * width / height), KEPT_HEIGHT)
        labels = read_reduced(os.path.join(folder, view["labels"]), size, Image.NEAREST)
        kinds_file = os.path.join(folder, f"kinds_{index}.png")
        if os.path.exists(kinds_file):
            allowed = allowed_by_kinds(read_reduced(kinds_file, size, Image.NEAREST))
        else:
            allowed = allowed_by_labels(labels)
        items = np.where((labels >= FIRST_ITEM) & (labels <= LAST_ITEM), labels, 0).astype(np.uint8)
        name = f"{folder}/{view['image']}"
        samples.append(Sample(name, read_reduced(picture_file, size, Image.BOX), allowed, items, foods))
    return samples


def find_captures(root):
    """Folders with capture.json below `root`, or `root` itself, in the order of their names."""
    found = []
    for folder, folders, files in os.walk(root):
        folders.sort()
        if "capture.json" in files:
            found.append(folder)
    return sorted(found)


def read_captures(roots):
    return [sample for root in roots for folder in find_captures(root) for sample in read_capture(folder)]


def pair_with_bare(samples, bare_root):
    """Gives each view of a set the same view from the folder of the set without food."""
    bare = read_captures([bare_root])
    if len(samples) != len(bare):
        raise ValueError(f"{bare_root}: expected {len(samples)} views, as there are with food, found {len(bare)}")
    for sample, own in zip(samples, bare):
        sample.bare = own
