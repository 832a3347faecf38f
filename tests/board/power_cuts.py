#!/usr/bin/env python3
"""Cuts the power of an emulated machine that runs station and hub: power_cuts.py GUEST INITRD

GUEST is a folder of make_guest.sh, INITRD what pack_guest.sh made of power_cuts.sh. Each boot first mends its disk, hands over
what waits and checks that the store has everything that the lamp told of, once. Then it scans under load until qemu is killed.
The disk keeps what was flushed, and a random part of the rest. After ten cuts a new disk is taken.

POWER_CUTS (100): how often. POWER_SEED: draws the same moments again. POWER_UNSYNCED="station hub", or one of them: it
syncs nothing, so that results must be lost and the test fails."""
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
from write_log import FLUSH, SECTOR, read_log, replay  # noqa: E402

DISK_MIB = 64
MARKS = DISK_MIB << 20  # past the file system's end
CUTS_OF_A_DISK = 10
LOAD_S = 5.0
RECOVERY_S = 1.0
REQUESTS_BACK = 64
TIMEOUT_S = 240.0


class Machine:
    """One boot."""

    def __init__(self, guest, initrd, folder):
        self.console_file = folder / "console"
        self.console_file.write_bytes(b"")
        log = folder / "log"
        log.write_bytes(b"")
        # Flushes stop at the log: the host's own disk has nothing to do with it.
        file = "driver=file,cache.no-flush=on"
        self.process = subprocess.Popen(
            ["qemu-system-x86_64", "-M", "q35", "-cpu", "max", "-accel", "tcg,thread=multi", "-smp", "2", "-m", "768",
             "-nic", "none", "-display", "none", "-monitor", "none", "-no-reboot", "-kernel", guest / "vmlinuz",
             "-initrd", initrd, "-append", "console=ttyS0 quiet panic=-1 no_timer_check",  # a busy host's timer is late
             "-serial", f"file:{self.console_file}",
             "-blockdev", f"{file},filename={folder / 'disk'},node-name=disk",
             "-blockdev", f"{file},filename={log},node-name=log",
             "-blockdev", f"driver=blklogwrites,file=disk,log=log,log-sector-size={SECTOR},node-name=logged",
             "-device", "virtio-blk-pci,drive=logged,write-cache=on"], stdin=subprocess.DEVNULL)

    def console(self):
        return self.console_file.read_text(errors="replace").replace("\r", "")

    def told(self, word):
        """What follows the word in a whole line of the console; None where there is none."""
        lines = self.console().split("\n")[:-1]
        return next((line[len(word):].split() for line in lines if line.startswith(word)), None)

    def wait_for(self, word):
        """False where the guest ends first."""
        end = time.monotonic() + TIMEOUT_S
        while self.told(word) is None:
            if self.process.poll() is not None:
                return self.told(word) is not None
            if time.monotonic() > end:
                return False
            time.sleep(0.05)
        return True

    def cut(self):
        self.process.kill()
        self.process.wait()


