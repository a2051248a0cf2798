#!/usr/bin/env bash
# Manual: FUXA (an HMI in the browser) shows and drives programs/tank; keeps a screenshot.
#   tests/interop/modbus/fuxa.sh PYTHON SCREENSHOT.png
# Installs FUXA from npm (its sqlite3 is compiled, about a minute) and Chromium from Debian.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
python="${1:-python3}" screenshot="${2:-fuxa.png}"
work="${FUXA_FOLDER:-$here/peers/fuxa}"

export DEBIAN_FRONTEND=noninteractive
command -v chromium >/dev/null || apt-get -o DPkg::Lock::Timeout=300 install -y -qq \
  --no-install-recommends chromium g++ make nodejs npm libnode-dev >/dev/null
if [ ! -d "$work/node_modules/@frangoteam/fuxa" ]; then
  mkdir -p "$work"
  echo '{"private": true, "dependencies": {"@frangoteam/fuxa": "1.3.4", "modbus-serial": "8.0.25"}}' \
    >"$work/package.json"
  (cd "$work" && npm install --no-audit --no-fund --ignore-scripts --silent &&
    npm rebuild sqlite3 --build-from-source --nodedir=/usr --silent)
fi
"$python" "$here/fuxa.py" --fuxa "$work/node_modules/@frangoteam/fuxa" --screenshot "$screenshot"
