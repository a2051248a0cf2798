#!/usr/bin/env bash
# Installs the OPC UA client of the tests here from npm: node-opcua, which shares nothing with asyncua.
set -euo pipefail
cd "$(dirname "$0")"

command -v npm >/dev/null || apt-get -o DPkg::Lock::Timeout=300 install -y -qq \
  --no-install-recommends nodejs npm >/dev/null
npm install --no-audit --no-fund --ignore-scripts --no-package-lock --loglevel=error
