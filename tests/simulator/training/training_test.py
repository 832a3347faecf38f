#!/usr/bin/env python3
"""Trains a toy and hands it to the program: the whole way from captures to classes, in less than a minute.

Usage: training_test.py BUILD SOURCE, the folders of the build and of the checkout. Exit status 77: python3-torch,
python3-numpy or python3-pil is not installed, which only CI counts as a failure.
"""

import math
import os
import random
import re
import struct
import subprocess
import sys
import tempfile
import unittest
from dataclasses import replace

try:
    import numpy as np
    import torch
    from PIL import Image
except ImportError as absent:
    print(f"{absent}: install what simulator/training/packages.txt names")
    sys.exit(1 if os.environ.get("CI") == "true" else 77)

# As tests/support/random_seed.hpp: on CI always the same.
SEED = int(os.environ.get("TRAYGAUGE_SEED", "1" if "CI" in os.environ else random.randrange(1 << 32)))
print(f"TRAYGAUGE_SEED={SEED}", flush=True)
random.seed(SEED)

BUILD, SOURCE = sys.argv.pop(1), sys.argv.pop(1)
TRAINING = os.path.join(SOURCE, "simulator", "training")
DEMO = os.path.join(SOURCE, "simulator", "demo")
sys.path.insert(0, TRAINING)

from augmentation import draw_batch, draw_sample, whole_picture  # noqa: E402
from captures import ANYTHING, Sample, bits, pair_with_bare, read_captures  # noqa: E402
from emptying import SHADE_PX, take_food, widened  # noqa: E402
from fitting import fit_picture  # noqa: E402
from integers import IntegerLayer, fixed_point, run_integers, to_integers  # noqa: E402
from layers import CLASSES, CLASS_NAMES, FOOD, food_layers, shared_scales, tensor_channels  # noqa: E402
from losses import BORDER_REACH, border_cells, embedding_loss  # noqa: E402
from measuring import agreement, float_outputs  # noqa: E402
from model import FloatNetwork, RoundedNetwork  # noqa: E402
from pasting import LEAST_PX, PASTED_LABEL, paste_food  # noqa: E402
from repainting import kind_mask, lay_things, repaint, repaint_item, smear  # noqa: E402
from tgn_file import crc32c  # noqa: E402

from plan import read_plan  # noqa: E402

PLAN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "toy.toml")
TOY = read_plan(PLAN)
TOY_LAYERS = food_layers(TOY.down, TOY.up, TOY.embedding)


def train(work, out, *more, plan=PLAN):
    command = [sys.executable, os.path.join(TRAINING, "train.py"), "--plan", plan, "--work", work, "--out", out]
    command += ["--captures", os.path.join(DEMO, "fish_and_potatoes")]
    command += ["--held-out", os.path.join(DEMO, "mash_and_meatballs"), *more]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def traygauge(*arguments):
    return subprocess.run([os.path.join(BUILD, "traygauge"), *arguments], capture_output=True, text=True, check=False)


def read_numbers(path, layers):
    """The numbers of a file's layers, which are known."""
    content = read(path)
    classes, text = struct.unpack_from("<HH", content, 24)
    at = 40 + 24 * classes + text
    numbers = []
    channels = tensor_channels(layers)
    for layer in layers:
        count = layer.channels
        inputs = sum(channels[tensor] for tensor, _ in layer.sources)
        step = struct.unpack_from("<f", content, at + 16)[0]
        at += 20
        biases = np.frombuffer(content, "<i4", count, at).astype(np.int64)
        multipliers = np.frombuffer(content, "<i4", count, at + 4 * count).astype(np.int64)
        shifts = np.frombuffer(content, np.uint8, count, at + 8 * count).astype(np.int64)
        shape = (count, layer.kernel, layer.kernel, inputs)
        weights = np.frombuffer(content, np.int8, int(np.prod(shape)), at + 9 * count).reshape(shape)
        numbers.append(IntegerLayer(weights, biases, multipliers, shifts, step))
        at += 9 * count + weights.size
    assert at == len(content)
    return numbers


def read(path):
    with open(path, "rb") as stream:
        return stream.read()


