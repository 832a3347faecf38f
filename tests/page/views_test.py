"""Every view in both languages and on each size of screen."""
import samples
from hub_rig import wait_for
from page_case import PageCase, Shared, store_samples

# What shows that the view has its data, and a word of it in each language.
VIEWS = {
    "#live": (".outlines", "Last tray", "Letztes Tablett"),
    "#history": ("table.history", "Show all", "Alle zeigen"),
    "#scan/kitchen-8": (".correction-form", "Warnings", "Warnungen"),
    "#scan/kitchen-4": ("table.checks", "Checks", "Prüfungen"),
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

    def test_kiosk_leaves_out_what_eaters_cannot_mend(self):
        self.station.hand_over(samples.doubtful(11))  # its time is not sure
        self.station.tell_state()
        self.show("#live")
        self.browser.wait_text("was not synchronised", ".notice")
        self.show("#kiosk")
        self.browser.wait_text("Some items could not be measured", ".notice")
        self.assertNotIn("synchronised", self.browser.text())
        self.station.hand_over(samples.meal(12))
        self.station.tell_shape(samples.shape(12))

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
        self.browser.wait_text("supply voltage of the station", ".notice")
        self.assertEqual(self.browser.find_all("main script, main img, .warnings b"), [])

    def test_refused_and_superseded(self):
        self.show("#scan/kitchen-5")
        self.browser.wait_text("The reference card was not found in both pictures.", ".notice-fault")
        self.show("#scan/kitchen-6")
        self.browser.wait_text("Scan kitchen-7 counts in place of this one.", ".notice")
        self.show("#scan/kitchen-777", "de")
        self.browser.wait_text("Diese Messung gibt es nicht.", "[role=alert]")
        self.assertIn("404", "".join(self.browser.errors()))

    def test_checks_are_told_by_word_and_shape(self):
        def rows():
            self.browser.wait_any("table.checks")
            return self.browser.run(
                "return [...document.querySelectorAll('table.checks tbody tr')].map((line) => [line.dataset.check, "
                "...[...line.children].map((cell) => cell.textContent), line.querySelector('.mark').classList[1]])")
        self.show("#scan/kitchen-4")
        self.assertEqual([[cell.strip() for cell in line] for line in rows()], [
            ["dish_slip_mm", "Dish and card moved against each other dish 1", "0.05 ± 0.21 mm", "0.75 mm", "passed",
             "mark-good"],
            ["scale_percent", "Too large by the card, compared with the dish dish 1", "0.12 ± 0.24 %", "1.00 %",
             "passed", "mark-good"],
            ["dish_height_mm", "Edge of the dish above where it belongs dish 1", "-1.31 ± 0.24 mm", "1.00 mm", "warned",
             "mark-warning"],
            ["item_slip_mm", "Item moved on its dish Rice", "–", "0.25 mm", "nothing to compare",
             "mark-away"],
            ["item_foot_mm", "Edge of the item above its dish Chicken curry", "-1.60 mm", "-0.75 mm", "refused",
             "mark-fault"],
            ["brand_new_mm", "brand_new_mm dish 1", "0.50 ± 0.10 mm", "1.00 mm", "passed", "mark-good"]])
        self.browser.wait_text("0.87 px · 0.91 px", ".facts")
        self.show("#scan/kitchen-4", "de")
        self.assertIn("Zu groß nach der Karte, verglichen mit dem Geschirr Geschirr 1", rows()[1][1])
        self.assertEqual([line[2:5] for line in rows()][2], ["-1,31 ± 0,24 mm", "1,00 mm", "Warnung"])

    def test_scans_of_earlier_programs_have_no_checks(self):
        self.show("#scan/kitchen-1")
        self.browser.wait_any(".correction-form")
        self.assertEqual(self.browser.find_all("table.checks"), [])
        self.browser.wait_text("Details", "main")
        self.check_page()

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
