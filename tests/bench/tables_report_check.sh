#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# The pages that bench/report/tables_report.py makes of a small made-up report show its figures, the
# published ones below them, and what follows from both; what is no report is refused. Exit code 0:
# passed, 1: failed, 77: skipped, there is no Python 3.
set -eu

# shellcheck source=tests/testing/report_program.sh
. "$(dirname -- "$0")/../testing/report_program.sh"
program=$root/bench/report/tables_report.py

# Two scenes of ours, one of them with media, and another one; 100 ms each by ais.
cat >"$work/make.py" <<'END'
import json
import sys

MEDIA = "VPLs in media"


def method(full, stages):
    return {"ms": {"FULL": full}, "stages_ms": stages, "sampled_percent": {"indirect": 12.5}}


def scene(name, published, stages, speedup, fps, shares):
    rows = {"fps": fps, "speedup": speedup, "hdrvdp_percent_of_pixels": shares,
            "hdrvdp_display": {"A_75": 7.25}, "hdrflip": {"A": 0.0125}, "relmse": {"A": 0.5},
            "bias": {"A": -0.25}}
    if name == "office-pm.gltf":
        rows["hdrvdp_display"]["floor_75"] = 1.5
        rows["hdrflip"]["floor"] = 0.0042
        rows["relmse"]["noise"] = 0.0061
        rows["unbiased_relmse"] = {"A": 0.4}
        rows["unbiased_relmse_low"] = {"A": 0.375}
        rows["unbiased_relmse_high"] = {"A": 0.425}
    if name == "a|b":
        rows["hdrvdp_percent_of_pixels"]["floor_75"] = 0.5
        rows["hdrvdp_percent_of_pixels"]["A_75"] = 0.4
    return {"scene": name, "set": "shipped" if name.endswith("gltf") else "real",
            "published": published, "rows": rows,
            "reference": {"samples": 64, "algorithm": "reference"},
            "methods": {"ais": method(100.0, stages), "amax": method(300.0, {})}}


def report():
    half = {"primary rays": 20.0, "indirect: VPL gather": 40.0, "direct: area lights": 10.0,
            "direct: reconstruction": 15.0, "edge samples": 5.0}
    fixed = {"primary rays": 60.0, "media: " + MEDIA: 10.0, "composition": 20.0, "novelty": 4.0}
    scenes = [
        scene("desk.gltf", "Desk", half, {"ID": 4.0, "FULL": 3.0, "FULL_A_vs_IGI": 7.0},
              {"ID_A": 8.0, "FULL_A": 10.0}, {"A_75": 0.6, "AMAX_75": 0.2}),
        scene("office-pm.gltf", "OfficePM", fixed, {"ID": 2.0, "FULL": 3.0, "FULL_A_vs_IGI": None},
              {"ID_A": 4.0, "FULL_A": 10.0}, {"A_75": 1.2, "AMAX_75": 0.9}),
        scene("a|b", None, half, {"ID": 1.0, "FULL": 5.0, "FULL_A_vs_IGI": 1.0},
              {"ID_A": 1.0, "FULL_A": 10.0}, {"A_75": 0.3, "AMAX_75": 0.1})]
    published = {"source": "A thesis",
                 "speedup": {"rows": {"Desk": {"ID": 3.21, "FULL": 3.23},
                                      "Sibenik": {"ID": 2.17, "FULL": None}}}}
    summary = {"shipped": {"speedup": {"ID": 3.0, "FULL": 3.0, "FULL_A_vs_IGI": 7.0},
                           "hdrvdp_percent_of_pixels": {"A_75": 0.9},
                           "common": {"speedup": {"ID": 4.0}},
                           "published": {"speedup": {"ID": 3.21}}},
               "real": {"speedup": {"ID": 1.0}}}
    return {"benchmark": "tables", "quick": False, "quality": "preview", "size": 512,
            "repetitions": 9, "reference_spp": 64, "methods": ["igi", "amax", "ais", "ic", "tic"],
            "published": published, "scenes": scenes, "summary": summary,
            "machine": {"processor": "A processor", "hardware_threads": 2},
            "versions": {"weft": "1", "compiler": "c", "embree": "4"},
            "device": {"backend": "native", "name": "n", "driver": "d", "version": "v",
                       "lanes": 8}}


whole = report()
json.dump(whole, open("tables.json", "w"))
json.dump({**whole, "quality": "high"}, open("tables-high.json", "w"))
json.dump({**whole, "benchmark": "dynamic"}, open("other.json", "w"))
del whole["scenes"][0]["methods"]["ais"]["stages_ms"]
json.dump(whole, open("lacking.json", "w"))
open("broken.json", "w").write("{")
END
(cd "$work" && python3 -B make.py)

