"""The model card: what a network is, what it was trained on, and how good it is."""

import math

from layers import CLASS_NAMES

WEAK_IOU = 0.6


def figure_text(value):
    return "–" if math.isnan(value) else f"{value:.3f}"


def figure_rows(figures_by_kind):
    kinds = list(figures_by_kind)
    names = list(dict.fromkeys(name for figures in figures_by_kind.values() for name in figures))
    rows = ["| figure | " + " | ".join(kinds) + " |", "| --- |" + " --- |" * len(kinds)]
    for name in names:
        cells = [figure_text(figures_by_kind[kind].get(name, float("nan"))) for kind in kinds]
        rows.append(f"| {name} | " + " | ".join(cells) + " |")
    return rows


def weak_classes(figures):
    return [name for name in CLASS_NAMES if not figures[f"IoU {name}"] >= WEAK_IOU]


def set_names(sets):
    by_name = {}
    for rendered in sets:
        by_name.setdefault(rendered.name, []).append(str(rendered.seed))
    return "; ".join(f"{name}, seeds {', '.join(seeds)}" for name, seeds in by_name.items()) or "none"


def provenance(plan, counts, figures):
    """Lines of ASCII for the network's file."""
    return "\n".join(
        [
            f"plan {plan.digest}, seed {plan.seed}",
            f"{plan.steps} steps in floats, {plan.rounded_steps} with the rounding of 8 bits, batches of {plan.batch}",
            f"trained on {counts['train']} pictures: {set_names(plan.train)}",
            f"held out {counts['held_out']} pictures: {set_names(plan.held_out)}",
            f"IoU of food on these, in 8 bits: {figures['IoU food']:.3f}".replace("nan", "not measured"),
        ]
    )


def compose_card(plan, counts, file_name, file_bytes, weights, figures_by_kind, same_class):
    rounded = figures_by_kind["8 bits"]
    faults = list(plan.faults)
    faults += [f"`{name}` is found badly on held-out pictures, or is not on them." for name in weak_classes(rounded)]
    faults.append("Cups, glasses, hands and other things are no class: the renderer draws none of them.")
    classes = f"{', '.join(CLASS_NAMES[:-1])} and {CLASS_NAMES[-1]}"
    lines = [
        f"# Model card: {file_name}",
        "",
        f"A U-Net of {weights} weights of 8 bits ({file_bytes} bytes) for pictures of {plan.width} x {plan.height}. It"
        f" tells {classes} apart, borders between items, and gives {plan.embedding} numbers a cell that are alike"
        " within portions of one food.",
        "",
        "## Training",
        "",
        f"- Plan {plan.digest}, seed {plan.seed}: {plan.steps} steps in floats, {plan.rounded_steps} with rounding,"
        f" batches of {plan.batch}.",
        f"- Trained on {counts['train']} pictures: {set_names(plan.train)}; further folders of captures:"
        f" {counts['further']}.",
        f"- Held out {counts['held_out']} pictures: {set_names(plan.held_out)}; further folders:"
        f" {counts['held_out_further']}. No photograph was trained on.",
        "",
        "## Figures, on pictures never trained on",
        "",
        *figure_rows(figures_by_kind),
        "",
        "Cells of the held-out pictures to which integers give the class that the rounded network gives in floats:"
        f" {figure_text(same_class)}.",
        "",
        "## Known faults",
        "",
        *[f"- {fault}" for fault in faults],
        "",
    ]
    return "\n".join(lines)
