#!/usr/bin/env bash
# Installs what the tests of the pages drive: Chromium from Debian, playwright for Python, and
# axe-core from npm, which judges contrast and names of controls.
set -euo pipefail
cd "$(dirname "$0")"

export DEBIAN_FRONTEND=noninteractive
apt-get -o DPkg::Lock::Timeout=300 install -y -qq --no-install-recommends chromium >/dev/null
command -v npm >/dev/null || apt-get -o DPkg::Lock::Timeout=300 install -y -qq \
  --no-install-recommends nodejs npm >/dev/null
python3 -m pip install --quiet --disable-pip-version-check "playwright>=1.50"
cd peers && npm install --no-audit --no-fund --ignore-scripts --no-package-lock --loglevel=error
