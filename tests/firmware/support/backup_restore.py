"""`traygauge backup` and `restore`: the same byte by byte, or refused. Usage: backup_restore.py BUILD_FOLDER CAPTURE"""
import gzip
import io
import json
import pathlib
import random
import shutil
import sys
import tarfile
import tempfile
import zlib

import station_folder as site

TOKENS = 'view_tokens = "view.tokens"\nwebhook = "https://till.example/scans"\nwebhook_secret = "webhook.secret"\n'


def files_of(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob('*') if path.is_file()}


class Case:
    def __init__(self, checks, folder, capture):
        self.checks = checks
        self.folder = folder
        self.capture = capture
        self.backup = folder / 'backup.tar.gz'
        self.target = folder / 'restored'

    def make(self, more, *options):
        """A station with a backup of it."""
        shutil.rmtree(self.folder / 'site', ignore_errors=True)
        station = site.make_station(self.folder / 'site', self.capture, more)
        self.checks.run(['backup', station, '--out', self.backup, *options], 0, 'wrote')
        return station

    def restore(self, status, said='', *options):
        return self.checks.run(['restore', self.backup, '--to', self.target, *options], status, said)

    def refuse(self, said, text):
        """What is in `backup` is refused, and nothing is written."""
        before = sorted(self.folder.rglob('*'))
        answer = self.restore(2, said)
        self.checks.expect(sorted(self.folder.rglob('*')) == before, f'{text}: something was written: {answer}')
        self.checks.expect('othing was restored' in answer, f'{text}: {answer}')

    def clear(self):
        shutil.rmtree(self.target, ignore_errors=True)


def test_round_trip(case):
    # Without secrets.
    station = case.make('listen = ["127.0.0.1:0"]\n')
    case.restore(0, 'as expected for a station called kitchen; dishes: dinner oval soup')
    expected = files_of(case.folder / 'site')
    for left_out in ('results.db', 'waiting/view_0.jpg', 'view.tokens', 'webhook.secret'):
        del expected[left_out]
    case.checks.expect(files_of(case.target) == expected, f'expected {expected.keys()}, found {files_of(case.target).keys()}')
    case.checks.expect(case.backup.stat().st_mode & 0o777 == 0o600, 'others can read the backup')

    # Files that are there.
    site.write(case.target / 'station.toml', 'mine')
    case.restore(2, 'there is a file')
    case.checks.expect((case.target / 'station.toml').read_text() == 'mine', 'a file was overwritten')
    case.restore(0, 'restored', '--force')
    case.checks.expect(files_of(case.target) == expected, '--force did not replace')
    case.clear()

    # A clone, from which one line differs.
    case.restore(0, 'as expected for a station called kitchen-2', '--name', 'kitchen-2')
    clone = (case.target / 'station.toml').read_text()
    case.checks.expect(clone == station.read_text().replace('"kitchen"', '"kitchen-2"'), clone)
    case.clear()
    case.restore(2, 'expected 1 to 32', '--name', 'Kitchen 2')
    case.checks.expect(not case.target.exists(), 'a bad name wrote something')

    # The secrets, only where they are wanted.
    case.make(TOKENS)
    answer = case.restore(2, 'view.tokens')
    case.checks.expect('to be made anew: view.tokens webhook.secret' in answer, answer)
    unpacked = gzip.decompress(case.backup.read_bytes())
    for secret in (site.TOKEN, site.WEBHOOK_SECRET):
        case.checks.expect(secret.encode() not in unpacked, 'a secret is in a backup without secrets')
    case.clear()
    case.make(TOKENS, '--with-secrets')
    case.restore(0, 'as expected for a hub')
    case.checks.expect((case.target / 'view.tokens').read_text() == f'# of the kitchen\n{site.TOKEN} ann\n', 'tokens differ')
    case.checks.expect((case.target / 'view.tokens').stat().st_mode & 0o777 == 0o600, 'others can read the tokens')
    case.clear()

    # Files elsewhere, and names with other letters.
    site.write(case.folder / 'site' / 'dishes' / 'schüssel.toml', (case.folder / 'site' / 'dishes' / 'soup.toml').read_bytes())
    site.write(case.folder / 'elsewhere' / 'ca.pem', '-----BEGIN CERTIFICATE-----')
    text = station.read_text().replace('webhook_secret =', 'webhook_ca = "../elsewhere/ca.pem"\nwebhook_secret =')
    site.write(station, text)
    case.checks.run(['backup', station, '--out', case.backup], 0, 'wrote')
    answer = case.restore(2, 'those in outside/')
    restored = files_of(case.target)
    case.checks.expect('dishes/schüssel.toml' in restored and
                       restored.get(f'outside{case.folder}/elsewhere/ca.pem') == b'-----BEGIN CERTIFICATE-----',
                       f'{restored.keys()}')
    case.clear()

    # What cannot be backed up.
    case.checks.run(['backup', case.folder / 'absent.toml', '--out', case.backup], 2, 'No such file')
    case.checks.run(['backup', station, '--out', station], 2, 'something that is no archive')
    site.write(station, 'name = ')
    case.checks.run(['backup', station, '--out', case.backup], 2, 'station.toml')


