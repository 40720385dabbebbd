# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""What a frame's time and errors consist of, and what keeps them from being smaller."""

import markdown_table

# Means to reach in the end: times as fast as amax and as igi, percent of the pixels.
GOAL_FULL, GOAL_IGI = 4.0, 6.0
GOAL_P75, GOAL_P95, GOAL_DISPLAY = 0.3, 0.15, 3.0
GATHERING = "gathering"
# Stages by the part of a frame that they belong to.
GROUPS = {
    GATHERING: ("VPL gather", "area lights", "distant light", "VPLs in media",
                "area lights in media", "distant light in media"),
    "first hits": ("primary rays", "view rays through media"),
    "light": ("VPL walk", "light samples"),
    "deciding": ("shadow probes", "shadow edges", "scheduling", "heuristic", "tile geometry"),
    "reconstruction": ("receivers", "reconstruction", "composition"),
    "edges": ("edge detection", "edge samples"),
}
BETWEEN = "between"
GROUP_OF = {stage: group for group, stages in GROUPS.items() for stage in stages}


def parts_of(method):
    """Milliseconds of a method's full frame by part; what no stage accounts for is between them.
    A stage of no known part is a part of its own."""
    parts = dict.fromkeys(GROUPS, 0.0)
    for stage, ms in method["stages_ms"].items():
        name = stage.rsplit(": ", 1)[-1]
        group = GROUP_OF.get(name, name)
        parts[group] = parts.get(group, 0.0) + ms
    parts[BETWEEN] = max(0.0, method["ms"]["FULL"] - sum(parts.values()))
    return parts


def bound(ais, amax):
    """How many times as fast as amax ais would be if gathering took no time; None where nothing
    else takes any."""
    rest = ais["ms"]["FULL"] - parts_of(ais)[GATHERING]
    return amax["ms"]["FULL"] / rest if rest > 0.0 else None


def time_limit(speedup, most, parts, sampled):
    """In words, what keeps a scene from the goal."""
    if speedup is not None and speedup >= GOAL_FULL:
        return "goal reached"
    total = sum(parts.values())
    fixed = {name: ms for name, ms in parts.items() if name != GATHERING}
    largest = max(fixed, key=fixed.get)
    if total <= 0.0:
        return ""
    if most is not None and most < GOAL_FULL:
        return f"{largest}, {100.0 * fixed[largest] / total:.0f} %"
    words = f"gathering, {100.0 * parts[GATHERING] / total:.0f} %"
    if sampled is not None:
        words += f": {sampled:.0f} % of the pixels are sampled for indirect light"
    return words


def time_row(scene):
    """None where a scene has no full frames of ais."""
    ais, amax = scene["methods"].get("ais"), scene["methods"].get("amax")
    if ais is None or ais["ms"]["FULL"] is None:
        return None
    parts = parts_of(ais)
    total = sum(parts.values())
    speedup = scene["rows"]["speedup"]
    most = bound(ais, amax) if amax and amax["ms"]["FULL"] else None
    shown = (*GROUPS, BETWEEN)
    other = sum(ms for name, ms in parts.items() if name not in shown)
    sampled = ais["sampled_percent"].get("indirect")
    shares = [100.0 * parts[name] / total if total > 0.0 else None for name in shown]
    shares[-1] = 100.0 * (parts[BETWEEN] + other) / total if total > 0.0 else None
    return [scene["scene"], markdown_table.number(ais["ms"]["FULL"], 1),
            *(markdown_table.number(share, 0) for share in shares),
            markdown_table.number(speedup["FULL"], 2), markdown_table.number(most, 1),
            markdown_table.number(speedup["FULL_A_vs_IGI"], 2),
            time_limit(speedup["FULL"], most, parts, sampled)]


def time_table(scenes):
    rows = [row for row in map(time_row, scenes) if row]
    return markdown_table.table(
        ["scene", "A, ms", *GROUPS, BETWEEN, f"FULL (of {GOAL_FULL:g})", "bound",
         f"over IGI (of {GOAL_IGI:g})", "limited by"], rows)


def error_limit(own, dense, floor, goal):
    if own <= goal:
        return "goal reached"
    if floor is not None and own <= floor:
        return "noise of the reference, whose halves differ by as much"
    if dense is None:
        return ""
    if dense > goal:
        return f"what A-MAX has as well, {100.0 * min(dense, own) / own:.0f} % of it"
    return "samples left out"


def error_row(scene):
    row = scene["rows"].get("hdrvdp_percent_of_pixels", {})
    own, dense = row.get("A_75"), row.get("AMAX_75")
    if own is None:
        return None
    return [scene["scene"], markdown_table.number(own, 2), markdown_table.number(dense, 2),
            markdown_table.number(None if dense is None else own - dense, 2),
            markdown_table.number(own / GOAL_P75, 1),
            error_limit(own, dense, row.get("floor_75"), GOAL_P75)]


def error_table(scenes):
    rows = [row for row in map(error_row, scenes) if row]
    return markdown_table.table(["scene", "A", "A-MAX", "A more", "times the goal",
                                 "limited by"], rows)


def high_table(scenes):
    """Errors and times of ais at a higher quality, and their means."""
    rows = []
    sums = [[] for _ in range(5)]
    for scene in scenes:
        tables = scene["rows"]
        figures = [tables.get("hdrvdp_display", {}).get("A_75"),
                   tables.get("hdrvdp_display", {}).get("A_95"),
                   tables.get("hdrvdp_percent_of_pixels", {}).get("A_75"),
                   tables.get("hdrvdp_percent_of_pixels", {}).get("A_95"),
                   scene["methods"].get("ais", {}).get("ms", {}).get("FULL")]
        for values, figure in zip(sums, figures):
            if figure is not None:
                values.append(figure)
        rows.append([scene["scene"], *(markdown_table.number(figure, 2) for figure in figures)])
    rows.append(["**mean**", *(markdown_table.number(sum(values) / len(values), 2) if values
                               else "" for values in sums)])
    return markdown_table.table(["scene", f"display 75 (of {GOAL_DISPLAY:g})", "display 95",
                                 "published 75", "published 95", "A, ms"], rows)
