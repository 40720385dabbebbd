#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# The page that bench/report/dynamic_report.py makes of a small made-up report holds its figures,
# plots and images; what is no report is refused. Exit code 0: passed, 1: failed, 77: skipped, there
# is no Python 3 with Matplotlib.
set -eu

# shellcheck source=tests/testing/report_program.sh
. "$(dirname -- "$0")/../testing/report_program.sh"
program=$root/bench/report/dynamic_report.py
need_matplotlib

# A sequence of two methods, one of which has no error in one frame and no rays in another, and a
# sequence without any figure over frames.
cat >"$work/make.py" <<'END'
import json
import pathlib


def frame(ms, rays, relmse):
    return {"ms": ms, "rays": rays, "errors": {"converged": {"relmse": relmse}},
            "records": {"kept": 20000.0 * ms}}


def method(name, frames, pictures=()):
    return {"method": name, "light": "indirect", "ms": 12.5, "rays": 2500.0, "errors": {},
            "flicker": {}, "rays_by_class": {"VPL gather": 1500.0}, "frames": frames,
            "pictures": list(pictures)}


def sequence(*methods):
    return {"scene": "a <room>", "happening": "box", "triangles": 36, "moving_triangles": 12,
            "methods": list(methods)}


def write(folder, report):
    pathlib.Path(folder).mkdir()
    pathlib.Path(folder, "dynamic.json").write_text(report)


whole = {"benchmark": "dynamic", "mode": "frames", "size": 512,
         "machine": {"hardware_threads": 2}, "device": {"backend": "native", "name": "n"},
         "versions": {"weft": "1"}, "summary": {"tic_vs_igi_ms": 0.5},
         "sequences": [
             sequence(method("igi", [frame(1.0, 0, 0.5), frame(10.0, 9, None), frame(100.0, 9, 1)]),
                      method("own & new", [frame(5.0, 9, 0.25)] * 3,
                             [{"frame": 0, "file": "dynamic/pictures/0.png"}])),
             sequence(method("tic", []))]}
write("whole", json.dumps(whole))
pathlib.Path("whole/pictures").mkdir()
pathlib.Path("whole/pictures/0.png").write_bytes(b"an image")
write("no-image", json.dumps(whole))
write("other", json.dumps({**whole, "benchmark": "scaling"}))
del whole["sequences"][0]["methods"][0]["frames"]
write("lacking", json.dumps(whole))
write("broken", "{")
pathlib.Path("empty").mkdir()
END
(cd "$work" && python3 -B make.py)

refuse_without_matplotlib "$program" "$work/whole"
"$python" -B "$program" "$work/whole" >"$work/log"
[ "$(cat "$work/log")" = "$work/whole/dynamic.html" ] || fail "not one file: $(cat "$work/log")"
"$python" -B "$program" "$work/whole" --output "$work/again.html" >"$work/log"
cmp -s "$work/whole/dynamic.html" "$work/again.html" || fail "made again, the page differs"

# The plots, of figures that the report has, are one SVG in the page, which names all methods. The
# times 1, 10 and 100 are evenly apart on a logarithmic axis; a figure that is missing, or that such
# an axis cannot show, leaves its dot out.
cat >"$work/check.py" <<'END'
import base64
import html.parser
import pathlib
import sys
import xml.etree.ElementTree

SVG = "{http://www.w3.org/2000/svg}"


class Page(html.parser.HTMLParser):
    """Words and images, by the text that stands for these."""

    def __init__(self, text):
        super().__init__()
        self.words, self.images = [], {}
        self.feed(text)

    def handle_data(self, data):
        self.words.append(data)

    def handle_starttag(self, tag, attributes):
        if tag == "img":
            attributes = dict(attributes)
            kind, data = attributes["src"].split(",")
            self.images[attributes["alt"]] = kind, base64.b64decode(data, validate=True)


def dots(name):
    found = [group for group in plot.iter(f"{SVG}g") if group.get("id") == name]
    assert len(found) == 1, name
    return [(float(dot.get("x")), float(dot.get("y"))) for dot in found[0].iter(f"{SVG}use")]


page = Page(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
assert {"a <room>: box", "tic vs igi ms", "12.5", "VPL gather"} < set(page.words), page.words
assert page.images["frame 0"] == ("data:image/png;base64", b"an image")
assert len(page.images) == 2, page.images
kind, data = page.images["a <room>: box, over frames"]
assert kind == "data:image/svg+xml;base64", kind
plot = xml.etree.ElementTree.fromstring(data)
texts = ["".join(text.itertext()).strip() for text in plot.iter(f"{SVG}text")]
for name, count in (("igi", 1), ("own & new", 1), ("frame", 4), ("milliseconds per frame", 1),
                    ("rays per frame, without primary rays", 1), ("records kept", 1),
                    ("relMSE against converged frames", 1), ("records made", 0), ("tic", 0)):
    assert texts.count(name) == count, (name, texts)
assert "2\u2009M" in texts, texts

times = dots("milliseconds-per-frame-igi")
assert len(times) == 3, times
right, up = times[1][0] - times[0][0], times[0][1] - times[1][1]
assert right > 50.0 and abs(times[2][0] - times[1][0] - right) < 0.01, times
assert up > 20.0 and abs(times[1][1] - times[2][1] - up) < 0.01, times
assert len(dots("rays-per-frame-without-primary-rays-igi")) == 2
assert len(dots("relMSE-against-converged-frames-igi")) == 2
assert len(dots("relMSE-against-converged-frames-own-new")) == 3
END
python3 -B "$work/check.py" "$work/whole/dynamic.html" || fail "the page is wrong"

refuse 2 'is no JSON' "$work/broken"
refuse 2 'is no report of bench dynamic' "$work/other"
refuse 2 "lacks 'frames'" "$work/lacking"
refuse 2 'expected what bench dynamic --report writes' "$work/empty"
refuse 2 'expected an image of the report' "$work/no-image"
refuse 5 'No such file' "$work/whole" --output "$work/gone/page.html"
refuse 1 'required' --output "$work/page.html"
[ ! -e "$work/lacking/dynamic.html" ] || fail "a page was written of a report that is refused"
echo "the page shows the figures, plots and images of a report, and what is none is refused"
