#!/usr/bin/env python3
"""What a measurement makes of captures whose description or pictures were spoilt.

    tests/evaluation/perturb/edits.py build/traygauge ../shared/captures --labels given auto --out edits.csv

Spoils every pair of every capture in each of the ways below, measures it, and prints, by what was spoilt and how much, how
many were refused, left a dish or an item out, were warned of by name, came out right, or were wrong: with a doubt about the
item, or in silence. Wrong: the sum of all food or an item is off by more than 10 % and by more than three of its sigmas.
Needs python3-numpy and python3-opencv.
"""
import argparse
import collections
import concurrent.futures
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

import cv2
import numpy as np

FIRST_FOOD, LAST_FOOD, FIRST_FURTHER_DISH, CARD = 2, 199, 201, 255
UNSURE = {"item_hardly_matched", "item_uncertain", "item_moved", "pictures_differ"}
FAR_OFF = 0.10
SIGMAS = 3.0
OUTCOMES = ["refused", "left out", "warned", "right", "unsure", "silent"]


class Pair:
    """Two views of a capture, to be spoilt in a folder of their own."""

    def __init__(self, capture, pair, folder, truth):
        self.truth = truth
        document = json.loads((capture / "capture.json").read_text())
        self.folder = folder
        self.document = {key: value for key, value in document.items() if key not in ("views", "pairs")}
        self.document["card"]["pattern"] = self.link(capture, document["card"]["pattern"], "card.png")
        views = [document["views"][index] for index in pair]
        self.document["views"] = [
            {**view, "image": self.link(capture, view["image"], f"view_{v}.jpg"),
             "labels": self.link(capture, view["labels"], f"labels_{v}.png")}
            for v, view in enumerate(views)]
        self.document["pairs"] = [[0, 1]]

    def link(self, capture, name, new_name):
        (self.folder / new_name).symlink_to((capture / name).resolve())
        return new_name

    def dishes(self):
        return self.document["dishes"] if "dishes" in self.document else [self.document["dish"]]

    def cameras(self):
        views = [view["camera"] for view in self.document["views"] if "camera" in view]
        return views + ([self.document["camera"]] if "camera" in self.document else [])

    def read(self, name):
        return cv2.imread(str(self.folder / name), cv2.IMREAD_UNCHANGED)

    def replace(self, name, pixels):
        (self.folder / name).unlink()
        cv2.imwrite(str(self.folder / name), pixels, [cv2.IMWRITE_JPEG_QUALITY, 95] if name.endswith(".jpg") else [])

    def save(self):
        (self.folder / "capture.json").write_text(json.dumps(self.document))


def card_size(pair, percent):
    """The card's print is smaller or larger than stated: a positive amount states it too large."""
    for key in ("width_mm", "height_mm"):
        pair.document["card"][key] *= 1.0 + percent / 100.0


def card_height(pair, mm):
    """The card lies higher than stated: its height is stated lower, and what that does not give, the dishes higher."""
    by_card_mm = min(mm, pair.document["card"]["thickness_mm"])
    pair.document["card"]["thickness_mm"] -= by_card_mm
    dish_height(pair, mm - by_card_mm)


def focal(pair, percent):
    """The focal length of another mode of the sensor."""
    for camera in pair.cameras():
        for key in ("fx", "fy"):
            camera[key] *= 1.0 + percent / 100.0


def no_distortion(pair, _):
    for camera in pair.cameras():
        camera["distortion"] = [0.0] * 5


def centre_swapped(pair, _):
    for camera in pair.cameras():
        camera["cx"], camera["cy"] = camera["cy"], camera["cx"]


def dish_height(pair, mm):
    """Every dish is stated higher than it is, from its foot to its rim."""
    for dish in pair.dishes():
        for key in ("rim_height_mm", "bottom_height_mm"):
            dish[key] += mm
        if "profile" in dish:
            dish["profile"] = [[inset, height + mm] for inset, height in dish["profile"]]


