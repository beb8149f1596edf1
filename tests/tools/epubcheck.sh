#!/bin/sh
# Checks an EPUB file; neither errors nor warnings pass.
set -eu
command -v epubcheck >/dev/null 2>&1 || "$(dirname "$0")/apt.sh" "checking EPUB files" epubcheck default-jre-headless
program=$(command -v epubcheck)
# In some systems the program is the archive itself, which not every shell can run.
case $(readlink -f "$program") in
*.jar) java -jar "$program" --failonwarnings "$1" ;;
*) "$program" --failonwarnings "$1" ;;
esac
