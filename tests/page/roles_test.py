"""Who may do what: login, corrections as manage, none as view. The hub stands below /kitchen, as behind a proxy."""
import datetime
import urllib.parse

import samples
from hub_rig import MANAGE_TOKEN, REVOKED_TOKEN, VIEW_TOKEN, HubRig, wait_for
from page_case import PageCase


class RolesTest(PageCase):
    @classmethod
    def make_rig(cls):
        return HubRig(with_tokens=True)

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        station = cls.rig.station()
        station.tell_state()
        for number in (1, 2, 3):
            station.hand_over(samples.meal(number))

    def setUp(self):
        self.browser.driver.execute_cdp_cmd("Network.clearBrowserCookies", {})

    def log_in(self, view, token):
        self.show(view)
        field = self.browser.wait_any("input[type=password]")
        field.send_keys(token)
        self.browser.find(".login .main-button").click()

    def wait_without_cookie(self):
        cookies = lambda: self.browser.driver.execute_cdp_cmd("Network.getAllCookies", {})["cookies"]
        wait_for(lambda: not cookies(), "a browser without the token")

    def choose(self, name, value):
        self.browser.run("const field = document.querySelector(`.correction-form [name=${arguments[0]}]`);"
                         "field.value = arguments[1]; field.dispatchEvent(new Event('change', {bubbles: true}))",
                         name, value)

    def save(self):
        self.browser.find(".correction-form .main-button").click()

    def test_wrong_token_and_login_page(self):
        self.log_in("#live", "wrong-token-0123456789abcdef")
        self.browser.wait_text("This token is not known", "[role=alert]")
        self.browser.errors()  # refusals are told there, too
        self.check_page()

    def test_token_is_kept_nowhere(self):
        self.log_in("#live", VIEW_TOKEN)
        self.browser.wait_text("You may look", "#session")
        self.browser.wait_text("142 ml", ".last-tray")
        kept = self.browser.run("return JSON.stringify([location.href, {...localStorage}, {...sessionStorage},"
                                "document.cookie, document.documentElement.outerHTML])")
        self.assertNotIn(VIEW_TOKEN, kept)
        self.assertNotIn(VIEW_TOKEN, urllib.parse.unquote(str(self.browser.requests())))
        self.browser.find("#session button").click()
        self.browser.wait_any("input[type=password]")
        self.wait_without_cookie()
        self.browser.errors()

    def test_revoked_token(self):
        """The page asks for another one, and no longer sends the old one, which would count as wrong each time."""
        self.log_in("#live", REVOKED_TOKEN)
        self.browser.wait_text("142 ml", ".last-tray")
        self.rig.write_tokens("view", VIEW_TOKEN)
        self.browser.wait_any("input[type=password]")
        self.wait_without_cookie()
        self.browser.errors()

    def test_site_and_its_time_zone(self):
        self.log_in("#about", VIEW_TOKEN)
        self.browser.wait_text("Asia/Tokyo (of the site)", ".facts")
        self.assertIn("North canteen", self.browser.run("return document.title"))
        self.browser.wait_text("North canteen", "#site-name")
        self.browser.run("location.hash = '#scan/kitchen-1'")
        tokyo = datetime.datetime.now(datetime.timezone(datetime.timedelta(hours=9)))
        self.browser.wait_text(f"{tokyo:%b} {tokyo.day}, {tokyo.year}", ".facts")
        self.browser.errors()

    def test_view_cannot_correct(self):
        self.log_in("#scan/kitchen-3", VIEW_TOKEN)
        self.browser.wait_text("log in with a token that manages")
        self.assertEqual(self.browser.find_all(".correction-form"), [])
        status = self.browser.driver.execute_async_script(
            "fetch('api/v1/scans/kitchen-3/corrections', {method: 'POST', "
            "headers: {'Content-Type': 'application/json'},"
            "body: '{\"action\":\"scan_wrong\"}'}).then((answer) => arguments[0](answer.status))")
        self.assertEqual(status, 403)
        self.browser.errors()

    def test_manage_corrects(self):
        self.log_in("#scan/kitchen-1", MANAGE_TOKEN)
        self.browser.wait_any(".correction-form")
        self.choose("food", "Brown rice")
        self.save()
        self.browser.wait_text("Item 2 is “Brown rice”.", ".corrections")
        self.browser.wait_text("ann", ".corrections")
        self.browser.wait_text("Rice, 142 ml ± 5 ml", ".items")

        self.choose("action", "split")
        self.choose("volume_ml", "40")
        self.choose("food", "Peas")
        self.save()
        self.browser.wait_text("Peas", ".items")
        self.browser.wait_text("102 ml", ".items")
        self.browser.wait_text("142 ml ± 5 ml", ".items")

        self.choose("action", "merge")
        self.choose("item", "3")
        self.browser.run("document.querySelector('[name=others][value=\"4\"]').click()")
        self.save()
        self.browser.wait_text("Item 4 is part of item 3.", ".corrections")
        self.browser.wait_text("(with item 4)", ".items")

        self.choose("action", "item_wrong")
        self.save()
        self.browser.wait_text("wrong", ".items .tag")
        self.browser.find(".undo").click()
        self.browser.wait_text("Correction 4 was taken back.", ".corrections")
        self.assertEqual(self.browser.find_all(".items .tag"), [])
        self.browser.errors()  # the refusals before the login
        self.check_page()
        self.browser.set_size("phone")
        self.check_page()
        self.browser.set_size("desktop")

        self.choose("action", "scan_wrong")
        self.save()
        self.browser.wait_text("as wrong", ".notice")
        self.show("#history?wrong=true")
        self.browser.wait_any("table.history")
        self.assertEqual(len(self.browser.find_all(".history tbody tr")), 1)

    def test_refusal_is_told(self):
        self.log_in("#scan/kitchen-2", MANAGE_TOKEN)
        self.browser.wait_any(".correction-form")
        self.choose("action", "split")
        self.choose("volume_ml", "5000")
        self.save()
        self.browser.wait_text("The part has to be larger than 0 ml", "[role=alert]")
        self.browser.errors()
