#!/bin/sh
# Builds packages for Debian 13 in the Debian 13 of tests/debian13, as `make package` does for this machine's release:
# package_debian13.sh FOLDER OUT. OUT gets the packages. COMMIT: what is built, because git does not see the checkout there.
# SOURCE_DATE_EPOCH counts, and JOBS and OPTIONS as in test_debian13.sh.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
jobs=${JOBS:-$(nproc)}
"$here/../debian13/test_debian13.sh" "$1" sh -euc "
  cmake --preset package -S /checkout -B /build/package -DTRAYGAUGE_COMMIT='${COMMIT:-}' ${OPTIONS:-}
  cmake --build /build/package -j $jobs --target traygauge traygauge-simulate traygauge-manual
  rm -rf /build/package/packages
  cd /build/package
  umask 022
  cpack"
mkdir -p "$2"
rm -f "$2"/*.deb
cp "$1"/root/build/package/packages/*.deb "$2"
