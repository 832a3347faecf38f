"""What a disk was asked for, as qemu's driver blklogwrites logs it (the format of the kernel's dm-log-writes), and what of it
outlasts a power cut."""
import os
import struct
from typing import NamedTuple

SECTOR = 512
MAGIC = 0x6A736677736872
FLUSH, FUA, DISCARD = 1, 2, 4


class Request(NamedTuple):
    sector: int
    data: bytes  # empty: a flush alone
    flags: int


def read_log(path):
    """All requests, in the order in which the disk had done them. The log ends where its writer was killed."""
    requests = []
    with open(path, "rb") as log:
        if struct.unpack("<Q", log.read(8).ljust(8, b"\0"))[0] != MAGIC:
            return []
        size = os.path.getsize(path)
        place = SECTOR
        while place + SECTOR <= size:
            log.seek(place)
            sector, count, flags, _ = struct.unpack("<4Q", log.read(32))
            log.seek(place + SECTOR)
            data = log.read(count * SECTOR) if not flags & DISCARD else b""
            if (not count and not flags) or len(data) % SECTOR != 0:
                break
            place += SECTOR + len(data)
            requests.append(Request(sector, data, flags))
    return requests


def write_sectors(disk, request, random, share):
    """Writes this share of the request's sectors; whether that was all of them."""
    is_whole = True
    for i in range(len(request.data) // SECTOR):
        if share < 1.0 and random.random() >= share:
            is_whole = False
            continue
        disk.seek((request.sector + i) * SECTOR)
        disk.write(request.data[i * SECTOR : (i + 1) * SECTOR])
    return is_whole


def replay(requests, image, random):
    """Writes to the image what the disk has after the cut: all that was flushed, and of each later write everything, nothing,
    or some of its sectors. Returns how many writes are not whole there."""
    flushed = max((i for i, request in enumerate(requests) if request.flags & FLUSH), default=0)
    spoilt = 0
    with open(image, "r+b") as disk:
        for i, request in enumerate(requests):
            is_durable = i < flushed or request.flags & FUA
            share = 1.0 if is_durable else random.choice((0.0, 0.5, 1.0))
            spoilt += not write_sectors(disk, request, random, share)
    return spoilt
