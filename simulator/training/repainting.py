"""What the renderer draws little of, painted over its pictures: trays, dishes and napkins of other colours and
patterns, shade with an edge, films of sauce, and things on the tray that are no food. Only what the kinds of pixels
allow is painted on, so that the truth stays true."""

import numpy as np
import torch
import torch.nn.functional as F

from captures import bits

PAINTED_KINDS = (("table",), ("glaze", "rim"), ("napkin",))  # each in a colour of its own
# Shares of pictures.
REPAINTED = 0.4  # for each of these
SHADED = 0.35
SMEARED = 0.3
WITH_THINGS = 0.5
LIKE_GLAZE = 0.5  # of the items that are repainted
MOST_THINGS = 4
MOST_SMEARS = 5


def kind_mask(allowed, names):
    """H x W: pixels that are of one of these kinds for certain."""
    return (allowed & ~bits(*names)) == 0


def places(shape):
    rows, columns = shape
    return np.mgrid[0:rows, 0:columns].astype(np.float32)


def random_axes(rng, shape):
    """How far each pixel lies from a place by chance, along a direction by chance and across it."""
    rows, columns = shape
    y, x = places(shape)
    angle = rng.uniform(0.0, np.pi)
    dx, dy = x - rng.uniform(0, columns), y - rng.uniform(0, rows)
    return np.cos(angle) * dx + np.sin(angle) * dy, np.cos(angle) * dy - np.sin(angle) * dx


def enlarge(numbers, shape):
    """1 x C x h x w numbers as a smooth field, C x H x W."""
    return F.interpolate(torch.from_numpy(numbers).float(), shape, mode="bicubic", align_corners=False)[0]


def smooth_noise(rng, shape, cells):
    """-1 to 1 about, over cells x cells numbers."""
    return enlarge(rng.uniform(-1.0, 1.0, (1, 1, cells, cells)), shape)[0]


def pattern(rng, shape):
    """Speckles, stripes, checks or clouds, -1 to 1 about."""
    kind = rng.integers(0, 4)
    if kind == 0:
        speckles = torch.from_numpy((rng.random(shape) < rng.uniform(0.02, 0.2)).astype(np.float32))
        return F.avg_pool2d(speckles[None, None], 3, 1, 1)[0, 0] * 6.0 * rng.choice([-1.0, 1.0])
    if kind == 1:
        return smooth_noise(rng, shape, int(rng.integers(4, 40)))
    y, x = places(shape)
    angle, period = rng.uniform(0.0, np.pi), rng.uniform(5.0, 40.0)
    along = np.sin((np.cos(angle) * x + np.sin(angle) * y) * 2.0 * np.pi / period)
    across = np.sin((np.cos(angle) * y - np.sin(angle) * x) * 2.0 * np.pi / period)
    sharpness = rng.uniform(1.0, 6.0)
    wave = along if kind == 2 else along * across
    return torch.from_numpy(np.clip(sharpness * wave, -1.0, 1.0).astype(np.float32))


def random_colour(rng):
    """Any hue, from black to white, seldom of full saturation."""
    light = rng.uniform(0.04, 0.95)
    hue = rng.uniform(-1.0, 1.0, 3)
    return torch.from_numpy(np.clip(light * (1.0 + rng.beta(1.0, 2.0) * hue), 0.0, 1.0).astype(np.float32))


def repaint(rng, picture, mask):
    """Keeps the shading: what a surface reflects is exchanged for another colour."""
    if not mask.any():
        return picture
    usual = picture[:, mask].mean(1).clamp_min(0.05)
    wanted = random_colour(rng)
    shading = (picture.mean(0) / usual.mean()).clamp(0.0, 2.0)
    if rng.random() < 0.5:
        shading = shading * (1.0 + rng.uniform(0.05, 0.35) * pattern(rng, picture.shape[1:]))
    painted = shading * wanted[:, None, None]
    if rng.random() < 0.3:  # a second colour in places
        share = (0.5 + 0.5 * pattern(rng, picture.shape[1:])).clamp(0.0, 1.0)
        painted = painted * (1.0 - share) + share * shading * random_colour(rng)[:, None, None]
    return torch.where(mask, painted.clamp(0.0, 1.0), picture)


def glaze_coloured(rng, picture, mask, glaze):
    """The lighter of the food's colours become the glaze's; its grain and shade stay."""
    wanted = picture[:, glaze].mean(1) * torch.from_numpy(rng.uniform(0.85, 1.15, 3)).float()
    usual = picture[:, mask].quantile(0.7, dim=1).clamp_min(0.05)
    share = rng.uniform(0.6, 1.0)
    painted = picture * (1.0 - share + share * wanted / usual)[:, None, None]
    return torch.where(mask, painted.clamp(0.0, 1.0), picture)


