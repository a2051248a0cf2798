#!/usr/bin/env bash
# Installs the Modbus clients of the tests here: mbpoll and libmodbus from Debian, modbus-serial,
# jsmodbus and Node-RED with node-red-contrib-modbus from npm. FUXA is a manual test: fuxa.sh.
set -euo pipefail
cd "$(dirname "$0")"

export DEBIAN_FRONTEND=noninteractive
apt-get -o DPkg::Lock::Timeout=300 install -y -qq --no-install-recommends \
  gcc libc6-dev libmodbus-dev mbpoll pkg-config >/dev/null
command -v npm >/dev/null || apt-get -o DPkg::Lock::Timeout=300 install -y -qq \
  --no-install-recommends nodejs npm >/dev/null
# no install scripts: the serial port's native part is not needed for TCP
cd peers && npm install --no-audit --no-fund --ignore-scripts --no-package-lock --loglevel=error
