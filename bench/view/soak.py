#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Uses a view for a long time, as a page would: moves, edits, switches, resizes, judges; and watches
how much memory the program has, how long it takes to answer, and whether a value is not finite.

It needs the Debian package python3-websockets.
"""
import asyncio
import json
import math
import pathlib
import random
import re
import signal
import statistics
import struct
import subprocess
import sys
import time

HEAD = struct.Struct("<4sBBHIIHHIf")
STEP = 1 / 30  # seconds between two messages of a drag
WARM_UP = 60  # seconds that do not count


class Page:
    """A page of a view: answers frames, and knows when what it asked for was shown."""

    def __init__(self, socket):
        self.socket = socket
        self.state = 0
        self.asked = {}
        self.waits = []  # seconds, kind, of each request until a frame showed it
        self.frames = 0
        self.status = {}
        self.errors = []
        self.bad_values = 0
        self.picked = 0

    async def ask(self, message, kind):
        self.state += 1
        message["state"] = self.state
        self.asked[self.state] = (time.monotonic(), kind)
        await self.socket.send(json.dumps(message))

    def shown(self, state):
        now = time.monotonic()
        for asked in [one for one in self.asked if one <= state]:
            begin, kind = self.asked.pop(asked)
            self.waits.append((now - begin, kind))

    def take(self, text):
        for key, value in json.loads(text).items():
            if key == "status":
                self.status = value
            elif key == "error":
                self.errors.append(value)
            elif key == "picked":
                self.picked += 1
                numbers = [one for layer in value["values"].values() for one in layer]
                self.bad_values += sum(not isinstance(one, (int, float)) for one in numbers)

    async def listen(self):
        async for message in self.socket:
            if isinstance(message, str):
                self.take(message)
                continue
            _, _, _, _, sequence, state, _, _, _, _ = HEAD.unpack(message[:HEAD.size])
            self.frames += 1
            self.shown(state)
            await self.socket.send(json.dumps({"ack": sequence}))


async def drag(page, camera, seconds):
    """Moves the camera to and fro, and rests a moment."""
    begin = time.monotonic()
    while (passed := time.monotonic() - begin) < seconds:
        await page.ask({"camera": moved(camera, passed), "moving": True}, "move")
        await asyncio.sleep(STEP)
    await page.ask({"camera": moved(camera, seconds), "moving": False}, "rest")
    await asyncio.sleep(1.5)


def moved(camera, angle):
    at = camera["at"]
    x, z = (camera["from"][i] - at[i] for i in (0, 2))
    turn = 0.3 * math.sin(angle)
    return {"from": [at[0] + x * math.cos(turn) + z * math.sin(turn), camera["from"][1],
                     at[2] + z * math.cos(turn) - x * math.sin(turn)],
            "at": at, "up": camera["up"], "fov": camera["fov"]}


async def edit(page, scene, chance):
    """Paints a material while a slider moves, moves an object, and takes all of it back."""
    name = chance.choice(scene["materials"])["name"]
    for i in range(20):
        await page.ask({"edit": {"material": name, "albedo": [i / 20, 0.5, 0.5]}, "moving": True,
                        "continues": i > 0}, "edit")
        await asyncio.sleep(STEP)
    thing = chance.choice(scene["objects"])
    await page.ask({"edit": {"object": thing, "move": [0.01, 0.01, 0]}, "moving": False}, "edit of "
                   "an object")
    await asyncio.sleep(1.0)
    await page.ask({"undo": "all"}, "undo")
    await asyncio.sleep(1.0)


async def switch(page, hello, size, cycle):
    """Shows each algorithm in turn, so that all have had their turn after the first minutes."""
    algorithms = [one for one in hello["algorithms"]
                  if one not in ("reference", "irradiance-cache", "ir")]
    algorithm = algorithms[cycle % len(algorithms)]
    await page.ask({"set": {"algorithm": algorithm}}, f"switch to {algorithm}")
    await asyncio.sleep(2.0)
    await page.ask({"set": {"algorithm": "ais", "trust": True}}, "switch back to ais")
    await asyncio.sleep(2.0)
    await page.ask({"set": {"size": [size[0] // 2, size[1] // 2], "trust": False}}, "resize")
    await asyncio.sleep(1.0)
    await page.ask({"set": {"size": size}}, "resize")
    await asyncio.sleep(1.0)


async def pick(page, size, chance):
    for _ in range(8):
        at = [chance.randrange(edge) for edge in size]
        await page.socket.send(json.dumps({"pick": at}))
        await asyncio.sleep(0.1)


def memory_mib(process):
    text = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    return int(re.search(r"VmRSS:\s*(\d+)", text).group(1)) / 1024


async def use(process, port, key, minutes, say):
    import websockets
    chance = random.Random(0)
    peaks, rests = {}, []
    async with websockets.connect(f"ws://127.0.0.1:{port}/ws", origin=f"http://127.0.0.1:{port}",
                                  max_size=None) as socket:
        await socket.send(json.dumps({"token": key}))
        told = json.loads(await socket.recv())
        hello, scene = told["hello"], told["scene"]
        size = hello["settings"]["size"]
        page = Page(socket)
        listener = asyncio.create_task(page.listen())
        begin = time.monotonic()
        cycle = 0

        async def watch():
            """The largest memory of each minute, whatever the program does just then."""
            while True:
                minute = int((time.monotonic() - begin) / 60)
                peaks[minute] = max(peaks.get(minute, 0.0), memory_mib(process))
                await asyncio.sleep(0.2)

        watcher = asyncio.create_task(watch())
        while (passed := time.monotonic() - begin) < 60 * minutes:
            await drag(page, hello["camera"], 6)
            await edit(page, scene, chance)
            await switch(page, hello, size, cycle)
            await pick(page, size, chance)
            if passed < WARM_UP:
                page.waits.clear()  # kernels are compiled, and memory is touched
            else:
                rests.append(memory_mib(process))  # always of the same settings, and at rest
            say(int(passed / 60), peaks[int(passed / 60)], page)
            cycle += 1
        watcher.cancel()
        listener.cancel()
    return page, peaks, rests


def soak(arguments, scene):
    command = [arguments.weft, "view", str(scene), "--size", arguments.size]
    if arguments.backend:
        command += ["--backend", arguments.backend]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    port, key = re.search(r"127.0.0.1:(\d+)/#(\w+)", process.stdout.readline()).groups()

    def say(minute, peak, page):
        longest = {}
        for seconds, kind in page.waits:
            longest[kind] = max(longest.get(kind, 0.0), seconds)
        waits = ", ".join(f"{kind} {1000 * wait:.0f}" for kind, wait in sorted(longest.items()))
        print(f"minute {minute}: {peak:.1f} MiB, {page.frames} frames, longest waits in ms: "
              f"{waits}; bad values: {page.bad_values} of {page.picked} pixels, errors: "
              f"{page.errors[-1:]}", flush=True)

    try:
        page, peaks, rests = asyncio.run(use(process, port, key, arguments.soak, say))
    finally:
        process.send_signal(signal.SIGINT)
        code = process.wait(60)
    # By then each algorithm has had its turn, which takes as much memory as the largest of them.
    first = max(peak for minute, peak in peaks.items() if minute < 2)
    growth = 100 * (max(peaks.values()) / first - 1)
    print(f"memory of the first two minutes: at most {first:.1f} MiB, of all: "
          f"{max(peaks.values()):.1f} MiB ({growth:+.1f} %); the program ended with {code}")
    if rests:
        # Peaks depend on what meets; what stays is seen where nothing happens.
        tenth = max(len(rests) // 10, 1)
        early, late = (statistics.median(part) for part in (rests[:tenth], rests[-tenth:]))
        print(f"memory at rest: {early:.1f} MiB in the first tenth after the first minute, "
              f"{late:.1f} in the last ({100 * (late / early - 1):+.1f} %)")
    if code != 0 or page.bad_values or page.errors:
        sys.exit("the view did not do what it should")
