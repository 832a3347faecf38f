"""Samples turned, scaled, lit and coloured otherwise at each step, by draws of that step alone: a run that is
stopped and taken up again sees what it would have seen."""

from dataclasses import dataclass

import numpy as np
import torch
import torch.nn.functional as F

from captures import ANYTHING
from emptying import EMPTIED, take_food
from fitting import FILLING_GREY, fit_picture
from pasting import PASTED, PASTED_LABEL, paste_food
from repainting import enlarge, repaint_item, repaint_sample

# Ranges in which trays and cameras differ; those of the experiment that carried over to real trays.
SCALE = (0.75, 1.25)
SHIFT = 0.15  # of the picture's sides
GAMMA = (0.7, 1.45)
CAST = 0.10
LIGHT = 0.30  # of smooth fields
SWAPPED = 0.15  # share of pictures
BARRED = 0.2  # share of pictures
PATCH_CELLS = 4  # columns and rows of numbers from which a field of light is enlarged
CELL_PX = 2  # of the picture, of a cell of classes and borders


@dataclass
class Batch:
    picture: torch.Tensor  # N x 3 x H x W, 0 to 1, of the 256 values that bytes have
    allowed: torch.Tensor  # N x H/2 x W/2
    items: torch.Tensor  # N x H/2 x W/2
    foods: list  # of each picture: label -> what the food is called; a picture in other colours has other foods


def draw_geometry(rng, sample, width, height):
    """Places in the sample, as grid_sample counts them, of the picture's pixels."""
    rows, columns = sample.allowed.shape
    angle = rng.uniform(0.0, 2.0 * np.pi)
    scale = rng.uniform(*SCALE)
    mirror = -1.0 if rng.random() < 0.5 else 1.0
    shift = rng.uniform(-SHIFT, SHIFT, 2) * (columns, rows)
    step = min(columns / width, rows / height) / scale  # pixels of the sample, of one of the picture

    u = (np.arange(width) + 0.5 - 0.5 * width) * step * mirror
    v = (np.arange(height) + 0.5 - 0.5 * height) * step
    x = np.cos(angle) * u[None, :] - np.sin(angle) * v[:, None] + shift[0]
    y = np.sin(angle) * u[None, :] + np.cos(angle) * v[:, None] + shift[1]
    return torch.from_numpy(np.stack([2.0 * x / columns, 2.0 * y / rows], 2)).float()[None]


def sample_at(values, grid, mode):
    tensor = torch.from_numpy(np.array(values, np.float32))
    tensor = tensor.permute(2, 0, 1)[None] if tensor.dim() == 3 else tensor[None, None]
    return F.grid_sample(tensor, grid, mode, padding_mode="reflection", align_corners=False)[0]


def light_field(rng, width, height):
    small = 1.0 + rng.uniform(-LIGHT, LIGHT, (1, 1, PATCH_CELLS, PATCH_CELLS))
    small = small * (1.0 + rng.uniform(-0.3, 0.3, (1, 3, 1, 1)) * (small - 1.0))
    return enlarge(small, (height, width)).clamp_min(0.2)


def change_colours(rng, picture):
    """Returns the picture and whether its channels were exchanged."""
    picture = picture.clamp(0.0, 1.0) ** rng.uniform(*GAMMA)
    picture = picture * torch.from_numpy(1.0 + rng.uniform(-CAST, CAST, (3, 1, 1))).float()
    if rng.random() < 0.6:
        picture = picture * light_field(rng, picture.shape[2], picture.shape[1])
    if rng.random() < 0.2:
        grey = picture.mean(0, keepdim=True)
        picture = grey + (picture - grey) * rng.uniform(0.3, 0.9)
    order = rng.permutation(3) if rng.random() < SWAPPED else np.arange(3)
    picture = picture[torch.from_numpy(order)]
    if rng.random() < 0.3:
        picture = F.avg_pool2d(F.pad(picture[None], (1, 1, 1, 1), mode="reflect"), 3, 1)[0]
    noise = torch.from_numpy(rng.standard_normal(picture.shape, dtype=np.float32))
    picture = picture + rng.uniform(0.0, 0.03) * noise
    return torch.floor(picture.clamp(0.0, 1.0) * 255.0 + 0.5) / 255.0, tuple(order)