def dish_depth(pair, mm):
    """The rim is stated as it is, the bottom too high."""
    for dish in pair.dishes():
        rim, bottom = dish["rim_height_mm"], dish["bottom_height_mm"]
        raised = lambda height: rim - (rim - height) * (rim - bottom - mm) / (rim - bottom)
        dish["bottom_height_mm"] = bottom + mm
        if "profile" in dish:
            dish["profile"] = [[inset, raised(height)] for inset, height in dish["profile"]]


def dish_size(pair, percent):
    for dish in pair.dishes():
        for key in ("outer_size_mm", "flat_bottom_size_mm"):
            if key in dish:
                dish[key] = [side * (1.0 + percent / 100.0) for side in dish[key]]
        if "profile" in dish:
            dish["profile"] = [[inset * (1.0 + percent / 100.0), height] for inset, height in dish["profile"]]


def no_profile(pair, _):
    for dish in pair.dishes():
        dish.pop("profile", None)


def dish_not_named(pair, _):
    if "dishes" not in pair.document:
        return False
    further = [dish["label"] for dish in pair.document["dishes"] if dish["label"] >= FIRST_FURTHER_DISH]
    pair.document["dishes"] = [dish for dish in pair.document["dishes"] if dish["label"] not in further[-1:]]
    return bool(further)


def fade(pair, percent):
    """So much of both pictures' colours is left."""
    for v in range(2):
        pixels = pair.read(f"view_{v}.jpg")
        grey = cv2.cvtColor(cv2.cvtColor(pixels, cv2.COLOR_BGR2GRAY), cv2.COLOR_GRAY2BGR)
        pair.replace(f"view_{v}.jpg", cv2.addWeighted(pixels, percent / 100.0, grey, 1.0 - percent / 100.0, 0.0))


def food_centre(labels, rank):
    sizes = collections.Counter(labels[(labels >= FIRST_FOOD) & (labels <= LAST_FOOD)].tolist())
    label = sizes.most_common(rank + 1)[-1][0]
    rows, columns = np.nonzero(labels == label)
    return int(np.median(columns)), int(np.median(rows))


def spot(pixels, centre, diameter, colour, blur):
    """Out-of-focus dirt: what is behind it still shows at its edge."""
    mask = np.zeros(pixels.shape[:2], np.float32)
    cv2.circle(mask, centre, diameter // 2, 1.0, -1)
    mask = cv2.GaussianBlur(mask, (0, 0), blur)[..., None]
    return (pixels * (1.0 - mask) + np.array(colour, np.float32) * mask).astype(np.uint8)


def dirt(pair, diameter_px):
    """A dark spot on the lens, over the largest food in the first view."""
    centre = food_centre(pair.read("labels_0.png"), 0)
    for v in range(2):
        pixels = pair.read(f"view_{v}.jpg")
        pair.replace(f"view_{v}.jpg", spot(pixels, centre, diameter_px, (25, 28, 30), max(3.0, diameter_px / 12)))


def hand(pair, width_px):
    """A finger from the picture's edge to the largest food, in the second view alone."""
    pixels = pair.read("view_1.jpg")
    x, y = food_centre(pair.read("labels_1.png"), 0)
    noise = np.random.default_rng(5).normal(0.0, 3.0, pixels.shape)
    mask = np.zeros(pixels.shape[:2], np.float32)
    cv2.line(mask, (x, pixels.shape[0] - 1), (x, y), 1.0, width_px)
    mask = cv2.GaussianBlur(mask, (0, 0), 1.5)[..., None]
    skin = np.array((125, 150, 205), np.float32) * (0.8 + 0.2 * mask)
    pair.replace("view_1.jpg", np.clip(pixels * (1.0 - mask) + (skin + noise) * mask, 0, 255).astype(np.uint8))


def steam(pair, percent):
    """A veil over the middle of both pictures, not the same in both."""
    for v in range(2):
        pixels = pair.read(f"view_{v}.jpg").astype(np.float32)
        coarse = np.random.default_rng(7 + v).uniform(0.3, 1.0, (9, 12)).astype(np.float32)
        veil = cv2.resize(coarse, (pixels.shape[1], pixels.shape[0]), interpolation=cv2.INTER_CUBIC)
        veil = np.clip(veil * percent / 100.0, 0.0, 1.0)[..., None]
        pair.replace(f"view_{v}.jpg", (pixels * (1.0 - veil) + 215.0 * veil).astype(np.uint8))


def outline_inside(pair, px):
    """Food outlined too tightly: the ring becomes dish."""
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * px + 1, 2 * px + 1))
    for v in range(2):
        labels = pair.read(f"labels_{v}.png")
        result = labels.copy()
        owner = {item["label"]: item.get("dish_label", 1) for item in pair.truth["items"]}
        for label in np.unique(labels):
            if FIRST_FOOD <= label <= LAST_FOOD:
                of_item = (labels == label).astype(np.uint8)
                result[(of_item == 1) & (cv2.erode(of_item, kernel) == 0)] = owner.get(int(label), 1)
        pair.replace(f"labels_{v}.png", result)


