#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Makes a page of what `./weft bench kernels --json FILE` wrote.

Needs only Python's standard library:
    python3 bench/report/backends_report.py docs/results/backends.json
"""

import sys

from markdown_table import number
import report_file

LABELS = {"native": "native, own BVH", "opencl": "OpenCL", "embree": "native, Embree"}


def label(backend):
    return LABELS.get(backend, backend)


def device_table(devices):
    return report_file.table(
        ["backend", "device", "driver", "version", "packet width", "units", "copies, GB/s"],
        [[label(d["label"]), d["name"], d["driver"], d["version"], d["lanes"], d["compute_units"],
          number(d["copy_bytes_per_second"] * 1e-9, 1)]
         for d in devices])


def structure_table(scenes):
    rows = []
    for scene in scenes:
        for structure in scene["structures"]:
            size = structure["bytes"]
            rows.append([scene["scene"], number(scene["triangles"], 0),
                         label(structure["backend"]),
                         number(structure["build_ms"], 1),
                         number(None if size is None else size * 1e-6, 2)])
    return report_file.table(["scene", "triangles", "backend", "build, ms", "MB"], rows)


def overview(scenes):
    """Whole frames, all scenes and algorithms."""
    names = [b["backend"] for b in scenes[0]["methods"][0]["backends"]]
    headings = ["scene, algorithm"]
    for i, name in enumerate(names):
        headings += [f"{label(name)}, ms"] + (["ratio"] if i else [])
    headings += ["Mrays", "host reads, MB", "host writes, MB"]
    rows = []
    for scene in scenes:
        for method in scene["methods"]:
            row = [f'{scene["scene"]}, {method["method"]}']
            for i, backend in enumerate(method["backends"]):
                row.append(number(backend["ms"], 1))
                if i:
                    row.append(number(backend["ratio"], 2))
            first = method["backends"][0]
            row += [number(first[key] * 1e-6, 2)
                    for key in ("rays", "host_read_bytes", "host_written_bytes")]
            rows.append(row)
    return report_file.table(headings, rows)


def find(entries, wanted, keys):
    """The entry that says the same under all keys, or None."""
    for entry in entries:
        if all(entry[key] == wanted[key] for key in keys):
            return entry
    return None


def all_entries(method, part, keys):
    """The entries of every backend, each once, in the order of the first that has it."""
    found = []
    for backend in method["backends"]:
        found += [e for e in backend[part] if find(found, e, keys) is None]
    return found


def times(method, part, wanted, keys):
    cells = []
    for i, backend in enumerate(method["backends"]):
        entry = find(backend[part], wanted, keys)
        cells.append(number(entry and entry["ms"], 3))
        if i:
            cells.append(number(entry and entry["ratio"], 2))
    return cells


def time_headings(method):
    headings = []
    for i, backend in enumerate(method["backends"]):
        headings += [f'{label(backend["backend"])}, ms'] + (["ratio"] if i else [])
    return headings


def stage_table(method):
    keys = ("name", "component")
    rows = []
    for stage in all_entries(method, "stages", keys):
        name = stage["name"] + (f', {stage["component"]}' if stage["component"] else "")
        rows.append([name, *times(method, "stages", stage, keys),
                     number(stage["rays"] * 1e-6, 3)])
    return report_file.table(["stage", *time_headings(method), "Mrays"], rows)


def on_all(method, kernel, text):
    """What `text` makes of a kernel's entry of each backend, and of the backend's name."""
    found = [(find(backend["kernels"], kernel, ("kernel",)), backend["backend"])
             for backend in method["backends"]]
    return " / ".join("–" if entry is None else text(entry, name) for entry, name in found)


def shares(method, kernel):
    return on_all(method, kernel, lambda entry, _: f'{100.0 * entry["share"]:.1f}')


def traffic(method, kernel, speeds):
    """Bound bytes by time, over what a copy on the device moves in that time."""
    def percent(entry, name):
        speed = entry["ms"] * 1e-3 * speeds[name]
        return f'{100.0 * entry["bound_bytes"] / speed:.1f}' if speed > 0.0 else "–"
    return on_all(method, kernel, percent)


def launches(method, kernel):
    found = [find(backend["kernels"], kernel, ("kernel",)) for backend in method["backends"]]
    counts = [None if entry is None else entry["launches"] for entry in found]
    if len(set(counts)) == 1:
        return str(counts[0])
    return " / ".join("–" if count is None else str(count) for count in counts)


def kernel_table(method, speeds):
    rows = []
    for kernel in all_entries(method, "kernels", ("kernel",)):
        rays = kernel["rays"]
        rate = rays * 1e-3 / kernel["ms"] if rays and kernel["ms"] > 0.0 else None
        rows.append([f'`{kernel["kernel"]}`', *times(method, "kernels", kernel, ("kernel",)),
                     shares(method, kernel), launches(method, kernel),
                     number(kernel["items"], 0),
                     number(rays and rays * 1e-6, 3), number(rate, 2),
                     number(kernel["bound_bytes"] * 1e-6, 2),
                     traffic(method, kernel, speeds)])
    return report_file.table(["kernel", *time_headings(method), "share, %", "launches", "items",
                              "Mrays", "Mrays/s", "bound, MB", "of copies, %"], rows)


def answer(summary, base):
    """What portability costs: the geometric means of whole frames."""
    times = " and ".join(f'{label(name)} {number(means["frame"], 2)}'
                         for name, means in summary.items())
    return (f"Over all scenes and algorithms a frame takes, in times that of {base}: {times} "
            "(geometric means of the ratios of whole frames).")


def build_part(devices):
    """Programs of each kernel, by backend that builds any."""
    parts = []
    for device in devices:
        kernels = {}
        for build in device["builds"]:
            kernels.setdefault(build["kernel"], []).append(build)
        if kernels:
            rows = []
            for name, builds in sorted(kernels.items()):
                row = [f"`{name}`"]
                for from_cache in (False, True):
                    ms = [b["ms"] for b in builds if b["from_cache"] == from_cache]
                    row += [len(ms), number(sum(ms), 1) if ms else ""]
                rows.append(row)
            parts += [f'{label(device["label"])}:', "",
                      report_file.table(["kernel", "compiled", "ms", "loaded from the cache",
                                         "ms"], rows)]
        else:
            parts += [f'{label(device["label"])}: kernels are compiled into Weft.', ""]
    return "\n".join(parts)


def scene_part(scene, speeds):
    parts = [f'## {scene["scene"]}', ""]
    for method in scene["methods"]:
        parts += [f'### {scene["scene"]}, {method["method"]}', "", stage_table(method),
                  kernel_table(method, speeds)]
    return "\n".join(parts)


def path_note(report):
    if not any(m["method"] == "path" for scene in report["scenes"] for m in scene["methods"]):
        return ""
    return f'`path` makes {report["path_samples"]} samples per pixel. '


def make(report, output):
    """Writes the page."""
    scenes = report["scenes"]
    speeds = {d["label"]: d["copy_bytes_per_second"] for d in report["devices"]}
    base = label(scenes[0]["methods"][0]["backends"][0]["backend"])
    text = "\n".join([
        "# Backends, kernel by kernel", "",
        "Made by `bench/report/backends_report.py` from what `./weft bench kernels` measured; "
        "[benchmarks](../benchmarks.md#kernels) says how, and what each column means.", "",
        f'{report_file.about(report)} Images of {report["size"]} × {report["size"]} pixels, '
        f'medians of {report["repetitions"]} frames; the backends take turns, frame by frame. '
        f"{path_note(report)}A ratio is the time over that of "
        f"{base}: below 1 is faster. It is the median of the ratios within each round, which may "
        f"differ from the quotient of the medians beside it. Several numbers in one cell are those "
        f"of the backends, in the order of the table below.", "", answer(report["summary"], base),
        "", device_table(report["devices"]),
        "## Whole frames", "", overview(scenes), "## Acceleration structures", "",
        "The backends that trace Weft's own BVH take turns: what the first has built, the next "
        "loads from the cache where that saves time.", "",
        structure_table(scenes), "## Building kernels", "", build_part(report["devices"]),
        *(scene_part(scene, speeds) for scene in scenes)])
    report_file.write_whole(output, text.rstrip("\n") + "\n")
    return [output]


if __name__ == "__main__":
    sys.exit(report_file.run("backends_report.py", "kernels", make))
