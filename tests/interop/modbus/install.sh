#!/usr/bin/env bash
# Installs the Modbus clients of the tests here: mbpoll and libmodbus from Debian, modbus-serial,
# jsmodbus and Node-RED with node-red-contrib-modbus from npm. FUXA is a manual test: fuxa.sh.
set -euo pipefail
cd "$(dirname "$0")"
. ../downloads.sh

export DEBIAN_FRONTEND=noninteractive
apt_install gcc libc6-dev libmodbus-dev mbpoll pkg-config
command -v npm >/dev/null || apt_install nodejs npm
# no install scripts: the serial port's native part is not needed for TCP
cd peers && npm_install
