"""A station's folder with secrets, and a way to run the programs, for the tests of `support`, `backup` and `restore`."""
import os
import pathlib
import shutil
import subprocess

TOKEN = 'Vq7+tK/9fPz2mLw8Yb3cXd5eRg1hSj4u'
WEBHOOK_SECRET = 'hM3sWebhookSigningKey+/=0123'
PASSWORD = 'p4ss&w0rd~x'
PATH_SECRET = 'T0HookPathSecret99'
QUERY_SECRET = 'Qu3rySecretValue77'
COMMENT_SECRET = 'written-in-a-comment-1'
INLINE_SECRET = 'TypedInPlaceOfAPath123'

STATION = f'''# the wifi's password is {COMMENT_SECRET}
[camera]
device = "serial:A1"
[button]
line = "TRIGGER"  # pw {COMMENT_SECRET}
[lens]
width = 1600
height = 1200
fx = 1396.9
fy = 1396.9
cx = 801.9
cy = 597.4
distortion = [-0.095, 0.026, 0.0, 0.0, 0.0]
[card]
pattern = "card.png"
width_mm = 85.60
height_mm = 53.98
thickness_mm = 0.8
[station]
name = "kitchen"  # by the door
socket = "hub"
folder = "waiting"
[hub]
store = "results.db"
'''
SECRET_LINES = f'''view_tokens = "view.tokens"
webhook = "https://till:{PASSWORD}@till.example/{PATH_SECRET}/scans?auth={QUERY_SECRET}"
webhook_secret = "webhook.secret"
'''


def write(path, content, mode=0o644):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    path.chmod(mode)


def make_station(folder, capture, more=SECRET_LINES):
    """The station file's path; beside it the card's print, dishes, tokens, a store and a picture."""
    write(folder / 'station.toml', STATION + more)
    shutil.copy(capture / 'card.png', folder / 'card.png')
    dishes = capture.parent.parent.parent / 'config' / 'dishes'
    for dish in dishes.glob('*.toml'):
        write(folder / 'dishes' / dish.name, dish.read_bytes())
    write(folder / 'view.tokens', f'# of the kitchen\n{TOKEN} ann\n', 0o600)
    write(folder / 'webhook.secret', WEBHOOK_SECRET + '\n', 0o600)
    write(folder / 'results.db', b'SQLite format 3\0' + b'a scan of somebody ' * 100)
    write(folder / 'waiting' / 'view_0.jpg', (capture / 'view_0.jpg').read_bytes())
    return folder / 'station.toml'


class Checks:
    """Counts what is not as expected, and tells it."""

    def __init__(self, build):
        self.program = str(pathlib.Path(build) / 'traygauge')
        self.failures = 0

    def expect(self, is_so, text):
        if not is_so:
            self.failures += 1
            print('FAIL:', text)

    def run(self, arguments, status, said='', environment=None):
        """Runs traygauge and returns what it said."""
        done = subprocess.run([self.program, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              env={**os.environ, **(environment or {})}, timeout=60, check=False)
        text = done.stdout.decode(errors='replace')
        self.expect(done.returncode == status and said in text,
                    f'{arguments}: expected status {status} and {said!r}, found {done.returncode} and: {text}')
        return text
