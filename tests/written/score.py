#!/usr/bin/env python3
# Compares the answers of run.sh with the true constants: the log of each autopilot beside the CSVs of the same flight.
#
#   score.py DIR [FLIGHT...]    --messages: also the text of every warning
import json
import pathlib
import sys

SOURCES = ("log", "full.csv", "commands.csv")


def answer(folder, source):
    """Exit status, seconds and result of the refinement of one file."""
    files = sorted((folder / "answers").glob(source + "*.refine.exit" if source == "log" else source + ".refine.exit"))
    if not files:
        return None
    stem = str(files[0])[: -len(".exit")]
    text = pathlib.Path(stem + ".out").read_text()
    return {
        "name": pathlib.Path(stem).name[: -len(".refine")],
        "exit": files[0].read_text().strip(),
        "seconds": pathlib.Path(stem + ".seconds").read_text().strip(),
        "result": json.loads(text) if text.strip() else {"parameters": {}, "warnings": []},
        "messages": pathlib.Path(stem + ".messages").read_text(),
    }


def cell(entry, truth):
    if entry is None:
        return f"{'-':>34}"
    low, high = entry.get("ci95") or (float("nan"), float("nan"))
    half = (high - low) / 2
    std = half / 1.96
    deviations = (entry["value"] - truth) / std if std > 0 else float("nan")
    mark = " " if entry.get("identifiable") else "?"
    if entry.get("identifiable") and abs(deviations) > 3:
        mark = "!"
    return f"{entry['value']:>12.5g}{mark}+-{half:>9.2g}{deviations:>8.1f}"


def commands(folder):
    lines = []
    for path in sorted((folder / "answers").glob("*.exit")):
        kind = path.name[: -len(".exit")].rsplit(".", 1)[1]
        if kind == "refine":
            continue
        stem = str(path)[: -len(".exit")]
        texts = pathlib.Path(stem + ".out").read_text(errors="replace").strip().splitlines()
        first = next((line for line in texts if len(line) > 12), "")[:110] if kind != "streams" else ""
        seconds = pathlib.Path(stem + ".seconds").read_text().strip()
        lines.append(f"  {kind:8} exit {path.read_text().strip()}  {seconds:>4} s  {first}")
    return lines


def show(folder, with_messages):
    truth = json.loads((folder / "truth.json").read_text())
    answers = [a for a in (answer(folder, source) for source in SOURCES) if a]
    print(f"\n== {folder.name}   value, 95 % half width, deviations from the truth")
    print("   ? not identifiable; ! identifiable and beyond 3 deviations")
    for a in answers:
        codes = ", ".join(w["code"] for w in a["result"].get("warnings", []))
        print(f"  {a['name']}: exit {a['exit']}, {a['seconds']} s; warnings: {codes or 'none'}")
    print(f"  {'':9}{'truth':>11}" + "".join(f"{a['name']:>34}" for a in answers))
    names = list(truth) + sorted({n for a in answers for n in a["result"]["parameters"]} - set(truth))
    for name in names:
        row = [cell(a["result"]["parameters"].get(name), truth.get(name, 0.0)) for a in answers]
        stated = f"{truth[name]:>11.5g}" if name in truth else f"{'(none)':>11}"
        print(f"  {name[:22]:9}{stated}" + "".join(row))
    print("\n".join(commands(folder)))
    if with_messages:
        for a in answers:
            for warning in a["result"].get("warnings", []):
                print(f"  [{a['name']}] {warning['code']}: {warning['message']}")
            print(f"  [{a['name']}] stderr: {a['messages'].strip()}")


def main(arguments):
    with_messages = "--messages" in arguments
    arguments = [a for a in arguments if a != "--messages"]
    if not arguments:
        print("usage: score.py DIR [FLIGHT...] [--messages]", file=sys.stderr)
        return 2
    root = pathlib.Path(arguments[0])
    for folder in sorted(p for p in root.iterdir() if (p / "truth.json").exists()):
        if not arguments[1:] or folder.name in arguments[1:]:
            show(folder, with_messages)
    return 0


sys.exit(main(sys.argv[1:]))
