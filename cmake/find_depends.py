#!/usr/bin/env python3
"""Writes the dependencies of cross-built packages, which dpkg-shlibdeps cannot find: find_depends.py BUILD_FOLDER

BUILD_FOLDER/depends.cmake is read by CPack. The packages that hold a library are called alike for every architecture and have
the same symbols, so the libraries that the programs load are looked up in this machine's packages, which have to be of the same
release: as dpkg-shlibdeps does, by the least version that has all symbols that are used, or by what the package says.
"""
import functools
import pathlib
import re
import subprocess
import sys

SIMULATOR = ["traygauge-simulate"]
# What CPack is told beside, see package.cmake.
FURTHER = {"TRAYGAUGE": ["systemd | systemd-standalone-sysusers"], "SIMULATOR": ["traygauge (= {version})"]}


def programs_of(build):
    """Those of each package: what is built for it, so that none is forgotten."""
    built = sorted(file.name for file in build.glob("traygauge*") if file.is_file() and file.read_bytes()[:4] == b"\x7fELF")
    missing = set(SIMULATOR + ["traygauge"]) - set(built)
    if missing:
        raise SystemExit(f"find_depends.py: {build} lacks {', '.join(sorted(missing))}; build them first")
    return {"TRAYGAUGE": [name for name in built if name not in SIMULATOR], "SIMULATOR": SIMULATOR}


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True, env={"LC_ALL": "C", "PATH": "/usr/bin:/bin"}).stdout


def loaded_libraries(program):
    return re.findall(r"\(NEEDED\).*\[(.*)\]", run("readelf", "--dynamic", "--wide", str(program)))


def used_symbols(program):
    """name@VERSION, or name@Base where it has none, as packages write them."""
    found = re.findall(r" UND (\S+)", run("readelf", "--dyn-syms", "--wide", str(program)))
    return {name.replace("@@", "@") if "@" in name else name + "@Base" for name in found}


def package_of(soname, multiarch):
    if soname.startswith("ld-linux-"):
        return "libc6"
    for place in (f"*/{multiarch}/{soname}", f"*/{soname}"):
        found = subprocess.run(["dpkg-query", "--search", place], capture_output=True, text=True)
        packages = sorted({line.split(":")[0] for line in found.stdout.splitlines()})
        if packages:
            return packages[0]
    raise SystemExit(f"find_depends.py: no installed package has {soname}; make installs what is missing")


def is_newer(first, second):
    return subprocess.run(["dpkg", "--compare-versions", first, "gt", second]).returncode == 0


def least_version(symbols_file, soname, used):
    """Of the package, so that the library has all symbols that are used; None where the file does not tell."""
    section, versions = False, set()
    for line in symbols_file.read_text().splitlines():
        if not line.startswith((" ", "|", "*")):
            section = line.split(" ")[0] == soname
        elif section and line.startswith(" "):
            symbol, version = line.split()[:2]
            if symbol in used:
                versions.add(version)
    return functools.reduce(lambda a, b: a if is_newer(a, b) else b, versions) if versions else None


def dependency_on(soname, used, architecture, multiarch):
    package = package_of(soname, multiarch)
    info = f"/var/lib/dpkg/info/{package}:{architecture}"
    if (symbols := pathlib.Path(info + ".symbols")).exists():
        if version := least_version(symbols, soname, used):
            return package, version
    name, _, version = soname.partition(".so.")
    if (shlibs := pathlib.Path(info + ".shlibs")).exists():
        for line in shlibs.read_text().splitlines():
            fields = line.split(None, 2)
            if fields[:2] == [name, version]:
                asked = re.fullmatch(r"(\S+)(?: \(>= (.*)\))?", fields[2])
                if asked:
                    return asked.group(1), asked.group(2) or ""
    return package, ""


def main():
    build = pathlib.Path(sys.argv[1])
    version = re.search(r'CPACK_DEBIAN_PACKAGE_VERSION "(.*)"', (build / "CPackConfig.cmake").read_text()).group(1)
    architecture = run("dpkg", "--print-architecture").strip()
    multiarch = run("dpkg-architecture", "--query", "DEB_HOST_MULTIARCH").strip()
    lines = []
    for component, programs in programs_of(build).items():
        least = {}
        for program in programs:
            used = used_symbols(build / program)
            for soname in loaded_libraries(build / program):
                package, asked = dependency_on(soname, used, architecture, multiarch)
                if package not in least or (asked and is_newer(asked, least[package])):
                    least[package] = asked
        depends = [f"{name} (>= {asked})" if asked else name for name, asked in sorted(least.items())]
        depends += [text.format(version=version) for text in FURTHER[component]]
        lines.append(f'set(CPACK_DEBIAN_{component}_PACKAGE_DEPENDS "{", ".join(depends)}")')
    (build / "depends.cmake").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
