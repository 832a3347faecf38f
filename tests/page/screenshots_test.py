"""Pictures for firmware/page/README.md, where TRAYGAUGE_SCREENSHOTS names a folder; not made otherwise."""
import json
import os
import pathlib
import unittest
import urllib.request

from page_case import PageCase, store_samples

# name: view, size, pixels of the picture for a pixel of the page, language, scheme, what has to be there, and
# what is pressed first
PICTURES = {
    "live": ("#live", "desktop", 0.6, "en", "light", ".outlines", None),
    "space": ("#scan/demo-1", "desktop", 0.6, "en", "dark", "canvas.space[data-drawn]", ".choice[value=space]"),
    "heights": ("#scan/demo-1", "desktop", 0.5, "de", "light", "canvas.heights", ".choice[value=heights]"),
    "history": ("#history", "desktop", 0.6, "de", "light", "table.history", None),
    "devices": ("#devices", "desktop", 0.6, "en", "light", ".figures-of-store", None),
    "phone": ("#live", "phone", 1, "de", "dark", ".outlines", None),
    "kiosk": ("#kiosk/demo", "kiosk", 0.4, "de", "light", ".kiosk-items", None),
}
WELL = {"temperature_c": 51.2, "under_voltage": False, "devices": ["camera /dev/video0", "arm", "button TRIGGER", "lamp"],
        "calibration": {"grade_percent": 0.31, "calibrated_on": "2026-11-02"}}
FOODS = {"demo-1": {2: "Fish", 3: "Potatoes", 4: "Spinach"}, "demo-2": {2: "Mashed potatoes", 3: "Meatballs"}}


@unittest.skipUnless("TRAYGAUGE_SCREENSHOTS" in os.environ, "TRAYGAUGE_SCREENSHOTS names no folder")
class ScreenshotsTest(PageCase):
    def name_foods(self):
        for scan, foods in FOODS.items():
            for label, food in foods.items():
                body = {"action": "rename", "item": label, "food": food, "author": "ann"}
                urllib.request.urlopen(urllib.request.Request(
                    f"{self.rig.address}api/v1/scans/{scan}/corrections", json.dumps(body).encode()))

    def test_pictures(self):
        store_samples(self.rig)
        self.rig.play_demo()
        self.name_foods()
        stations = [self.rig.station(name) for name in ("kitchen", "demo")]
        folder = pathlib.Path(os.environ["TRAYGAUGE_SCREENSHOTS"])
        folder.mkdir(parents=True, exist_ok=True)
        for name, (view, size, scale, language, scheme, ready, button) in PICTURES.items():
            self.browser.set_size(size, scale)
            self.browser.set_scheme(scheme)
            for station in stations:
                station.tell_state(**WELL)
            self.show(view, language)
            if button:
                self.browser.wait_any(button).click()
            self.browser.wait_any(ready)
            self.browser.wait_any(".connection-good")
            self.browser.screenshot(folder / f"{name}.png")
