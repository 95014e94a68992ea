"""Runs the program `ident` in a folder of its own and gives its JSON: the notebooks draw, they estimate nothing."""

import atexit
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent
program = pathlib.Path(os.environ.get("IDENT", root / "build" / "ident")).resolve()
folder = pathlib.Path(tempfile.mkdtemp(prefix="ident-notebook-"))
atexit.register(shutil.rmtree, folder, ignore_errors=True)


def ident(*words):
    """The JSON of a command; words as on the command line."""
    done = subprocess.run([program, *map(str, words), "--json"], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)
    return json.loads(done.stdout)


def report(*words):
    """The same with the report's sections: tables and the data of all plots."""
    ident(*words, "--report", "notebook-report.json")
    return json.loads((folder / "notebook-report.json").read_text())


def plot_of(result, title):
    """The first plot with that title, in any section."""
    return next(p for s in result["sections"] for p in s["plots"] if p["title"] == title)


def vehicle(name, source, effects="", **values):
    """Writes a vehicle file from another with some values changed: a number, or a value and its deviation."""
    text = source.read_text()
    for key, value in values.items():
        new = f"{{value: {value[0]}, std: {value[1]}}}" if isinstance(value, tuple) else str(value)
        text, found = re.subn(rf"(?m)^( *{key}:).*$", rf"\g<1> {new}", text)
        assert found == 1, key
    (folder / name).write_text(text.rstrip() + "\n" + effects)
    return name


def values_of(path):
    """Numbers of a vehicle file under their names."""
    pairs = re.findall(r"(?m)^ *([\w.]+): ([-+.\de]+) *(?:#.*)?$", path.read_text())
    return {name: float(value) for name, value in pairs}


def table(head, rows):
    """Prints a table; cells are text."""
    widths = [max(len(row[c]) for row in [head, *rows]) for c in range(len(head))]
    for row in [head, *rows]:
        print("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())


def style():
    """Plots as in the reports: measured grey and thin, under what is predicted."""
    import matplotlib.pyplot as plt

    plt.rcParams.update({
        "figure.figsize": (8, 3),
        "figure.dpi": 80,
        "figure.constrained_layout.use": True,
        "axes.grid": True,
        "axes.axisbelow": True,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.prop_cycle": plt.cycler(color=["#0b6bb0", "#c2500a", "#00785a", "#9c3f7d"]),
        "grid.color": "#e8ebee",
    })
    return plt


grey = "#868e96"
