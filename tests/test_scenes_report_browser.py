"""Reports in a real browser: nothing is fetched, nothing complains, nothing sticks out, every picture is seen."""

import base64
import json
import os
import re
import shutil
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reports import SCENES
from selenium.webdriver import Chrome
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By

import hydroelastic as he

FLAGS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-dev-shm-usage",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-quic",
    "--no-first-run",
)


@dataclass
class Browser:
    """A browser that logs what it complains of and what it asks for."""

    driver: Chrome

    def show(self, file: Path) -> tuple[list[Any], list[str]]:
        """Open a page; return complaints of the console, and what is asked for beside the page and what it holds."""
        # What an earlier page has left is not of this one.
        self._requests()
        self.driver.get(file.as_uri())
        asked = [url for url in self._requests() if url != file.as_uri() and not url.startswith("data:")]
        return self.driver.get_log("browser"), asked

    def widths(self, width: int, *, dark: bool = False) -> tuple[int, int]:
        """Return how wide the page wants to be, and how wide the window is."""
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [scheme]})
        window = {"width": width, "height": 800, "deviceScaleFactor": 1, "mobile": False}
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", window)
        return self.value("document.documentElement.scrollWidth"), self.value("window.innerWidth")

    def value(self, expression: str) -> Any:
        """Return the value of an expression."""
        return self.driver.execute_script(f"return {expression}")

    def _requests(self) -> list[str]:
        entries = [json.loads(entry["message"])["message"] for entry in self.driver.get_log("performance")]
        return [
            entry["params"]["request"]["url"] for entry in entries if entry["method"] == "Network.requestWillBeSent"
        ]


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    programs = shutil.which("chromium"), shutil.which("chromedriver")
    if None in programs and not in_own_root():
        pytest.skip("chromium and chromedriver are not on the path; the root that ./hydro prepares has them")
    options = Options()
    options.binary_location = programs[0] or ""
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    for flag in (*FLAGS, f"--user-data-dir={tmp_path_factory.mktemp('browser')}"):
        options.add_argument(flag)
    driver = Chrome(options=options, service=Service(programs[1]))
    # Whatever a page asks for is refused, as without a network, and logged.
    driver.execute_cdp_cmd("Network.enable", {})
    offline = {"offline": True, "latency": 0, "downloadThroughput": 0, "uploadThroughput": 0}
    driver.execute_cdp_cmd("Network.emulateNetworkConditions", offline)
    yield Browser(driver)
    driver.quit()


def in_own_root() -> bool:
    """Whether this is the Debian root that ./hydro prepares, to which a browser belongs.

    ./hydro names its virtual environment by the suite of the root, or by the version of a Python that was there.
    """
    environment = os.environ.get("HYDROELASTIC_INSIDE")
    return environment is not None and not Path(environment).name.startswith("python")


Reports = Callable[[str], tuple[he.Result, Path]]


@pytest.fixture(scope="module")
def reports(tmp_path_factory: pytest.TempPathFactory) -> Reports:
    """Returns the outcome and the page of a kind of scene, made when it is asked for first."""

    @cache
    def made(kind: str) -> tuple[he.Result, Path]:
        name, overrides = SCENES[kind]
        folder = tmp_path_factory.mktemp("reports") / kind
        result = he.solve(he.read(name, overrides))
        result.save(folder, report=True)
        # Away from all other files, which it does not need.
        return result, shutil.move(folder / "report.html", tmp_path_factory.mktemp("page") / "report.html")

    return made


@pytest.mark.slow_but("tank")
@pytest.mark.parametrize("kind", SCENES)
def test_a_page_is_shown(browser: Browser, reports: Reports, kind: str) -> None:
    result, file = reports(kind)
    complaints, asked = browser.show(file)
    assert complaints == []
    assert asked == []
    assert browser.driver.title == f"{result.summary['scene']['title']} – report"
    titles = [heading.text for heading in browser.driver.find_elements(By.TAG_NAME, "h2")]
    assert titles[:2] == ["Answer", "Results"]
    assert titles[-3:] == ["What was modelled, and why", "Scene", "Cost"]
    sizes = browser.value("Array.from(document.images, image => [image.complete, image.naturalWidth, image.alt])")
    assert sizes
    assert all(complete and width > 0 and caption for complete, width, caption in sizes)
    assert len({caption for *_, caption in sizes}) == len(sizes)
    assert file.stat().st_size < 5e6


