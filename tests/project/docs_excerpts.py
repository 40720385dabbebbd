#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the excerpts of sources that pages of docs/ show, so that they are always what the sources
say:

    python3 -B tests/project/docs_excerpts.py [--check] [--root FOLDER] [--build FOLDER]

The block of code below a comment

    <!-- excerpt of FILE: START -->
    <!-- excerpt of FILE: START ... END -->
    <!-- excerpt of FILE -->

is the file from the only line that holds START, to the next line that holds END where one is named,
and then as far as brackets are open and lines end with a backslash; or the whole file. Comments on
lines of their own and empty lines are left out. A file that begins with build/ lies in the build
folder. A page with such comments shows no other code in C or C++.

--check writes nothing. Exit code 0: all are right (or were written), 1: some are not, or a line
cannot be found.
"""

import argparse
import pathlib
import re
import sys

MARK = re.compile(r"^<!-- excerpt of (\S+?)(?:: (.+?)(?: \.\.\. (.+?))?)? -->$")
OPEN, CLOSE = "([{", ")]}"


class ExcerptError(Exception):
    """A comment that names nothing, or more than one place."""


def depth_of(line):
    return sum(line.count(c) for c in OPEN) - sum(line.count(c) for c in CLOSE)


def is_comment(line):
    return line.lstrip().startswith("//")


def excerpt(lines, start, end):
    """The lines from `start` on, as the comment at the top tells."""
    places = [i for i, line in enumerate(lines) if start in line and not is_comment(line)]
    if len(places) != 1:
        raise ExcerptError(f"{len(places)} lines hold '{start}', expected one")
    first = last = places[0]
    if end:
        while end not in lines[last] or last == first:
            last += 1
            if last == len(lines):
                raise ExcerptError(f"no line below '{start}' holds '{end}'")
    depth = sum(depth_of(line) for line in lines[first : last + 1] if not is_comment(line))
    while depth > 0 or lines[last].endswith("\\"):
        last += 1
        if last == len(lines):
            raise ExcerptError(f"the brackets after '{start}' are never closed")
        depth += 0 if is_comment(lines[last]) else depth_of(lines[last])
    return [line for line in lines[first : last + 1] if line and not is_comment(line)]


def with_excerpts(page, root, build):
    """The lines of a page with all excerpts anew, and how many there are."""
    lines = page.read_text(encoding="utf-8").split("\n")
    marked = any(MARK.match(line) for line in lines)
    result, count, i = [], 0, 0
    while i < len(lines):
        result.append(lines[i])
        mark = MARK.match(lines[i])
        i += 1
        if not mark and "<!-- excerpt" in lines[i - 1]:
            raise ExcerptError(f"{page.relative_to(root)}:{i}: is no mark of an excerpt")
        if not mark and marked and lines[i - 1] in ("```c", "```cpp"):
            raise ExcerptError(f"{page.relative_to(root)}:{i}: shows code that is no excerpt")
        if not mark:
            continue
        place = f"{page.relative_to(root)}:{i}"
        name, start, end = mark.groups()
        folder = build if name.startswith("build/") else root
        file = folder / name.removeprefix("build/") if folder else None
        if not lines[i].startswith("```") or "```" not in lines[i + 1 :]:
            raise ExcerptError(f"{place}: no block of code follows")
        closing = lines.index("```", i + 1)
        try:
            if file is None:
                shown = lines[i + 1 : closing]  # nothing is known of the build
            else:
                text = file.read_text(encoding="utf-8").rstrip("\n").split("\n")
                shown = excerpt(text, start, end) if start else text
        except (ExcerptError, OSError) as error:
            raise ExcerptError(f"{place}: {name}: {error}") from error
        result += [lines[i], *shown, "```"]
        i = closing + 1
        count += 1
    return "\n".join(result), count


def main():
    parser = argparse.ArgumentParser(description="Writes the excerpts that pages of docs/ show.")
    parser.add_argument("--check", action="store_true", help="only say which are not as the sources")
    parser.add_argument("--root", type=pathlib.Path,
                        default=pathlib.Path(__file__).resolve().parents[2])
    parser.add_argument("--build", type=pathlib.Path, help="build folder, for drawings")
    options = parser.parse_args()
    total, wrong = 0, False
    for page in sorted(options.root.glob("docs/*.md")):
        try:
            text, count = with_excerpts(page, options.root, options.build)
        except ExcerptError as error:
            sys.exit(f"{error}")
        total += count
        if text == page.read_text(encoding="utf-8"):
            continue
        wrong = True
        name = page.relative_to(options.root)
        if options.check:
            build = f" --build {options.build}" if options.build else ""
            print(f"{name}: an excerpt is not what the source says; run {sys.argv[0]}{build}",
                  file=sys.stderr)
        else:
            beside = page.with_suffix(".md.new")
            beside.write_text(text, encoding="utf-8")
            beside.rename(page)
            print(f"{name}: written")
    print(f"{total} excerpts")
    return 1 if wrong and options.check else 0


if __name__ == "__main__":
    sys.exit(main())
