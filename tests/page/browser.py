"""Chromium without a screen, and what tests ask of it."""
import json
import os
import shutil

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from hub_rig import wait_for

SIZES = {"desktop": (1280, 860), "kiosk": (1920, 1080), "phone": (360, 760)}


def find_browser():
    """The paths of browser and driver; None where one is missing."""
    browser, driver = shutil.which("chromium"), shutil.which("chromedriver")
    return (browser, driver) if browser and driver else None


class Browser:
    def __init__(self, *more_options):
        browser, driver = find_browser()
        options = webdriver.ChromeOptions()
        options.binary_location = browser
        for option in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--disable-background-networking",
                       "--disable-component-update", "--no-first-run", "--hide-scrollbars", *more_options):
            options.add_argument(option)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(options=options, service=Service(driver, log_output=os.devnull))
        self.driver.set_script_timeout(20)

    def set_size(self, name, scale=1):
        width, height = SIZES[name]
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": scale, "mobile": False})

    def set_scheme(self, scheme):
        features = [{"name": "prefers-color-scheme", "value": scheme},
                    {"name": "prefers-reduced-motion", "value": "reduce"}]
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})

    def answer_itself(self, ending, script):
        """From the next page on, requests for addresses with that ending are answered by an expression."""
        source = ("const real = window.fetch; window.fetch = (path, ...rest) => String(path).endsWith('%s') "
                  "? Promise.resolve(%s) : real(path, ...rest)" % (ending, script))
        added = self.driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": source})
        return lambda: self.driver.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", added)

    def open(self, address):
        if address.partition("#")[0] != self.driver.current_url.partition("#")[0]:
            self.driver.get(address)
            return
        # A change of the part after "#" alone would load nothing.
        self.run("history.replaceState(null, '', arguments[0])", address)
        self.driver.refresh()

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def find_all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def text(self, selector="body"):
        """As people read it; numbers and units hold together by spaces that do not break."""
        script = "return [...document.querySelectorAll(arguments[0])].map((n) => n.innerText).join('\\n')"
        return self.run(script, selector).replace("\u00a0", " ")

    def wait_text(self, text, selector="body", seconds=15):
        wait_for(lambda: text in self.text(selector), f"“{text}” in {selector}; it says: {self.text(selector)!r}",
                 seconds)

    def wait_any(self, selector, seconds=15):
        return wait_for(lambda: self.find_all(selector), f"an element {selector}", seconds)[0]

    def press(self, key, times=1):
        ActionChains(self.driver).send_keys(*[getattr(Keys, key)] * times).perform()

    def press_tab(self, times):
        """Class or id of what gets the focus, and how its outline is drawn."""
        self.run("document.activeElement.blur()")
        seen = []
        for _ in range(times):
            self.press("TAB")
            seen.append(tuple(self.run("const n = document.activeElement; return [n.id || n.className,"
                                       "getComputedStyle(n).outlineStyle]")))
        return seen

    def point_at(self, selector, across, down):
        """`across` and `down`: parts of the element's width and height."""
        node = self.find(selector)
        self.run("arguments[0].scrollIntoView({block: 'center'})", node)
        width, height = node.size["width"], node.size["height"]
        ActionChains(self.driver).move_to_element_with_offset(
            node, int(width * (across - 0.5)), int(height * (down - 0.5))).perform()

    def errors(self):
        """What the console says, but for what the page asks in case the hub has it."""
        optional = ("/api/v1/site", "/shape", "/picture", "/scans/latest")

        def is_expected(message):
            return ("404" in message and any(part in message for part in optional)) or (
                "503" in message and "/health" in message)  # a part fails, which the page shows

        entries = self.driver.get_log("browser")
        return [entry["message"] for entry in entries
                if entry["level"] in ("SEVERE", "WARNING") and not is_expected(entry["message"])]

    def requests(self):
        """Addresses asked for since the last call, with the bytes that came."""
        asked, sizes = {}, {}
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            parameters = message["params"]
            if message["method"] == "Network.requestWillBeSent":
                asked[parameters["requestId"]] = parameters["request"]["url"]
            elif message["method"] == "Network.loadingFinished":
                sizes[parameters["requestId"]] = parameters["encodedDataLength"]
        return [(url, sizes.get(request, 0)) for request, url in asked.items()]

    def screenshot(self, path):
        self.driver.save_screenshot(str(path))

    def close(self):
        self.driver.quit()
