#!/usr/bin/env python3
"""No picture leaves the station's memory: plants a pattern in the frames, measures them, and looks for it on the disk, in
every answer of the hub, in the hub's memory and in core dumps. That it is found in the station's memory shows that the
search works. Usage: picture_stays.py BUILD_FOLDER PLANT_PROGRAM CAPTURE"""
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request

build, plant, capture = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
LONGEST_S = 60


def wait_for(file, text):
    end = time.monotonic() + LONGEST_S
    while time.monotonic() < end:
        found = re.search(text, file.read_text()) if file.exists() else None
        if found:
            return found
        time.sleep(0.1)
    sys.exit(f"{file.name}: no '{text}' within {LONGEST_S} s, but: {file.read_text()}")


def memory_of(process):
    """All that can be read of it, piece by piece."""
    with open(f"/proc/{process.pid}/maps") as maps, open(f"/proc/{process.pid}/mem", "rb", 0) as memory:
        for line in maps:
            begin, end = (int(number, 16) for number in line.split()[0].split("-"))
            if "r" not in line.split()[1] or "[v" in line:
                continue
            try:
                memory.seek(begin)
                yield memory.read(end - begin)
            except OSError:
                pass


def main():
    problems = []
    with tempfile.TemporaryDirectory() as name, tempfile.TemporaryDirectory() as elsewhere:
        folder = pathlib.Path(name)
        planted = subprocess.run([plant, capture, f"{elsewhere}/capture"], check=True, capture_output=True, text=True)
        pattern = bytes(int(number, 16) for number in planted.stdout.split())
        # In one channel, and in three. A part is enough, wherever a row was cut.
        part = slice(32, 96)
        forms = [pattern[part], bytes(value for value in pattern[part] for _ in range(3))]

        def holds(content):
            return any(form in content for form in forms)

        hub = subprocess.Popen(
            [f"{build}/traygauge", "hub", "--socket", folder / "hub", "--store", folder / "r.db", "--listen", "127.0.0.1:0"],
            stdout=open(folder / "hub.log", "w"), stderr=subprocess.STDOUT, cwd=folder)
        # Until Ctrl-C, so that its memory can be looked at.
        station = subprocess.Popen(
            ["sh", "-c", 'ulimit -c unlimited; exec "$@"', "sh", f"{build}/traygauge", "station", "--devices",
             f"simulator:{elsewhere}/capture", "--labels", "auto", "--repeat", "--real-time", "--hub", folder / "hub",
             "--keep", folder / "keep"],
            stdout=open(folder / "station.log", "w"), stderr=subprocess.STDOUT, cwd=folder)
        try:
            base = wait_for(folder / "hub.log", r"http://[0-9.:]+[0-9]").group(0)
            wait_for(folder / "station.log", "Scan 1 .* ml")
            time.sleep(1)
            if not any(holds(piece) for piece in memory_of(station)):
                problems.append("the pattern is not even in the station's memory: this test finds nothing")
            if any(holds(piece) for piece in memory_of(hub)):
                problems.append("the pattern is in the hub's memory")
            for path in ["", "api/v1/scans", "api/v1/scans/station-1", "api/v1/scans/station-1/document",
                         "api/v1/scans/station-1/shape", "api/v1/scans/station-1/mesh", "api/v1/stations", "health",
                         "metrics", "api/v1/export.csv", "api/v1/export.json", "api/v1/site"]:
                try:
                    content = urllib.request.urlopen(f"{base}/{path}", timeout=10).read()
                except urllib.error.HTTPError as error:
                    # Nothing synchronises the clock here; and away from its checkout the hub has no page.
                    if (path, error.code) not in (("health", 503), ("", 404)):
                        problems.append(f"/{path} answers {error.code}")
                    content = error.read()
                if holds(content):
                    problems.append(f"the pattern is in the answer of /{path}")
            station.send_signal(signal.SIGSEGV)
            station.wait(LONGEST_S)
        finally:
            for process in (station, hub):
                process.kill()
                process.wait()
        for file in folder.rglob("*"):
            if file.is_file() and holds(file.read_bytes()):
                problems.append(f"the pattern is in {file.name}")
        if list(folder.glob("*core*")):
            problems.append("the station left a core dump")
    print("\n".join(problems) or "the pattern stays in the station's memory")
    sys.exit(1 if problems else 0)


main()
