#!/bin/sh
# Writes a new figure from the template beside this script: new-figure.sh two-cameras
set -eu
name=${1:-}
case $name in
'' | *[!a-z0-9-]* | [!a-z]* | *-)
    echo "make new-figure NAME=two-cameras: the name has small letters, digits and hyphens" >&2
    exit 2
    ;;
esac
here=$(cd "$(dirname "$0")" && pwd)
gallery=$here/../src/gallery
module=$(printf %s "$name" | tr - _)
type=$(printf %s "$name" | awk -F- '{ for (i = 1; i <= NF; i++) printf "%s%s", toupper(substr($i, 1, 1)), substr($i, 2) }')
title=$(printf %s "$name" | tr - ' ' | awk '{ print toupper(substr($0, 1, 1)) substr($0, 2) }')
if [ -e "$gallery/$module" ]; then
    echo "the figure $name exists already" >&2
    exit 1
fi
mkdir -p "$gallery/$module"
fill() {
    sed -e "s/new-figure/$name/g" -e "s/NewFigure/$type/g" -e "s/New figure/$title/g" "$1" >"$2"
}
for file in mod model words view; do
    fill "$here/$file.rs" "$gallery/$module/$file.rs"
done
list=$here/../src/gallery.rs
awk -v line="mod $module;" -v entry="    $module::View," '
    /^(pub )?mod / && !done { last = 1 }
    last && !/^(pub )?mod / { print line; last = 0; done = 1 }
    /^\];/ { print entry }
    { print }
' "$list" >"$list.part"
mv "$list.part" "$list"
echo "wrote $name; see CONTRIBUTING.md, \"Adding a figure\""
