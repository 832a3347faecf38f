#!/usr/bin/env python3
"""Writes the dependencies of cross-built packages, which dpkg-shlibdeps cannot find: find_depends.py BUILD_FOLDER

BUILD_FOLDER/depends.cmake is read by CPack. The packages that hold a library are called alike for every architecture, so the
libraries that the programs load are looked up in this machine's packages, which have to be of the same release. Where
dpkg-shlibdeps finds the least version that has all symbols that are used, this asks for what the package says of the library,
or for the version that this release has.
"""
import pathlib
import re
import subprocess
import sys

PROGRAMS = {
    "TRAYGAUGE": ["traygauge", "traygauge-calibrate", "traygauge-card", "traygauge-hub", "traygauge-station"],
    "SIMULATOR": ["traygauge-simulate"],
}
# What CPack is told beside, see package.cmake.
FURTHER = {"TRAYGAUGE": ["systemd | systemd-standalone-sysusers"], "SIMULATOR": ["traygauge (= {version})"]}


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True, env={"LC_ALL": "C", "PATH": "/usr/bin:/bin"}).stdout


def loaded_libraries(program):
    return re.findall(r"\(NEEDED\).*\[(.*)\]", run("readelf", "--dynamic", "--wide", str(program)))


def package_of(soname):
    if soname.startswith("ld-linux-"):
        return "libc6"
    found = subprocess.run(["dpkg-query", "--search", f"*/{soname}"], capture_output=True, text=True)
    packages = sorted({line.split(":")[0] for line in found.stdout.splitlines() if line.endswith("/" + soname)})
    if not packages:
        raise SystemExit(f"find_depends.py: no installed package has {soname}; make installs what is missing")
    return packages[0]


def dependency_on(soname):
    package = package_of(soname)
    architecture = run("dpkg", "--print-architecture").strip()
    name, _, version = soname.partition(".so.")
    shlibs = pathlib.Path(f"/var/lib/dpkg/info/{package}:{architecture}.shlibs")
    if shlibs.exists():
        for line in shlibs.read_text().splitlines():
            fields = line.split(None, 2)
            if len(fields) == 3 and [name, version] == fields[:2]:
                return fields[2]
    released = run("dpkg-query", "--show", "--showformat=${Version}", package)
    return f"{package} (>= {re.sub(r'[-+][^-+]*$', '', released.split('+')[0])})"


def main():
    build = pathlib.Path(sys.argv[1])
    version = re.search(r'CPACK_DEBIAN_PACKAGE_VERSION "(.*)"', (build / "CPackConfig.cmake").read_text()).group(1)
    lines = []
    for component, programs in PROGRAMS.items():
        sonames = {soname for program in programs for soname in loaded_libraries(build / program)}
        depends = sorted({dependency_on(soname) for soname in sonames})
        depends += [text.format(version=version) for text in FURTHER[component]]
        lines.append(f'set(CPACK_DEBIAN_{component}_PACKAGE_DEPENDS "{", ".join(depends)}")')
    (build / "depends.cmake").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
