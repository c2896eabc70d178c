#!/bin/sh
# Makes filpost.vsix in this folder: the client of the language server beside the files that
# stand here. Needs node and npm, and takes its packages from the npm registry.
set -e
cd "$(dirname "$0")"
cp ../../../../LICENSE-MIT LICENSE
npm install --ignore-scripts --no-audit --no-fund --package-lock=false
npx vsce package --no-git-tag-version --allow-missing-repository --out filpost.vsix
