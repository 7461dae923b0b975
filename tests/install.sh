#!/usr/bin/env bash
# Installs the build to a folder of its own and builds the example of docs/own-decider.md against it, outside the tree; runs it on
# the small set.   tests/install.sh BUILD_DIR SOURCE_DIR
set -euo pipefail
build=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/prefix" >"$work/install.log" || { cat "$work/install.log"; exit 1; }
for file in bin/auv-graphslam share/posidonia/ini/paper-exp2.ini share/doc/posidonia/copyright \
	share/bash-completion/completions/auv-graphslam; do
	[ -e "$work/prefix/$file" ] || { echo "not installed: $file"; exit 1; }
done
"$work/prefix/bin/auv-graphslam" --version
cp -r "$source/examples/01-own-decider" "$work/example"
cmake -S "$work/example" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix"
cmake --build "$work/build"
own=$work/build/own-decider
"$own" --list-deciders | grep CNearestERD
"$own" -c "$source/ini/square.ini" -r "$source/rawlogs/square/square.rawlog" -e CSequentialStereoERD,CNearestERD -o "$work/run"
grep -q "0 false; sequential" "$work/run/run.log" || { echo "it accepted a false loop"; exit 1; }
grep -q ",roi,accepted" "$work/run/loops.csv" || { echo "it closed no loop"; exit 1; }
