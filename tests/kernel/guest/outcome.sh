#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# outcome.sh pass|fail|panic|hang: ends so.
case $1 in
pass) exit 0 ;;
fail) exit 1 ;;
panic) echo c >/proc/sysrq-trigger ;;
hang) while :; do :; done ;;
esac
