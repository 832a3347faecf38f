"""Batches drawn by a process of their own while the network learns from the one before."""

import collections
import multiprocessing
import signal
from concurrent.futures import ProcessPoolExecutor

import torch

from augmentation import draw_batch

MOST_AHEAD = 4

_drawn_from = None  # of the drawing process: samples and plan


def begin_drawing(samples, plan):
    global _drawn_from
    _drawn_from = (samples, plan)
    torch.set_num_threads(1)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the process that learns


def draw_step(step):
    samples, plan = _drawn_from
    return draw_batch(samples, plan, step)


class BatchesAhead:
    """Those of the steps from `first` to `end`, in order. A with statement ends the process."""

    def __init__(self, samples, plan, first, end):
        # A fork sees the samples without a copy of them.
        self.process = ProcessPoolExecutor(1, multiprocessing.get_context("fork"), begin_drawing, (samples, plan))
        self.steps = iter(range(first, end))
        self.ordered = collections.deque()
        for _ in range(MOST_AHEAD):
            self.order()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.shutdown(cancel_futures=True)

    def order(self):
        step = next(self.steps, None)
        if step is not None:
            self.ordered.append(self.process.submit(draw_step, step))

    def take(self):
        batch = self.ordered.popleft().result()
        self.order()
        return batch
