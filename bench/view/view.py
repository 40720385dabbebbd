#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""How quickly `weft view` follows a hand: drags in Chromium, frames a second and the time from an
input until an image shows it, scene by scene.

    ./weft bench view [--scenes NAME ...] [--size WxH] [--seconds S] [--backend NAME] [--json FILE]
    ./weft bench view --soak MINUTES [--scenes NAME]

With --soak it uses one view for so long, and watches its memory and its answers: see soak.py.

It needs Chromium, its driver and Selenium (Debian packages chromium-driver, python3-selenium), and
a machine that does nothing else: the browser draws on the same processor.
"""
import argparse
import json
import pathlib
import re
import signal
import statistics
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SCENES = ["cornell-box", "shirley6", "desk", "conference", "sibenik"]
PATIENCE = 120  # seconds, for what takes some

# Before the page begins: when each camera was sent, by its number.
NOTE_SENDING = """
(() => {
  window.sentAt = new Map();
  const send = WebSocket.prototype.send;
  WebSocket.prototype.send = function (data) {
    if (typeof data === 'string' && data.startsWith('{"camera"')) {
      const state = JSON.parse(data).state;
      window.sentAt.set(state, performance.now());
    }
    return send.call(this, data);
  };
})();
"""

# A drag of so many seconds, one move each time the browser draws; tells what was drawn, and when.
DRAG = """
const [seconds, done] = arguments;
const canvas = document.querySelector('canvas');
const box = canvas.getBoundingClientRect();
const middle = [box.left + box.width / 2, box.top + box.height / 2];
const send = (type, x, y, buttons) => canvas.dispatchEvent(new PointerEvent(type, {
  pointerId: 1, pointerType: 'mouse', isPrimary: true, bubbles: true, cancelable: true,
  button: type === 'pointermove' ? -1 : 0, buttons, clientX: x, clientY: y}));
const drawn = [];
let last = -1;
const begin = performance.now();
window.sentAt.clear();
send('pointerdown', ...middle, 1);
const step = () => {
  const now = performance.now();
  const frame = window.weftView.lastFrame;
  if (frame && frame.seq !== last) {
    last = frame.seq;
    drawn.push([now - begin, frame.state, frame.width]);
  }
  const share = (now - begin) / 1000 / seconds;
  // Two turns there and back within a tenth of the window.
  const x = middle[0] + 0.1 * box.width * Math.sin(4 * Math.PI * share);
  if (share < 1) {
    send('pointermove', x, middle[1], 1);
    requestAnimationFrame(step);
    return;
  }
  send('pointerup', x, middle[1], 0);
  done({drawn, sent: [...window.sentAt].map(([state, at]) => [state, at - begin])});
};
requestAnimationFrame(step);
"""


def browser():
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     "--window-size=1440,900"):
        options.add_argument(argument)
    driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
    driver.set_script_timeout(PATIENCE)
    driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": NOTE_SENDING})
    return driver


def wait_for_image(driver):
    """Waits until an image in full size is drawn; returns the seconds since the page was opened."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        if driver.execute_script("return Boolean(window.weftView && window.weftView.lastFrame "
                                 "&& !window.weftView.lastFrame.moving)"):
            return driver.execute_script("return performance.now() / 1000")
        time.sleep(0.01)
    raise SystemExit("no image came")


def latencies(sent, drawn):
    """Milliseconds from each camera that was sent until an image of it, or a later one, was drawn."""
    times = []
    at = 0
    for state, when in sent:
        while at < len(drawn) and drawn[at][1] < state:
            at += 1
        if at < len(drawn):
            times.append(drawn[at][0] - when)
    return times


def measure(arguments, scene):
    command = [arguments.weft, "view", str(ROOT / "scenes" / f"{scene}.gltf"), "--size",
               arguments.size]
    if arguments.backend:
        command += ["--backend", arguments.backend]
    view = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    begin = time.monotonic()
    link = re.search(r"http://\S+", view.stdout.readline()).group()
    ready = time.monotonic() - begin
    driver = browser()
    try:
        driver.get(link)
        first = wait_for_image(driver)
        # The first drag finds the size of moving images.
        driver.execute_async_script(DRAG, arguments.seconds)
        time.sleep(1.0)
        found = driver.execute_async_script(DRAG, arguments.seconds)
    finally:
        driver.quit()
        view.send_signal(signal.SIGINT)
        view.wait(PATIENCE)
    times = latencies(found["sent"], found["drawn"])
    return {"scene": scene, "ready_seconds": ready, "first_image_seconds": first,
            "frames_per_second": len(found["drawn"]) / arguments.seconds,
            "latency_ms": statistics.median(times) if times else None,
            "latency_95_ms": sorted(times)[int(0.95 * len(times))] if times else None,
            "width": statistics.median(width for _, _, width in found["drawn"])}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--weft", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--scenes", nargs="+", default=SCENES, help="names of files in scenes/")
    parser.add_argument("--size", default="512x512", help="of the image at rest")
    parser.add_argument("--seconds", type=float, default=5.0, help="of a drag")
    parser.add_argument("--backend", help="as of weft render")
    parser.add_argument("--json", help="file for all figures")
    parser.add_argument("--soak", type=float, metavar="MINUTES",
                        help="use one view for so long instead, without a browser")
    arguments = parser.parse_args()
    if arguments.soak:
        from soak import soak
        return soak(arguments, ROOT / "scenes" / f"{arguments.scenes[0]}.gltf")
    try:
        import selenium  # noqa: F401
    except ImportError:
        sys.exit("bench view: no Selenium, expected the Debian package python3-selenium and "
                 "--python /usr/bin/python3")
    print("scene           first image s  frames/s  latency ms  of 95 %  width")
    results = []
    for scene in arguments.scenes:
        result = measure(arguments, scene)
        results.append(result)
        print(f"{scene:15} {result['first_image_seconds']:13.2f} "
              f"{result['frames_per_second']:9.1f} {result['latency_ms']:11.0f} "
              f"{result['latency_95_ms']:8.0f} {result['width']:6.0f}", flush=True)
    if arguments.json:
        pathlib.Path(arguments.json).write_text(json.dumps(results, indent=2) + "\n")


main()
