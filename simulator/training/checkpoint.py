"""Where a run stands, on disk."""

import os

import torch


def save_checkpoint(path, state):
    unfinished = f"{path}.part"
    torch.save(state, unfinished)
    os.replace(unfinished, path)


def load_checkpoint(path, digest):
    """None where there is none; ValueError where it belongs to another plan or other data."""
    if not os.path.exists(path):
        return None
    state = torch.load(path, map_location="cpu")
    if state["digest"] != digest:
        raise ValueError(
            f"{path}: expected a run of this plan and these captures, found another; name another --work, or remove it"
        )
    return state
