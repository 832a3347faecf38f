"""A hub in a temporary folder, on a port of its own, that can be stopped and started again."""
import os
import pathlib
import socket
import subprocess
import tempfile
import time
import urllib.error
import urllib.request

import fake_station

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("TRAYGAUGE_PROGRAM", str(ROOT / "build" / "traygauge"))
VIEW_TOKEN = "view-token-0123456789abcdef"
REVOKED_TOKEN = "revoked-token-0123456789abcdef"
MANAGE_TOKEN = "manage-token-0123456789abcdef"


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def wait_for(condition, what, seconds=15):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.05)
    raise AssertionError(f"not within {seconds} s: {what}")


class HubRig:
    def __init__(self, with_tokens=False):
        self.folder_owner = tempfile.TemporaryDirectory(prefix="traygauge_page_")
        self.folder = pathlib.Path(self.folder_owner.name)
        self.port = free_port()
        self.socket = self.folder / "hub"
        self.with_tokens = with_tokens
        self.process = None
        self.stations = []
        if with_tokens:
            self._write_config()
        self.start()

    @property
    def address(self):
        return f"http://127.0.0.1:{self.port}/" + ("kitchen/" if self.with_tokens else "")

    def write_tokens(self, role, *lines):
        """The hub reads the file again within a second."""
        file = self.folder / f"{role}.tokens"
        new = file.with_suffix(".new")
        new.write_text("\n".join(lines) + "\n")
        new.chmod(0o600)
        new.rename(file)

    def _write_config(self):
        self.write_tokens("view", VIEW_TOKEN, REVOKED_TOKEN)
        self.write_tokens("manage", f"{MANAGE_TOKEN} ann")
        (self.folder / "station.toml").write_text(
            '[station]\nname = "kitchen"\nsocket = "hub"\nfolder = "kept"\n'
            f'[hub]\nstore = "results.db"\nlisten = ["127.0.0.1:{self.port}"]\n'
            'site_name = "North canteen"\ntime_zone = "Asia/Tokyo"\n'
            'base_path = "/kitchen"\nview_tokens = "view.tokens"\nmanage_tokens = "manage.tokens"\n')

    def start(self, options=None):
        if options is None:
            options = ["--config", "station.toml"] if self.with_tokens else [
                "--socket", str(self.socket), "--store", "results.db", "--listen", f"127.0.0.1:{self.port}"]
        log = open(self.folder / "hub.log", "a")
        self.process = subprocess.Popen([PROGRAM, "hub", *options], cwd=self.folder, stdout=log, stderr=log)
        wait_for(self._answers, f"an answer of the hub; it said: {(self.folder / 'hub.log').read_text()}")

    def _answers(self):
        try:
            urllib.request.urlopen(self.address + "health", timeout=2).read()
        except urllib.error.HTTPError:
            return True  # a part fails, but the hub answers
        except OSError:
            return False
        return True

    def stop(self):
        self.process.terminate()
        self.process.wait(timeout=10)

    def station(self, name="kitchen"):
        station = fake_station.FakeStation(self.socket, name)
        self.stations.append(station)
        return station

    def play_demo(self):
        """A real station named demo with the demo's two trays, until it has ended."""
        subprocess.run([PROGRAM, "station", "--devices", f"simulator:{ROOT / 'simulator' / 'demo'}", "--hub",
                        str(self.socket), "--keep", str(self.folder / "kept"), "--name", "demo"],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=60)

    def close(self):
        for station in self.stations:
            station.close()
        ended_with = self.process.poll()
        if ended_with is None:
            self.stop()
        log = (self.folder / "hub.log").read_text()
        self.folder_owner.cleanup()
        if ended_with is not None:
            raise AssertionError(f"the hub ended by itself with status {ended_with}; it said: {log}")
