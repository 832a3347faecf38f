"""The network as core computes it: integers alone, bit by bit the same."""

import math
from dataclasses import dataclass

import numpy as np
import torch
import torch.nn.functional as F

from model import enlarge, input_size

MAX_BIAS = 1 << 30
MIN_SHIFT, MAX_SHIFT = 1, 62


@dataclass
class IntegerLayer:
    """Of one layer: int8 weights (output, row, column, input), and three numbers an output channel."""

    weights: np.ndarray
    biases: np.ndarray
    multipliers: np.ndarray
    shifts: np.ndarray
    step: float


def fixed_point(scale):
    """Multiplier below 2^31 and shift whose quotient multiplier / 2^shift is nearest to the scale."""
    _, exponent = math.frexp(scale)
    shift = min(max(31 - exponent, MIN_SHIFT), MAX_SHIFT)
    multiplier = int(math.floor(math.ldexp(scale, shift) + 0.5))
    if multiplier >= 1 << 31:
        multiplier, shift = multiplier >> 1, shift - 1
    if shift < MIN_SHIFT or multiplier >= 1 << 31:
        raise ValueError(f"a scale of {scale} does not fit the file")
    return max(1, multiplier), shift


def to_integers(rounded):
    """The layers of a RoundedNetwork that was calibrated."""
    made = []
    for index, layer in enumerate(rounded.layers):
        step_in = float(rounded.steps[layer.sources[0][0]])
        step_out = float(rounded.steps[index + 1])
        weight = rounded.weights[index].detach().double()
        steps = rounded.weight_steps(rounded.weights[index]).double()
        levels = torch.floor(weight / steps[:, None, None, None] + 0.5).clamp(-127, 127)
        units = step_in * steps
        biases = torch.floor(rounded.biases[index].detach().double() / units + 0.5).clamp(-MAX_BIAS, MAX_BIAS)
        pairs = [fixed_point(float(unit) / step_out) for unit in units]
        made.append(
            IntegerLayer(
                levels.permute(0, 2, 3, 1).contiguous().numpy().astype(np.int8),
                biases.numpy().astype(np.int64),
                np.array([pair[0] for pair in pairs], np.int64),
                np.array([pair[1] for pair in pairs], np.int64),
                step_out,
            )
        )
    return made


def run_integers(layers, numbers, picture):
    """Outputs by role, H x W x channels, of a picture of bytes, H x W x 3. Sums are exact in doubles: they are
    below 2^53."""
    tensors = [torch.from_numpy(picture.astype(np.float64)).permute(2, 0, 1)[None]]
    outputs = {}
    for layer, own in zip(layers, numbers):
        size = input_size(layer, tensors)
        sources = [torch.floor(enlarge(tensors[tensor], how, size) + 0.5) for tensor, how in layer.sources]
        weights = torch.from_numpy(own.weights.astype(np.float64)).permute(0, 3, 1, 2)
        sums = F.conv2d(torch.cat(sources, 1), weights, None, layer.stride, layer.kernel // 2)[0]
        whole = sums.numpy().astype(np.int64) + own.biases[:, None, None]
        half = np.int64(1) << (own.shifts - 1)
        scaled = (whole * own.multipliers[:, None, None] + half[:, None, None]) >> own.shifts[:, None, None]
        low = 0 if layer.relu else -128
        clamped = np.clip(scaled, low, low + 255)
        tensors.append(torch.from_numpy(clamped.astype(np.float64))[None])
        if layer.role:
            outputs[layer.role] = clamped.transpose(1, 2, 0)
    return outputs
