"""Search, pages and the CSV of the history."""
import datetime
import urllib.request

import samples
from page_case import PageCase


class HistoryTest(PageCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        station = cls.rig.station()
        for number in range(1, 61):
            station.hand_over(samples.meal(number, age_s=3600 * 24 * 10 if number <= 2 else 60))
        station.hand_over(samples.document(61, [samples.item(2, 50.0, food="Käse")]))
        cls.rig.station("buffet").hand_over(samples.meal(1, station="buffet"))

    def rows(self, view):
        self.show(view)
        self.browser.wait_any("table.history, .found > .quiet:not(:empty)")
        self.browser.wait_any(".paging")
        return len(self.browser.find_all(".history tbody tr"))

    def test_filters(self):
        self.assertEqual(self.rows("#history?food=Käse"), 1)
        self.assertEqual(self.rows("#history?station=buffet"), 1)
        self.assertEqual(self.rows("#history?text=kitchen-42"), 1)
        self.assertEqual(self.rows("#history?corrected=true"), 0)
        self.assertIn("No scan fits this search.", self.browser.text(".found"))
        day = (datetime.datetime.now() - datetime.timedelta(days=10)).strftime("%Y-%m-%d")
        self.assertEqual(self.rows(f"#history?from={day}&to={day}"), 2)
        self.check_page()

    def test_form_makes_the_address(self):
        self.rows("#history")
        self.browser.find("[name=food]").send_keys("Käse")
        self.browser.find(".filters .main-button").click()
        self.browser.wait_text("Käse", ".history")
        self.assertIn("food=K%C3%A4se", self.browser.run("return location.hash"))

    def test_pages(self):
        self.assertEqual(self.rows("#history"), 25)
        seen = set()
        for count in (25, 25, 12):
            addresses = self.browser.run("return [...document.querySelectorAll('.history tbody a')].map((a) => a.hash)")
            self.assertEqual(len(addresses), count)
            self.assertFalse(seen & set(addresses), "a scan is on two pages")
            seen |= set(addresses)
            older = [link for link in self.browser.find_all(".paging a") if link.text == "Older"]
            if older:
                first = addresses[0]
                older[0].click()
                self.browser.wait_any(f".history:not(:has(a[href='{first}']))")
        self.assertEqual(len(seen), 62)

    def test_csv_is_that_of_the_selection(self):
        self.rows("#history?station=buffet")
        address = self.browser.find("a[download]").get_attribute("href")
        with urllib.request.urlopen(address) as answer:
            lines = answer.read().decode().splitlines()
        self.assertEqual(len(lines), 1 + 3)
        self.assertIn("buffet-1", lines[1])
