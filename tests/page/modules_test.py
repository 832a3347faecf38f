"""Modules of the page by themselves, in the browser that runs them."""
from page_case import PageCase


class ModulesTest(PageCase):
    def evaluate(self, module, expression):
        return self.browser.driver.execute_async_script(
            f"const done = arguments[0]; import('./{module}').then((m) => done({expression}),"
            "(error) => done(String(error)))")

    def setUp(self):
        self.show("#about")
        self.browser.wait_any(".facts")

    def test_days_begin_at_midnight_of_the_site(self):
        """Also on the days on which the clocks change, and in zones that are ahead or behind."""
        for zone, day, days, expected in (
                ("Europe/Berlin", "2026-11-27", 0, "2026-11-26T23:00:00.000Z"),
                ("Europe/Berlin", "2026-03-29", 0, "2026-03-28T23:00:00.000Z"),
                ("Europe/Berlin", "2026-03-29", 1, "2026-03-29T22:00:00.000Z"),
                ("Europe/Berlin", "2026-10-25", 0, "2026-10-24T22:00:00.000Z"),
                ("Europe/Berlin", "2026-10-25", 1, "2026-10-25T23:00:00.000Z"),
                ("America/New_York", "2026-12-31", 1, "2027-01-01T05:00:00.000Z"),
                ("Pacific/Auckland", "2026-01-01", 0, "2025-12-31T11:00:00.000Z"),
                ("Asia/Kolkata", "2026-06-01", 0, "2026-05-31T18:30:00.000Z")):
            found = self.evaluate("times.js", f"(m.set_site_zone('{zone}'), m.start_of_day('{day}', {days}))")
            self.assertEqual(found, expected, (zone, day, days))

    def test_times_are_those_of_the_site(self):
        shown = self.evaluate("times.js", "(m.set_site_zone('Asia/Tokyo'), m.format_time('2026-11-27T20:00:00Z'))")
        self.assertIn("Nov 28, 2026", shown)
        self.assertIn("5:00:00", shown)
        self.assertEqual(self.evaluate("times.js", "(m.set_site_zone('No/Where'), m.is_zone_of_site())"), False)

    def test_numbers(self):
        for call, expected in (("format_measured(142.4, 5.1)", "142 ml ± 5 ml"),
                               ("format_measured(4.24, 0.31)", "4.2 ml ± 0.3 ml"),
                               ("format_measured(null, null)", "no volume"), ("format_measured(20, null)", "20 ml"),
                               ("format_number(-0.001, 2)", "0.00"), ("format_number(-1.316, 2)", "-1.32"),
                               ("format_age(59.9)", "59 s"), ("format_age(61)", "1 minute"),
                               ("format_age(7300)", "2 hours"), ("format_age(200000)", "2 days"),
                               ("format_bytes(17408)", "17 kB"), ("format_bytes(999)", "999 B")):
            self.assertEqual(self.evaluate("numbers.js", f"m.{call}").replace("\u00a0", " "), expected, call)

    def test_last_correction_that_holds(self):
        corrections = [{"correction": 1, "action": "rename"}, {"correction": 2, "action": "split"},
                       {"correction": 3, "action": "undo", "number": 2}]
        holding = self.evaluate("correction_list.js", f"m.last_holding({corrections})")
        self.assertEqual(holding["correction"], 1)
        corrections.append({"correction": 4, "action": "undo", "number": 1})
        self.assertIsNone(self.evaluate("correction_list.js", f"m.last_holding({corrections})"))

    def test_addresses(self):
        for place, expected in (("{hash: '', search: '?kiosk'}", ["kiosk"]),
                                ("{hash: '#kiosk/demo', search: ''}", ["kiosk", "demo"]),
                                ("{hash: '#scan/a%2Fb', search: ''}", ["scan", "a/b"]),
                                ("{hash: '#scan/%', search: ''}", ["scan", "%"]),
                                ("{hash: '', search: ''}", ["live"])):
            found = self.evaluate("router.js", f"(({{view, path}}) => [view, ...path])(m.read_address({place}))")
            self.assertEqual(found, expected, place)
