"""No secret and no picture gets into what `traygauge support` writes. Usage: support_bundle.py BUILD_FOLDER CAPTURE"""
import base64
import http.server
import os
import pathlib
import re
import socket
import subprocess
import sys
import tempfile
import threading
import time
import urllib.parse

import station_folder as site

SECRETS = [site.TOKEN, site.WEBHOOK_SECRET, site.PASSWORD, site.PATH_SECRET, site.QUERY_SECRET, site.COMMENT_SECRET,
           site.INLINE_SECRET, 'unknownTokenOfSomebody', 'session-of-somebody']
NAMES = ['versions', 'station_file', 'config_check', 'paths', 'devices', 'machine', 'services', 'log_station',
         'log_hub', 'hub_health']


def forms_of(secret):
    """As bytes, in what others may have made of it."""
    yield secret.encode()
    for safe in ('', '/'):
        yield urllib.parse.quote(secret, safe=safe).encode()
        yield urllib.parse.quote(secret, safe=safe).replace('%2B', '%2b').replace('%2F', '%2f').encode()
    for before in ('', 'a', 'ab'):
        encoded = base64.b64encode((before + secret).encode())
        # The digits that hold no bit of the neighbours.
        yield encoded[{0: 0, 1: 2, 2: 3}[len(before)]:len(encoded) // 4 * 4 - 4]
        yield base64.urlsafe_b64encode((before + secret).encode())[{0: 0, 1: 2, 2: 3}[len(before)]:-4]


def log_lines():
    basic = base64.b64encode(f'till:{site.PASSWORD}'.encode()).decode()
    yield 'hub started'
    yield f'a browser sent {site.TOKEN} in its address'
    yield f'GET /api/v1/scans?token={urllib.parse.quote(site.TOKEN, safe="")}&limit=3'
    yield f'Authorization: Bearer unknownTokenOfSomebody\r'
    yield f'"authorization":"bearer unknownTokenOfSomebody", next'
    yield f'authorization: Basic {basic}'
    yield f'x {basic} y'
    yield 'Cookie: traygauge=session-of-somebody; other=session-of-somebody'
    yield f'posting to https://till:{site.PASSWORD}@till.example/{site.PATH_SECRET}/scans?auth={site.QUERY_SECRET} failed'
    yield f'signed by {base64.b64encode(site.WEBHOOK_SECRET.encode()).decode()}'
    for before in ('a', 'ab', 'abc'):
        yield 'packed ' + base64.b64encode(f'{before}{site.TOKEN}{before}'.encode()).decode()
    yield f'password = "unknownTokenOfSomebody"'
    yield f'{{"secret": "unknownTokenOfSomebody", "tray": 7}}'
    yield 'the last line'


def make_fakes(folder):
    """journalctl and systemctl as they would answer, but for one that never ends."""
    site.write(folder / 'lines', '\n'.join(log_lines()) + '\n')
    site.write(folder / 'journalctl', f'#!/bin/sh\ncat {folder}/lines\n', 0o755)
    site.write(folder / 'systemctl', f'#!/bin/sh\necho "active (running) with --key {site.TOKEN}"\n', 0o755)
    return {'PATH': f'{folder}:{os.environ["PATH"]}'}


class Health(http.server.BaseHTTPRequestHandler):
    heads = []

    def do_GET(self):
        Health.heads.append(self.path + '\n' + str(self.headers))
        body = f'{{"status": "ok", "why": "{site.TOKEN}"}}'.encode()
        self.send_response(200)
        self.send_header('Set-Cookie', 'traygauge=session-of-somebody')
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *arguments):
        pass


def bundle_of(checks, folder, station, environment, said=''):
    """The texts by their names; every byte was searched for every secret."""
    out = folder / 'bundle.tar.gz'
    checks.run(['support', station, '--out', out], 0, said or f'{out}: wrote 10 texts', environment)
    target = folder / 'unpacked'
    subprocess.run(['rm', '-rf', target], check=True)
    target.mkdir()
    subprocess.run(['tar', 'xzf', out, '-C', target], check=True)
    files = {path.stem: path.read_bytes() for path in target.glob('traygauge-support/*.txt')}
    others = [path for path in target.rglob('*') if path.is_file() and path.suffix != '.txt']
    checks.expect(not others and sorted(files) == sorted(NAMES), f'expected {NAMES}, found {sorted(files)} {others}')
    for name, content in files.items():
        for secret in SECRETS:
            for form in forms_of(secret):
                checks.expect(form not in content, f'{station}: {name} holds {form!r} of {secret}: {content[-2000:]!r}')
        checks.expect(b'\xff\xd8\xff' not in content and b'PNG' not in content and b'SQLite format' not in content,
                      f'{name} holds a picture or a database')
    return {name: content.decode() for name, content in files.items()}


