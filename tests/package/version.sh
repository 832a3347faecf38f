#!/bin/sh
# Checks what `--version` says: of this build, and of one whose commit git does not know. Usage: version.sh BUILD SOURCE CMAKE
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
status=0
version=$(sed -n 's/^project(traygauge VERSION \([0-9.]*\) .*/\1/p' "$2/CMakeLists.txt")
expect() { # PATTERN FILE
  grep -qx -e "$1" "$2" || { echo "expected '$1', found:"; cat "$2"; status=1; }
}
for program in traygauge traygauge-simulate; do
  "$1/$program" --version >"$folder/said"
  expect "$program $version" "$folder/said"
  expect 'build: [A-Z][A-Za-z]*, .* [0-9.]*, .*, with\(out\)\? profile paper' "$folder/said"
  expect 'built with: Eigen 3[0-9.]*, OpenCV 4[0-9.]*, SQLite 3[0-9.]*, .*' "$folder/said"
  expect 'commit: \([0-9a-f]*\(+changes\)\?\|not known, .*\)' "$folder/said"
done
grep -qx "## \[$version\] - [0-9-]*" "$2/CHANGELOG.md" || { echo "CHANGELOG.md has no release $version"; status=1; }

header() { # ARGUMENTS…: what a build there would say
  "$3" "-DROOT=$1" "-DOUTPUT=$folder/commit.hpp" "-DCOMMIT=$2" -P "$source/cmake/commit.cmake"
  sed -n 's/.*kCommit = "\(.*\)";/\1/p' "$folder/commit.hpp"
}
source=$2
mkdir "$folder/archive"
[ "$(header "$folder/archive" '' "$3")" = '' ] || { echo "a source archive has a commit"; status=1; }
[ "$(header "$folder/archive" 0123abc+changes "$3")" = 0123abc+changes ] || { echo "a given commit does not count"; status=1; }
[ "$(header "$folder/archive" '"; int x' "$3")" = '' ] || { echo "what is no commit counts"; status=1; }
if command -v git >/dev/null; then
  cd "$folder/archive"
  git init -q .
  echo one >file
  git add file
  git -c user.name=a -c user.email=a@b.example commit -q -m one
  commit=$(header "$folder/archive" '' "$3")
  [ "$commit" = "$(git rev-parse --short=12 HEAD)" ] || { echo "the commit is told as '$commit'"; status=1; }
  echo two >file
  [ "$(header "$folder/archive" '' "$3")" = "$commit+changes" ] || { echo "changes are not told"; status=1; }
fi
exit "$status"