@pytest.mark.slow_but("tank")
@pytest.mark.parametrize("kind", SCENES)
def test_nothing_sticks_out(browser: Browser, reports: Reports, kind: str) -> None:
    browser.show(reports(kind)[1])
    for width in (400, 1200):
        wanted, given = browser.widths(width)
        assert wanted <= given
        # What is too wide for the window can be scrolled in its own box, and read with a keyboard.
        boxes = browser.value(
            "Array.from(document.querySelectorAll('.scroll, pre'),"
            " box => [box.getBoundingClientRect().right, box.tabIndex])"
        )
        assert all(right <= given and index == 0 for right, index in boxes)


def _frequencies(summary: dict[str, Any]) -> list[tuple[float, float]]:
    return [(mode["omega"], mode["relative_error"]) for mode in summary["modes"]]


# Numbers of summary.json with their errors, as far as digits are shown by them; of the others six or more are shown.
NUMBERS = {
    **dict.fromkeys(("tank", "float", "plates", "round tank", "canal"), _frequencies),
    "open": lambda summary: [
        (wavenumber, 1e-5) for table in summary["response"] for wavenumber in np.ravel(table["wavenumbers"])
    ],
    "sea": lambda summary: [
        (number, error)
        for table in summary["radiation"]
        for matrix, error in zip(table["added_mass"], table["relative_error"], strict=True)
        for number in np.diagonal(matrix)
    ],
    "string": lambda summary: [(mode["omega"], 1e-12) for mode in summary["modes"]],
    "thread": lambda summary: [
        (mode["damped_omega"], mode["relative_error"]) for mode in summary["modes"][0]["oscillating"]
    ],
    "roll": lambda summary: [(summary["response"]["largest_angle"], 1e-12)],
}


@pytest.mark.slow_but("tank")
@pytest.mark.parametrize("kind", SCENES)
def test_numbers_are_read(browser: Browser, reports: Reports, kind: str) -> None:
    result, file = reports(kind)
    browser.show(file)
    read = [float(text) for text in re.findall(r"\d+\.\d*(?:e[+-]\d+)?", browser.value("document.body.innerText"))]
    numbers = NUMBERS[kind](result.summary)
    assert numbers
    for value, error in numbers:
        # d digits, 4 to 13, of which 10^-d is at most the error: the last one is rounded by at most 5·10^-d.
        assert min(abs(number - abs(value)) for number in read) <= 5.0 * min(max(error, 1e-13), 1e-4) * abs(value)


def test_colours_follow_the_reader(browser: Browser, reports: Reports) -> None:
    browser.show(reports("tank")[1])
    colours = []
    for dark in (False, True):
        browser.widths(1200, dark=dark)
        style = "getComputedStyle(document.body)"
        colours.append([_brightness(browser.value(f"{style}.{name}")) for name in ("backgroundColor", "color")])
    (light_paper, light_ink), (dark_paper, dark_ink) = colours
    assert light_paper - light_ink > 0.7
    assert dark_ink - dark_paper > 0.7


def _brightness(colour: str) -> float:
    """Mean of red, green and blue, from 0 to 1."""
    return sum(float(part) for part in re.findall(r"[\d.]+", colour)[:3]) / (3 * 255)


@pytest.mark.slow_but("tank")
@pytest.mark.parametrize("kind", ["tank", "roll"])
def test_a_page_can_be_printed(browser: Browser, reports: Reports, kind: str) -> None:
    browser.show(reports(kind)[1])
    printed = base64.b64decode(browser.driver.execute_cdp_cmd("Page.printToPDF", {"preferCSSPageSize": True})["data"])
    assert printed.startswith(b"%PDF")
    assert printed.count(b"/Type /Page\n") + printed.count(b"/Type /Page ") > 1
    browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print", "features": []})
    # The width of A4 between its margins.
    window = {"width": 680, "height": 960, "deviceScaleFactor": 1, "mobile": False}
    browser.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", window)
    shown = browser.value("getComputedStyle(document.querySelector('nav')).display")
    widest = browser.value(
        "Math.max(...Array.from(document.querySelectorAll('table, pre, img'), e => e.getBoundingClientRect().right))"
    )
    # What would have to be scrolled stands whole.
    hidden = browser.value(
        "Array.from(document.querySelectorAll('pre'), box => [box.scrollHeight - box.clientHeight,"
        " getComputedStyle(box).maxHeight])"
    )
    browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
    assert hidden == [[0, "none"]]
    assert shown == "none"
    assert widest <= 680