# What is spoilt, how much, and with which labels it makes sense.
KINDS = [
    ("nothing", lambda pair, _: None, [0], ("given", "auto")),
    ("card size %", card_size, [-5, -3, -2, -1, -0.5, 0.5, 1, 2, 3, 5], ("given", "auto")),
    ("card height mm", card_height, [1, 2, 3, 5, 10], ("given", "auto")),
    ("focal %", focal, [-10, -5, -2, -1, 1, 2, 5, 10], ("given", "auto")),
    ("no distortion", no_distortion, [0], ("given", "auto")),
    ("centre swapped", centre_swapped, [0], ("given", "auto")),
    ("dish height mm", dish_height, [-8, -4, -2, -1, 1, 2, 4, 8], ("given", "auto")),
    ("dish depth mm", dish_depth, [-4, -2, 2, 4], ("given", "auto")),
    ("dish size %", dish_size, [-5, -3, -2, -1, 1, 2, 3, 5], ("given", "auto")),
    ("no profile", no_profile, [0], ("given", "auto")),
    ("dish not named", dish_not_named, [0], ("given", "auto")),
    ("colours left %", fade, [0, 5, 10, 20, 30, 50, 75], ("given", "auto")),
    ("dirt px", dirt, [30, 60, 120], ("given", "auto")),
    ("hand px", hand, [60, 120], ("given", "auto")),
    ("steam %", steam, [20, 40, 60], ("given", "auto")),
    ("outline inside px", outline_inside, [3, 8, 15], ("given",)),
]
# The warnings that name what was spoilt: card and dishes disagree.
NAMES = {"scale_disagrees", "card_lifted", "card_not_flat", "dish_differs", "dish_shape_unknown", "unknown_object", "lens_dirty",
         "lens_does_not_fit"}


def wrong_by_ml(volume_ml, truth_ml, sigma_ml):
    error_ml = abs(volume_ml - truth_ml)
    return error_ml > FAR_OFF * truth_ml and error_ml > SIGMAS * sigma_ml


def sigma_of(item):
    return item["sigma_ml"] or 0.0


def outcome_of(document, truth, given):
    """Outcome, and by how much the sum of all food is off in per cent."""
    if document["status"] not in ("ok", "partial"):
        return "refused", None
    items = document["items"]
    codes = {warning["code"] for warning in document["warnings"]}
    truth_ml = sum(item["volume_ml"] for item in truth["items"])
    sum_ml = sum(item["volume_ml"] or 0.0 for item in items)
    error = 100.0 * (sum_ml / truth_ml - 1.0)
    if any(item["status"] != "ok" for item in items):
        return "left out", error
    if codes & NAMES:
        return "warned", error
    # Errors of one capture's items go the same way, as those of its scale do.
    wrong = wrong_by_ml(sum_ml, truth_ml, sum(sigma_of(item) for item in items))
    if given:
        by_label = {item["label"]: item["volume_ml"] for item in truth["items"]}
        wrong |= any(wrong_by_ml(item["volume_ml"], by_label[item["label"]], sigma_of(item)) for item in items)
    if not wrong:
        return "right", error
    doubted = {warning["label"] for warning in document["warnings"] if warning["code"] in UNSURE}
    return ("unsure" if doubted else "silent"), error


