#!/usr/bin/env python3
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Uses the page of `weft view` in Chromium: the first image, a drag, settings, the inspector, the
command, edits, a comparison, judging and measuring, and the end of the program.

    tests/view/view_browser.py PROGRAM [FOLDER]

FOLDER: where screenshots of the page go, on a laptop and on a phone.
"""
import pathlib
import re
import shlex
import signal
import subprocess
import sys
import tempfile
import time

from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.chrome.service import Service

HERE = pathlib.Path(__file__).resolve().parent
SCENE = HERE.parent.parent / "scenes" / "cornell-box.gltf"
PATIENCE = 60  # seconds, for what takes a fraction of one


def browser(width, height):
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     f"--window-size={width},{height}"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
    # The window may be larger than the page.
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500})
    return driver


def wait(driver, expression, what):
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        if driver.execute_script("return " + expression):
            return
        time.sleep(0.05)
    state = driver.execute_script("return JSON.stringify(window.weftView)")
    raise SystemExit(f"waited in vain for {what}: {state}")


def is_final(state="window.weftView.state"):
    return (f"window.weftView && window.weftView.lastFrame && window.weftView.lastFrame.final && "
            f"window.weftView.lastFrame.state === {state}")


def check_errors(driver):
    bad = [entry for entry in driver.get_log("browser")
           if entry["level"] == "SEVERE" and "favicon" not in entry["message"]]
    if bad:
        raise SystemExit(f"the browser complains: {bad}")


def check_texts(driver):
    """Refuses texts that are too small to read, and controls without a name."""
    small = driver.execute_script("""
        return [...document.querySelectorAll('body *')].filter(e =>
            e.childNodes.length && [...e.childNodes].some(n => n.nodeType === 3 && n.data.trim()) &&
            e.offsetParent && parseFloat(getComputedStyle(e).fontSize) < 12)
            .map(e => e.tagName + ': ' + e.textContent.trim().slice(0, 40))""")
    if small:
        raise SystemExit(f"texts below 12 px: {small}")
    nameless = driver.execute_script("""
        return [...document.querySelectorAll('button, input, select')].filter(e =>
            e.offsetParent &&
            !(e.getAttribute('aria-label') || e.title || e.textContent.trim() ||
              (e.labels && e.labels.length) || e.getAttribute('aria-labelledby')))
            .map(e => e.outerHTML.slice(0, 80))""")
    if nameless:
        raise SystemExit(f"controls without a name: {nameless}")


def drag(driver, across, down, steps=8):
    canvas = driver.find_element(By.TAG_NAME, "canvas")
    actions = ActionChains(driver, duration=20).move_to_element(canvas).click_and_hold()
    for _ in range(steps):
        actions.move_by_offset(across // steps, down // steps)
    actions.release().perform()


def command_of(driver):
    wait(driver, "window.weftView.status && window.weftView.status.command", "a command")
    return driver.execute_script("return window.weftView.status.command")


def press(driver, name):
    """Presses a button, wherever it is."""
    driver.execute_script("const b = document.getElementById(arguments[0]);"
                          "b.closest('details')?.setAttribute('open', ''); b.click()", name)


def set_field(driver, name, value):
    """Gives a field a value as a hand would, which drags first and lets go then."""
    driver.execute_script("""
        const field = document.getElementById(arguments[0]);
        field.closest('details')?.setAttribute('open', '');
        field.value = arguments[1];
        for (const kind of ['input', 'change'])
            field.dispatchEvent(new Event(kind, {bubbles: true}));""", name, value)


def check_edits(driver):
    set_field(driver, "target", "material green")
    set_field(driver, "albedo", "#3040c0")
    wait(driver, "window.weftView.scene.edits.length === 1", "an edit")
    wait(driver, is_final(), "the image of an edited scene")
    if "--edits" not in command_of(driver):
        raise SystemExit("the command does not have the edit")
    set_field(driver, "target", "object short block")
    driver.find_element(By.TAG_NAME, "body").send_keys("g")
    drag(driver, 40, 0)
    wait(driver, "window.weftView.scene.edits.length === 2", "the edit of a drag")
    driver.find_element(By.TAG_NAME, "body").send_keys("g")
    press(driver, "undo")
    wait(driver, "window.weftView.scene.edits.length === 1", "an undone edit")
    press(driver, "undo-all")
    wait(driver, "window.weftView.scene.edits.length === 0", "the scene as it was")
    wait(driver, is_final(), "its image")


def check_comparison(driver):
    set_field(driver, "seconds", "0.3")
    set_field(driver, "algorithm-b", "igi")
    press(driver, "compare")
    wait(driver, "window.weftView.lastFrameB && window.weftView.lastFrameB.final", "picture B")
    wait(driver, "window.weftView.status.phase === 'finished'", "picture A")
    wait(driver, "!document.getElementById('copy-b').disabled", "the command of B")
    if not driver.execute_script("return !document.getElementById('divider').hidden"):
        raise SystemExit("there is no border between both pictures")


def check_order(driver):
    """Refuses requests that overtake the settings chosen just before them."""
    sent = driver.execute_script("""
        const kinds = [];
        const send = WebSocket.prototype.send;
        WebSocket.prototype.send = function (text) {
            kinds.push(Object.keys(JSON.parse(text))[0]);
            send.call(this, text);
        };
        for (const name of ['compare', 'measure']) document.getElementById(name).click();
        WebSocket.prototype.send = send;
        return kinds.join(' ')""")
    if sent != "set measure":
        raise SystemExit(f"the page sent: {sent}, expected: set measure")


def check_judging(driver):
    press(driver, "trust")
    wait(driver, "window.weftView.trust && window.weftView.trust.panes.length === 2",
         "a judgement of both pictures")
    press(driver, "trust")
    check_order(driver)
    wait(driver, "window.weftView.front && window.weftView.front.running === false && "
                 "window.weftView.front.points.length >= 3", "what settings cost")
    if driver.execute_script("return document.querySelectorAll('#front circle').length") < 3:
        raise SystemExit("the plot has no points")


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    shots = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
    with tempfile.TemporaryDirectory() as folder:
        view = subprocess.Popen(
            [program, "view", str(SCENE), "--size", "160x160", "--backend", "native",
             "--output", folder], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        link = re.search(r"http://\S+", view.stdout.readline()).group()
        driver = browser(1440, 900)
        try:
            driver.get(link)
            wait(driver, is_final("0"), "the first image")
            check_texts(driver)
            before = driver.execute_script("return window.weftView.frames")
            drag(driver, 160, 40)
            wait(driver, is_final(), "the image after a drag")
            moved = driver.execute_script("return window.weftView.frames") - before
            if moved < 3:
                raise SystemExit(f"{moved} frames came during a drag, expected several")
            command = command_of(driver)
            if "--look-from" not in command:
                raise SystemExit(f"{command} does not say where the camera stands")
            made = subprocess.run([program, *shlex.split(command)[1:]], cwd=folder)
            if made.returncode != 0:
                raise SystemExit(f"{command} fails")
            # Picks the pixel in the middle, and says what it shows.
            ActionChains(driver).move_to_element(
                driver.find_element(By.TAG_NAME, "canvas")).click().perform()
            wait(driver, "document.body.textContent.includes('indirect')", "what a pixel shows")
            if shots:
                driver.save_screenshot(str(shots / "view-laptop.png"))
            driver.find_element(By.TAG_NAME, "body").send_keys("p")
            wait(driver, "document.body.textContent.includes('view-001.png')", "a saved image")
            if not (pathlib.Path(folder) / "view-001.png").is_file():
                raise SystemExit("no image was saved")
            check_edits(driver)
            check_comparison(driver)
            if shots:
                driver.save_screenshot(str(shots / "view-comparison.png"))
            check_judging(driver)
            check_texts(driver)
            if shots:
                driver.save_screenshot(str(shots / "view-costs.png"))
            check_errors(driver)
            driver.quit()
            driver = browser(390, 844)
            driver.get(link)
            wait(driver, "window.weftView && window.weftView.lastFrame", "an image on a phone")
            wide = driver.execute_script(
                "return document.documentElement.scrollWidth - window.innerWidth")
            if wide > 0:
                raise SystemExit(f"the page is {wide} px wider than a phone")
            check_texts(driver)
            if shots:
                driver.save_screenshot(str(shots / "view-phone.png"))
            check_errors(driver)
            view.send_signal(signal.SIGINT)
            if view.wait(PATIENCE) != 0:
                raise SystemExit(f"the program ended with {view.returncode}")
            wait(driver, "document.body.textContent.includes('ended')", "the farewell")
        finally:
            driver.quit()
            view.kill()
    print("the page does what it should")


main()
