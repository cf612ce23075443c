# SPDX-License-Identifier: Apache-2.0
"""A headless Chromium on one page of the viewer, and what the tests ask it. Exits with 77, "skipped", without one.
Run the tests as NAME_page.py FOLDER, where FOLDER/RUN/view.html and paths.h5 were written by test_viewer."""
import atexit
import os
import shutil
import sys

try:
    import h5py
    import numpy as np
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.ui import Select, WebDriverWait
except ImportError as missing:
    print(f"skipped: {missing} (Debian: python3-selenium, python3-h5py)")
    sys.exit(77)

# The colour of the WebGL canvas around a pixel of the layout: it can be read in the moment of drawing only.
PIXELS = """
const [x, y, radius] = arguments, view = document.getElementById("world");
wavetracer.draw();
const copy = document.createElement("canvas");
copy.width = view.width; copy.height = view.height;
const pen = copy.getContext("2d"), ratio = view.width / view.clientWidth;
pen.drawImage(view, 0, 0);
return Array.from(pen.getImageData(Math.round((x - radius) * ratio), Math.round((y - radius) * ratio),
                                   Math.ceil((2 * radius + 1) * ratio), Math.ceil((2 * radius + 1) * ratio)).data);
"""


class Page:
    def __init__(self, folder, run, width=1280, height=800, dark=True):
        driver, browser = shutil.which("chromedriver"), shutil.which("chromium")
        if not driver or not browser:
            print("skipped: no chromium or chromedriver (Debian: chromium, chromium-driver)")
            sys.exit(77)
        options = webdriver.ChromeOptions()
        options.binary_location = browser
        for flag in ("--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
                     "--enable-unsafe-swiftshader", "--disable-dev-shm-usage", "--hide-scrollbars",
                     f"--window-size={width},{height}"):
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        self.driver = webdriver.Chrome(service=Service(driver), options=options)
        atexit.register(self.driver.quit)
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", dict(
            width=width, height=height, deviceScaleFactor=1, mobile=False))
        self.scheme("dark" if dark else "light")
        self.file = h5py.File(os.path.join(folder, run, "paths.h5"))
        self.driver.get("file://" + os.path.abspath(os.path.join(folder, run, "view.html")))
        WebDriverWait(self.driver, 60).until(lambda d: d.execute_script("return !!window.wavetracer") or self.failed())

    def wait(self, what, holds, seconds=60):
        """Until it holds; the page may draw in between."""
        WebDriverWait(self.driver, seconds).until(lambda _: holds(), f"waited {seconds} s for {what}")

    def failed(self):
        """False, unless the page has failed before it was ready: then there is nothing to wait for."""
        log = [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]
        assert not log, log
        return False

    def scheme(self, name):
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
            "features": [{"name": "prefers-color-scheme", "value": name}]})

    def js(self, code, *arguments):
        return self.driver.execute_script(code, *arguments)

    def find(self, name):
        return self.driver.find_element(By.ID, name)

    def text(self, name):
        return self.find(name).text.replace("\u2212", "-")

    def choose(self, name, value):
        Select(self.find(name)).select_by_value(str(value))

    def check(self, name, wanted):
        box = self.find(name)
        if box.is_selected() != wanted:
            box.click()

    def type(self, name, value):
        self.js("const c = document.getElementById(arguments[0]); c.value = arguments[1];"
                "c.dispatchEvent(new Event('input', {bubbles: true}));", name, str(value))

    def visible(self):
        return self.js("return wavetracer.visibleCount()")

    def pixels(self, x, y, radius):
        """RGB of the WebGL canvas around a place, shape (n, n, 3)."""
        values = np.array(self.js(PIXELS, x, y, radius), float).reshape(-1, 4)[:, :3]
        size = int(round(len(values) ** 0.5))
        return values.reshape(size, size, 3)

    def at(self, x, y):
        """Moves the pointer to a place of the canvas, in pixels from its upper left corner."""
        canvas = self.find("world")
        size = canvas.size
        return ActionChains(self.driver).move_to_element_with_offset(
            canvas, round(x - size["width"] // 2), round(y - size["height"] // 2))

    def hover(self, x, y):
        self.at(x, y).perform()

    def click(self, x, y):
        self.at(x, y).click().perform()

    def from_above(self):
        """Looks straight down, and returns the map from file coordinates to pixels, by the rules of a pinhole camera."""
        self.find("top").click()
        camera = self.js("const {orbit} = wavetracer, t = orbit.target;"
                         "return [[t.x, t.y, t.z], orbit.distance, orbit.elevation, orbit.camera.fov]")
        target, distance, elevation, fov = np.array(camera[0]), camera[1], camera[2], camera[3]
        centre = np.array(self.js("return wavetracer.meta.centre_m"))
        size = self.find("world").size
        assert abs(elevation - np.pi / 2) < 0.01, elevation
        up = np.array([0, np.sin(elevation), np.cos(elevation)])
        back = np.array([0, -np.cos(elevation), np.sin(elevation)])

        def project(point):
            p = np.asarray(point) - centre - target
            scale = size["height"] / 2 / np.tan(np.radians(fov / 2)) / (distance - p @ back)
            return np.array([size["width"] / 2 + scale * p[0], size["height"] / 2 - scale * (p @ up)])
        return project

    def frame_rows(self, frame):
        offsets = self.file["frames/path_offset"][...]
        return np.arange(int(offsets[frame]), int(offsets[frame + 1]))

    def index(self, row):
        """Returns the index of a path of the file in the frame that the page shows; its delay tells it from the others.
        """
        delays = np.array(self.js("return Array.from(wavetracer.state.frame.delay_s)"))
        found = np.nonzero(np.abs(delays - self.file["paths/delay_s"][row]) < 1e-13)[0]
        assert len(found) > 0, row
        return int(found[0])

    def points(self, row, frame):
        """The points of a path from the transmitter to the receiver, file coordinates."""
        paths = self.file["paths"]
        first, last = paths["vertex_offset"][row], paths["vertex_offset"][row + 1]
        return np.vstack([self.file["frames/transmitter_position_m"][frame, paths["tx"][row]],
                          self.file["vertices/position_m"][first:last],
                          self.file["frames/receiver_position_m"][frame, paths["rx"][row]]])

    def check_clean(self):
        """Nothing was fetched, nothing failed."""
        log = [entry for entry in self.driver.get_log("browser") if entry["level"] in ("SEVERE", "ERROR")]
        assert not log, log
        assert self.js("return performance.getEntriesByType('resource').length") == 0

    def screenshot(self, name):
        self.driver.save_screenshot(os.path.join(sys.argv[1], name + ".png"))
