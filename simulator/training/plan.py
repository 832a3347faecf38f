"""What is to be trained, on what, and for how long: a TOML file."""

import hashlib
import tomllib
from dataclasses import dataclass, field


@dataclass(frozen=True)
class RenderedSet:
    """Of `traygauge-simulate render`: a set and a seed."""

    name: str
    seed: int
    pairs: int = 0
    bare: bool = False  # without food as well

    def folder(self):
        return f"{self.name}-{self.seed}"

    def bare_folder(self):
        return f"{self.folder()}-bare"


@dataclass(frozen=True)
class Plan:
    width: int
    height: int
    down: tuple
    up: tuple
    embedding: int
    steps: int  # in floats
    rounded_steps: int  # after that, with the rounding of 8 bits
    batch: int
    rate: float
    rounded_rate: float
    seed: int
    train: tuple  # RenderedSet
    held_out: tuple
    faults: tuple = ()
    repainted_food: float = 0.0  # share of the pictures on which one food gets another colour
    digest: str = field(default="", compare=False)


class PlanError(Exception):
    """A sentence about the file."""


def read_sets(entries):
    return tuple(RenderedSet(str(entry["set"]), int(seed), int(entry.get("pairs", 0)), bool(entry.get("bare", False)))
                 for entry in entries for seed in entry["seeds"])


def read_plan(path):
    try:
        with open(path, "rb") as stream:
            content = stream.read()
        values = tomllib.loads(content.decode("utf-8"))
        sections = [values["network"], values["schedule"], values.get("augmentation", {})]
        known = {name: value for section in sections for name, value in section.items()}
        plan = Plan(
            **{name: tuple(value) if isinstance(value, list) else value for name, value in known.items()},
            train=read_sets(values.get("train", [])),
            held_out=read_sets(values.get("held_out", [])),
            faults=tuple(values.get("faults", ())),
            digest=hashlib.sha256(content).hexdigest()[:16],
        )
    except OSError as problem:
        raise PlanError(f"{path}: expected a plan of the training, found {problem.strerror}") from problem
    except (tomllib.TOMLDecodeError, UnicodeDecodeError, KeyError, TypeError, ValueError) as problem:
        raise PlanError(f"{path}: expected a plan like simulator/training/food.toml, found: {problem}") from problem
    if set(plan.train) & set(plan.held_out):
        raise PlanError(f"{path}: expected held-out sets that are not trained on, found one that is")
    if len(plan.up) != len(plan.down) - 1:
        found = f"{len(plan.up)} and {len(plan.down)}"
        raise PlanError(f"{path}: expected one number less in `up` than in `down`, found {found}")
    return plan