def main():
    build, capture = sys.argv[1], pathlib.Path(sys.argv[2])
    checks = site.Checks(build)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        environment = make_fakes(folder / 'fakes')
        server = http.server.ThreadingHTTPServer(('127.0.0.1', 0), Health)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        listen = f'listen = ["192.0.2.1:80", "127.0.0.1:{server.server_port}"]\n'

        station = site.make_station(folder / 'site', capture, site.SECRET_LINES + listen)
        texts = bundle_of(checks, folder, station, environment)
        checks.expect('webhook = "https://till.example"' in texts['station_file'], texts['station_file'])
        checks.expect('hub.view_tokens = "view.tokens"' in texts['station_file'], texts['station_file'])
        checks.expect('called kitchen' in texts['config_check'], texts['config_check'])
        checks.expect('view.tokens: file, ' in texts['paths'] and 'mode 0600' in texts['paths'], texts['paths'])
        checks.expect('view_0.jpg: file' in texts['paths'] and 'last-good.toml' in texts['paths'], texts['paths'])
        checks.expect('active (running)' in texts['services'], texts['services'])
        checks.expect('"status": "ok"' in texts['hub_health'], texts['hub_health'])
        for kept in ('hub started', 'the last line', '"tray": 7', 'limit=3', 'posting to https://till.example'):
            checks.expect(kept in texts['log_hub'], f'the log lost {kept}: {texts["log_hub"]}')
        checks.expect('supply voltage' in texts['machine'] and 'MiB free' in texts['machine'], texts['machine'])
        checks.expect(len(Health.heads) == 1 and Health.heads[0].startswith('/health') and
                      'uthorization' not in Health.heads[0], f'the hub was asked so: {Health.heads}')

        # Every text key that people know is shown, but for secrets.
        example = (capture.parent.parent.parent / 'config' / 'station.toml').read_text()
        keys = sorted(set(re.findall(r'^(?:# )?([a-z_]+) = \[?"', example, re.MULTILINE)))
        checks.expect(len(keys) > 40, f'found few keys: {keys}')
        site.write(station, '[all]\n' + ''.join(f'{key} = "as/{key}/is"\n' for key in keys))
        texts = bundle_of(checks, folder, station, {'PATH': '/nowhere'})
        removed = re.findall(r'all[.]([a-z_]+) = "[(]removed[)]"', texts['station_file'])
        secret = {key for key in keys if any(part in key for part in ('token', 'secret', 'pass', '_key'))}
        checks.expect(set(removed) == secret | {'webhook'},
                      f'removed: {removed}; is a new key missing in kShownKeys of station_values.cpp?')

        # A secret in place of a path, and keys that do not exist.
        site.make_station(folder / 'site', capture, f'{site.SECRET_LINES}manage_tokens = "{site.INLINE_SECRET}"\n')
        texts = bundle_of(checks, folder, station, environment)
        checks.expect('(removed)' in texts['config_check'], texts['config_check'])
        site.make_station(folder / 'site', capture, f'{site.SECRET_LINES}door = "{site.INLINE_SECRET}"\n')
        texts = bundle_of(checks, folder, station, environment)
        checks.expect('hub.door = "(removed)"' in texts['station_file'], texts['station_file'])
        checks.expect('hub.door: expected one of' in texts['config_check'], texts['config_check'])

        # No TOML: its good lines are shown, and its secrets known all the same.
        for bad in (site.SECRET_LINES.replace('"\n', '\n'), 'name = "unclosed\n', '= 3\n', f'pin = {site.COMMENT_SECRET} # {site.COMMENT_SECRET}\n', '"""\n'):
            site.make_station(folder / 'site', capture, bad if 'webhook' in bad else site.SECRET_LINES + bad)
            texts = bundle_of(checks, folder, station, environment)
            checks.expect('cannot be read' in texts['station_file'] and '3: camera.device = "serial:A1"' in
                          texts['station_file'], texts['station_file'])

        # No station file: of secrets, those beside it are known.
        site.write(folder / 'fakes' / 'lines', f'browser {site.TOKEN}, hook {site.WEBHOOK_SECRET}\n')
        site.write(station, os.urandom(70_000))
        bundle_of(checks, folder, station, environment)
        texts = bundle_of(checks, folder, folder / 'site' / 'absent.toml', environment)
        checks.expect('No such file' in texts['config_check'], texts['config_check'])

        # A secret that cannot be read cannot be looked for.
        site.make_station(folder / 'site', capture)
        (folder / 'site' / 'view.tokens').unlink()
        (folder / 'site' / 'view.tokens').mkdir()
        texts = bundle_of(checks, folder, station, environment, 'logs are left out')
        checks.expect('This is left out' in texts['log_hub'], texts['log_hub'])

        # A log without end.
        site.write(folder / 'fakes' / 'journalctl', f'#!/bin/sh\nyes {site.QUERY_SECRET}\n', 0o755)
        (folder / 'site' / 'view.tokens').rmdir()
        site.make_station(folder / 'site', capture)
        texts = bundle_of(checks, folder, station, environment)
        checks.expect('wrote more than 8 MiB' in texts['log_hub'], texts['log_hub'][-100:])

        # Neither systemd nor a hub, and one that never answers.
        silent = socket.create_server(('127.0.0.1', 0))
        site.make_station(folder / 'site', capture, f'listen = ["127.0.0.1:{silent.getsockname()[1]}"]\n')
        begin = time.monotonic()
        texts = bundle_of(checks, folder, station, {'PATH': '/nowhere'})
        checks.expect(time.monotonic() - begin < 5, 'the hub that does not answer took too long')
        checks.expect('did not answer in time' in texts['hub_health'], texts['hub_health'])
        checks.expect('journalctl is not installed' in texts['log_hub'], texts['log_hub'])
        checks.expect('systemctl is not installed' in texts['services'], texts['services'])

        # What cannot be written, and what must not be overwritten.
        checks.run(['support', station, '--out', folder / 'absent' / 'x.tar.gz'], 2, 'cannot be written')
        checks.run(['support', station, '--out', station], 2, 'something that is no archive stands there')
        checks.run(['support', station, '--out', '/dev/full'], 2, 'cannot be written')
    return 1 if checks.failures else 0


sys.exit(main())
