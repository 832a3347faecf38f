"""What all tests of the page share: one browser, a hub with sample scans, and checks that hold for every view."""
import pathlib
import unittest

import hub_rig
import samples
from browser import Browser

AUDIT = (pathlib.Path(__file__).parent / "accessibility.js").read_text()
WEBGL = ("--enable-unsafe-swiftshader", "--use-angle=swiftshader")


class Shared:
    """Made by the first test that needs them; page_test.py closes them."""
    browser = None
    lowest_contrast = 99.0
    page_bytes = 0

    @classmethod
    def get_browser(cls):
        if cls.browser is None:
            cls.browser = Browser(*WEBGL)
        return cls.browser

    @classmethod
    def close(cls):
        if cls.browser is not None:
            cls.browser.close()


def store_samples(rig):
    """Scan 1 is of an earlier program, 4 has checks, 5 is refused, 6 superseded by 7, 8 doubtful; 9 has forty items, 10 is
    the last and has a shape."""
    station = rig.station()
    station.tell_state(temperature_c=51.2, under_voltage=False, calibration={"grade_percent": 0.31})
    station.hand_over(samples.unchecked(1))
    for number in range(2, 5):
        checks = samples.checks() if number == 4 else []
        station.hand_over(samples.meal(number, age_s=86400 * (5 - number), checks=checks))
    station.hand_over(samples.refused(5))
    station.hand_over(samples.meal(6))
    station.hand_over(samples.meal(7, supersedes="kitchen-6"))
    station.hand_over(samples.doubtful(8))
    station.hand_over(samples.forty_items(9))
    station.hand_over(samples.meal(10))
    station.tell_shape(samples.shape(10))
    return station


class PageCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Shared.get_browser()
        cls.rig = cls.make_rig()
        cls.browser.set_scheme("light")
        cls.browser.set_size("desktop")

    @classmethod
    def make_rig(cls):
        return hub_rig.HubRig()

    @classmethod
    def tearDownClass(cls):
        cls.browser.open("about:blank")
        cls.browser.requests(), cls.browser.errors()  # the next class begins anew
        cls.rig.close()

    def show(self, view, language="en", rig=None):
        self.browser.open(f"{(rig or self.rig).address}{view}{'&' if '?' in view else '?'}lang={language}")

    def check_page(self):
        """No error, nobody else was asked, nothing hinders people, nothing sticks out."""
        self.assertEqual(self.browser.errors(), [])
        for url, _ in self.browser.requests():
            is_own = url.startswith((self.rig.address, "data:", "blob:", "about:"))
            self.assertTrue(is_own, f"the page asked {url}")
        wide = self.browser.run("return document.documentElement.scrollWidth - innerWidth")
        self.assertLessEqual(wide, 0, "the page is wider than the screen")
        for scheme in ("dark", "light"):
            self.browser.set_scheme(scheme)
            found = self.browser.run(AUDIT)
            self.assertEqual(found["problems"], [], scheme)
            Shared.lowest_contrast = min(Shared.lowest_contrast, found["lowest"])