class WholeWay(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.file = os.path.join(cls.folder.name, "toy.tgn")
        cls.run_at_once = train(os.path.join(cls.folder.name, "work"), cls.file)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_learns(self):
        self.assertEqual(self.run_at_once.returncode, 0, self.run_at_once.stderr)
        rows = re.findall(r"\| IoU food \| ([\d.]+) \| ([\d.]+) \|", self.run_at_once.stdout)
        # Food covers less than a tenth of these pictures.
        self.assertGreater(float(rows[0][1]), 0.3, self.run_at_once.stdout)
        self.assertIn("held out", self.run_at_once.stdout.lower())
        self.assertEqual(read(self.file[:-4] + ".md").decode(), self.run_at_once.stdout)

    def test_stopped_and_taken_up_again_gives_the_same_file(self):
        work, other = os.path.join(self.folder.name, "pieces"), os.path.join(self.folder.name, "pieces.tgn")
        for steps in ("40", "125"):  # in floats, and with rounding
            self.assertEqual(train(work, other, "--stop-after", steps).returncode, 0)
            self.assertFalse(os.path.exists(other))
        self.assertEqual(train(work, other).returncode, 0)
        self.assertEqual(read(other), read(self.file))

    def test_the_program_computes_what_the_file_states(self):
        shown = traygauge("network", self.file)
        self.assertEqual(shown.returncode, 0, shown.stderr)
        self.assertIn("computed as the file states", shown.stdout)
        self.assertIn("seed 1", shown.stdout)

    def test_the_program_finds_the_classes_that_integers_give_here(self):
        picture_file = os.path.join(DEMO, "mash_and_meatballs", "view_0.jpg")
        sheet = os.path.join(self.folder.name, "sheet.png")
        shown = traygauge("network", self.file, "--picture", picture_file, "-o", sheet)
        self.assertEqual(shown.returncode, 0, shown.stderr)
        told = {name: float(share) for name, share in re.findall(r"^(\w+) +([\d.]+) %", shown.stdout, re.M)}
        with Image.open(picture_file) as picture:
            whole, place = fit_picture(np.asarray(picture.convert("RGB")), 96, 72)
        self.assertEqual(place, (0, 0, 96, 72))
        classes = run_integers(TOY_LAYERS, read_numbers(self.file, TOY_LAYERS), whole)[CLASSES].argmax(2)
        for index, name in enumerate(CLASS_NAMES):
            self.assertAlmostEqual(told[name], 100.0 * (classes == index).mean(), delta=0.051, msg=name)
        with Image.open(sheet) as picture:
            self.assertEqual(picture.size, (4 * 96, 72))

    def test_a_damaged_file_is_refused(self):
        content = bytearray(read(self.file))
        content[random.randrange(8, len(content))] ^= 1
        damaged = os.path.join(self.folder.name, "damaged.tgn")
        with open(damaged, "wb") as stream:
            stream.write(content)
        shown = traygauge("network", damaged)
        self.assertEqual((shown.returncode, shown.stdout), (2, ""))
        self.assertIn("damaged", shown.stderr)

    def test_the_stored_network_is_that_of_the_stored_plan(self):
        shown = traygauge("network", os.path.join(SOURCE, "config", "network", "food.tgn"))
        self.assertEqual(shown.returncode, 0, shown.stderr)
        self.assertIn("computed as the file states", shown.stdout)
        plan = read_plan(os.path.join(TRAINING, "food.toml"))
        self.assertIn(f"plan {plan.digest}, seed {plan.seed}", shown.stdout)
        with open(os.path.join(SOURCE, "config", "network", "food.md"), encoding="utf-8") as card:
            self.assertIn(plan.digest, card.read())

    def test_what_cannot_be_trained_ends_with_a_sentence(self):
        work = os.path.join(self.folder.name, "work")
        other_plan = os.path.join(self.folder.name, "other.toml")
        with open(PLAN, encoding="utf-8") as stream:
            text = stream.read()
        for change, told in (("seed = 1", "another run"), ("seed = 1\nsead = 2", "sead"), ("", "seed")):
            with open(other_plan, "w", encoding="utf-8") as stream:
                stream.write(text.replace("seed = 1", change) if told != "another run" else text + "\n# changed\n")
            ended = train(work, self.file + ".other", plan=other_plan)
            self.assertEqual(ended.returncode, 2, ended.stderr)
            self.assertIn("another" if told == "another run" else told, ended.stderr)
            self.assertEqual(ended.stderr.count("\n"), 1, ended.stderr)
        ended = train(work, self.file + ".other", plan=os.path.join(self.folder.name, "absent.toml"))
        self.assertEqual((ended.returncode, ended.stderr.count("\n")), (2, 1), ended.stderr)


class Integers(unittest.TestCase):
    """With weights by chance: nothing of this depends on training."""

    @classmethod
    def setUpClass(cls):
        torch.set_num_threads(1)
        torch.manual_seed(random.randrange(1 << 30))
        cls.layers = food_layers((6, 8, 10), (8, 6), 8)
        floats = FloatNetwork(cls.layers)
        cls.samples = read_captures([DEMO])
        batches = [draw_batch(cls.samples, replace(TOY, width=64, height=48), step).picture for step in range(4)]
        for batch in batches:
            floats(batch)  # batch norms learn what comes
        cls.rounded = RoundedNetwork(cls.layers, floats.eval().folded())
        cls.rounded.calibrate(batches)
        cls.numbers = to_integers(cls.rounded)

    def test_agree_with_the_rounded_network_in_floats(self):
        share = agreement(
            float_outputs(self.rounded), lambda picture: run_integers(self.layers, self.numbers, picture),
            self.samples, 64, 48,
        )
        # Floats differ where a value lies at a half, and a class where two channels are as large.
        self.assertGreater(share, 0.95)

    def test_sources_of_one_layer_share_their_step(self):
        group = shared_scales(self.layers)
        for layer in self.layers:
            steps = {float(self.rounded.steps[tensor]) for tensor, _ in layer.sources}
            self.assertEqual(len(steps), 1)
            self.assertEqual(len({group[tensor] for tensor, _ in layer.sources}), 1)

    def test_fixed_point_is_the_nearest(self):
        for _ in range(2000):
            scale = 2.0 ** random.uniform(-31.0, 20.0)
            multiplier, shift = fixed_point(scale)
            self.assertLess(multiplier, 1 << 31)
            self.assertTrue(1 <= shift <= 62)
            self.assertLessEqual(abs(multiplier / 2.0**shift - scale), scale * 2.0**-31 * 1.01)

    def test_checksum_has_the_usual_check_value(self):
        self.assertEqual(crc32c(b"123456789"), 0xE3069283)


class Parts(unittest.TestCase):
    def test_pictures_are_reduced_by_area(self):
        """fit_picture against a mean by hand; network_input_test has the same of core's."""
        with Image.open(os.path.join(DEMO, "fish_and_potatoes", "view_0.jpg")) as picture:
            pixels = np.asarray(picture.convert("RGB"))[:700, :1111]
        whole, place = fit_picture(pixels, 96, 72)
        left, top, wide, high = place
        rows, columns = pixels.shape[:2]
        self.assertTrue(wide == 96 or high == 72)
        # A pixel in the middle by hand, in fractions.
        x, y = wide // 2, high // 2
        expected = np.zeros(3)
        for row in range(y * rows // high, math.ceil((y + 1) * rows / high)):
            tall = min(row + 1, (y + 1) * rows / high) - max(row, y * rows / high)
            for column in range(x * columns // wide, math.ceil((x + 1) * columns / wide)):
                broad = min(column + 1, (x + 1) * columns / wide) - max(column, x * columns / wide)
                expected += tall * broad * pixels[row, column]
        expected /= rows * columns / (high * wide)
        self.assertLessEqual(np.abs(whole[top + y, left + x] - expected).max(), 0.5 + 1e-6)

    def test_border_lies_between_items_alone(self):
        items = torch.zeros(1, 6, 8, dtype=torch.long)
        items[0, 1:5, 0:4] = 2
        items[0, 1:5, 4:8] = 3
        border = border_cells(items)[0, 0]
        self.assertEqual(border.sum(), 4 * 2 * BORDER_REACH)
        self.assertEqual(border[1:5, 4 - BORDER_REACH : 4 + BORDER_REACH].sum(), 4 * 2 * BORDER_REACH)

    def test_embedding_pulls_one_food_and_pushes_others(self):
        samples = read_captures([os.path.join(DEMO, "mash_and_meatballs")])
        batch = draw_batch(samples, replace(TOY, batch=1, width=320, height=240), 0)
        present = sorted(set(batch.items.flatten().tolist()) - {0})
        self.assertEqual(len(present), 2)
        apart = torch.zeros(1, 2, 60, 80)
        cells = batch.items[:, ::2, ::2]
        apart[0, 0][cells[0] == present[0]] = 4.0
        together = torch.zeros(1, 2, 60, 80)
        self.assertLess(float(embedding_loss(apart, batch)), float(embedding_loss(together, batch)))
        batch.foods = [{label: "the same" for label in present}]
        self.assertGreater(float(embedding_loss(apart, batch)), float(embedding_loss(together, batch)))

    def test_paint_covers_what_it_may(self):
        rng = np.random.default_rng(SEED)
        kinds = torch.from_numpy(np.kron(rng.integers(0, len(CLASS_NAMES), (6, 8)), np.ones((8, 8), np.int64)))
        allowed = 1 << kinds
        picture = torch.from_numpy(rng.random((3, 48, 64))).float()
        table, food, glaze = (kind_mask(allowed, (name,)) for name in ("table", "food", "glaze"))
        self.assertTrue(torch.equal(table, kinds == 0))
        painted = {
            "tray": (repaint(rng, picture, table), table),
            "things": (lay_things(rng, picture, table.float()), table),
            "smears": (smear(rng, picture, food, glaze.float()), glaze),
        }
        for name, (made, may_change) in painted.items():
            self.assertTrue(torch.equal(made[:, ~may_change], picture[:, ~may_change]), name)
            self.assertTrue(0.0 <= float(made.min()) and float(made.max()) <= 1.0, name)
        self.assertFalse(torch.equal(painted["tray"][0], picture))

    def test_an_item_in_another_colour_stays_where_it_is(self):
        rng = np.random.default_rng(SEED)
        samples = read_captures([DEMO])[:2]
        repainted = 0
        for index in range(20):
            picture, allowed, items = draw_sample(rng, samples[index % 2], 160, 120)
            allowed = torch.where(allowed == bits("glaze", "rim"), torch.full_like(allowed, bits("glaze")), allowed)
            made, label = repaint_item(rng, picture, allowed, items)
            changed = (made != picture).any(0)
            self.assertEqual(bool(changed.any()), label != 0)
            self.assertFalse(bool((changed & ((items != label) | (items == 0))).any()))
            self.assertTrue(0.0 <= float(made.min()) and float(made.max()) <= 1.0)
            repainted += int(label != 0)
        self.assertGreater(repainted, 0)

    def test_what_is_eaten_shows_the_dish_below(self):
        rng = np.random.default_rng(SEED)
        items = torch.zeros(60, 80, dtype=torch.long)
        items[10:30, 10:30], items[30:50, 40:70] = 2, 3
        glaze = torch.full_like(items, bits("glaze"))
        allowed = torch.where(items > 0, bits("food"), glaze)
        picture = torch.where(items > 0, 0.9, 0.4).expand(3, -1, -1)
        darker = torch.full((3, 60, 80), 0.2)  # exposed otherwise
        shares = []
        for _ in range(60):
            made, kinds, left = take_food(rng, picture, allowed, items, darker, glaze)
            eaten = (items > 0) & (left == 0)
            self.assertTrue(torch.equal(left[~eaten], items[~eaten]))
            self.assertTrue(torch.equal(kinds, torch.where(left > 0, bits("food"), glaze)))
            self.assertLess(float((made - torch.where(left > 0, 0.9, 0.4)).abs().max()), 1e-5)
            shares.append(float(eaten.sum() / (items > 0).sum()))
        self.assertIn(0.0, shares)
        self.assertIn(1.0, shares)
        self.assertTrue(any(0.0 < share < 1.0 for share in shares))

    def test_taken_food_changes_nothing_far_from_it(self):
        rng = np.random.default_rng(SEED)
        sample = read_captures([DEMO])[0]
        picture, allowed, items = draw_sample(rng, sample, 160, 120)
        made, _, left = take_food(rng, picture, allowed, items, torch.rand(picture.shape), allowed)
        far = ~widened((items > 0) & (left == 0), 2 * SHADE_PX)
        self.assertTrue(torch.equal(made[:, far], picture[:, far]))
        self.assertTrue(torch.equal(made[:, left > 0], picture[:, left > 0]))

    def test_views_meet_those_without_food(self):
        one = os.path.join(DEMO, "fish_and_potatoes")
        samples = read_captures([one])
        pair_with_bare(samples, one)
        self.assertTrue(all(sample.bare.name == sample.name for sample in samples))
        rng = np.random.default_rng(SEED)
        for sample in samples:
            left = [int((draw_sample(rng, sample, 160, 120)[2] > 0).sum()) for _ in range(60)]
            self.assertIn(0, left)
            self.assertTrue(any(left))
        with self.assertRaisesRegex(ValueError, f"expected {len(samples)} views, as there are with food, found"):
            pair_with_bare(samples, DEMO)

    def test_pasted_food_hides_no_dish(self):
        samples = read_captures([DEMO])
        rng = np.random.default_rng(SEED)
        pasted = 0
        for _ in range(20):
            host, donor = (samples[i] for i in rng.integers(0, len(samples), 2))
            picture, allowed, items = draw_sample(rng, host, 160, 120)
            # Labels alone do not tell table from cutlery.
            allowed = torch.where(allowed & 1 > 0, torch.ones_like(allowed), allowed)
            lent, _, lent_items = draw_sample(rng, donor, 160, 120)
            made, kinds, labels, taken = paste_food(rng, picture, allowed, items, lent, lent_items)
            laid = labels == PASTED_LABEL
            self.assertEqual(bool(laid.any()), taken != 0)
            self.assertTrue(torch.equal(kinds[~laid], allowed[~laid]) and torch.equal(labels[~laid], items[~laid]))
            self.assertTrue(bool((kinds[laid] == 1 << FOOD).all()) and bool((allowed[laid] == 1).all()))
            on_dish = allowed != 1
            self.assertTrue(torch.equal(made[:, on_dish], picture[:, on_dish]))
            pasted += int(taken != 0)
            self.assertTrue(taken == 0 or int(laid.sum()) >= LEAST_PX)
        self.assertGreater(pasted, 0)

    def test_truth_lies_where_the_picture_does(self):
        rows, columns = 90, 240  # wider than the network's picture
        items = np.zeros((rows, columns), np.uint8)
        items[30:60, 100:180] = 7
        picture = np.repeat((items > 0)[:, :, None], 3, 2).astype(np.uint8) * 255
        allowed = np.where(items > 0, 1 << FOOD, 1).astype(np.uint8)
        batch = whole_picture(Sample("drawn", picture, allowed, items, {7: "food"}), 160, 120)
        shown = batch.picture[0, 0, 1::2, 1::2]
        self.assertTrue(torch.equal(shown > 0.9, batch.items[0] == 7))
        self.assertTrue(bool((batch.allowed[0][:10] == ANYTHING).all()))

    def test_batches_depend_on_seed_and_step_alone(self):
        samples = read_captures([DEMO])
        first, again = (draw_batch(samples, TOY, 9) for _ in range(2))
        self.assertTrue(torch.equal(first.picture, again.picture) and torch.equal(first.items, again.items))
        self.assertFalse(torch.equal(first.picture, draw_batch(samples, TOY, 10).picture))
        self.assertEqual(first.picture.shape, (TOY.batch, 3, TOY.height, TOY.width))
        self.assertLess(int(first.allowed.max()), 1 << len(CLASS_NAMES))


if __name__ == "__main__":
    unittest.main(verbosity=2)
