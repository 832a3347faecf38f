"""How good a network is, on pictures that it never saw."""

import os

import numpy as np
import torch
from PIL import Image

from augmentation import whole_picture
from captures import bits
from fitting import fit_picture
from layers import BORDER, CLASS_NAMES, CLASSES, EMBEDDING, FOOD
from losses import border_cells, coarse_items

def float_outputs(network):
    """A function from a picture of bytes to outputs by role, H x W x channels."""

    @torch.no_grad()
    def run(picture):
        tensor = torch.from_numpy(picture).permute(2, 0, 1)[None].float() / 255.0
        return {role: made[0].permute(1, 2, 0).numpy() for role, made in network(tensor).items()}

    return run


def ratio(part, whole):
    return float(part) / float(whole) if whole else float("nan")


class Tally:
    """Counts over pictures, from which the figures come."""

    def __init__(self):
        count = len(CLASS_NAMES)
        self.both, self.either, self.true = np.zeros(count), np.zeros(count), np.zeros(count)
        self.borders = np.zeros(3)  # right, found, true
        self.cells = np.zeros(2)  # of items in pictures of several: nearest to their own item's middle, all
        self.bare = np.zeros(2)  # of dishes without food: taken for food, all

    def add(self, outputs, batch):
        allowed = batch.allowed[0].numpy()
        known = np.isin(allowed, [1 << i for i in range(len(CLASS_NAMES))])
        found = outputs[CLASSES].argmax(2)
        for i in range(len(CLASS_NAMES)):
            mine, true = (found == i) & known, (allowed == 1 << i)
            self.both[i] += (mine & true).sum()
            self.either[i] += (mine | true).sum()
            self.true[i] += true.sum()
        border = border_cells(batch.items)[0, 0].numpy() > 0
        likely = (outputs[BORDER][:, :, 0] > 0) & (batch.items[0].numpy() > 0)
        self.borders += (likely & border).sum(), likely.sum(), border.sum()
        self.add_embedding(outputs[EMBEDDING], batch)

    def add_bare(self, outputs, batch):
        dish = np.isin(batch.allowed[0].numpy(), [bits("glaze"), bits("rim")])
        self.bare += (outputs[CLASSES].argmax(2)[dish] == FOOD).sum(), dish.sum()

    def add_embedding(self, embedding, batch):
        items = coarse_items(batch.items, embedding.shape[:2])[0].numpy()
        labels = [label for label in np.unique(items) if label and (items == label).sum() >= 4]
        if len(labels) < 2:
            return
        middles = np.stack([embedding[items == label].mean(0) for label in labels])
        for index, label in enumerate(labels):
            cells = embedding[items == label]
            nearest = ((cells[:, None] - middles[None]) ** 2).sum(2).argmin(1)
            self.cells += (nearest == index).sum(), len(cells)

    def figures(self):
        # Of a class that no pixel shows for certain nothing is known.
        either = np.where(self.true > 0, self.either, 0)
        made = {f"IoU {name}": ratio(b, e) for name, b, e in zip(CLASS_NAMES, self.both, either)}
        made["border precision"] = ratio(self.borders[0], self.borders[1])
        made["border recall"] = ratio(self.borders[0], self.borders[2])
        made["embedding: cells nearest to their own item"] = ratio(*self.cells)
        made["bare dishes: cells taken for food"] = ratio(*self.bare)
        return made


def bytes_of(batch):
    return (batch.picture[0] * 255.0 + 0.5).floor().to(torch.uint8).permute(1, 2, 0).numpy()


def measure(run, samples, width, height):
    tally = Tally()
    for sample in samples:
        batch = whole_picture(sample, width, height)
        tally.add(run(bytes_of(batch)), batch)
        if sample.bare is not None:
            batch = whole_picture(sample.bare, width, height)
            tally.add_bare(run(bytes_of(batch)), batch)
    return tally.figures()


def agreement(first, second, samples, width, height):
    """Share of the cells for which both name the same class."""
    same = []
    for sample in samples:
        picture = fit_picture(sample.picture, width, height)[0]
        same.append((first(picture)[CLASSES].argmax(2) == second(picture)[CLASSES].argmax(2)).mean())
    return float(np.mean(same))


def measure_photographs(run, folder, width, height):
    """IoU of food on NAME.jpg against NAME_mask.png, as real_food_on_trays has it; of groups of names, told by
    what stands behind the first underscore."""
    groups = {}
    for file in sorted(os.listdir(folder)):
        mask_file = os.path.join(folder, file[:-4] + "_mask.png")
        if not file.endswith(".jpg") or not os.path.exists(mask_file):
            continue
        with Image.open(os.path.join(folder, file)) as picture:
            pixels = np.asarray(picture.convert("RGB"))
        with Image.open(mask_file) as mask:
            food = np.asarray(mask.convert("L")) > 0
        whole, (left, top, wide, high) = fit_picture(pixels, width, height)
        found = run(whole)[CLASSES].argmax(2) == FOOD
        rows, columns = food.shape
        y = (top + (np.arange(rows) + 0.5) * high / rows) * found.shape[0] / height
        x = (left + (np.arange(columns) + 0.5) * wide / columns) * found.shape[1] / width
        seen = found[np.ix_(y.astype(int), x.astype(int))]
        group = file[:-4].partition("_")[2] or file[:-4]
        groups.setdefault(group, []).append(ratio((seen & food).sum(), (seen | food).sum()))
    return {
        f"photographs, IoU food, {group} ({len(own)})": float(np.mean(own)) for group, own in sorted(groups.items())
    }
