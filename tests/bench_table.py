"""Prints the medians that criterion measured: python tests/bench_table.py target/criterion"""

import json
import pathlib
import sys

rows = []
for file in sorted(pathlib.Path(sys.argv[1]).glob("**/new/estimates.json")):
    benchmark = json.loads((file.parent / "benchmark.json").read_text(encoding="utf-8"))
    median_ns = json.loads(file.read_text(encoding="utf-8"))["median"]["point_estimate"]
    rows.append((benchmark["full_id"], median_ns))
width = max((len(name) for name, _ in rows), default=4)
print(f"{'work':{width}}  median")
for name, median_ns in rows:
    for unit, scale in (("s", 1e9), ("ms", 1e6), ("µs", 1e3), ("ns", 1)):
        if median_ns >= scale:
            print(f"{name:{width}}  {median_ns / scale:.3g} {unit}")
            break
