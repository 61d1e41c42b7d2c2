"""Writes tests/slowest.csv, the seconds of each test file and its slowest test: tests/conftest.py orders by it.

    ./hydro test --junitxml=/tmp/report.xml
    ./hydro python tests/support/slowest.py /tmp/report.xml

Seconds are those of setup, call and teardown. Of a run on several cores they are of a core that others load as well.
"""

import csv
import sys
from collections import defaultdict
from pathlib import Path
from xml.etree import ElementTree

TABLE = Path(__file__).parents[1] / "slowest.csv"
COLUMNS = ("file", "seconds", "tests", "slowest_seconds", "slowest_test")


def rows_of(report: Path) -> list[tuple[str, float, int, float, str]]:
    """The rows of the table, the slowest file first, of a JUnit report of pytest."""
    times: dict[str, list[tuple[float, str]]] = defaultdict(list)
    for case in ElementTree.parse(report).getroot().iter("testcase"):
        times[case.attrib["classname"].removeprefix("tests.")].append((float(case.attrib["time"]), case.attrib["name"]))
    rows = []
    for name, of in times.items():
        most, test = max(of)
        rows.append((f"{name}.py", round(sum(time for time, _ in of), 1), len(of), round(most, 1), test))
    return sorted(rows, key=lambda row: (-row[1], row[0]))


def write(report: Path, table: Path = TABLE) -> None:
    """Write the table of a report."""
    with table.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows(rows_of(report))


if __name__ == "__main__":
    write(Path(sys.argv[1]))
