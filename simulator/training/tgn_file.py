"""Files of networks, as core/network/network_file.hpp has them, and their test vectors."""

import os
import struct

import numpy as np

from integers import run_integers

SIGNATURE = b"\x89TGN\r\n\x1a\n"
VERSION = 1
NAME_BYTES = 24


def crc_table():
    table = []
    for byte in range(256):
        for _ in range(8):
            byte = (byte >> 1) ^ (0x82F63B78 if byte & 1 else 0)
        table.append(byte)
    return table


CRC_TABLE = crc_table()


def crc32c(content):
    """CRC-32C (Castagnoli), as RFC 3720 has it."""
    remainder = 0xFFFFFFFF
    for byte in content:
        remainder = (remainder >> 8) ^ CRC_TABLE[(remainder ^ byte) & 0xFF]
    return remainder ^ 0xFFFFFFFF


def draw_test_picture(seed, width, height):
    """As core/network/test_vector.hpp says."""
    state = seed
    content = bytearray()
    for i in range(3 * width * height):
        state = (1664525 * state + 1013904223) & 0xFFFFFFFF
        content.append(((state >> 24) + i // 3 % 256) // 2)
    return np.frombuffer(bytes(content), np.uint8).reshape(height, width, 3)


def test_vector(layers, numbers, seed, width, height):
    picture = draw_test_picture(seed, width, height)
    outputs = run_integers(layers, numbers, picture)
    content = b"".join((outputs[layer.role] & 0xFF).astype(np.uint8).tobytes() for layer in layers if layer.role)
    return seed, crc32c(picture.tobytes()), crc32c(content)


def layer_bytes(layer, own):
    sources = list(layer.sources) + [(0, 0)] * (2 - len(layer.sources))
    head = struct.pack(
        "<8B4Hf",
        layer.kernel, layer.stride, int(layer.relu), layer.role,
        len(layer.sources), sources[0][1], sources[1][1], 0,
        sources[0][0], sources[1][0], layer.channels, 0,
        own.step,
    )
    return b"".join(
        [
            head,
            own.biases.astype("<i4").tobytes(),
            own.multipliers.astype("<i4").tobytes(),
            own.shifts.astype(np.uint8).tobytes(),
            own.weights.tobytes(),
        ]
    )


def compose(layers, numbers, width, height, class_names, provenance, seed):
    """The file's bytes."""
    text = provenance.encode("ascii")
    body = struct.pack(
        "<6H3I",
        VERSION, width, height, len(layers), len(class_names), len(text),
        *test_vector(layers, numbers, seed, width, height),
    )
    body += b"".join(name.encode("ascii").ljust(NAME_BYTES, b"\0") for name in class_names)
    body += text + b"".join(layer_bytes(layer, own) for layer, own in zip(layers, numbers))
    checked = struct.pack("<I", len(SIGNATURE) + 8 + len(body)) + body
    return SIGNATURE + struct.pack("<I", crc32c(checked)) + checked


def write_whole(path, content):
    """The file appears only when it is complete."""
    unfinished = f"{path}.part"
    with open(unfinished, "wb") as stream:
        stream.write(content)
    os.replace(unfinished, path)
