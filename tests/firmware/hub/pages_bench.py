#!/usr/bin/env python3
"""Whether open pages slow the scans: measures the same trays without pages and with 50 that listen to events and fetch every
scan and its shape, alternately, and prints the time of a scan of each and their ratio. The hub runs with the priority that
its unit gives it. The pages stand for browsers on other machines, so that they only get what station and hub leave over.
Usage: pages_bench.py BUILD_FOLDER CAPTURES [ROUNDS]"""
import multiprocessing
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request

build, captures = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 5
PAGES = 50
SCANS = 30


class Pages:
    """Clients that do what a page does, in a process of their own."""

    def __init__(self, base, count):
        self.fetched = multiprocessing.Value("i", 0)
        listening = multiprocessing.Barrier(2)
        self.process = multiprocessing.Process(target=self.run, args=(base, count, listening), daemon=True)
        self.process.start()
        listening.wait(60)

    def run(self, base, count, listening):
        os.nice(19)
        threads = [threading.Thread(target=self.follow, args=(base, urllib.request.urlopen(f"{base}/api/v1/events", timeout=60)))
                   for _ in range(count)]
        for thread in threads:
            thread.start()
        listening.wait(60)

    def follow(self, base, stream):
        event = ""
        for line in stream:
            text = line.decode().strip()
            if text.startswith("event:"):
                event = text[6:].strip()
            if text.startswith("data:") and event in ("scan", "shape"):
                scan = re.search(r'"id":"([^"]+)"', text).group(1)
                path = f"scans/{scan}" + ("/shape" if event == "shape" else "")
                urllib.request.urlopen(f"{base}/api/v1/{path}", timeout=60).read()
                with self.fetched.get_lock():
                    self.fetched.value += 1

    def close(self):
        self.process.kill()
        self.process.join()


def unit_priority():
    unit = pathlib.Path(__file__).resolve().parents[3] / "config/systemd/traygauge-hub.service"
    return re.search(r"^Nice=(\d+)$", unit.read_text(), re.MULTILINE).group(1)


def time_scans(folder):
    begin = time.monotonic()
    subprocess.run([build / "traygauge", "station", "--devices", f"simulator:{captures}", "--scans", str(SCANS), "--hub",
                    folder / "hub", "--keep", folder / "keep", "--name", "bench"], check=True, capture_output=True)
    return (time.monotonic() - begin) / SCANS * 1000


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        with open(folder / "hub.log", "w") as log:
            hub = subprocess.Popen(["nice", "-n", unit_priority(), build / "traygauge", "hub", "--socket", folder / "hub",
                                    "--store", folder / "r.db", "--listen", "127.0.0.1:0"], stdout=log, stderr=log)
        try:
            while not (found := re.search(r"http://[0-9.:]+[0-9]", (folder / "hub.log").read_text())):
                time.sleep(0.1)
            alone, watched, fetched = [], [], 0
            time_scans(folder)
            for _ in range(rounds):
                alone.append(time_scans(folder))
                pages = Pages(found.group(0), PAGES)
                watched.append(time_scans(folder))
                fetched += pages.fetched.value
                pages.close()
        finally:
            hub.terminate()
            hub.wait()
    print(f"a scan without pages: {statistics.median(alone):.0f} ms ({min(alone):.0f} to {max(alone):.0f})")
    print(f"with {PAGES} pages: {statistics.median(watched):.0f} ms ({min(watched):.0f} to {max(watched):.0f}), "
          f"{fetched} answers fetched")
    ratios = [b / a for a, b in zip(alone, watched)]
    print(f"ratio: {statistics.median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f})")


main()
