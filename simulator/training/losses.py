"""What the network is trained to do."""

import torch
import torch.nn.functional as F

from layers import BORDER, CLASS_NAMES, CLASSES, EMBEDDING, FOOD

# Of each class in the sum over cells: what is small on a tray counts more. The order is that of CLASS_NAMES.
CLASS_WEIGHTS = (0.5, 1.0, 1.0, 2.0, 4.0, 4.0, 2.0)
BORDER_REACH = 2  # cells from a cell to the other item, on its border
BORDER_WEIGHT = 10.0  # borders are few
PULL_WITHIN = 0.3  # no pull on what lies so near its item's middle
PUSH_WITHIN = 1.5  # middles of different foods at least twice as far from each other
MIN_ITEM_CELLS = 4
# Of classes, borders and embedding in the sum.
WEIGHTS = (1.0, 0.5, 0.3)


def allowed_mask(allowed):
    """N x classes x H x W: 1 where a cell may be of that class."""
    shifts = torch.arange(len(CLASS_NAMES))[None, :, None, None]
    return ((allowed[:, None] >> shifts) & 1).float()


def class_loss(logits, allowed):
    """Minus the logarithm of the probability of what a cell may be, and dice of food."""
    probability = F.softmax(logits, 1)
    mask = allowed_mask(allowed)
    likely = (probability * mask).sum(1).clamp_min(1e-6)
    # Of several that a cell may be, the least counts.
    weights = torch.tensor(CLASS_WEIGHTS)[None, :, None, None].masked_fill(mask == 0, max(CLASS_WEIGHTS)).amin(1)
    food = (allowed == 1 << FOOD).float()
    predicted = probability[:, FOOD]
    dice = 1.0 - (2.0 * (food * predicted).sum() + 1.0) / (food.sum() + predicted.sum() + 1.0)
    return -(weights * torch.log(likely)).sum() / weights.sum() + dice


def border_cells(items):
    """Cells of an item with a cell of another item near."""
    labels = items[:, None].float()
    size = 2 * BORDER_REACH + 1
    largest = F.max_pool2d(labels, size, 1, BORDER_REACH)
    absent = torch.where(labels > 0, labels, torch.full_like(labels, 1e3))
    smallest = -F.max_pool2d(-absent, size, 1, BORDER_REACH)
    return ((largest > smallest) & (labels > 0)).float()


def border_loss(logits, items):
    return F.binary_cross_entropy_with_logits(
        logits, border_cells(items), pos_weight=torch.tensor(BORDER_WEIGHT)
    )


def coarse_items(items, size):
    """Items at the cells of the embedding: 0 where the finer cells of one disagree."""
    rows, columns = size
    pieces = [items[:, j : 2 * rows : 2, i : 2 * columns : 2] for j in (0, 1) for i in (0, 1)]
    agrees = (pieces[0] == pieces[1]) & (pieces[0] == pieces[2]) & (pieces[0] == pieces[3])
    return torch.where(agrees, pieces[0], torch.zeros_like(pieces[0]))


def item_middles(embedding, batch):
    """Of every item that is large enough: its middle, how far its cells spread, and its food."""
    items = coarse_items(batch.items, embedding.shape[-2:])
    middles, spreads, foods = [], [], []
    for index, own in enumerate(items):
        cells = embedding[index].flatten(1)
        flat = own.flatten()
        for label in sorted(set(flat.tolist()) - {0}):
            chosen = cells[:, flat == label]
            if chosen.shape[1] < MIN_ITEM_CELLS:
                continue
            middle = chosen.mean(1)
            distance = (chosen - middle[:, None]).norm(dim=0)
            middles.append(middle)
            spreads.append(F.relu(distance - PULL_WITHIN).square().mean())
            foods.append(batch.foods[index].get(label, f"item {index} {label}"))
    return middles, spreads, foods


def embedding_loss(embedding, batch):
    """Pulls an item's cells together and portions of one food towards each other, pushes foods apart (De
    Brabandere, Neven, Van Gool, Semantic instance segmentation with a discriminative loss function, 2017)."""
    middles, spreads, foods = item_middles(embedding, batch)
    if not middles:
        return embedding.sum() * 0.0
    loss = torch.stack(spreads).mean()
    if len(middles) == 1:
        return loss
    stacked = torch.stack(middles)
    # The square root has no gradient at 0.
    distances = (stacked[:, None] - stacked[None]).square().sum(2).add(1e-8).sqrt()
    is_same = torch.tensor([[a == b for b in foods] for a in foods])
    others = ~torch.eye(len(foods), dtype=torch.bool)
    push = F.relu(2.0 * PUSH_WITHIN - distances).square()
    pull = F.relu(distances - PULL_WITHIN).square()
    return loss + torch.where(is_same, pull, push)[others].mean() + 1e-3 * stacked.norm(dim=1).mean()


def total_loss(outputs, batch):
    parts = (
        class_loss(outputs[CLASSES], batch.allowed),
        border_loss(outputs[BORDER], batch.items),
        embedding_loss(outputs[EMBEDDING], batch),
    )
    return sum(weight * part for weight, part in zip(WEIGHTS, parts))
