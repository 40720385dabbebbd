# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""What every renderer's program does: sets up, warms up, and renders for each budget.

    NAME_peer.py --probe --variant VARIANT
    NAME_peer.py --variant VARIANT --scene FOLDER --threads N --budgets SECONDS... -o FOLDER
                 [--check SECONDS] [--reference SECONDS]

Writes one JSON line for the renderer and one for each image; for a budget that no image has filled,
a line with `unfilled`; where something fails, one with `problem`, and where the renderer has no like
of something in the scene, with `not_expressible`. The caller ends a program that takes too long and
keeps the lines it has.
"""

import argparse
import json
import os
import pathlib
import time

PROBE_SECONDS = 0.1  # a first image this long tells the speed
MOST_SAMPLES = 1 << 20
TRIES = 8  # at a number of samples that fills a budget
LEAST_SHARE, MOST_SHARE = 0.85, 1.05  # of a budget: what an image may take that fills it
AIM = 0.97  # a little less than fits: whoever is late by chance must not look better for it


class Renderer:
    """A renderer with a scene, ready to render. Subclasses say how."""

    name = ""  # as tables show it
    denoised = False
    version = ""
    notes = ()

    def render(self, samples, seed):
        """An image, height by width by 3, linear, top row first, and the seconds it took, without
        what is only done once for that number of samples."""
        raise NotImplementedError

    def close(self):
        """Removes what the renderer has left."""

    # Of renderers that go on until they are stopped instead: `render_for(seconds)` returns the
    # same and the samples per pixel.
    render_for = None


class Costs:
    """Seconds by number of samples, as a line through what was measured last."""

    def __init__(self):
        self.measured = {}

    def add(self, samples, seconds):
        self.measured[samples] = seconds

    def line(self, budget):
        """Seconds that cost the same for any number of samples, and those of each, about there."""
        nearest = sorted(self.measured, key=lambda n: abs(self.measured[n] - budget))[:2]
        first = nearest[0]
        if len(nearest) > 1:
            other = nearest[1]
            each = (self.measured[other] - self.measured[first]) / (other - first)
            fixed = self.measured[first] - each * first
            if each > 0.0 and fixed >= 0.0:
                return fixed, each
        return 0.0, self.measured[first] / first

    def samples_for(self, budget):
        fixed, each = self.line(budget)
        return max(1, min(MOST_SAMPLES, int((AIM * budget - fixed) / max(each, 1e-9))))

    def more_fit(self, samples, seconds, budget):
        """Whether an image with another sample would take no longer than the budget."""
        _, each = self.line(budget)
        return samples < MOST_SAMPLES and seconds + each <= budget


class Filled:
    """An image, and whether it used its budget: took about as long, or has all samples that fit,
    which is a single one where none does."""

    def __init__(self, image, samples, seconds, filled):
        self.image, self.samples, self.seconds, self.filled = image, samples, seconds, filled

    def __iter__(self):
        return iter((self.image, self.samples, self.seconds))

    def unfilled(self, budget):
        return (f"left out at {budget:g} s: of {TRIES} images none took between "
                f"{LEAST_SHARE * budget:.2f} and {MOST_SHARE * budget:.2f} s; the nearest took "
                f"{self.seconds:.2f} s for {self.samples:g} samples")


def render(renderer, costs, samples, seed):
    image, seconds = renderer.render(samples, seed)
    costs.add(samples, seconds)
    return image, seconds


def warm_up(renderer, costs):
    """Renders untimed images until the speed is known."""
    renderer.render(1, 1)
    samples = 1
    while True:
        _, seconds = render(renderer, costs, samples, 1)
        slow = seconds >= PROBE_SECONDS
        # Two numbers of samples tell what costs the same for any number.
        if (slow and len(costs.measured) > 1) or 4 * samples > MOST_SAMPLES:
            return
        samples *= 2 if slow else 4


def within(renderer, costs, budget, seed):
    """Images of more or fewer samples until one fills the budget; else the nearest."""
    best = None
    samples = costs.samples_for(budget)
    for attempt in range(TRIES):
        image, seconds = render(renderer, costs, samples, seed + attempt)
        late = seconds > MOST_SHARE * budget
        filled = samples == 1 if late else (seconds >= LEAST_SHARE * budget
                                            or not costs.more_fit(samples, seconds, budget))
        found = Filled(image, samples, seconds, filled)
        if filled:
            return found
        if best is None or abs(seconds - budget) < abs(best.seconds - budget):
            best = found
        # What was measured last counts alone where the line through the measurements leads nowhere:
        # a single image may have been disturbed.
        next_samples = costs.samples_for(budget)
        if (next_samples >= samples) if late else (next_samples <= samples):
            scaled = int(samples * AIM * budget / max(seconds, 1e-9))
            next_samples = min(scaled, samples - 1) if late else max(scaled, samples + 1)
        samples = max(1, min(MOST_SAMPLES, next_samples))
    return best


def once(renderer, costs, budget, seed):
    """An image of about as many samples as the budget holds."""
    samples = costs.samples_for(budget)
    image, seconds = render(renderer, costs, samples, seed)
    return Filled(image, samples, seconds, True)


def answer(answers, **fields):
    answers.write(json.dumps(fields) + "\n")
    answers.flush()


def serve(renderer, args, answers):
    from exr_file import write_exr
    costs = Costs()
    if renderer.render_for:
        renderer.render_for(2.0 * PROBE_SECONDS)
    else:
        warm_up(renderer, costs)
    answer(answers, version=renderer.version, notes=list(renderer.notes))
    # That of --check need not fill its time: it shows what the mean is, and nothing else.
    parts = [(budget, within, {}) for budget in args.budgets]
    parts += [(args.check, once, {"check": True})] if args.check else []
    # Its random numbers are others than those of all images before it.
    parts += [(args.reference, once, {"reference": True})] if args.reference else []
    for number, (budget, fit, fields) in enumerate(parts):
        if renderer.render_for:
            image, seconds, samples = renderer.render_for(budget)
        else:
            found = fit(renderer, costs, budget, 100 * (number + 1))
            image, samples, seconds = found
            if not found.filled:
                answer(answers, unfilled=f"{renderer.name}: {found.unfilled(budget)}")
                fields = {"check": True}  # it still shows what the mean is
        if args.mirror:
            image = image[:, ::-1]
        stem = f"{renderer.name}-{'reference' if 'reference' in fields else f'{budget:g}'}"
        file = f"{stem}.exr".lower().replace(", ", "-").replace(" ", "-")
        write_exr(pathlib.Path(args.output) / file, image)
        answer(answers, name=renderer.name, budget_s=budget, seconds=seconds, samples=samples,
               denoised=renderer.denoised, picture=file, **fields)


def parse():
    parser = argparse.ArgumentParser()
    parser.add_argument("--probe", action="store_true")
    parser.add_argument("--variant", default="")
    parser.add_argument("--scene")
    parser.add_argument("--threads", type=int, default=0)
    parser.add_argument("--budgets", type=float, nargs="+", default=[])
    parser.add_argument("--check", type=float, default=0.0)
    parser.add_argument("--reference", type=float, default=0.0)
    parser.add_argument("-o", "--output")
    args = parser.parse_args()
    args.threads = args.threads or len(os.sched_getaffinity(0))
    return args


def main(probe, make_renderer):
    """Runs a renderer's program: `probe(variant)` returns its version or raises, and
    `make_renderer(variant, scene, threads)` a Renderer."""
    # Whatever libraries print goes elsewhere: standard output belongs to the other program.
    answers = os.fdopen(os.dup(1), "w", buffering=1)
    os.dup2(2, 1)
    args = parse()
    try:
        if args.probe:
            answer(answers, version=probe(args.variant))
            return
        from exported_scene import ExportedScene
        from expressible import NotExpressible
        scene = ExportedScene(args.scene)
        args.mirror = scene.camera["mirror_x"]
        try:
            renderer = make_renderer(args.variant, scene, args.threads)
        except NotExpressible as reason:
            answer(answers, not_expressible=str(reason))
            return
        try:
            serve(renderer, args, answers)
        finally:
            renderer.close()
    except Exception as error:  # whatever it is, the others go on without this one
        text = " ".join(str(error).split())[:300]
        answer(answers, problem=f"{type(error).__name__}: {text}")
    finally:
        answers.flush()
        # Some libraries crash where their threads end after them.
        os._exit(0)


def stopwatch():
    """Returns a function that tells the seconds since this call."""
    begin = time.perf_counter()
    return lambda: time.perf_counter() - begin
