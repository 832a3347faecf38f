#!/usr/bin/env python3
"""Trains the network for food and writes its file and its model card.

One call does all of it: renders what is missing, trains, goes on with the rounding of 8 bits, measures on held-out
pictures, and writes. A call that was stopped goes on where it was; the same plan and captures give the same file on the
same machine. README.md has more.
"""

import argparse
import ctypes
import hashlib
import math
import os
import subprocess
import sys

import torch

from augmentation import draw_batch
from captures import pair_with_bare, read_captures
from checkpoint import load_checkpoint, save_checkpoint
from drawing import BatchesAhead
from integers import run_integers, to_integers
from layers import CLASS_NAMES, food_layers
from losses import total_loss
from measuring import agreement, float_outputs, measure, measure_photographs
from model import FloatNetwork, RoundedNetwork
from model_card import compose_card, provenance
from plan import PlanError, read_plan
from progress import Progress
from tgn_file import compose, write_whole

SAVE_STEPS = 200
LAST_RATE = 0.01  # of the first: where the cosine ends
WARM_UP = 0.02  # of the steps: the rate rises
TEST_SEED = 1  # of the file's test picture
# glibc's mallopt().
M_TRIM_THRESHOLD, M_MMAP_THRESHOLD = -1, -3
MOST_MMAP_THRESHOLD = 32 << 20  # what glibc takes at most


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    here = os.path.dirname(os.path.abspath(__file__))
    parser.add_argument("--plan", default=os.path.join(here, "food.toml"), help="what to train, default food.toml")
    parser.add_argument("--work", required=True, help="folder for captures and for where the run stands")
    parser.add_argument("--out", required=True, help="the network's file (.tgn); its model card is NAME.md beside it")
    parser.add_argument("--renderer", help="traygauge-simulate, where sets are to be rendered")
    parser.add_argument("--jobs", type=int, default=0, help="threads of the renderer; 0: one a core")
    parser.add_argument("--captures", action="append", default=[], help="a further folder of captures to train on")
    parser.add_argument("--held-out", action="append", default=[], help="a further folder of captures to measure on")
    parser.add_argument("--photographs", help="folder with NAME.jpg and NAME_mask.png, to measure on")
    parser.add_argument("--stop-after", type=int, default=0, help="stop after so many steps; the next call goes on")
    return parser.parse_args()


def render_missing(plan, arguments):
    for rendered in plan.train + plan.held_out:
        if arguments.renderer is None:
            raise PlanError(f"{arguments.plan}: renders {rendered.name}; name the program with --renderer")
        command = [arguments.renderer, "render", rendered.name, "--reduced", "--kinds", "--seed", str(rendered.seed)]
        command += ["--pairs", str(rendered.pairs), "--jobs", str(arguments.jobs), "--out"]
        captures = os.path.join(arguments.work, "captures")
        subprocess.run(command + [os.path.join(captures, rendered.folder())], check=True, stdout=subprocess.DEVNULL)
        if rendered.bare:
            out = os.path.join(captures, rendered.bare_folder())
            subprocess.run(command + [out, "--bare"], check=True, stdout=subprocess.DEVNULL)


def read_samples(plan, arguments):
    """Those to train on, and those to measure on."""
    captures = os.path.join(arguments.work, "captures")

    def samples_of(sets, further):
        samples = []
        for rendered in sets:
            own = read_captures([os.path.join(captures, rendered.folder())])
            if rendered.bare:
                pair_with_bare(own, os.path.join(captures, rendered.bare_folder()))
            samples += own
        return samples + read_captures(further)

    train = samples_of(plan.train, arguments.captures)
    held_out = samples_of(plan.held_out, arguments.held_out)
    for samples, what in ((train, "train"), (held_out, "measure")):
        if not samples:
            raise PlanError(f"{arguments.plan}: expected captures with labels to {what} on, found none")
    return train, held_out


def digest_of(plan, samples):
    """Of all that a run depends on."""
    content = hashlib.sha256(plan.digest.encode())
    for sample in samples:
        for view in (sample, sample.bare):
            if view is not None:
                for part in (view.picture, view.allowed, view.items):
                    content.update(part.tobytes())
        content.update(repr(sorted(sample.foods.items())).encode())
    return content.hexdigest()


def rate_at(step, steps, first):
    warm = min(1.0, (step + 1) / max(1.0, WARM_UP * steps))
    cosine = 0.5 * (1.0 + math.cos(math.pi * step / steps))
    return first * warm * (LAST_RATE + (1.0 - LAST_RATE) * cosine)


def channels_side_by_side(what):
    """A network or a tensor: convolutions of few channels run two to three times as fast so."""
    return what.to(memory_format=torch.channels_last)


