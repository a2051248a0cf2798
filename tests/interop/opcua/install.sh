#!/usr/bin/env bash
# Installs the OPC UA client of the tests here from npm: node-opcua, which shares nothing with asyncua.
set -euo pipefail
cd "$(dirname "$0")"
. ../downloads.sh

command -v npm >/dev/null || apt_install nodejs npm
npm_install
