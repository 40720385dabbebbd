#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# Uses `weft view` in a browser, as view_browser.py says. Exit code 0: passed, 1: failed, 77: there
# is no Chromium with its driver, or no Selenium. $1, if given: a folder for screenshots.
set -eu

for tool in chromium chromedriver; do
    command -v "$tool" >/dev/null || {
        echo "skipped: no $tool"
        exit 77
    }
done
# Debian's own Python has Debian's Selenium, whatever else is installed.
/usr/bin/python3 -c 'import selenium' 2>/dev/null || {
    echo "skipped: no Selenium (Debian package python3-selenium)"
    exit 77
}
exec /usr/bin/python3 -B "$WEFT_SOURCE_DIR/tests/view/view_browser.py" "$WEFT_PROGRAM" "$@"
