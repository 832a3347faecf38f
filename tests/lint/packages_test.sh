#!/bin/sh
# Checks config/packages.txt against what the build really used: every listed package exists, and every header
# that the compiler read and every tool that the Makefile or a test calls belongs to a listed package or to one that a
# listed package depends on. Usage: packages_test.sh BUILD_FOLDER. Exit status 77: cannot be checked here.
set -eu

root=$(cd "$(dirname "$0")/../.." && pwd)
build=$1
for tool in dpkg-query apt-cache ninja; do
  command -v $tool >/dev/null 2>&1 || { echo "no $tool here"; exit 77; }
done
[ -f "$build/build.ninja" ] || { echo "not built with ninja"; exit 77; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
listed=$(sed 's/#.*//' "$root/config/packages.txt")
status=0

apt-cache pkgnames | sort -u >"$work/known"
for package in $listed; do
  grep -qxF -- "$package" "$work/known" ||
    { echo "config/packages.txt: no package is called $package"; status=1; }
done

apt-cache depends --recurse --no-recommends --no-suggests --no-conflicts --no-breaks --no-replaces --no-enhances \
  $listed | sed 's/^[ |]*\(Depends: \|PreDepends: \)\?//; s/[<>]//g; s/:.*//' | sort -u >"$work/closure"

# Headers outside the checkout, by their real paths, as the package manager knows them.
ninja -C "$build" -t deps | sed -n 's/^    \(\/.*\)/\1/p' | grep -vF -e "$root/" -e "$build/" | sort -u |
  xargs -r realpath -e 2>/dev/null | sort -u >"$work/files" || true
[ -s "$work/files" ] || { echo "nothing has been built in $build"; exit 77; }
for tool in g++ cmake ctest ninja make nm clang-format clang-tidy run-clang-tidy gnuplot; do
  found=$(command -v $tool) || { echo "$tool is not installed"; status=1; continue; }
  realpath "$found" >>"$work/files"
done

xargs dpkg-query -S <"$work/files" >"$work/owners" 2>"$work/unowned" || true
if [ -s "$work/unowned" ]; then
  echo "belongs to no package:"
  cat "$work/unowned"
  status=1
fi
sed 's/: .*//; s/, /\n/g; s/:[a-z0-9]*//g' "$work/owners" | sort -u >"$work/used"
if comm -23 "$work/used" "$work/closure" | grep .; then
  echo "used by the build, but config/packages.txt neither lists nor brings the packages above"
  status=1
fi
echo "$(wc -l <"$work/files") headers and tools of $(wc -l <"$work/used") packages checked"
exit $status