def repaint_item(rng, picture, allowed, items):
    """Gives one food its glaze's colour, so that shape and grain alone tell it, or any colour; returns the picture and
    the item's label, or 0."""
    labels = [int(label) for label in torch.unique(items) if label]
    glaze = kind_mask(allowed, ("glaze",))
    if not labels or not glaze.any():
        return picture, 0
    label = labels[int(rng.integers(0, len(labels)))]
    mask = items == label
    like_glaze = rng.random() < LIKE_GLAZE
    return glaze_coloured(rng, picture, mask, glaze) if like_glaze else repaint(rng, picture, mask), label


def shade(rng, picture):
    """Light from one side is cut off along an edge, sharp or soft."""
    rows, columns = picture.shape[1:]
    y, x = places((rows, columns))
    angle = rng.uniform(0.0, 2.0 * np.pi)
    reach = rng.uniform(-0.4, 0.4) * columns
    distance = np.cos(angle) * (x - columns / 2) + np.sin(angle) * (y - rows / 2) - reach
    distance = distance + 12.0 * smooth_noise(rng, (rows, columns), 5).numpy()
    steps = np.clip(distance / rng.uniform(1.0, 30.0), -60.0, 60.0)  # beyond them all is dark or lit
    lit = 1.0 / (1.0 + np.exp(-steps))
    tint = 1.0 + rng.uniform(-0.08, 0.08, (3, 1, 1))
    dark = rng.uniform(0.35, 0.85) * tint
    return picture * torch.from_numpy(dark + (1.0 - dark) * lit[None]).float()


def blob(rng, shape, size_px):
    """0 to 1: a rounded spot of irregular outline somewhere."""
    along, across = random_axes(rng, shape)
    u, v = along / size_px, across / (size_px * rng.uniform(0.3, 1.0))
    far = np.sqrt(u * u + v * v) + 0.35 * smooth_noise(rng, shape, 24).numpy()
    return torch.from_numpy(np.clip(4.0 * (1.0 - far), 0.0, 1.0).astype(np.float32))


def smear(rng, picture, food, glaze):
    """Sauce of a food's colour, thin upon the glaze."""
    if not food.any() or not glaze.any():
        return picture
    own = picture[:, food]
    colour = own[:, int(rng.integers(0, own.shape[1]))]
    for _ in range(int(rng.integers(1, MOST_SMEARS + 1))):
        cover = rng.uniform(0.15, 0.7) * blob(rng, picture.shape[1:], rng.uniform(5.0, 30.0)) * glaze
        luma = picture.mean(0, keepdim=True)
        picture = picture * (1.0 - cover) + cover * colour[:, None, None] * (0.5 + 0.5 * luma / 0.7)
    return picture.clamp(0.0, 1.0)


def thing(rng, shape):
    """0 to 1: a rectangle or an ellipse somewhere; and how far from its middle each pixel is, 1 at its edge."""
    along, across = random_axes(rng, shape)
    length = rng.uniform(8.0, 60.0)
    width = length * rng.uniform(0.3, 1.0)
    u, v = np.abs(along) / length, np.abs(across) / width
    far = np.maximum(u, v) if rng.random() < 0.5 else np.sqrt(u * u + v * v)
    return torch.from_numpy(np.clip((1.0 - far) * length / 1.5, 0.0, 1.0).astype(np.float32)), far


def lay_things(rng, picture, table):
    """Stickers, packets, cups, phones: plain or printed shapes, often with rings, upon the tray."""
    for _ in range(int(rng.integers(1, MOST_THINGS + 1))):
        cover, far = thing(rng, picture.shape[1:])
        colour = random_colour(rng)[:, None, None].expand_as(picture)
        if rng.random() < 0.5:
            colour = colour * (1.0 + 0.4 * pattern(rng, picture.shape[1:]))
        if rng.random() < 0.5:  # a cup's mouth, a lid's edge
            inner = torch.from_numpy((far < rng.uniform(0.5, 0.95)).astype(np.float32))
            colour = colour * (1.0 - inner) + inner * random_colour(rng)[:, None, None]
        light = 1.0 + 0.3 * smooth_noise(rng, picture.shape[1:], 4)
        cover = cover * table
        picture = picture * (1.0 - cover) + cover * (colour * light).clamp(0.0, 1.0)
    return picture


def repaint_sample(rng, picture, allowed):
    """`picture` 3 x H x W, 0 to 1, and what its pixels may be, H x W."""
    for kinds in PAINTED_KINDS:
        if rng.random() < REPAINTED:
            picture = repaint(rng, picture, kind_mask(allowed, kinds))
    if rng.random() < WITH_THINGS:
        picture = lay_things(rng, picture, kind_mask(allowed, ("table",)).float())
    if rng.random() < SMEARED:
        picture = smear(rng, picture, kind_mask(allowed, ("food",)), kind_mask(allowed, ("glaze",)).float())
    if rng.random() < SHADED:
        picture = shade(rng, picture)
    return picture
