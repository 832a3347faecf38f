#!/usr/bin/python3
"""Writes scenes with one tall food each, from config/scenes/example.toml: tall_scenes.py FOLDER

Eight foods of 60, 80, 100 and 120 mm, in pictures of 800 x 600. Each is rendered by `traygauge-simulate render`.
"""
import pathlib
import sys

FOODS = [  # kind, length and width in mm
    ("mash", 100, 90),
    ("mash", 80, 70),
    ("bread", 100, 90),
    ("cake", 100, 80),
    ("burger_patty", 110, 110),
    ("lasagne", 110, 90),
    ("potatoes", 110, 100),
    ("fries", 110, 90),
]
HEIGHTS_MM = [60, 80, 100, 120]


def main() -> None:
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    config = pathlib.Path(__file__).resolve().parents[2] / "config"
    example = (config / "scenes/example.toml").read_text()
    before = example.split("[[foods]]")[0].replace("../dishes", str(config / "dishes"))
    for size, half in (("width = 1600", "width = 800"), ("height = 1200", "height = 600"), ("fx = 1400.0", "fx = 700.0")):
        before = before.replace(size, half)
    after = "[card]" + example.split("[card]")[1]
    for i, (kind, length_mm, width_mm) in enumerate(FOODS):
        for height_mm in HEIGHTS_MM:
            name = f"{kind}{i}_{height_mm}"
            scene = before.replace('name = "example"', f'name = "{name}"')
            scene = scene.replace("seed = 1 ", f"seed = {i * 7 + height_mm} ")
            food = (
                f'[[foods]]\nkind = "{kind}"\ncentre_mm = [0.0, 0.0]\nrotation_deg = {(i * 37 + height_mm) % 180}.0\n'
                f"size_mm = [{length_mm}.0, {width_mm}.0, {height_mm}.0]\nseed = {i * 100 + height_mm}\n\n"
            )
            (folder / f"{name}.toml").write_text(scene + food + after)


if __name__ == "__main__":
    main()
