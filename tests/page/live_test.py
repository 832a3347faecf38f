"""The page says what is, also when the hub is away, hangs or comes back."""
import signal

import hub_rig
import samples
from hub_rig import wait_for
from page_case import PageCase


class LiveTest(PageCase):
    def setUp(self):
        self.station = self.rig.station()
        self.station.tell_state()

    def tearDown(self):
        self.station.close()

    def is_stale(self):
        return self.browser.run("return document.body.classList.contains('is-stale')")

    def mark_document(self):
        self.browser.run("window.is_same_document = true")

    def check_same_document(self):
        self.assertTrue(self.browser.run("return window.is_same_document === true"), "the page was loaded anew")

    def test_results_and_states_are_shown(self):
        other = self.rig.station("buffet")  # which says nothing but its name
        self.show("#live")
        self.browser.wait_text("buffet", ".stations")
        self.browser.wait_text("Ready: put a tray down", ".stations")
        self.station.hand_over(samples.meal(1))
        self.browser.wait_text("142 ml ± 5 ml", ".last-tray")
        self.station.hand_over(samples.document(2, [samples.item(2, 33.3, 1.5, food="Peas")]))
        self.browser.wait_text("Peas 33 ml ± 2 ml", "#announcements")
        self.station.hand_over(samples.refused(3))
        self.browser.wait_text("The reference card was not found", ".last-tray")
        self.browser.wait_text("Not measured.", "#announcements")
        self.station.tell_state("measuring")
        self.browser.wait_text("Measuring", ".stations")
        self.station.tell_state(next_tray={"tray": "17", "foods": 3, "dishes": ["dinner"], "valid_ms": 9000})
        self.browser.wait_text("Next tray: 17, 3 foods, dinner", ".stations")
        self.station.tell_state(faults=[{"device": "camera", "message": "camera: It is <gone>."}])
        self.browser.wait_text("camera: It is <gone>.", ".stations")
        self.station.tell_state(faults=[{"device": "arm <b>", "status": "stalled", "message": "?"}])
        self.browser.wait_text("Arm <b>: did not reach its place.", ".stations")
        self.browser.wait_text("Has said nothing for", "[data-station=buffet].is-old", 15)
        other.close()
        self.browser.wait_text("Not connected for", "[data-station=buffet].is-old")

    def test_stopped_hub_and_restart(self):
        self.station.hand_over(samples.meal(10))
        self.show("#live")
        self.browser.wait_text("142 ml ± 5 ml")
        self.mark_document()
        self.rig.stop()
        self.browser.wait_text("Not live: no connection to the hub since", "#connection", 15)
        self.browser.wait_text("Not known: there is no connection to the hub.", ".stations")
        self.browser.wait_text("What is shown is old.", "#announcements")
        self.assertTrue(self.is_stale())
        self.rig.start()
        self.check_recovery()
        self.station = self.rig.station()
        self.station.tell_state()
        self.browser.wait_text("Ready: put a tray down", ".stations")
        self.station.hand_over(samples.document(11, [samples.item(2, 77.0, 3.0, food="Peas")]))
        self.browser.wait_text("77 ml ± 3 ml")

    def test_hub_that_hangs(self):
        """Its connections stay open: nothing but the silence tells it."""
        self.station.hand_over(samples.meal(20))
        self.show("#kiosk")
        self.browser.wait_text("142 ml ± 5 ml")
        self.mark_document()
        self.rig.process.send_signal(signal.SIGSTOP)
        try:
            self.browser.wait_text("Not live:", "#connection", 15)
            self.browser.wait_text("Not known: there is no connection to the hub.", ".kiosk-states")
            self.assertTrue(self.is_stale())
        finally:
            self.rig.process.send_signal(signal.SIGCONT)
        self.check_recovery()

    def test_hub_that_answers_without_news(self):
        """Events and other answers come, stations do not: the page must not look live."""
        restore = self.browser.answer_itself(
            "/stations", "window.refuse ? new Response('{}', {status: 500}) : real(path, ...rest)")
        try:
            self.show("#live")
            self.browser.wait_text("Live.", "#connection")
            self.browser.run("window.refuse = true")
            self.browser.wait_text("Not live: nothing new from the hub for", "#connection", 15)
            self.assertTrue(self.is_stale())
            self.browser.run("window.refuse = false")
            wait_for(lambda: not self.is_stale(), "a page that is live again", 15)
        finally:
            restore()

    def check_recovery(self):
        wait_for(lambda: not self.is_stale(), "a page that is live again", 15)
        self.browser.wait_text("Live.", "#connection")
        self.check_same_document()
        self.browser.errors()  # the requests that failed are told there

    def test_demo_station(self):
        """The real station with the demo's trays, whose shapes are measured."""
        rig = hub_rig.HubRig()
        try:
            self.show("#live", rig=rig)
            self.browser.wait_text("No station has connected to this hub yet.", ".stations")
            self.browser.wait_text("Nothing has been measured yet.", ".last-tray")
            rig.play_demo()
            self.browser.wait_any(".outline path")
            self.browser.wait_text("demo-2", ".last-tray")
            shown = self.browser.find_all(".items tbody tr")
            self.assertEqual(len(shown), 2)
            self.assertEqual(self.browser.errors(), [])
            self.browser.open("about:blank")
        finally:
            rig.close()
