#!/usr/bin/python3
"""Runs `ident thrust` on every recording of real thrust stands and prints data/REAL_BENCH.md.

    tests/campaign/thrust_real_bench.py build/ident ../shared/data/bench > data/REAL_BENCH.md
"""
import json
import subprocess
import sys
from pathlib import Path

HEAD = """# `ident thrust` on real thrust stands

Every file as it was recorded, read without editing. Made by

    tests/campaign/thrust_real_bench.py build/ident {data} > data/REAL_BENCH.md

The recordings are not part of the project; their origin and licences:

| folder | source |
|---|---|
| `esc_test` | RCbenchmark 1580, one three-bladed 7-inch propeller on three motors; github alspitz/esc_test 4078609, MIT |
| `strawson_1520` | RCbenchmark 1520, eight 5-inch propellers on motors a and c at 7.4 and 11.1 V; github StrawsonDesign/motor_propeller_testing 7031418, MIT |
| `uiuc_static` | UIUC propeller data base, static tests (Brandt, Deters, Ananda, Dantsker, Selig); github usuaero/PyProp e568dda, MIT |

"k Omega^2" and "+ linear" are the RMS misfits of thrust over steady points in % of full scale; the intervals of kT and
kQ hold the misfit of the law. Codes are the warnings of the program.
"""

# Said of every file of a stand: not repeated in each line.
COMMON = {"command_range_unknown", "transients_excluded", "ignored_column", "ignored_columns"}


def run(program, files):
    done = subprocess.run([program, "thrust", "--json", *map(str, files)], capture_output=True, text=True)
    return (json.loads(done.stdout), "") if done.returncode == 0 else (None, done.stderr.strip())


def pair(entry, scale, digits):
    return f"{entry['value'] * scale:.{digits}f} ± {entry['std'] * scale:.{digits}f}" if entry else ""


def line(name, result, error):
    if result is None:
        return f"| {name} | refused: {error.replace('|', '/').split(': ', 2)[-1]} | | | | |"
    kT, kQ = result["parameters"].get("kT"), result["parameters"].get("kQ")
    law = result["quadratic_law"]
    codes = sorted({w["code"] for w in result["warnings"]} - COMMON)
    return (f"| {name} | {pair(kT, 1e6, 3)} | {pair(kQ, 1e8, 3)} | {law['misfit_percent_fs']:.2f} | "
            f"{law['with_linear_term_percent_fs']:.2f} | {', '.join(codes)} |")


def table(program, title, groups):
    print(f"\n## {title}\n\n| file | kT [1e-6 N s^2/rad^2] | kQ [1e-8 N m s^2/rad^2] | k Omega^2 | + linear | codes |")
    print("|---|---|---|---|---|---|")
    for name, files in groups:
        print(line(name, *run(program, files)))


def main(program, data):
    data = Path(data)
    print(HEAD.format(data=data).rstrip())
    logs = sorted((data / "esc_test").glob("Log*.csv"))
    table(program, "esc_test", [(f.name, [f]) for f in logs] + [("all four", logs)])
    sweeps = sorted((data / "strawson_1520").glob("*.csv"))
    groups = [(f"motor {m}, {v}.x V, all", [f for f in sweeps if f.name[0] == m and f.stem.endswith(f"_{v}")])
              for m in "ac" for v in ("7", "11")]
    table(program, "strawson_1520", [(f.name, [f]) for f in sweeps] + groups)
    table(program, "uiuc_static", [(f.name, [f]) for f in sorted((data / "uiuc_static").glob("*.txt"))])


if __name__ == "__main__":
    main(*sys.argv[1:])
