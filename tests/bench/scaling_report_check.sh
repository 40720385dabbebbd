#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# The page and the plots that bench/report/scaling_report.py makes of a small made-up report show
# its figures; what is no report is refused. Exit code 0: passed, 1: failed, 77: skipped, there is
# no Python 3 with Matplotlib.
set -eu

# shellcheck source=tests/testing/report_program.sh
. "$(dirname -- "$0")/../testing/report_program.sh"
program=$root/bench/report/scaling_report.py

need_matplotlib

# An axis with builds and a point left out, one with errors, and one too short for any law.
cat >"$work/make.py" <<'END'
import json


def law(expected, exponent, **parameters):
    return {"text": "offset + slope x", "parameters": parameters, "expected": expected,
            "relative_rms": 0.125, "exponent": exponent}


def method(points, fitted, relmse=None):
    return {"method": "igi", "law": fitted, "relmse_exponent": relmse, "hdrflip_exponent": None,
            "points": [{"x": x, "ms": ms, "errors": errors} for x, ms, errors in points]}


def axis(name, unit, of_method, build=None, left_out=()):
    return {"axis": name, "unit": unit, "setting": "a <room>", "methods": [of_method],
            "build": build, "left_out": list(left_out)}


def error(relmse):
    return {"relmse": relmse, "hdrflip": None}


axes = [
    axis("triangles", "triangles", method([(100, 10.0, None), (1000, 12.0, None)],
                                          law([10.5, 11.5], 0.0625, offset=1.5, slope=2.5)),
         {"points": [{"x": 100, "ms": 1.0}, {"x": 1000, "ms": 10.0}],
          "law": law([1.0, 10.0], 1.0, offset=0.0, slope=0.01)}, ["1e+07 triangles: too many"]),
    axis("vpls", "VPLs", method([(8, 1.5, error(0.5)), (64, 6.0, error(0.0625)),
                                 (512, 24.0, error(0.0))],
                                law([1.5, 6.0, 24.0], 0.5, offset=4.0, slope=0.25), -1.0)),
    axis("threads", "threads", method([(1, 7.25, None)], None))]
whole = {"benchmark": "scaling", "size": 256, "repetitions": 9, "reference_spp": 64, "axes": axes,
         "machine": {"processor": "A processor", "hardware_threads": 2, "threads": 0,
                     "memory": 2 ** 34},
         "versions": {"weft": "1", "compiler": "c", "embree": "4"},
         "device": {"backend": "native", "name": "n"}}
json.dump(whole, open("scaling.json", "w"))
json.dump({**whole, "benchmark": "dynamic"}, open("other.json", "w"))
del whole["axes"][1]["methods"][0]["points"][0]["ms"]
json.dump(whole, open("lacking.json", "w"))
open("broken.json", "w").write("{")
END
(cd "$work" && python3 -B make.py)

refuse_without_matplotlib "$program" "$work/scaling.json"
"$python" -B "$program" "$work/scaling.json" >"$work/log"
# The page, three plots of times and one of errors.
[ "$(wc -l <"$work/log")" -eq 5 ] || fail "not five files: $(cat "$work/log")"

# expect LINE: the page has that line.
expect() {
    grep -qxF -e "$1" "$work/scaling.md" || fail "scaling.md lacks the line: $1
$(cat "$work/scaling.md")"
}
expect '## Triangles'
expect '![Triangles: time](scaling-triangles.svg)'
expect '![Virtual lights: error](scaling-vpls-error.svg)'
expect '| triangles | igi, ms | expected | build, ms | expected |'
expect '| 1000 | 12.00 | 11.50 | 10.00 | 10.00 |'
expect '| VPLs | igi, ms | expected | relMSE | HDR-FLIP |'
expect '| 64 | 6.00 | 6.00 | 0.06250 |  |'
expect '| 1 | 7.25 |  |'
expect "- igi: offset + slope x with offset 1.5, slope 2.5; off by 12.5 % (root mean square). \
As a power of x the exponent is 0.06."
expect '- Errors of igi as a power of x: relMSE -1.00.'
expect '- Left out: 1e+07 triangles: too many.'
expect '- igi: too few points, or a time of 0, to fit anything.'

# Every plot is XML and names its axes and lines. On logarithmic axes dots at 8, 64 and 512 VPLs and
# 1.5, 6 and 24 ms are evenly apart, to the right and up; the law has no dots. A logarithmic axis
# cannot show an error of 0.
cat >"$work/check.py" <<'END'
import pathlib
import sys
import xml.etree.ElementTree

folder = pathlib.Path(sys.argv[1])
SVG = "{http://www.w3.org/2000/svg}"


def texts(plot):
    return {"".join(text.itertext()).strip() for text in plot.iter(f"{SVG}text")}


def line(plot, name):
    """The places of its dots; fails where there is no line of that name."""
    found = [group for group in plot.iter(f"{SVG}g") if group.get("id") == name]
    assert len(found) == 1 and found[0].find(f"{SVG}path") is not None, name
    return [(float(dot.get("x")), float(dot.get("y"))) for dot in found[0].iter(f"{SVG}use")]


plots = {file.stem: xml.etree.ElementTree.parse(file) for file in folder.glob("*.svg")}
assert len(plots) == 4, plots
assert texts(plots["scaling-triangles"]) > {
    "Triangles: time", "triangles", "milliseconds", "igi", "igi, expected", "build",
    "build, expected", "100", "1\u2009k"}, texts(plots["scaling-triangles"])
assert not any("expected" in text for text in texts(plots["scaling-threads"]))
assert len(line(plots["scaling-threads"], "igi")) == 1

dots = line(plots["scaling-vpls"], "igi")
assert len(dots) == 3, dots
(right, up), *others = [(bx - ax, ay - by) for (ax, ay), (bx, by) in zip(dots, dots[1:])]
assert right > 100.0 and up > 50.0, dots
assert all(abs(x - right) < 0.01 and abs(y - up) < 0.01 for x, y in others), dots
assert line(plots["scaling-vpls"], "igi-expected") == []

errors = plots["scaling-vpls-error"]
assert {"Virtual lights: error", "VPLs", "error", "igi, relMSE"} < texts(errors), texts(errors)
assert len(line(errors, "igi-relMSE")) == 2
assert not any("HDR-FLIP" in text for text in texts(errors)), texts(errors)
END
python3 -B "$work/check.py" "$work" || fail "a plot is wrong"

# The same report makes the same files.
mkdir "$work/again"
"$python" -B "$program" "$work/scaling.json" --output "$work/again/scaling.md" >"$work/log"
for file in "$work"/again/*; do
    cmp -s "$file" "$work/$(basename -- "$file")" || fail "made again, $file differs"
done

refuse 2 'is no JSON' "$work/broken.json"
refuse 2 'is no report of bench scaling' "$work/other.json"
refuse 2 "lacks 'ms'" "$work/lacking.json"
refuse 2 'No such file' "$work/gone.json"
refuse 5 'No such file' "$work/scaling.json" --output "$work/gone/page.md"
refuse 1 'required' --output "$work/page.md"
[ ! -e "$work/lacking.md" ] || fail "a page was written of a report that is refused"
echo "the page and plots show the figures of a report, and what is none is refused"
