#!/bin/sh
# Builds packages for Debian 13 in the Debian 13 of tests/debian13, as `make package` does for this machine's release:
# package_debian13.sh FOLDER ARCH OUT. OUT gets the packages; those of arm64 are cross-built. COMMIT: what is built, because git does
# not see the checkout there. SOURCE_DATE_EPOCH counts, and JOBS and OPTIONS as in test_debian13.sh.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
jobs=${JOBS:-$(nproc)}
build=/build/package-$2
case $2 in
  amd64) prepare='' preset=package depends='' ;;
  arm64)
    # The manual is what the programs say, by the emulator.
    prepare="apt-get -qq install -y --no-install-recommends g++-aarch64-linux-gnu qemu-user >/dev/null
      /checkout/tests/board/make_sysroot.sh /build/sysroot-arm64"
    preset="package-arm64 -DTRAYGAUGE_SYSROOT=/build/sysroot-arm64"
    depends="/checkout/cmake/find_depends.py $build" ;;
  *) echo "package_debian13.sh: expected amd64 or arm64, found $2" >&2; exit 2 ;;
esac
"$here/../debian13/test_debian13.sh" "$1" sh -euc "
  $prepare
  cmake --preset $preset -S /checkout -B $build -DTRAYGAUGE_COMMIT='${COMMIT:-}' ${OPTIONS:-}
  cmake --build $build -j $jobs --target traygauge traygauge-simulate traygauge-manual
  $depends
  rm -rf $build/packages
  cd $build
  umask 022
  cpack"
mkdir -p "$3"
rm -f "$3"/*.deb
cp "$1/root$build"/packages/*.deb "$3"
