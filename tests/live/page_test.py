# SPDX-License-Identifier: Apache-2.0
"""The page of a live world: there before the first frame, of the newest frame, loaded again by the browser, and gone
from nothing when it cannot be written. Assumes an OpenCL device; the browser's part needs Chromium."""
import json
import os
import re
import shutil
import tempfile
import time

from live_server import Server, expect, frame, vehicle


def meta_of(page):
    with open(page, encoding="utf-8") as file:
        found = re.search(r'<script type="application/json" id="meta">(.*?)</script>', file.read(), re.DOTALL)
    return json.loads(found.group(1)) if found else None


def wait_for(what, holds, seconds=20):
    end = time.monotonic() + seconds
    while not holds():
        expect(time.monotonic() < end, f"{what}, within {seconds} s")
        time.sleep(0.1)


def shows(page, time_s):
    meta = meta_of(page)
    return meta is not None and meta["title"] == f"Live world, {time_s:g} s"


def in_browser(page, client):
    """Camera and choices outlast the page that is loaded again with the next frame."""
    try:
        from selenium import webdriver
        from selenium.webdriver.chrome.service import Service
    except ImportError:
        return print("no selenium: the page is not opened")
    driver, browser = shutil.which("chromedriver"), shutil.which("chromium")
    if not driver or not browser:
        return print("no Chromium: the page is not opened")
    options = webdriver.ChromeOptions()
    options.binary_location = browser
    for flag in ("--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
                 "--enable-unsafe-swiftshader", "--disable-dev-shm-usage", "--window-size=1200,800"):
        options.add_argument(flag)
    with webdriver.Chrome(service=Service(driver), options=options) as chrome:
        chrome.get("file://" + page)
        wait_for("the page", lambda: chrome.execute_script("return !!window.wavetracer"))
        chrome.execute_script("wavetracer.orbit.distance = 77; wavetracer.orbit.apply();"
                              "document.getElementById('colour').value = 'kind'; window.first = true")
        client.ask(frame(9, 9.0, [vehicle("car1", 10, 0, 0)]))
        title = "return document.getElementById('title').textContent"
        wait_for("the page of the next frame", lambda: chrome.execute_script("return !!window.wavetracer")
                 and chrome.execute_script(title) == "Live world, 9 s")
        expect(chrome.execute_script("return window.first") is None, "the page was not loaded again")
        expect(abs(chrome.execute_script("return wavetracer.orbit.distance") - 77) < 1e-6, "the camera moved")
        expect(chrome.execute_script("return document.getElementById('colour').value") == "kind", "a choice was lost")
        # Empty places are neither counted nor offered.
        summary = chrome.execute_script("return document.getElementById('summary').textContent")
        expect("2 antennas, 1 vehicle," in summary, summary)
        expect(chrome.execute_script("return document.getElementById('receiver').length") == 2, "empty places")
        severe = [entry for entry in chrome.get_log("browser") if entry["level"] == "SEVERE"]
        expect(not severe, severe)
    print("in a browser")


with tempfile.TemporaryDirectory() as folder:
    page = os.path.join(folder, "live.html")
    with Server(more=["--page", page]) as server, server.connect() as client:
        client.hello()
        with open(page, encoding="utf-8") as file:
            expect("No frame was solved yet" in file.read(), "a page before the first frame")
        answer = client.ask(frame(1, 1.5, [vehicle("car1", 0, 0, 0), vehicle("car2", 30, 0, 180)]))
        expect(answer["message"] == "channels", answer)
        wait_for("the first frame on the page", lambda: shows(page, 1.5))
        meta = meta_of(page)
        expect([row[0] for row in meta["receivers"] if row[0]] == ["car1/roof", "car2/roof"], meta["receivers"])
        expect([row[0] for row in meta["instances"] if row[0]] == ["car1", "car2"], meta["instances"])
        expect(meta["paths"][1] == sum(link["paths"] for link in answer["links"]) > 0, (meta["paths"], answer))
        # Many frames at once: the last one is shown.
        for step in range(30):
            client.ask(frame(step, 2 + step / 10, [vehicle("car1", step, 0, 0)]))
        wait_for("the last of many frames", lambda: shows(page, 4.9))
        in_browser(page, client)
        expect(server.process.poll() is None, server.log)
    expect(os.listdir(folder) == ["live.html"], os.listdir(folder))
    print("the newest frame")

    # A page that cannot be written is an error at the start; if it cannot be written later, that is reported once, and
    # frames continue.
    try:
        Server(more=["--page", os.path.join(folder, "absent", "live.html")])
        expect(False, "a page in a folder that is not there")
    except RuntimeError as error:
        expect("absent/live.html" in str(error), error)
    inner = os.path.join(folder, "inner")
    os.mkdir(inner)
    with Server(more=["--page", os.path.join(inner, "live.html")]) as server, server.connect() as client:
        client.hello()
        shutil.rmtree(inner)
        with open(inner, "w", encoding="utf-8"):
            pass
        for step in range(3):
            expect(client.ask(frame(step, step, [vehicle("car1", 0, 0, 0)]))["message"] == "channels", "a frame")
            time.sleep(1.2)  # a page is written once a second at most
        wait_for("the word about the page", lambda: any("could not be written" in line for line in server.log))
        said = [line for line in server.log if "could not be written" in line]
        expect(len(said) == 1 and "frames go on" in said[0], server.log)
    print("pages that cannot be written")