class Cuts:
    def __init__(self, guest, initrd, folder, seed):
        self.guest, self.initrd, self.folder = guest, initrd, folder
        self.random = random.Random(seed)
        self.machine = None
        self.boots = self.disks = 0
        self.stored = 0  # on this disk, when it was last checked
        self.told = {}  # by the tray's name, on this disk
        self.sums = dict.fromkeys((
            "cuts", "in recovery", "queue full", "writes lost or torn", "journal replayed", "mended by e2fsck",
            "damaged after e2fsck", "results waited", "done", "kept", "stored", "lost", "doubled", "checks", "failed"), 0)

    def new_disk(self):
        self.disks += 1
        self.stored, self.told = 0, {}
        disk = self.folder / "disk"
        disk.unlink(missing_ok=True)
        with open(disk, "wb") as file:
            file.truncate(MARKS + SECTOR)
        subprocess.run(["/sbin/mkfs.ext4", "-q", "-F", "-E", "lazy_itable_init=0,lazy_journal_init=0", disk, f"{DISK_MIB}M"],
                       check=True)

    def boot(self, is_last):
        self.boots += 1
        extra = self.folder / "test"
        extra.mkdir(exist_ok=True)
        (extra / "told").write_text("".join(f"{signal} {tray}\n" for tray, signal in self.told.items()))
        away_s, there_s = self.random.uniform(0.3, 2.0), self.random.uniform(1.0, 5.0)
        unsynced = "".join(f"{name.upper()}_PRELOAD=/test/no_sync.so\n"
                           for name in os.environ.get("POWER_UNSYNCED", "").split())
        (extra / "moment").write_text(
            f"RUN=boot{self.boots}\nLAST={'1' if is_last else ''}\nMARKS=/dev/vda@{MARKS}\n"
            f"AWAY_S={away_s:.2f}\nTHERE_S={there_s:.2f}\n{unsynced}")
        initrd = self.folder / "initrd"
        shutil.copyfile(self.initrd, initrd)
        with open(initrd, "ab") as file:
            names = b"test/told\ntest/moment\n"
            file.write(subprocess.run(["cpio", "-o", "-H", "newc", "--quiet"], input=names, cwd=self.folder, check=True,
                                      capture_output=True).stdout)
        shutil.copyfile(self.folder / "disk", self.folder / "before")
        self.machine = Machine(self.guest, initrd, self.folder)
        return self.machine

    def note_boot(self, machine):
        """What the boot found. False where something is wrong."""
        sums = self.sums
        if (fsck := machine.told("FSCK ")) is not None:
            for what, status in zip(("journal replayed", "mended by e2fsck", "damaged after e2fsck"), fsck):
                sums[what] += status != "0"
        if (waited := machine.told("WAITED ")) is not None:
            sums["results waited"] += waited != ["0"]
        if (stored := machine.told("STORED ")) is not None:
            self.stored = int(stored[0])
            sums["lost"] += int(stored[1])
            sums["doubled"] += int(stored[2])
        if (checked := machine.told("CHECKED ")) is None:
            return machine.told("GUEST-EXIT") is None
        sums["checks"] += 1
        return checked == ["0"] and fsck[2] == "0"

    def before_cut(self, requests):
        """The disk stops at one of its last requests, half of the time just before a flush: at most moments it has nothing to
        do, and all is flushed."""
        end = max(0, len(requests) - self.random.randrange(REQUESTS_BACK))
        if self.random.random() < 0.5:
            end = max((i for i in range(end) if requests[i].flags & FLUSH), default=end)
        return requests[:end]

    def lose_power(self):
        """What is left of the disk, and what its marks say."""
        requests = self.before_cut(read_log(self.folder / "log"))
        marks = [request.data.rstrip(b"\0").decode() for request in requests if request.sector * SECTOR >= MARKS]
        shutil.copyfile(self.folder / "before", self.folder / "disk")
        on_disk = [request for request in requests if request.sector * SECTOR < MARKS]
        spoilt = replay(on_disk, self.folder / "disk", self.random)
        for signal, tray in (mark.split() for mark in marks if mark != "full"):
            self.told[tray] = signal
            self.sums[signal] += 1
        self.sums["queue full"] += "full" in marks
        self.sums["writes lost or torn"] += spoilt
        return f"{len(on_disk)} requests, {spoilt} writes lost or torn, {len(marks)} told"

    def cut_once(self):
        """False where a boot found something wrong."""
        machine = self.boot(is_last=False)
        begin = time.monotonic()
        in_recovery = self.random.random() < 0.25
        delay_s = self.random.uniform(0.0, RECOVERY_S if in_recovery else LOAD_S)
        is_there = machine.wait_for("MOUNTED" if in_recovery else "CHECKED 0")
        if is_there:
            time.sleep(delay_s)
        machine.cut()
        is_good = self.note_boot(machine) and is_there
        if not is_good:
            return self.fail(machine)
        self.sums["cuts"] += 1
        self.sums["in recovery"] += machine.told("CHECKED ") is None
        print(f"cut {self.sums['cuts']}: {delay_s:.2f} s after {'mounting' if in_recovery else 'the check'}, "
              f"{self.lose_power()}; {time.monotonic() - begin:.1f} s", flush=True)
        return True

    def check(self):
        machine = self.boot(is_last=True)
        is_whole = machine.wait_for("GUEST-EXIT 0")
        machine.cut()
        return (self.note_boot(machine) and is_whole) or self.fail(machine)

    def fail(self, machine):
        self.sums["failed"] += 1
        print(machine.console(), flush=True)
        return False

    def run(self, count):
        while self.sums["cuts"] < count and self.sums["failed"] < 3:
            self.new_disk()
            left = min(CUTS_OF_A_DISK, count - self.sums["cuts"])
            if all(self.cut_once() for _ in range(left)):
                self.check()
            self.sums["stored"] += self.stored
        # Few cuts may all hit the recovery.
        has_load = self.sums["done"] + self.sums["kept"] > 0 or count < CUTS_OF_A_DISK
        return 0 if self.sums["failed"] == 0 and has_load else 1

    def close(self):
        """Says what came of it, however it ended."""
        if self.machine is not None:
            self.machine.cut()
        print(f"{self.disks} disks; " + ", ".join(f"{name}: {value}" for name, value in self.sums.items()))


def main():
    count = int(os.environ.get("POWER_CUTS", "100"))
    seed = int(os.environ.get("POWER_SEED", random.SystemRandom().randrange(1 << 32)))
    print(f"POWER_SEED={seed}", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        cuts = Cuts(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), pathlib.Path(folder), seed)
        try:
            return cuts.run(count)
        finally:
            cuts.close()


if __name__ == "__main__":
    sys.exit(main())
