"""Where nothing has been measured yet, the page says what is left to set up."""
import hub_rig
import samples
from hub_rig import wait_for
from page_case import PageCase


class SetupRig(hub_rig.HubRig):
    """With a station file that somebody sets up meanwhile."""

    def __init__(self):
        super().__init__()
        self.stop()
        self.write()
        self.start(["--config", "station.toml"])

    def write(self, tables=""):
        (self.folder / "station.toml").write_text(
            '[station]\nname = "kitchen"\nsocket = "hub"\nfolder = "kept"\n'
            f'[hub]\nstore = "results.db"\nlisten = ["127.0.0.1:{self.port}"]\n[arm]\n{tables}')


class FirstStepsTest(PageCase):
    @classmethod
    def make_rig(cls):
        return SetupRig()

    def test_steps_are_ticked_off_until_a_tray_is_measured(self):
        self.show("#live")
        self.browser.wait_text("To do: the reference card is printed and measured", ".last-tray")
        self.browser.wait_text("traygauge setup /etc/traygauge/station.toml", ".last-tray")
        self.rig.write("[card]\n")
        self.browser.wait_text("Done: the reference card is printed and measured", ".last-tray")
        self.browser.wait_text("To do: the lens is calibrated", ".last-tray")
        self.rig.write("[card]\n[lens]\n[arm_geometry]\n")
        self.browser.wait_text("Done: the lens is calibrated", ".last-tray")
        self.browser.wait_text("Done: the move to the second view", ".last-tray")
        self.browser.wait_text("To do: the station runs", ".last-tray")
        station = self.rig.station()
        station.tell_state()
        self.browser.wait_text("Done: the station runs", ".last-tray")
        self.check_page()
        self.show("#live", "de")
        self.browser.wait_text("Zu tun: Das erste Tablett ist gemessen", ".last-tray")
        self.browser.set_size("phone")
        self.check_page()
        station.hand_over(samples.meal(1))
        self.browser.wait_text("142 ml", ".last-tray")
        wait_for(lambda: not self.browser.find_all(".first-steps"), "the steps to be gone")
