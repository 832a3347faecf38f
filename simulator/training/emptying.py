"""Food taken off its dish, whole or in part: what is behind it shows the same scene rendered without food."""

import numpy as np
import torch
import torch.nn.functional as F

from repainting import random_axes, smooth_noise

# Shares of pictures, and of items on these.
EMPTIED = 0.5  # where it was rendered without food
ALL_EATEN = 0.25
TAKEN = 0.5
EATEN_IN_PART = 0.5
SHADE_PX = 6  # around food, which goes with it: its shade and its light


def widened(mask, reach_px):
    """By a square: along rows, then along columns."""
    size = 2 * reach_px + 1
    rows = F.max_pool2d(mask[None, None].float(), (1, size), 1, (0, reach_px))
    return F.max_pool2d(rows, (size, 1), 1, (reach_px, 0))[0, 0] > 0


def bitten(rng, item):
    """Of an item's pixels, those on one side of a ragged line through one of them."""
    places = torch.nonzero(item)
    row, column = places[int(rng.integers(0, len(places)))].tolist()
    along, _ = random_axes(rng, item.shape)
    far = along - along[row, column] + 8.0 * smooth_noise(rng, item.shape, 12).numpy()
    return item & torch.from_numpy(far > 0.0)


def eaten_pixels(rng, items):
    """Pixels of the food that is taken."""
    if rng.random() < ALL_EATEN:
        return items > 0
    eaten = torch.zeros_like(items, dtype=torch.bool)
    for label in torch.unique(items).tolist():
        if label == 0 or rng.random() >= TAKEN:
            continue
        item = items == label
        eaten |= bitten(rng, item) if rng.random() < EATEN_IN_PART else item
    return eaten


def match_light(bare, picture, unchanged):
    """A camera exposes a bare dish otherwise: the bare picture, as bright as the other where both show the same."""
    if not unchanged.any():
        return bare
    gain = picture[:, unchanged].mean(1) / bare[:, unchanged].mean(1).clamp_min(0.02)
    return (bare * gain[:, None, None]).clamp(0.0, 1.0)


def take_food(rng, picture, allowed, items, bare_picture, bare_allowed):
    """Pixels of all five; returns picture, allowed and items with less food."""
    eaten = eaten_pixels(rng, items)
    if not eaten.any():
        return picture, allowed, items
    bare_picture = match_light(bare_picture, picture, ~widened(items > 0, 2 * SHADE_PX))
    left = (items > 0) & ~eaten
    changed = widened(eaten, SHADE_PX) & ~left
    share = F.avg_pool2d(changed[None, None].float(), 5, 1, 2)[0, 0].where(~left & ~eaten, eaten.float())
    picture = picture * (1.0 - share) + bare_picture * share
    return picture, torch.where(eaten, bare_allowed, allowed), items.masked_fill(eaten, 0)