python3 -B "$program" "$work/tables.json" >"$work/log"
[ "$(wc -l <"$work/log")" -eq 2 ] || fail "not two pages: $(cat "$work/log")"

# expect PAGE LINE: the page has that line.
expect() {
    grep -qxF -e "$2" "$work/$1" || fail "$1 lacks the line: $2
$(cat "$work/$1")"
}
# A figure of its own, the published one below, and means; FULL of Sibenik does not count.
expect tables.md '| desk.gltf | 4.00 |  |  | 3.00 | 7.00 |  |  |  |  |  |'
expect tables.md '| references | `reference`, box filter, 64 samples per pixel |'
expect tables.md '| *published: Desk* | 3.21 |  |  | 3.23 |  |  |  |  |  |  |'
expect tables.md '| **mean** | 3.00 |  |  | 3.00 | 7.00 |  |  |  |  |  |'
expect tables.md '| *published mean, all scenes* | 2.69 |  |  | 3.23 |  |  |  |  |  |  |'
expect tables.md '| *published mean of these* | 3.21 |  |  |  |  |  |  |  |  |  |'
# 2.8 and 4 against 3; 3.5 and 6 against 7; 1.3 and 0.3 percent against 0.9.
expect tables.md '| speed-up FULL | 3.00 | 2.8 | reached | 4 | 33 % off |  | 3.23 |'
expect tables.md '| A over IGI | 7.00 | 3.5 | reached | 6 | reached |  |  |'
expect tables.md '| HDR-VDP 75 %, A | 0.90 | 1.3 | reached | 0.3 | 200 % off |  |  |'
expect tables.md '| speed-up ID | 3.00 | 2.7 | reached |  |  | 1.00 | 2.69 |'
# Half of the time is gathering: without it, 300 ms over 50 ms.
expect tables.md "| desk.gltf | 100.0 | 50 | 20 | 0 | 0 | 15 | 5 | 10 | 3.00 | 6.0 | 7.00 \
| gathering, 50 %: 12 % of the pixels are sampled for indirect light |"
# A stage that no part knows counts with what is between; 300 ms over 90 ms is not enough.
expect tables.md "| office-pm.gltf | 100.0 | 10 | 60 | 0 | 0 | 20 | 0 | 10 | 3.00 | 3.3 |  \
| first hits, 60 % |"
grep -qF 'a\|b | 100.0 |' "$work/tables.md" || fail "a bar within a name is not escaped"
expect errors.md '| desk.gltf | 0.60 | 0.20 | 0.40 | 2.0 | samples left out |'
expect errors.md '| office-pm.gltf | 1.20 | 0.90 | 0.30 | 4.0 | what A-MAX has as well, 75 % of it |'
# The floor of the reference goes before what a method leaves out.
expect errors.md "| a\|b | 0.40 | 0.10 | 0.30 | 1.3 | noise of the reference, whose halves differ by \
as much |"
expect errors.md '| office-pm.gltf | 0.0125 |  |  |  | 0.0042 |'
expect errors.md '| office-pm.gltf | 0.4000 ± 0.0250 |  |  |  |'
expect errors.md '| scene | A | A-MAX | IGI | IC | floor |'
expect errors.md '| office-pm.gltf | 0.5000 |  |  |  | 0.0061 |'
# A set without floors has no such column: HDR-FLIP and relMSE of one set, bias and unbiased relMSE
# of both.
[ "$(grep -cxF '| scene | A | A-MAX | IGI | IC |' "$work/errors.md")" -eq 6 ] ||
    fail "a column of floors without any"
expect errors.md '| desk.gltf | 7.25 |  | 0.60 |  | 100.00 |'
expect errors.md '| **mean** | 7.25 |  | 0.90 |  | 100.00 |'

rm "$work/tables.md" "$work/errors.md"
refuse 2 'is no JSON' "$work/broken.json"
refuse 2 'is no report of bench tables' "$work/other.json"
refuse 2 'lacks' "$work/lacking.json"
refuse 2 'No such file' "$work/gone.json"
refuse 5 'No such file' "$work/tables.json" --output "$work/gone"
refuse 1 'required' --output "$work"
if [ -e "$work/tables.md" ] || [ -e "$work/errors.md" ]; then
    fail "a page was written of a report that is refused"
fi
echo "the pages show the figures of a report, and what is none is refused"
