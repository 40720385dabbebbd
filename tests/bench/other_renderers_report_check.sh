#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# The page that bench/report/other_renderers_report.py makes of a small made-up report shows its
# figures, who wins and who is left out; what is no report is refused. Exit code 0: passed, 1: failed,
# 77: skipped, there is no Python 3.
set -eu

# shellcheck source=tests/testing/report_program.sh
. "$(dirname -- "$0")/../testing/report_program.sh"
program=$root/bench/report/other_renderers_report.py

# Two scenes: Weft wins in the first one, and in the second one loses to another renderer.
cat >"$work/make.py" <<'END'
import json
import sys

sys.path.insert(0, sys.argv[1])
import verdicts  # noqa: E402


def image(name, hdrflip, **fields):
    return {"name": name, "budget_s": 0.3, "seconds": 0.29, "samples": 4, "denoised": False,
            "mean_ratio": 1.001, "hdrflip": hdrflip, "relmse": 0.1, **fields}


def scene(name, images, left_out):
    verdicts.judge(images)
    return {"scene": name, "size": [64, 64], "threads": 0, "reference": "r.exr",
            "pictures": images, "left_out": left_out, "notes": ["A note."],
            "verdicts": [verdicts.verdict(images, 0.3)]}


denoised = image("Renderer, denoised", 0.05, denoised=True)
whole = {"benchmark": "peers", "quick": False, "size": 64, "budgets": [0.3], "settings": {},
         "machine": {"processor": "A processor", "hardware_threads": 4, "threads": 2},
         "versions": {"peer": "Renderer 3", "weft": "weft 1", "python": "3.11"},
         "scenes": [scene("box.gltf", [image("Renderer", 0.25), image("Weft path", 0.5),
                                       image("Weft ais", 0.125), dict(denoised),
                                       image("Other", 0.01, mean_ratio=1.5)], {}),
                    scene("fog.gltf", [image("Renderer", 0.25),
                                       image("Weft ais", 0.2, seconds=0.4),
                                       image("Weft path", 0.5), dict(denoised)],
                          {"other": "not expressible: media"})]}
whole["summary"] = verdicts.summary(whole["scenes"], whole["budgets"])
json.dump(whole, open("peers.json", "w"))
halves = json.loads(json.dumps(whole))
halves["scenes"][0]["reference_floor"] = 0.0123
halves["scenes"][0]["pictures"][0] |= {"relmse_unbiased": 0.5, "relmse_interval": 0.0025}
halves["scenes"][1]["notes"].append("Other: left out at 0.3 s: of 8 images none took")
json.dump(halves, open("halves.json", "w"))
json.dump({**whole, "benchmark": "rays"}, open("other.json", "w"))
del whole["scenes"][1]["pictures"][0]["late"]
json.dump(whole, open("lacking.json", "w"))
open("broken.json", "w").write("{")
END
(cd "$work" && python3 -B make.py "$root/bench/other_renderers")

python3 -B "$program" "$work/peers.json" >"$work/log"
[ "$(wc -l <"$work/log")" -eq 1 ] || fail "not one page: $(cat "$work/log")"

# expect LINE: the page has that line.
expect() {
    grep -qxF -e "$1" "$work/peers.md" || fail "peers.md lacks the line: $1
$(cat "$work/peers.md")"
}
expect "Weft has the lowest HDR-FLIP of all undenoised at 0.3 s on 1 of 2. Against denoised \
images of others it has the lower one at 0.3 s on 0 of 2."
expect '| scene | Weft path | Weft ais | Renderer | Renderer, denoised | Other |'
expect '| box.gltf | 0.5000 | **0.1250** | 0.2500 | 0.0500 | 0.0100\* |'
# Weft's best image is late: the other renderer wins.
expect '| fog.gltf | 0.5000 | 0.2000+ | **0.2500** | 0.0500 |  |'
expect '| box.gltf | Weft ais | 0.1250 | Renderer | 0.2500 | Renderer, denoised | 0.0500 | 0.50 |'
expect '| fog.gltf | Weft path | 0.5000 | Renderer | 0.2500 | Renderer, denoised | 0.0500 | 2.00 |'
expect '| fog.gltf | 0.29 s, 4 | 0.40 s, 4 | 0.29 s, 4 | 0.29 s, 4 |  |'
expect '| box.gltf | 1.001 | 1.001 | 1.001 | 1.001 | 1.500 |'
expect "| \`other\` | not expressible: media | fog.gltf |"
expect '- A note.'

! grep -q halves "$work/peers.md" || fail "halves are named that there are not"

# References of two halves: their difference, relMSE without their noise, and budgets not filled.
python3 -B "$program" "$work/halves.json" --output "$work/peers.md" >"$work/log"
expect "| scene | Weft path | Weft ais | Renderer | Renderer, denoised | Other | between halves of \
the reference |"
expect '| box.gltf | 0.5000 | **0.1250** | 0.2500 | 0.0500 | 0.0100\* | 0.0123 |'
expect '| box.gltf |  |  | 0.5000 ± 0.0025 |  |  |'
expect '## Budgets that were not filled'
expect '- fog.gltf, Other: left out at 0.3 s: of 8 images none took'

refuse 2 'is no JSON' "$work/broken.json"
refuse 2 'is no report of bench other_renderers' "$work/other.json"
refuse 2 "lacks 'late'" "$work/lacking.json"
refuse 2 'No such file' "$work/gone.json"
refuse 5 'No such file' "$work/peers.json" --output "$work/gone/page.md"
[ ! -e "$work/lacking.md" ] || fail "a page was written of a report that is refused"
echo "the page shows the figures of a report, and what is none is refused"