class Run:
    """A training that can be stopped after any step."""

    def __init__(self, plan, samples, work, stop_after):
        self.plan, self.samples = plan, samples
        self.path = os.path.join(work, "checkpoint.pt")
        self.digest = digest_of(plan, samples)
        self.layers = food_layers(plan.down, plan.up, plan.embedding)
        self.stop_after = stop_after
        torch.manual_seed(plan.seed)
        self.floats = channels_side_by_side(FloatNetwork(self.layers))
        self.rounded = None
        self.step = 0
        self.begin_phase()
        state = load_checkpoint(self.path, self.digest)
        if state is not None:
            self.restore(state)

    def network(self):
        return self.floats if self.rounded is None else self.rounded

    def begin_phase(self):
        self.optimiser = torch.optim.AdamW(self.network().parameters(), lr=self.plan.rate, weight_decay=1e-4)

    def restore(self, state):
        self.step = state["step"]
        self.floats.load_state_dict(state["floats"])
        if state["rounded"] is not None:
            self.rounded = channels_side_by_side(RoundedNetwork(self.layers, self.floats.folded()))
            self.rounded.load_state_dict(state["rounded"])
            self.begin_phase()
        self.optimiser.load_state_dict(state["optimiser"])

    def save(self):
        rounded = None if self.rounded is None else self.rounded.state_dict()
        save_checkpoint(self.path, {
            "digest": self.digest, "step": self.step, "floats": self.floats.state_dict(), "rounded": rounded,
            "optimiser": self.optimiser.state_dict(),
        })

    def round_off(self):
        """From floats to 8 bits: batch norms go into the weights, and tensors get their steps."""
        self.rounded = channels_side_by_side(RoundedNetwork(self.layers, self.floats.folded()))
        end = self.plan.steps + self.plan.rounded_steps
        batches = [draw_batch(self.samples, self.plan, end + i).picture for i in range(8)]
        self.rounded.calibrate(batches)
        self.begin_phase()

    def advance(self, batch):
        plan = self.plan
        if self.step == plan.steps and self.rounded is None:
            self.round_off()
        if self.rounded is None:
            rate = rate_at(self.step, plan.steps, plan.rate)
        else:
            rate = rate_at(self.step - plan.steps, plan.rounded_steps, plan.rounded_rate)
        for group in self.optimiser.param_groups:
            group["lr"] = rate
        self.network().train()
        loss = total_loss(self.network()(channels_side_by_side(batch.picture)), batch)
        self.optimiser.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_(self.network().parameters(), 5.0)
        self.optimiser.step()
        self.step += 1
        return float(loss)

    def finish(self):
        """False where it was stopped before the end."""
        total = self.plan.steps + self.plan.rounded_steps
        end = min(total, self.stop_after) if self.stop_after else total
        progress = Progress("training", total)
        with BatchesAhead(self.samples, self.plan, self.step, end) as batches:
            while self.step < end:
                loss = self.advance(batches.take())
                progress.show(self.step, f"loss {loss:.3f}")
                if self.step % SAVE_STEPS == 0:
                    self.save()
        self.save()
        return self.step == total


def write_results(run, held_out, plan, arguments):
    numbers = to_integers(run.rounded.eval())
    by_floats = float_outputs(run.floats.eval())

    def by_integers(picture):
        return run_integers(run.layers, numbers, picture)

    size = (plan.width, plan.height)
    figures = {"floats": measure(by_floats, held_out, *size), "8 bits": measure(by_integers, held_out, *size)}
    if arguments.photographs:
        figures["floats"].update(measure_photographs(by_floats, arguments.photographs, *size))
        figures["8 bits"].update(measure_photographs(by_integers, arguments.photographs, *size))
    same_class = agreement(float_outputs(run.rounded), by_integers, held_out, *size)
    counts = {
        "train": len(run.samples), "further": len(arguments.captures),
        "held_out": len(held_out), "held_out_further": len(arguments.held_out),
    }
    text = provenance(plan, counts, figures["8 bits"])
    content = compose(run.layers, numbers, *size, CLASS_NAMES, text, TEST_SEED)
    weights = sum(own.weights.size for own in numbers)
    name = os.path.basename(arguments.out)
    card = compose_card(plan, counts, name, len(content), weights, figures, same_class)
    write_whole(arguments.out, content)
    write_whole(os.path.splitext(arguments.out)[0] + ".md", card.encode("utf-8"))
    print(card, end="")


def keep_freed_memory():
    """Each step frees its tensors. Given back to the system, their memory would have to be fetched again, which takes
    half of the time."""
    libc = ctypes.CDLL(None)
    libc.mallopt(M_MMAP_THRESHOLD, MOST_MMAP_THRESHOLD)
    libc.mallopt(M_TRIM_THRESHOLD, (1 << 31) - 1)


def main():
    arguments = parse_arguments()
    keep_freed_memory()
    # Sums in another order are other sums: the same file needs the same number of threads.
    torch.set_num_threads(1)
    torch.use_deterministic_algorithms(True)
    os.makedirs(arguments.work, exist_ok=True)
    try:
        plan = read_plan(arguments.plan)
        render_missing(plan, arguments)
        train, held_out = read_samples(plan, arguments)
        run = Run(plan, train, arguments.work, arguments.stop_after)
    except (PlanError, OSError, ValueError, subprocess.CalledProcessError) as problem:
        sys.stderr.write(f"train.py: {problem}\n")
        return 2
    try:
        if run.finish():
            write_results(run, held_out, plan, arguments)
    except KeyboardInterrupt:
        sys.stderr.write(f"\ntrain.py: stopped at step {run.step}; the next call goes on from the last checkpoint\n")
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
