#!/bin/sh
# Makes filpost.vsix in this folder, or where the first argument says: the client of the language
# server beside the files that stand here. Needs node and npm, and takes its packages from the npm
# registry, or from the folder of modules that the second argument names. It is made in a folder of
# its own, so that none of them stays here.
set -e
here=$(cd "$(dirname "$0")" && pwd)
out=${1:-$here/filpost.vsix}
case $out in /*) ;; *) out=$PWD/$out ;; esac
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
cp -r "$here/." "$made"
cp "$here/../../../../LICENSE-MIT" "$made/LICENSE"
if [ -n "$2" ]; then
    cp -r "$2" "$made/node_modules"
fi
cd "$made"
[ -n "$2" ] || npm install --ignore-scripts --no-audit --no-fund --package-lock=false
npx vsce package --no-git-tag-version --allow-missing-repository --out "$out"
