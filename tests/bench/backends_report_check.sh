#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# The page that bench/report/backends_report.py makes of a small made-up report shows its figures;
# what is no report is refused. Exit code 0: passed, 1: failed, 77: skipped, there is no Python 3.
set -eu

# shellcheck source=tests/testing/report_program.sh
. "$(dirname -- "$0")/../testing/report_program.sh"
program=$root/bench/report/backends_report.py

# Two backends; a kernel that both run, and one that only the second does.
cat >"$work/make.py" <<'END'
import json


def kernel(name, ms, ratio, launches, rays):
    return {"kernel": name, "ms": ms, "ratio": ratio, "share": ms / 100.0, "launches": launches,
            "items": 4096, "rays": rays, "bound_bytes": 2500000}


def backend(name, ms, ratio, kernels):
    return {"backend": name, "ms": ms, "ratio": ratio, "rays": 3000000, "host_read_bytes": 500000,
            "host_written_bytes": 0, "kernels": kernels,
            "stages": [{"name": "VPL gather", "component": "indirect", "ms": ms / 2.0,
                        "ratio": ratio, "rays": 2000000}]}


def device(label, builds):
    return {"label": label, "name": "n", "driver": "d", "version": "v", "lanes": 8,
            "compute_units": 2, "builds": builds, "copy_bytes_per_second": 1e9}


method = {"method": "igi", "backends": [
    backend("native", 100.0, 1.0, [kernel("vpl_gather", 50.0, 1.0, 4, 2000000)]),
    backend("opencl", 150.0, 1.5, [kernel("vpl_gather", 75.0, 1.5, 8, 2000000),
                                   kernel("compose", 2.0, None, 1, None)])]}
whole = {"benchmark": "kernels", "size": 512, "repetitions": 9, "path_samples": 4,
         "machine": {"processor": "A processor", "hardware_threads": 4, "threads": 2,
                     "memory": 2 ** 33},
         "versions": {"weft": "1", "compiler": "c", "embree": "4"},
         "devices": [device("native", []),
                     device("opencl", [
                         {"kernel": "compose", "flags": "-a", "ms": 100.5, "from_cache": False},
                         {"kernel": "compose", "flags": "-b", "ms": 1.0, "from_cache": True}])],
         "summary": {"opencl": {"frame": 1.5}},
         "scenes": [{"scene": "box.gltf", "triangles": 36, "media": False,
                     "structures": [{"backend": "native", "build_ms": 1.25, "bytes": 4000000},
                                    {"backend": "opencl", "build_ms": 2.5, "bytes": None}],
                     "methods": [method]}]}
json.dump(whole, open("backends.json", "w"))
json.dump({**whole, "benchmark": "rays"}, open("other.json", "w"))
del whole["scenes"][0]["methods"][0]["backends"][1]["kernels"][0]["share"]
json.dump(whole, open("lacking.json", "w"))
open("broken.json", "w").write("{")
END
(cd "$work" && python3 -B make.py)

python3 -B "$program" "$work/backends.json" >"$work/log"
[ "$(wc -l <"$work/log")" -eq 1 ] || fail "not one page: $(cat "$work/log")"

# expect LINE: the page has that line.
expect() {
    grep -qxF -e "$1" "$work/backends.md" || fail "backends.md lacks the line: $1
$(cat "$work/backends.md")"
}
expect '| box.gltf, igi | 100.0 | 150.0 | 1.50 | 3.00 | 0.50 | 0.00 |'
expect '| box.gltf | 36 | native, own BVH | 1.2 | 4.00 |'
expect '| box.gltf | 36 | OpenCL | 2.5 |  |'
expect '| stage | native, own BVH, ms | OpenCL, ms | ratio | Mrays |'
expect '| VPL gather, indirect | 50.000 | 75.000 | 1.50 | 2.000 |'
# Two million rays in 50 ms are 40 million a second; 2.5 MB in 50 ms, 5 % of 1 GB/s.
expect "| \`vpl_gather\` | 50.000 | 75.000 | 1.50 | 50.0 / 75.0 | 4 / 8 | 4096 | 2.000 | 40.00 \
| 2.50 | 5.0 / 3.3 |"
expect '| `compose` |  | 2.000 |  | – / 2.0 | – / 1 | 4096 |  |  | 2.50 | – / 125.0 |'
expect '| `compose` | 1 | 100.5 | 1 | 1.0 |'
grep -q 'a frame takes, in times that of native, own BVH: OpenCL 1.50 (geo' "$work/backends.md" ||
    fail 'the page does not say what portability costs'
expect 'native, own BVH: kernels are compiled into Weft.'

refuse 2 'is no JSON' "$work/broken.json"
refuse 2 'is no report of bench kernels' "$work/other.json"
refuse 2 "lacks 'share'" "$work/lacking.json"
refuse 2 'No such file' "$work/gone.json"
refuse 5 'No such file' "$work/backends.json" --output "$work/gone/page.md"
refuse 1 'required' --output "$work/page.md"
[ ! -e "$work/lacking.md" ] || fail "a page was written of a report that is refused"
echo "the page shows the figures of a report, and what is none is refused"
