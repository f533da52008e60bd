#!/bin/sh
# Runs these impacts, leaves results.csv and scores it: exit code 0 if they pass, else 1.
# What follows the name of this script goes to the scorer, e.g. --tolerance 0.6 --plot score.png
set -e
cd "$$(dirname "$$0")"
command -v carom >/dev/null || { echo "no carom: activate its environment" >&2; exit 2; }
$command
"$${PYTHON:-python3}" -m carom.verify.pack.collect .
carom verify score results.csv --case ../case.toml "$$@"