def test_name(case):
    """Lines that look like the name, and are another one's."""
    station = case.make('')
    text = station.read_text()
    for name, wanted, status in (
            ("  name\t=  'kitchen' # name = \"kitchen\"", "  name\t=  'k3' # name = \"kitchen\"", 0),
            ('repeat_within_s = 3\r\nname = "kitchen"\r', 'repeat_within_s = 3\r\nname = "k3"\r', 0),
            ('"name" = "kitchen"', '', 2), ('name = """kitchen"""', '', 2)):
        before = text.replace('name = "kitchen"  # by the door', name)
        site.write(station, before)
        case.checks.run(['backup', station, '--out', case.backup], 0, 'wrote')
        case.restore(status, '' if status == 0 else 'has no line name', '--name', 'k3')
        if status == 0:
            case.checks.expect((case.target / 'station.toml').read_bytes().decode() == before.replace(name, wanted), name)
        case.clear()
    site.write(station, text.replace('[hub]', "[hub]\nsite_name = '''\n[station]\nname = \"x\"\n'''"))
    case.checks.run(['backup', station, '--out', case.backup], 0, 'wrote')
    case.restore(0, 'called k3', '--name', 'k3')
    case.clear()


def holds_the_same(damaged, whole):
    """gzip has a few bits that say nothing: when it was packed, and what fills the last byte of a block."""
    try:
        return gzip.decompress(damaged) == gzip.decompress(whole)
    except (OSError, EOFError, zlib.error):
        return False


def test_damage(case):
    """A bit of many places of a small archive."""
    station = case.make('')
    shutil.rmtree(case.folder / 'site' / 'dishes')
    (case.folder / 'site' / 'card.png').write_bytes(bytes(range(256)) * 2)
    case.checks.run(['backup', station, '--out', case.backup], 0, 'wrote')
    whole = case.backup.read_bytes()
    places = [*range(20), *random.sample(range(20, len(whole) - 20), 110), *range(len(whole) - 20, len(whole))]
    refused = 0
    for place in places:
        damaged = bytearray(whole)
        damaged[place] ^= 1 << random.randrange(8)
        if holds_the_same(damaged, whole):
            continue
        case.backup.write_bytes(damaged)
        case.refuse('', f'byte {place} of {len(whole)}')
        refused += 1
    for length in [*random.sample(range(len(whole)), 20), len(whole) - 1]:
        case.backup.write_bytes(whole[:length])
        case.refuse('', f'the first {length} of {len(whole)} bytes')
    case.backup.write_bytes(whole + b'\0')
    case.refuse('', 'a byte too many')
    case.backup.write_bytes(b'')
    case.refuse('', 'nothing')
    case.backup.unlink()
    case.restore(2, 'cannot be read')
    return refused + 22


def pack(entries):
    stream = io.BytesIO()
    with tarfile.open(fileobj=stream, mode='w', format=tarfile.GNU_FORMAT) as archive:
        for entry, content in entries:
            archive.addfile(entry, io.BytesIO(content))
    return gzip.compress(stream.getvalue(), mtime=0)


def crc32c(data):
    crc = 0xffffffff
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0x82f63b78 if crc & 1 else 0)
    return crc ^ 0xffffffff


def entry_of(name, content=b'', kind=tarfile.REGTYPE, link=''):
    entry = tarfile.TarInfo(name)
    entry.type, entry.linkname, entry.size = kind, link, len(content)
    return entry, content


