#!/usr/bin/env python3
"""A hub and a station on simulated devices for many trays in a row: prints what memory both have, and whether each result is in
the store exactly once. Ends with status 1 where something is not as it has to be.
Usage: trays.py BUILD_FOLDER CAPTURES [TRAYS]"""
import collections
import json
import pathlib
import re
import sqlite3
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request

build, captures = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
TRAYS = int(sys.argv[3]) if len(sys.argv) > 3 else 10_000
EVERY = max(1, min(100, TRAYS // 20))  # trays from one look at the memory to the next
MAX_KIB = {"station": 64 * 1024, "hub": 24 * 1024}
MAX_GROWTH_KIB = 1024  # of the most, after a fifth of the trays, when caches are full


def memory_kib(process):
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    return {name: int(re.search(rf"Vm{name}:\s+(\d+) kB", status).group(1)) for name in ("RSS", "HWM")}


def key_of(document):
    """What a document is known by: times of the stages tell every scan from all others, also of the same tray. What the
    station adds where it hands a document over, such as an id, is not printed and does not count."""
    told = {"scan", "tray", "status", "items", "duration_ms", "timing_ms"}
    return json.dumps({name: document[name] for name in told}, sort_keys=True)


def look_at_page(base):
    """What a page fetches of the last tray. Its shape and picture come after its result, and leave after twenty more."""
    newest = json.loads(urllib.request.urlopen(f"{base}/api/v1/scans?limit=50", timeout=60).read())["scans"][:1]
    for scan in newest:
        for path in ("", "/shape", "/picture"):
            try:
                urllib.request.urlopen(f"{base}/api/v1/scans/{scan['id']}{path}", timeout=60).read()
            except urllib.error.HTTPError as answer:
                if answer.code != 404:
                    raise


def start_hub(folder):
    with open(folder / "hub.log", "w") as log:
        hub = subprocess.Popen([build / "traygauge", "hub", "--socket", folder / "hub", "--store", folder / "results.db",
                                "--listen", "127.0.0.1:0"], stdout=log, stderr=log)
    while not (found := re.search(r"http://[0-9.:]+[0-9]", (folder / "hub.log").read_text())):
        if hub.poll() is not None:
            sys.exit((folder / "hub.log").read_text())
        time.sleep(0.1)
    return hub, found.group(0)


def start_station(folder):
    with open(folder / "station.log", "w") as log:
        return subprocess.Popen([build / "traygauge", "station", "--devices", f"simulator:{captures}", "--scans", str(TRAYS),
                                 "--json", "--show-pictures", "--hub", folder / "hub", "--keep", folder / "keep", "--name",
                                 "soak"], stdout=subprocess.PIPE, stderr=log, text=True)


def follow(station, hub, base):
    """Reads the station's results until it ends, and looks at the memory meanwhile."""
    printed, looks, begin = collections.Counter(), [], time.monotonic()
    for line in station.stdout:
        printed[key_of(json.loads(line))] += 1
        trays = sum(printed.values())
        if trays % EVERY == 0 and trays < TRAYS:
            look_at_page(base)
            look = {"station": memory_kib(station), "hub": memory_kib(hub)}
            looks.append((trays, look))
            print(f"{trays} trays, {time.monotonic() - begin:.0f} s: " + ", ".join(
                f"{name} {sizes['RSS']} KiB, at most {sizes['HWM']}" for name, sizes in look.items()), flush=True)
    return printed, looks


def read_store(file):
    store = sqlite3.connect(f"file:{file}?mode=ro", uri=True)
    stored = collections.Counter(key_of(json.loads(body)) for (body,) in store.execute("SELECT body FROM documents"))
    set_aside = store.execute("SELECT count(*) FROM set_aside").fetchone()[0]
    store.close()
    return stored, set_aside


def pictures_kib():
    """What the simulated camera holds: of both views the picture, 3 bytes a pixel, and its labels, 1 byte."""
    sizes = (json.loads(file.read_text())["camera"] for file in captures.glob("*/capture.json"))
    return max(2 * 4 * size["width"] * size["height"] for size in sizes) // 1024


def judge_memory(looks):
    faults = []
    for name, limit in MAX_KIB.items():
        held = pictures_kib() if name == "station" else 0
        most = looks[-1][1][name]["HWM"]
        # A look meets a process at any step of a scan, between which its memory differs by megabytes: only the most counts.
        most_early = [look[name]["HWM"] for trays, look in looks if trays <= TRAYS // 5][-1]
        growth = most - most_early
        print(f"{name}: at most {most / 1024:.1f} MiB" +
              (f", without the simulated camera's pictures {(most - held) / 1024:.1f}" if held else "") +
              f"; after a fifth of the trays {growth:+d} KiB")
        if most - held > limit:
            faults.append(f"The {name} had {most - held} KiB; at most {limit} are allowed.")
        if growth > MAX_GROWTH_KIB and TRAYS >= 1000:  # else caches still fill
            faults.append(f"The {name} grew by {growth} KiB; at most {MAX_GROWTH_KIB} are allowed.")
    return faults


def judge_results(printed, stored, set_aside, log):
    """Done or kept: at the end each result has to be in the store, once."""
    late = log.count("does not take results")
    print(f"The hub took {'every result at once' if late == 0 else f'no result at once, {late} times; they waited'}.")
    faults = []
    lost, doubled = printed - stored, stored - printed
    print(f"{sum(printed.values())} results printed, {sum(stored.values())} stored, {sum(lost.values())} of them missing, "
          f"{sum(doubled.values())} too many, {set_aside} set aside")
    if sum(printed.values()) != TRAYS or len(printed) != TRAYS:
        faults.append(f"Expected {TRAYS} results that differ, found {len(printed)}.")
    if lost or doubled or set_aside:
        faults.append("The store does not hold each result exactly once.")
    return faults


def main():
    with tempfile.TemporaryDirectory(prefix="traygauge_soak_") as name:
        folder = pathlib.Path(name)
        hub, base = start_hub(folder)
        station = start_station(folder)
        try:
            printed, looks = follow(station, hub, base)
            status = station.wait()
        finally:
            for process in (station, hub):
                process.terminate()
                process.wait()
        faults = judge_memory(looks)
        faults += judge_results(printed, *read_store(folder / "results.db"), (folder / "station.log").read_text())
        if status != 0:
            faults.append(f"The station ended with status {status}.")
        if hub.returncode != 0:
            faults.append(f"The hub ended with status {hub.returncode}.")
    for fault in faults:
        print(fault, file=sys.stderr)
    sys.exit(1 if faults else 0)


main()