def measure(program, folder, labels):
    command = [program, "measure", str(folder), "--pair", "0,1", "--labels", labels, "--json"]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    if result.returncode == 2:
        return {"status": "input", "message": result.stderr, "items": [], "warnings": []}
    if result.returncode > 1:
        sys.exit(f"{folder}: {result.stderr}")
    return json.loads(result.stdout)


def run(case):
    program, capture, numbers, kind, amount, labels = case
    spoil = next(entry[1] for entry in KINDS if entry[0] == kind)
    truth = json.loads((capture / "truth.json").read_text())
    with tempfile.TemporaryDirectory(dir="/dev/shm") as folder:
        pair = Pair(capture, numbers, pathlib.Path(folder), truth)
        if spoil(pair, amount) is False:
            return None
        pair.save()
        document = measure(program, folder, labels)
    outcome, error = outcome_of(document, truth, labels == "given")
    codes = sorted({warning["code"] for warning in document["warnings"]})
    return [labels, kind, amount, f"{capture.parent.name}/{capture.name}", f"{numbers[0]}-{numbers[1]}", outcome,
            "" if error is None else f"{error:.2f}", document["status"], " ".join(codes)]


def cases_of(options):
    kinds = [entry for entry in KINDS if not options.kinds or any(name in entry[0] for name in options.kinds)]
    for capture in sorted(path.parent for path in options.captures.rglob("truth.json")):
        document = json.loads((capture / "capture.json").read_text())
        for numbers in document["pairs"]:
            for kind, _, amounts, makes_sense in kinds:
                for labels in [name for name in options.labels if name in makes_sense]:
                    for amount in amounts:
                        yield options.program, capture, numbers, kind, amount, labels


def print_table(rows):
    counts = collections.defaultdict(collections.Counter)
    for row in rows:
        counts[row[0], row[1], row[2]][row[5]] += 1
    order = [entry[0] for entry in KINDS]
    print(f"{'labels':6} {'spoilt':18} {'amount':>6} " + " ".join(f"{name:>9}" for name in OUTCOMES))
    for labels, kind, amount in sorted(counts, key=lambda key: (key[0], order.index(key[1]), key[2])):
        of_kind = counts[labels, kind, amount]
        print(f"{labels:6} {kind:18} {amount:6g} " + " ".join(f"{of_kind[name]:9d}" for name in OUTCOMES))
    total = collections.Counter(row[5] for row in rows)
    print(f"{len(rows)} cases: " + ", ".join(f"{name} {total[name]}" for name in OUTCOMES))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="the program traygauge")
    parser.add_argument("captures", type=pathlib.Path, help="folder with captures that have truth.json")
    parser.add_argument("--labels", nargs="+", choices=["given", "auto"], default=["given", "auto"])
    parser.add_argument("--kinds", nargs="+", help="words of the kinds to try; else all")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("edits.csv"), help="a CSV of all cases")
    options = parser.parse_args()
    rows = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool, options.out.open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["labels", "spoilt", "amount", "capture", "pair", "outcome", "error_percent", "status", "warnings"])
        for row in pool.map(run, cases_of(options)):
            if row is not None:
                rows.append(row)
                table.writerow(row)
                file.flush()
    if not rows:
        sys.exit(f"{options.captures}: no captures with truth.json")
    print_table(rows)


if __name__ == "__main__":
    main()
