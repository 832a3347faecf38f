"""How far a long run is, on one line of the terminal; a line now and then where it goes to a file."""

import sys
import time

BAR_CELLS = 30
LINE_S = 30.0


class Progress:
    def __init__(self, what, total):
        self.what, self.total = what, total
        self.begun_s = self.told_s = time.monotonic()
        self.first = None

    def show(self, done, note):
        now_s = time.monotonic()
        self.first = done if self.first is None else self.first
        is_terminal = sys.stderr.isatty()
        if not is_terminal and done < self.total and now_s - self.told_s < LINE_S:
            return
        self.told_s = now_s
        rate = (done - self.first) / max(now_s - self.begun_s, 1e-9)
        left = f"{(self.total - done) / rate / 60.0:.1f} min left" if rate > 0 and done < self.total else ""
        cells = BAR_CELLS * done // self.total
        bar = "#" * cells + "." * (BAR_CELLS - cells)
        text = f"{self.what} [{bar}] {done}/{self.total} {note} {left}"
        sys.stderr.write(f"\r{text:<100}" if is_terminal else text.rstrip() + "\n")
        if is_terminal and done >= self.total:
            sys.stderr.write("\n")
        sys.stderr.flush()
