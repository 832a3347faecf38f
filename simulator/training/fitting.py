"""Pictures of any size in the one that the network takes, by the same whole numbers as core."""

import numpy as np

FILLING_GREY = 128


def covered(source, target):
    """target x source: how much of each target pixel every source pixel covers, in whole numbers."""
    ends = np.arange(1, target + 1) * source
    pixels = np.arange(1, source + 1) * target
    overlap = np.minimum(ends[:, None], pixels[None]) - np.maximum((ends - source)[:, None], (pixels - target)[None])
    return np.maximum(overlap, 0).astype(np.float64)


def fit_picture(picture, width, height):
    """The picture in one of width x height as core/network/network_input.hpp has it, and where it lies there:
    left, top, width, height. Sums are whole numbers below 2^53."""
    rows, columns = picture.shape[:2]
    wide, high = width, height
    if columns * height > rows * width:
        high = max(1, rows * width // columns)
    else:
        wide = max(1, columns * height // rows)
    left, top = (width - wide) // 2, (height - high) // 2
    lines = np.tensordot(covered(rows, high), picture.astype(np.float64), (1, 0))
    sums = np.tensordot(covered(columns, wide), lines, (1, 1)).transpose(1, 0, 2).astype(np.int64)
    area = rows * columns
    whole = np.full((height, width, 3), FILLING_GREY, np.uint8)
    whole[top : top + high, left : left + wide] = (sums + area // 2) // area
    return whole, (left, top, wide, high)
