"""Writes tests/slowest.csv, the seconds of each test file and its slowest test: tests/conftest.py orders by it.

    ./hydro test --junitxml=/tmp/report.xml
    ./hydro test --all --junitxml=/tmp/report_of_all.xml
    ./hydro python tests/support/slowest.py /tmp/report.xml /tmp/report_of_all.xml

Seconds are those of setup, call and teardown. Of a run on several cores they are of a core that others load as well.
"""

import csv
import sys
from collections import defaultdict
from pathlib import Path
from xml.etree import ElementTree

TABLE = Path(__file__).parents[1] / "slowest.csv"
COLUMNS = ("file", "seconds", "seconds_of_all", "tests", "slowest_seconds", "slowest_test")


def times_of(report: Path) -> dict[str, list[tuple[float, str]]]:
    """Seconds and name of each test of a file, of a JUnit report of pytest."""
    times: dict[str, list[tuple[float, str]]] = defaultdict(list)
    for case in ElementTree.parse(report).getroot().iter("testcase"):
        name = case.attrib["classname"].removeprefix("tests.")
        times[f"{name}.py"].append((float(case.attrib["time"]), case.attrib["name"]))
    return times


def write(report: Path, report_of_all: Path, table: Path = TABLE) -> None:
    """Write the table of a report without the slow tests and of one with them, the slowest file of the first on top."""
    own, with_slow = times_of(report), times_of(report_of_all)
    rows = []
    for name in own | with_slow:
        most, test = max(own[name], default=(0.0, ""))
        seconds = [round(sum(time for time, _ in times[name]), 1) for times in (own, with_slow)]
        rows.append((name, *seconds, len(own[name]), round(most, 1), test))
    with table.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(sorted(rows, key=lambda row: (-row[1], row[0])))


if __name__ == "__main__":
    write(Path(sys.argv[1]), Path(sys.argv[2]))
