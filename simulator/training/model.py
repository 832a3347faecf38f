"""The network in floats, with and without the rounding that its file brings."""

import torch
import torch.nn.functional as F
from torch import nn

from layers import BILINEAR, NEAREST, SAME, shared_scales, tensor_channels

PIXEL_STEP = 1.0 / 255.0  # real value of one unit of the picture
LAST_BYTE = 255.0
LAST_SIGNED = 127.0
WEIGHT_LEVELS = 127.0


def enlarge(tensor, enlargement, size):
    """Twofold, cut off to `size`: height and width."""
    if enlargement == SAME:
        return tensor
    if enlargement == NEAREST:
        large = F.interpolate(tensor, scale_factor=2, mode="nearest")
    else:
        large = F.interpolate(tensor, scale_factor=2, mode="bilinear", align_corners=False)
    return large[..., : size[0], : size[1]]


def input_size(layer, tensors):
    """Height and width of what a layer reads: that of a source that is not enlarged, else twice its own."""
    for tensor, enlargement in layer.sources:
        if enlargement == SAME:
            return tensors[tensor].shape[-2:]
    height, width = tensors[layer.sources[0][0]].shape[-2:]
    return 2 * height, 2 * width


class FloatNetwork(nn.Module):
    """With batch norm after every convolution that has a ReLU. Takes pictures of 0 to 1, N x 3 x H x W."""

    def __init__(self, layers):
        super().__init__()
        self.layers = layers
        channels = tensor_channels(layers)
        self.convolutions = nn.ModuleList()
        self.norms = nn.ModuleList()
        for layer in layers:
            inputs = sum(channels[tensor] for tensor, _ in layer.sources)
            self.convolutions.append(
                nn.Conv2d(inputs, layer.channels, layer.kernel, layer.stride, layer.kernel // 2, bias=not layer.relu)
            )
            self.norms.append(nn.BatchNorm2d(layer.channels) if layer.relu else nn.Identity())

    def forward(self, picture):
        """Outputs by role."""
        tensors = [picture]
        outputs = {}
        for layer, convolution, norm in zip(self.layers, self.convolutions, self.norms):
            size = input_size(layer, tensors)
            sources = [enlarge(tensors[tensor], how, size) for tensor, how in layer.sources]
            made = norm(convolution(torch.cat(sources, 1)))
            tensors.append(F.relu(made) if layer.relu else made)
            if layer.role:
                outputs[layer.role] = tensors[-1]
        return outputs

    def folded(self):
        """Weights and bias of each layer, with its batch norm in them."""
        numbers = []
        for layer, convolution, norm in zip(self.layers, self.convolutions, self.norms):
            weight = convolution.weight.detach().clone()
            if not layer.relu:
                numbers.append((weight, convolution.bias.detach().clone()))
                continue
            gain = norm.weight.detach() / torch.sqrt(norm.running_var + norm.eps)
            bias = norm.bias.detach() - gain * norm.running_mean
            numbers.append((weight * gain[:, None, None, None], bias))
        return numbers


def round_through(values):
    """To the nearest integer, halves upward as core does; the gradient passes as if nothing had been rounded."""
    return values + (torch.floor(values + 0.5) - values).detach()


class RoundedNetwork(nn.Module):
    """The network whose weights and tensors take the values that 8 bits can state. `steps`, one a tensor, come
    from calibrate(); before that, nothing but weights is rounded."""

    def __init__(self, layers, numbers):
        super().__init__()
        self.layers = layers
        self.weights = nn.ParameterList([nn.Parameter(weight) for weight, _ in numbers])
        self.biases = nn.ParameterList([nn.Parameter(bias) for _, bias in numbers])
        self.register_buffer("steps", torch.zeros(len(layers) + 1))

    @staticmethod
    def weight_steps(weight):
        """One an output channel; never 0."""
        return weight.detach().abs().amax((1, 2, 3)).clamp_min(1e-7) / WEIGHT_LEVELS

    def rounded_weight(self, index):
        weight = self.weights[index]
        step = self.weight_steps(weight)[:, None, None, None]
        return round_through(weight / step) * step

    def is_calibrated(self):
        return bool((self.steps > 0).all())

    def round_tensor(self, values, tensor, is_signed):
        step = self.steps[tensor]
        low, high = (-LAST_SIGNED - 1, LAST_SIGNED) if is_signed else (0.0, LAST_BYTE)
        return torch.clamp(round_through(values / step), low, high) * step

    def run(self, picture):
        """All tensors."""
        is_rounding = self.is_calibrated()
        tensors = [picture]
        for index, layer in enumerate(self.layers):
            size = input_size(layer, tensors)
            sources = []
            for tensor, how in layer.sources:
                source = enlarge(tensors[tensor], how, size)
                if is_rounding and how == BILINEAR:
                    source = round_through(source / self.steps[tensor]) * self.steps[tensor]
                sources.append(source)
            made = F.conv2d(
                torch.cat(sources, 1), self.rounded_weight(index), self.biases[index], layer.stride, layer.kernel // 2
            )
            if layer.relu:
                made = F.relu(made)
            if is_rounding:
                made = self.round_tensor(made, index + 1, not layer.relu)
            tensors.append(made)
        return tensors

    def forward(self, picture):
        tensors = self.run(picture)
        return {layer.role: tensors[i + 1] for i, layer in enumerate(self.layers) if layer.role}

    @torch.no_grad()
    def calibrate(self, batches, share=0.9999):
        """Steps of the tensors, such that this share of their values on the batches is not cut off."""
        largest = torch.zeros(len(self.layers) + 1)
        for picture in batches:
            for i, tensor in enumerate(self.run(picture)):
                values = tensor.abs().flatten()
                rank = max(1, int(share * values.numel()))
                largest[i] = torch.maximum(largest[i], values.kthvalue(rank).values)
        steps = torch.zeros_like(largest)
        for i, layer in enumerate(self.layers):
            steps[i + 1] = largest[i + 1].clamp_min(1e-6) / (LAST_BYTE if layer.relu else LAST_SIGNED)
        steps[0] = PIXEL_STEP
        for i, first in enumerate(shared_scales(self.layers)):
            if first != i:
                steps[first] = torch.maximum(steps[first], steps[i])
        self.steps.copy_(steps[torch.tensor(shared_scales(self.layers))])
