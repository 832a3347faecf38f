"""Food of one sample laid on the tray or the napkin of another (G. Ghiasi et al., Simple copy-paste is a strong data
augmentation method for instance segmentation, CVPR 2021): the renderer puts food into dishes alone."""

import numpy as np
import torch
import torch.nn.functional as F

from layers import FOOD
from repainting import kind_mask

PASTED = 0.3  # share of pictures
LEAST_PX, MOST_PX = 150, 5000
PASTED_LABEL = 199  # no renderer's capture has so many items
SHADOW_PX = 5


def paste_food(rng, picture, allowed, items, donor_picture, donor_items):
    """Pixels of all three, and of a donor; returns picture, allowed and items with at most one food more, and its label
    at the donor's, or 0. It covers nothing but tray, napkin and cutlery: no other item changes its shape."""
    labels = [int(label) for label in torch.unique(donor_items) if label]
    if not labels:
        return picture, allowed, items, 0
    label = labels[int(rng.integers(0, len(labels)))]
    mask = donor_items == label
    count = int(mask.sum())
    free = kind_mask(allowed, ("table", "napkin"))
    if not LEAST_PX <= count <= MOST_PX or not free.any():
        return picture, allowed, items, 0
    rows, columns = mask.shape
    at = torch.nonzero(free)[int(rng.integers(0, int(free.sum())))]
    centre = torch.nonzero(mask).float().mean(0)
    shift = (at - centre).round().long().tolist()
    moved = torch.roll(mask, shift, (0, 1))
    source = torch.roll(donor_picture, shift, (1, 2))
    # What was rolled over the picture's sides comes in at the other side: cut off.
    y, x = np.arange(rows), np.arange(columns)
    inside_y = (y - shift[0] >= 0) & (y - shift[0] < rows)
    inside_x = (x - shift[1] >= 0) & (x - shift[1] < columns)
    moved &= torch.from_numpy(inside_y[:, None] & inside_x[None])
    moved &= kind_mask(allowed, ("table", "napkin", "cutlery"))
    if int(moved.sum()) < LEAST_PX:
        return picture, allowed, items, 0
    shadow = F.avg_pool2d(moved[None, None].float(), 2 * SHADOW_PX + 1, 1, SHADOW_PX)[0, 0]
    shadow = torch.roll(shadow, [int(s) for s in rng.integers(-3, 4, 2)], (0, 1))
    picture = picture * (1.0 - rng.uniform(0.2, 0.8) * shadow * free)
    picture = torch.where(moved, source, picture)
    allowed = torch.where(moved, torch.full_like(allowed, 1 << FOOD), allowed)
    items = torch.where(moved, torch.full_like(items, PASTED_LABEL), items)
    return picture, allowed, items, label
