"""The layers of the network for food, as its file states them (core/network/network.hpp)."""

from dataclasses import dataclass

# Roles and enlargements by the numbers of the file.
NONE, CLASSES, BORDER, EMBEDDING = range(4)
SAME, NEAREST, BILINEAR = range(3)

# What pixels are told apart as: the kinds that `traygauge-simulate render --kinds` writes, from 1 on.
CLASS_NAMES = ("table", "food", "glaze", "rim", "card", "cutlery", "napkin")
FOOD = CLASS_NAMES.index("food")


@dataclass(frozen=True)
class Layer:
    """A convolution. Tensor 0 is the picture, tensor i what layer i - 1 makes."""

    sources: tuple  # of (tensor, enlargement)
    channels: int
    kernel: int = 3
    stride: int = 1
    relu: bool = True
    role: int = NONE


def food_layers(down, up, embedding):
    """A U-Net: len(down) scales, each half the size of the one before; heads at half the picture's size."""
    layers = [Layer(((0, SAME),), down[0], stride=2)]
    at_scale = [1]  # the tensor that is handed across, of each scale
    for channels in down[1:]:
        layers.append(Layer(((at_scale[-1], SAME),), channels, stride=2))
        layers.append(Layer(((len(layers), SAME),), channels))
        at_scale.append(len(layers))
    last = at_scale.pop()
    for channels in up:
        is_finest = len(at_scale) == 1
        if is_finest:  # cells of four pixels: what foods are alike is told there
            layers.append(Layer(((last, SAME),), embedding, relu=False, role=EMBEDDING))
        layers.append(Layer(((last, BILINEAR), (at_scale.pop(), SAME)), channels))
        last = len(layers)
    layers.append(Layer(((last, SAME),), 1, kernel=1, relu=False, role=BORDER))
    layers.append(Layer(((last, SAME),), len(CLASS_NAMES), kernel=1, relu=False, role=CLASSES))
    return tuple(layers)


def tensor_channels(layers):
    """Channels of every tensor, the picture's first."""
    return [3] + [layer.channels for layer in layers]


def shared_scales(layers):
    """For each tensor the first of those whose values have to mean the same: sources of one layer stand side by
    side in one sum."""
    group = list(range(len(layers) + 1))
    for layer in layers:
        found = sorted({group[tensor] for tensor, _ in layer.sources})
        group = [found[0] if g in found else g for g in group]
    return group
