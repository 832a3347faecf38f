"""The drawings of a tray, by pointer and by keyboard."""
from hub_rig import wait_for
from browser import Browser
from page_case import PageCase, store_samples


class TrayTest(PageCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        store_samples(cls.rig)

    def focus_item(self, label, browser=None):
        script = "document.querySelector(`.item-name[data-label='${arguments[0]}']`).focus()"
        (browser or self.browser).run(script, label)

    def test_outlines_light_up(self):
        self.show("#live")
        self.browser.wait_any(".outlines")
        self.focus_item(3)
        self.browser.wait_text("Chicken curry 88 ml ± 3 ml", "[data-caption]")
        self.browser.wait_any(".is-lit[data-outline='3']")
        self.assertEqual(len(self.browser.find_all(".is-lit[data-outline]")), 1)

    def test_heights(self):
        self.show("#live")
        self.browser.wait_any(".choice[value=heights]").click()
        self.browser.wait_any("canvas.heights")
        painted = self.browser.run(
            "const c = document.querySelector('canvas.heights'); const d = c.getContext('2d')"
            ".getImageData(0, 0, c.width, c.height).data; let n = 0;"
            "for (let i = 3; i < d.length; i += 4) n += d[i] > 0; return n * 4 / d.length")
        self.assertGreater(painted, 0.5)
        box = self.browser.run("const b = document.querySelector('canvas.heights').getBoundingClientRect();"
                               "return [b.width, b.height]")
        self.assertAlmostEqual(box[0] / box[1], 1.0, delta=0.1)
        self.browser.point_at("canvas.heights", 0.5, 0.72)
        self.browser.wait_text("Green beans:", ".told")
        self.browser.wait_text("mm above the table", ".told")
        self.check_page()

    def test_space_is_drawn_when_it_is_shown(self):
        self.show("#live")
        self.browser.wait_any(".choice[value=space]").click()
        self.browser.wait_any("canvas.space[data-drawn=all]")
        self.focus_item(2)
        self.browser.wait_any("canvas.space[data-drawn='2']")
        self.browser.wait_text("Rice 142 ml ± 5 ml", "[data-caption]")
        self.browser.point_at("canvas.space", 0.5, 0.62)
        wait_for(lambda: self.browser.find("canvas.space").get_attribute("data-drawn") == "4", "the item pointed at")
        before = self.browser.find("canvas.space").screenshot_as_base64
        self.browser.run("document.querySelector('canvas.space').focus()")
        self.browser.press("ARROW_LEFT", 4)
        wait_for(lambda: self.browser.find("canvas.space").screenshot_as_base64 != before, "a turned tray")
        self.check_page()
        self.browser.find(".choice[value=outlines]").click()

    def test_without_webgl(self):
        browser = Browser("--disable-3d-apis")
        try:
            browser.open(self.rig.address + "?lang=en#live")
            browser.wait_any(".choice[value=space]").click()
            browser.wait_any("[role=note]")
            self.assertIn("cannot draw in 3-D", browser.text("[role=note]"))
            self.focus_item(3, browser)
            browser.wait_text("88 ml ± 3 ml", "[data-caption]")
        finally:
            browser.close()
