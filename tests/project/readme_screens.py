# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Whether README.md can be read screen by screen: python3 readme_screens.py FILE

What stands before the first section fits into one screen, and says there with an image, two
commands and a list of limits what the program is; every later section fits into one screen. Lines
are estimated as a browser shows them: 105 characters of text, 24 pixels high, 45 on a screen.
Prints one line for each fault; exit code 0: none, 1: some.
"""

import math
import pathlib
import re
import struct
import sys

SCREEN = 45.0
WIDTH = 105
PIXELS = 24.0
LINE_IMAGE = 840  # pixels, the width of the text


def image_size(path):
    """Width and height of a PNG file, by its header."""
    return struct.unpack(">II", path.read_bytes()[16:24])


def shown(text):
    """Text as it is shown: without the targets of links and without marks."""
    return re.sub(r"[`*]|</?sub>", "", re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text))


def table_lines(rows, folder):
    """Height of a table, each of whose columns has a width by its longest cell."""
    cells = [[cell.strip() for cell in row.strip("|").split("|")] for row in rows]
    images = [re.search(r"!\[[^\]]*\]\(([^)]*)\)", cell) for row in cells for cell in row]
    if any(images):
        share = LINE_IMAGE / len(cells[0])
        sizes = [image_size(folder / image.group(1)) for image in images if image]
        return max(height * min(1.0, share / width) for width, height in sizes) / PIXELS + 1.5
    longest = [max(len(shown(row[i])) for row in cells) for i in range(len(cells[0]))]
    scale = min(1.0, WIDTH / sum(longest))
    lines = 0.0
    for row in cells:
        lines += 0.6 + max(math.ceil(len(shown(cell)) / max(1.0, scale * most))
                           for cell, most in zip(row, longest))
    return lines


def block_lines(block, folder):
    """Height of a block of lines without an empty one between them, in lines of text."""
    first = block[0]
    if first.startswith("#"):
        return 2.5 + (block_lines(block[1:], folder) if len(block) > 1 else 0.0)
    if first.startswith("<!--"):
        return block_lines(block[1:], folder) if len(block) > 1 else 0.0
    if first.startswith("```"):
        return 0.85 * (len(block) - 2) + 2.0
    if first.startswith("|"):
        return table_lines(block, folder) + 0.7
    if image := re.fullmatch(r"!\[[^\]]*\]\(([^)]*)\)", first):
        width, height = image_size(folder / image.group(1))
        return height * min(1.0, LINE_IMAGE / width) / PIXELS + 0.7
    return sum(math.ceil(len(shown(line)) / WIDTH) for line in block) + 0.7


def blocks_of(text):
    """The blocks of a page; the lines of a code block stay together."""
    blocks, block, code = [], [], False
    for line in [*text.split("\n"), ""]:
        if line.startswith("```"):
            code = not code
        if line or code:
            block.append(line)
        elif block:
            blocks.append(block)
            block = []
    return blocks


def faults(path):
    folder = path.parent
    sections = re.split(r"^(?=## )", path.read_text(encoding="utf-8"), flags=re.MULTILINE)
    for section in sections:
        name = section.split("\n")[0]
        lines = sum(block_lines(block, folder) for block in blocks_of(section))
        if lines > SCREEN:
            yield f"{name}: about {lines:.0f} lines, expected at most {SCREEN:.0f}"
    for pattern, number, what in (
            (r"^!\[", 1, "an image"),
            (r"^\./weft ", 2, "two commands"),
            (r"cannot", 1, "what the program cannot do")):
        if len(re.findall(pattern, sections[0], flags=re.MULTILINE)) < number:
            yield f"the first screen lacks {what}"


if __name__ == "__main__":
    FOUND = list(faults(pathlib.Path(sys.argv[1])))
    print("\n".join(FOUND), end="\n" if FOUND else "")
    sys.exit(1 if FOUND else 0)
