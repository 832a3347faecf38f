#!/bin/sh
# core_alone_test.sh CMAKE COMPILER CHECKOUT BUILD: core configures on a machine without OpenCV, and one of its
# sources compiles. Libraries other than Eigen are hidden from CMake.
set -eu
cmake=$1 compiler=$2 checkout=$3 build=$4
rm -rf "$build"
"$cmake" -S "$checkout/core" -B "$build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_DISABLE_FIND_PACKAGE_OpenCV=ON -DCMAKE_DISABLE_FIND_PACKAGE_GTest=ON \
  -DCMAKE_DISABLE_FIND_PACKAGE_CLI11=ON -DCMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON \
  -DTRAYGAUGE_PRECOMPILED_HEADERS=OFF
"$cmake" --build "$build" --target CMakeFiles/traygauge_core.dir/base/status.cpp.o
if grep -i opencv "$build/CMakeCache.txt" | grep -v DISABLE_FIND_PACKAGE; then
  echo 'core looked for OpenCV' >&2
  exit 1
fi
