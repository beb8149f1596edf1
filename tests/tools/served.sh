#!/bin/sh
# Tests the book at EPIPOLE_LIBRARY in a browser, then measures how many pages a second it gives.
set -eu
cd "$(dirname "$0")/../browser"
npx playwright test --reporter=line book search settings continue terms symbols run listings frames
command -v wrk >/dev/null 2>&1 || ../tools/apt.sh "counting pages a second" wrk
for page in index.html rays.html sfm.html; do
    printf '%s: ' "$page"
    wrk -t 2 -c 32 -d 5s -H 'Accept-Encoding: br' "$EPIPOLE_LIBRARY/$page" |
        awk '/Requests\/sec/ { rate = $2 } /Transfer\/sec/ { size = $2 } END { print rate " pages a second, " size " a second" }'
done
