"""Put tables of the committed measurements into the pages that tell of them.

    ./hydro python results/page_tables.py

Run it after `./hydro bench`. It replaces what stands between the marks of each table on docs/speed_against_error.md and
docs/performance.md, and nothing else.
"""

from __future__ import annotations

from pathlib import Path

from hydroelastic.benchmarks.problems import PROBLEMS
from hydroelastic.benchmarks.runner import equal_error, ratios, read_csv

ROOT = Path(__file__).parent.parent
BENCHMARKS = ROOT / "results" / "benchmarks"


def pages() -> dict[Path, str]:
    """Each page with its tables as the measurements have them now."""
    texts = {ROOT / "docs" / name: "" for name in ("speed_against_error.md", "performance.md")}
    for path in texts:
        content = path.read_text(encoding="utf-8")
        for problem in PROBLEMS.values():
            made_of = f"results/benchmarks/{problem.file}.csv"
            begin, end = (f"<!-- {word}: {made_of} by results/page_tables.py -->" for word in ("begin", "end"))
            if begin in content:
                rows = list(read_csv(ROOT / made_of))
                text = ratios(problem, rows) if problem.base else equal_error(problem, rows)
                before, _, rest = content.partition(begin)
                content = f"{before}{begin}\n\n{text}\n\n{end}{rest.partition(end)[2]}"
        texts[path] = content
    return texts


def main() -> None:
    """Write the pages anew."""
    for page, content in pages().items():
        page.write_text(content, encoding="utf-8")
        print(f"Written to {page.relative_to(ROOT)}")


if __name__ == "__main__":
    main()