def pixels_at(sample, grid):
    """Picture, what its pixels may be, and their items."""
    picture = sample_at(sample.picture, grid, "bilinear") / 255.0
    allowed = sample_at(sample.allowed, grid, "nearest")[0].long()
    return picture, allowed, sample_at(sample.items, grid, "nearest")[0].long()


def draw_sample(rng, sample, width, height):
    """Picture, what its pixels may be, and their items, all of width x height."""
    grid = draw_geometry(rng, sample, width, height)
    pixels = pixels_at(sample, grid)
    if sample.bare is None or rng.random() >= EMPTIED:
        return pixels
    bare_picture, bare_allowed, _ = pixels_at(sample.bare, grid)
    return take_food(rng, *pixels, bare_picture, bare_allowed)


def of_cells(pixels):
    return pixels[CELL_PX // 2 :: CELL_PX, CELL_PX // 2 :: CELL_PX].contiguous()


def bar_sides(rng, picture, allowed, items):
    """What a picture of another shape leaves free, as fit_picture fills it."""
    rows, columns = items.shape
    bar = int(rng.uniform(0.02, 0.15) * rows)
    outside = torch.ones_like(items, dtype=torch.bool)
    if rng.random() < 0.8:  # wide pictures are usual
        outside[bar : rows - bar] = False
    else:
        outside[:, bar : columns - bar] = False
    picture = torch.where(outside, torch.tensor(FILLING_GREY / 255.0), picture)
    return picture, allowed.masked_fill(outside, ANYTHING), items.masked_fill(outside, 0)


def draw_batch(samples, plan, step):
    rng = np.random.default_rng([plan.seed, step])
    width, height = plan.width, plan.height
    pictures, allowed, items, foods = [], [], [], []
    for index in rng.integers(0, len(samples), plan.batch):
        sample = samples[index]
        picture, kinds, labels = draw_sample(rng, sample, width, height)
        names = dict(sample.foods)
        if rng.random() < PASTED:
            donor = samples[int(rng.integers(0, len(samples)))]
            lent, _, lent_labels = draw_sample(rng, donor, width, height)
            picture, kinds, labels, taken = paste_food(rng, picture, kinds, labels, lent, lent_labels)
            if taken in donor.foods:
                names[PASTED_LABEL] = donor.foods[taken]
        # A plan without it draws nothing here, so that its pictures do not change.
        if plan.repainted_food > 0.0 and rng.random() < plan.repainted_food:
            picture, label = repaint_item(rng, picture, kinds, labels)
            if label:
                names[label] = f"{names.get(label, '')} repainted"
        picture = repaint_sample(rng, picture, kinds)
        picture, order = change_colours(rng, picture)
        if rng.random() < BARRED:
            picture, kinds, labels = bar_sides(rng, picture, kinds, labels)
        pictures.append(picture)
        allowed.append(of_cells(kinds))
        items.append(of_cells(labels))
        foods.append({label: f"{name} {order}" for label, name in names.items()})
    return Batch(torch.stack(pictures), torch.stack(allowed), torch.stack(items), foods)


def whole_picture(sample, width, height):
    """The sample as it is, reduced: a batch of one. Cells beside the picture may be anything."""
    fitted, (left, top, wide, high) = fit_picture(sample.picture, width, height)
    picture = torch.from_numpy(fitted).permute(2, 0, 1).float() / 255.0
    rows, columns = sample.allowed.shape
    y = ((np.arange(height // CELL_PX) + 0.5) * CELL_PX - top) * rows / high
    x = ((np.arange(width // CELL_PX) + 0.5) * CELL_PX - left) * columns / wide
    seen = ((y >= 0) & (y < rows))[:, None] & ((x >= 0) & (x < columns))[None]
    pick = np.ix_(np.clip(y.astype(int), 0, rows - 1), np.clip(x.astype(int), 0, columns - 1))
    return Batch(
        picture[None],
        torch.from_numpy(np.where(seen, sample.allowed[pick], ANYTHING).astype(np.int64))[None],
        torch.from_numpy(np.where(seen, sample.items[pick], 0).astype(np.int64))[None],
        [dict(sample.foods)],
    )
