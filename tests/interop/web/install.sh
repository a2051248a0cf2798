#!/usr/bin/env bash
# Installs what the tests of the pages drive: Chromium from Debian, playwright for Python, and
# axe-core from npm, which judges contrast and names of controls.
set -euo pipefail
cd "$(dirname "$0")"
. ../downloads.sh

export DEBIAN_FRONTEND=noninteractive
apt_install chromium
command -v npm >/dev/null || apt_install nodejs npm
try python3 -m pip install --quiet --disable-pip-version-check "playwright>=1.50"
cd peers && npm_install
