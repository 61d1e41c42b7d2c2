"""The table of the slowest tests is of the files that there are, and is made from two reports of pytest."""

import csv
from pathlib import Path

import slowest

REPORT = """<testsuites><testsuite>
<testcase classname="tests.test_a" name="test_one[x]" time="1.25"/>
<testcase classname="tests.test_a" name="test_two" time="0.5"/>
<testcase classname="tests.test_b" name="test_three" time="2.5"/>
</testsuite></testsuites>"""


SLOW = '<testcase classname="tests.test_c" name="test_four" time="60.0"/>'


def test_rows_begin_with_the_slowest_file(tmp_path: Path) -> None:
    report, complete, table = tmp_path / "report.xml", tmp_path / "report_of_all.xml", tmp_path / "slowest.csv"
    report.write_text(REPORT, encoding="utf-8")
    complete.write_text(REPORT.replace("</testsuite>", f"{SLOW}</testsuite>"), encoding="utf-8")
    slowest.write(report, complete, table)
    assert table.read_text(encoding="utf-8").splitlines() == [
        "file,seconds,seconds_of_all,tests,slowest_seconds,slowest_test",
        "test_b.py,2.5,2.5,1,2.5,test_three",
        "test_a.py,1.8,1.8,2,1.2,test_one[x]",
        "test_c.py,0,60.0,0,0.0,",
    ]


def test_the_table_names_files_that_exist() -> None:
    with slowest.TABLE.open(encoding="utf-8", newline="") as file:
        names = [row["file"] for row in csv.DictReader(file)]
    assert [name for name in names if not (slowest.TABLE.parent / name).exists()] == []
