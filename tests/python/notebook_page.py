# SPDX-License-Identifier: Apache-2.0
"""The page of a run as the notebook shows it: a browser opens the cell, and the city is drawn inside of it.

Usage: notebook_page.py FOLDER, where notebook_test.py has left view.html. Exits with 77 without a browser.
"""
import pathlib
import shutil
import sys

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.support.ui import WebDriverWait
except ImportError as missing:
    print(f"skipped: {missing} (Debian: python3-selenium)")
    sys.exit(77)

driver, browser = shutil.which("chromedriver"), shutil.which("chromium")
page = pathlib.Path(sys.argv[1]) / "view.html"
if not driver or not browser or not page.exists():
    print("skipped: no chromium, no chromedriver (Debian: chromium, chromium-driver), or no notebook was run")
    sys.exit(77)
options = webdriver.ChromeOptions()
options.binary_location = browser
for flag in ("--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
             "--disable-dev-shm-usage", "--window-size=1000,760"):
    options.add_argument(flag)
chrome = webdriver.Chrome(service=Service(driver), options=options)
try:
    chrome.get(page.resolve().as_uri())
    frame = chrome.find_element("tag name", "iframe")
    assert frame.size["height"] == 640 and frame.size["width"] > 900, frame.size
    chrome.switch_to.frame(frame)
    WebDriverWait(chrome, 60).until(lambda inside: inside.execute_script("return !!window.wavetracer"))
    colours = chrome.execute_script("""
        const view = document.getElementById("world");
        wavetracer.draw();
        const copy = document.createElement("canvas");
        copy.width = view.width; copy.height = view.height;
        const pen = copy.getContext("2d");
        pen.drawImage(view, 0, 0);
        const data = pen.getImageData(0, 0, copy.width, copy.height).data, seen = new Set();
        for (let i = 0; i < data.length; i += 4) seen.add(data[i] * 65536 + data[i + 1] * 256 + data[i + 2]);
        return [seen.size, wavetracer.visibleCount()];""")
    chrome.save_screenshot(str(page.with_suffix(".png")))
    assert colours[0] > 30 and colours[1] > 0, colours
    print(f"the cell shows {colours[1]} paths in {colours[0]} colours: {page.with_suffix('.png')}")
finally:
    chrome.quit()
