"""Pictures for firmware/page/README.md, where TRAYGAUGE_SCREENSHOTS names a folder; not made otherwise."""
import os
import pathlib
import unittest

import samples
from page_case import PageCase, store_samples

# name: view, size, language, scheme, what has to be there, what is chosen first
PICTURES = {
    "live": ("#live", "desktop", "en", "light", ".outlines", None),
    "space": ("#scan/kitchen-10", "desktop", "en", "dark", "canvas.space[data-drawn]", ".choice[value=space]"),
    "heights": ("#scan/kitchen-10", "phone", "de", "light", "canvas.heights", ".choice[value=heights]"),
    "history": ("#history", "desktop", "de", "light", "table.history", None),
    "devices": ("#devices", "desktop", "en", "light", ".figures-of-store", None),
    "phone": ("#live", "phone", "de", "dark", ".outlines", None),
    "kiosk": ("#kiosk", "kiosk", "de", "light", ".kiosk-items", None),
}


@unittest.skipUnless("TRAYGAUGE_SCREENSHOTS" in os.environ, "TRAYGAUGE_SCREENSHOTS names no folder")
class ScreenshotsTest(PageCase):
    def test_pictures(self):
        station = store_samples(self.rig)
        folder = pathlib.Path(os.environ["TRAYGAUGE_SCREENSHOTS"])
        folder.mkdir(parents=True, exist_ok=True)
        for name, (view, size, language, scheme, ready, button) in PICTURES.items():
            self.browser.set_size(size)
            self.browser.set_scheme(scheme)
            station.tell_state(temperature_c=51.2, under_voltage=False, calibration={"grade_percent": 0.31})
            self.show(view, language)
            if button:
                self.browser.wait_any(button).click()
            self.browser.wait_any(ready)
            self.browser.wait_any(".connection-good")
            self.browser.screenshot(folder / f"{name}.png")
