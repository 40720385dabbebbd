# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Tables in Markdown."""


def number(value, decimals):
    """A figure, or nothing where there is none."""
    return "" if value is None else f"{value:.{decimals}f}"


def cell(value):
    return str(value).replace("|", "\\|").replace("\n", " ")


def table(headings, rows, others="---:"):
    """A table whose first column is text; `others`: the rule below the others, by default that of
    figures."""
    def line(cells):
        return "| " + " | ".join(map(cell, cells)) + " |"
    rule = "|---|" + f"{others}|" * (len(headings) - 1)
    return "\n".join([line(headings), rule, *map(line, rows)])
