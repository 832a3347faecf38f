"""A station that drifts is told where health is, before one of its trays is refused."""
import samples
from page_case import PageCase


class HealthTest(PageCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.station = cls.rig.station()
        for number in range(1, 21):
            cls.station.hand_over(samples.drifting(number))

    def show_devices(self, language):
        self.station.tell_state()
        self.show("#devices", language)
        self.browser.wait_any(".health")

    def test_drift_is_told_in_both_languages(self):
        hubs = "In the last 20 trays the card made everything 0.74 % larger than the dishes say"
        self.show_devices("en")
        self.browser.wait_text("Drift of station kitchen", ".health-warning")
        self.browser.wait_text(hubs, ".health-warning")
        self.check_page()
        self.show_devices("de")
        self.browser.wait_text("Drift der Station kitchen", ".health-warning")
        self.browser.wait_text("weicht über viele Tabletts hinweg ab", ".health-warning")
        self.browser.wait_text(hubs, ".health-warning [lang=en]")
        self.check_page()

    def test_devices_power_and_calibration_are_told_in_both_languages(self):
        fault = {"device": "arm /dev/ttyUSB0", "status": "stalled", "message": "The arm did not arrive."}
        state = {"devices": ["camera usb-1", "arm /dev/ttyUSB0", "button 17", "lamp"], "temperature_c": 82.4,
                 "under_voltage": True, "lens": "Dark at x = 812.",
                 "calibration": {"grade_percent": 0.31, "calibrated_on": "2026-01-31"}}
        told = {"en": ("Camera works", "Arm does not work", "Arm of station kitchen", "Power of station kitchen",
                       "Lens of station kitchen", "Dark at x = 812.",
                       "stronger power supply", "82.4 °C", "0.31 %", "Jan 31, 2026"),
                "de": ("Kamera in Ordnung", "Arm funktioniert nicht", "Arm /dev/ttyUSB0: ", "Arm der Station kitchen",
                       "Strom der Station kitchen",
                       "Objektiv der Station kitchen", "Auf dem Objektiv ist Schmutz", "Dark at x = 812.", "stärkeres Netzteil", "82,4 °C", "0,31 %", "31.01.2026")}
        for language, texts in told.items():
            self.station.tell_state(**state)
            self.show("#devices", language)
            self.browser.wait_any(".health-warning")
            self.browser.wait_any(".devices .mark-good")
            self.assertEqual(self.browser.find_all(".devices .mark-fault"), [])
            self.station.tell_state(**{**state, "faults": [fault]})
            self.browser.wait_any(".devices .mark-fault")
            for text in texts:
                self.browser.wait_text(text, "main")
            self.check_page()
        self.station.tell_state(**state)

    def test_drift_is_shown_in_figures(self):
        told = {"en": ("Too large by the card, median of 20 trays\n0.74 ± 0.00 %",
                       "Glaze of the dishes too high, median of 20 trays\n0.62 ± 0.00 mm"),
                "de": ("Zu groß nach der Karte, Median über 20 Tabletts\n0,74 ± 0,00 %",
                       "Glasur des Geschirrs zu hoch, Median über 20 Tabletts\n0,62 ± 0,00 mm")}
        for language, texts in told.items():
            self.show_devices(language)
            for text in texts:
                self.browser.wait_text(text, ".drift")
            self.check_page()

    def test_what_a_scan_costs_the_card_is_told(self):
        self.show_devices("en")
        self.browser.wait_text("Written for each scan, on average\n", ".figures-of-store")
