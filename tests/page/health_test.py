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
        hubs = "In the last 20 trays the card made everything 0.44 % larger than the dishes say"
        self.show_devices("en")
        self.browser.wait_text("Drift of station kitchen", ".health-warning")
        self.browser.wait_text(hubs, ".health-warning")
        self.check_page()
        self.show_devices("de")
        self.browser.wait_text("Drift der Station kitchen", ".health-warning")
        self.browser.wait_text("weicht über viele Tabletts hinweg ab", ".health-warning")
        self.browser.wait_text(hubs, ".health-warning [lang=en]")
        self.check_page()
