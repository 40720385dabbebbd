# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""What programs that make pages of reports share: reading, tables, writing, exit codes."""

import argparse
import json
import os
import pathlib
import sys

import markdown_table

EXIT_INPUT, EXIT_OUTPUT = 2, 5  # as Weft's other programs say
EXIT_MISSING = 69  # as ./weft says where a package is missing


class BadInput(Exception):
    """A file is not the report that a page is made of."""


class Parser(argparse.ArgumentParser):
    """Fails as Weft's other programs do."""

    def error(self, message):
        self.exit(1, f"{self.prog}: {message}\n")


def read_report(file, benchmark, key=None, option="--json"):
    """The JSON that `./weft bench BENCHMARK --json`, or another option, wrote, in which it is
    called `key`, if given."""
    try:
        report = json.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise BadInput(f"{file}: {error.strerror}, expected what bench {benchmark} "
                       f"{option} writes") from error
    except ValueError as error:
        raise BadInput(f"{file}: is no JSON ({error})") from error
    if not isinstance(report, dict) or report.get("benchmark") != (key or benchmark):
        raise BadInput(f"{file}: is no report of bench {benchmark}")
    return report


def write_whole(file, text):
    """Writes beside the file, then takes its place."""
    beside = file.with_name(file.name + ".part")
    beside.write_text(text, encoding="utf-8")
    os.replace(beside, file)


def table(headings, rows):
    """A table as a paragraph of its own."""
    return markdown_table.table(headings, rows) + "\n"


def about(report):
    """Machine and versions in a sentence."""
    machine, versions = report["machine"], report["versions"]
    threads = machine["threads"] or machine["hardware_threads"]
    return (f'Measured on {machine["processor"]} with {threads} of '
            f'{machine["hardware_threads"]} hardware threads and '
            f'{machine["memory"] / 2 ** 30:.0f} GiB of memory; Weft {versions["weft"]}, '
            f'compiler {versions["compiler"]}, Embree {versions["embree"]}.')


def run(name, benchmark, make, key=None):
    """A whole program: `make(report, output)` writes the page and returns the files it wrote. `key`
    is what reports call the benchmark, if not by its name."""
    parser = Parser(prog=name, description=f"Makes a page of what bench {benchmark} --json wrote.")
    parser.add_argument("report", type=pathlib.Path, help="JSON file")
    parser.add_argument("--output", type=pathlib.Path, help="the page; else beside the report")
    args = parser.parse_args()
    output = args.output or args.report.with_suffix(".md")
    try:
        files = make(read_report(args.report, benchmark, key), output)
    except BadInput as error:
        print(f"{name}: {error}", file=sys.stderr)
        return EXIT_INPUT
    except (KeyError, IndexError, TypeError, AttributeError, ValueError) as error:
        print(f"{name}: {args.report}: lacks {error} ({type(error).__name__}), expected what this "
              f"version of bench {benchmark} writes", file=sys.stderr)
        return EXIT_INPUT
    except OSError as error:
        print(f"{name}: {error.filename}: {error.strerror}", file=sys.stderr)
        return EXIT_OUTPUT
    print("\n".join(str(file) for file in files))
    return 0
