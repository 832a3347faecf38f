"""Every view in both languages and on each size of screen."""
import samples
from hub_rig import wait_for
from page_case import PageCase, Shared, store_samples

# What shows that the view has its data, and a word of it in each language.
VIEWS = {
    "#live": (".outlines", "Last tray", "Letztes Tablett"),
    "#history": ("table.history", "Show all", "Alle zeigen"),
    "#scan/kitchen-8": (".correction-form", "Warnings", "Warnungen"),
    "#scan/kitchen-9": (".correction-form", "Details", "Einzelheiten"),
    "#devices": (".figures-of-store", "Stored results", "Gespeicherte Ergebnisse"),
    "#about": (".facts", "Licence", "Lizenz"),
    "#kiosk": (".kiosk-items", "Ready: put a tray down", "Bereit: Tablett hinstellen"),
}


class ViewsTest(PageCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.station = store_samples(cls.rig)

    def check_views(self, size, views):
        self.browser.set_size(size)
        for view in views:
            ready, *words = VIEWS[view]
            for language, word in zip(("en", "de"), words):
                with self.subTest(view=view, language=language):
                    self.station.tell_state()
                    self.show(view, language)
                    self.browser.wait_any(ready)
                    self.browser.wait_text(word)
                    self.check_page()

    def test_desktop(self):
        self.check_views("desktop", [view for view in VIEWS if view != "#kiosk"])

    def test_phone(self):
        self.check_views("phone", VIEWS)

    def test_kiosk(self):
        self.check_views("kiosk", ["#kiosk"])
        controls = self.browser.run("return [...document.querySelectorAll('a, button, input, select')]"
                                    ".filter((n) => n.getClientRects().length > 0).map((n) => n.outerHTML)")
        self.assertEqual(controls, [], "a kiosk has nothing to press")

    def test_page_is_small(self):
        self.browser.run("sessionStorage.clear()")
        self.browser.driver.execute_cdp_cmd("Network.clearBrowserCache", {})
        self.browser.requests()
        self.show("#live")
        self.browser.wait_any(".outlines")
        files = [(url, size) for url, size in self.browser.requests() if "/api/" not in url]
        Shared.page_bytes = sum(size for _, size in files)
        self.assertGreater(Shared.page_bytes, 50_000)
        self.assertLessEqual(Shared.page_bytes, 300_000, files)
        self.assertFalse([url for url, _ in files if "three" in url], "the 3-D library was fetched unasked")

    def test_names_are_text(self):
        self.show("#scan/kitchen-8")
        self.browser.wait_text(samples.EVIL, ".items")
        self.browser.wait_text("Something <b>new</b>.", ".warnings")
        self.browser.wait_text("Shows too little texture", ".items")
        self.browser.wait_text("was not synchronised", ".notice")
        self.assertEqual(self.browser.find_all("main script, main img, .warnings b"), [])

    def test_refused_and_superseded(self):
        self.show("#scan/kitchen-5")
        self.browser.wait_text("The reference card was not found in both pictures.", ".notice-fault")
        self.show("#scan/kitchen-6")
        self.browser.wait_text("Scan kitchen-7 counts in place of this one.", ".notice")
        self.show("#scan/kitchen-777", "de")
        self.browser.wait_text("Diese Messung gibt es nicht.", "[role=alert]")
        self.assertIn("404", "".join(self.browser.errors()))

    def test_picture_is_shown_where_there_is_one(self):
        self.show("#scan/kitchen-10")
        self.browser.wait_any(".outlines")
        self.assertEqual(self.browser.find_all("main img"), [])
        restore = self.browser.answer_itself("/picture", "real('icon.svg')")
        try:
            self.show("#scan/kitchen-10")
            self.browser.wait_any(".picture img")
            wait_for(lambda: self.browser.run("return document.querySelector('.picture img').naturalWidth > 0"),
                     "a picture that is drawn")
            self.check_page()
        finally:
            restore()

    def test_language_is_switched_and_remembered(self):
        self.show("#about")
        self.browser.wait_text("Licence")
        self.browser.run("localStorage.clear(); location.hash = '#about'")
        self.browser.find("#languages [value=de]").click()
        self.browser.wait_text("Lizenz")
        self.assertEqual(self.browser.run("return document.documentElement.lang"), "de")
        self.browser.open(self.rig.address + "#about")
        self.browser.wait_text("Lizenz")
        self.browser.run("localStorage.clear()")

    def test_keyboard_focus_is_seen(self):
        self.show("#live")
        self.browser.wait_any(".items")
        seen = self.browser.press_tab(16)
        self.assertTrue(all(outline == "solid" for _, outline in seen), seen)
        for wanted in ("skip", "brand", "item-name", "choice"):
            self.assertTrue([name for name, _ in seen if wanted in name], f"Tab does not reach {wanted}: {seen}")