def manifest_of(entries, **more):
    files = [{'name': entry.name, 'bytes': len(content), 'crc32c': crc32c(content)} for entry, content in entries]
    text = json.dumps({'format': 'traygauge backup', 'version': 1, 'program': '0', 'made_at': 'x',
                       'station': 'station.toml', 'left_out': [], 'files': files, **more}).encode()
    return entry_of('manifest.json', text)


def test_bad_archives(case):
    good = entry_of('station.toml', site.STATION.encode())

    def refuse(said, entries, manifest=None):
        case.backup.write_bytes(pack([manifest or manifest_of(entries), *entries]))
        case.refuse(said, said)

    # The writer of these tests is right: a good one goes through.
    case.backup.write_bytes(pack([manifest_of([good]), good]))
    case.restore(2, 'restored 1 files')  # whose card is missing
    case.checks.expect((case.target / 'station.toml').read_text() == site.STATION, 'restored another file')
    case.clear()

    for name in ('../evil', '/etc/evil', 'a/../../evil', 'a//b', './a', 'a/.', 'a\nb', '..', 'x' * 300):
        refuse('path leads elsewhere', [good, entry_of(name, b'evil')])
    for kind in (tarfile.SYMTYPE, tarfile.LNKTYPE, tarfile.CHRTYPE, tarfile.BLKTYPE, tarfile.FIFOTYPE, tarfile.DIRTYPE):
        refuse('', [good, entry_of('evil', kind=kind, link='/etc/passwd')])
    refuse('twice', [good, good])
    refuse('lies in what is a file', [good, entry_of('a/b/c'), entry_of('a/b')])
    refuse('more than 1,000 files', [entry_of(f'f{i}') for i in range(1001)])
    refuse('is not what the manifest says', [good, entry_of('a', b'1')], manifest_of([good, entry_of('a', b'2')]))
    refuse('is not what the manifest says', [good, entry_of('a', b'1')], manifest_of([good, entry_of('b', b'1')]))
    refuse('does not hold the files', [good], manifest_of([good, entry_of('a', b'2')]))
    refuse('does not hold the files', [good, entry_of('a', b'1')], manifest_of([good]))
    refuse('does not hold the station file', [good], manifest_of([good], station='other.toml'))
    refuse('another version', [good], manifest_of([good], version=2))
    refuse('no backup', [good], manifest_of([good], format='x'))
    refuse('manifest cannot be read', [good], entry_of('manifest.json', b'[' * 10_000))
    refuse('manifest cannot be read', [good], manifest_of([good], files='x'))
    refuse('no backup', [entry_of('a')], good)

    # Much in little: 65 MiB of zeros, and a size that is a lie.
    zeros = zlib.compressobj(9, zlib.DEFLATED, 31)
    block = bytes(1024 * 1024)
    head = tarfile.TarInfo('station.toml')
    head.size = 300 * 1024 * 1024
    packed = zeros.compress(head.tobuf(tarfile.GNU_FORMAT)) + b''.join(zeros.compress(block) for _ in range(80))
    packed += zeros.flush()
    case.backup.write_bytes(packed)
    case.refuse('more than 64 MiB', 'a bomb')
    huge = tarfile.TarInfo('station.toml')
    huge.size = 1 << 40
    case.backup.write_bytes(gzip.compress(huge.tobuf(tarfile.GNU_FORMAT) + bytes(1024), mtime=0))
    case.refuse('more than 64 MiB', 'a size that is a lie')

    # Links in the folder that would lead out of it.
    inner = entry_of('dishes/evil.toml', b'evil')
    case.backup.write_bytes(pack([manifest_of([good, inner]), good, inner]))
    case.target.mkdir()
    (case.folder / 'elsewhere').mkdir(exist_ok=True)
    (case.target / 'dishes').symlink_to(case.folder / 'elsewhere')
    case.refuse('or a link', 'a link on the way')
    case.clear()
    case.target.write_text('a file')
    case.refuse('it is no folder', 'a file in place of the folder')
    case.target.unlink()


def main():
    checks = site.Checks(sys.argv[1])
    seed = random.randrange(1 << 32)
    random.seed(seed)
    with tempfile.TemporaryDirectory() as name:
        case = Case(checks, pathlib.Path(name), pathlib.Path(sys.argv[2]))
        (case.folder / 'site').mkdir()
        test_round_trip(case)
        test_name(case)
        damaged = test_damage(case)
        test_bad_archives(case)
    print(f'{damaged} damaged archives were refused; seed {seed}')
    return 1 if checks.failures else 0


sys.exit(main())
