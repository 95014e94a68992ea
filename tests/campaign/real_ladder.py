#!/usr/bin/python3
"""Errors of prediction on held-out flight of real recordings: as stated, plain least squares, and what ident takes.

    tests/campaign/real_ladder.py build/ident ../shared/data/flight
"""
import json
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parents[2] / "data"

METRICS = (("velocity", "m/s"), ("rate", "rad/s"), ("attitude", "deg"))
SHOWN = ("stated", "thrust", "drag", "air", "full")


def flights(data):
    """Name, log, map or None, vehicle."""
    published, maps = HERE / "published", HERE / "maps"
    yield "neurobem/flight_a", data / "neurobem" / "flight_a.csv", None, data / "neurobem" / "vehicle.yaml"
    for name in ("ground_a", "ground_b"):
        yield (f"neuralswarm/{name}", data / "neuralswarm" / f"{name}.csv", None,
               data / "neuralswarm" / "vehicle.yaml")
    for log in sorted((data / "nanobench").glob("*.csv")):
        yield f"nanobench/{log.stem}", log, maps / "nanobench_crazyflie.yaml", published / "crazyflie_21.yaml"
    for name in ("log10", "log15", "log16"):
        yield (f"arplab/{name}", data / "arplab_crazyflie" / f"{name}.csv",
               maps / f"arplab_crazyflie_{name}.yaml", published / "crazyflie_arplab.yaml")
    for log in sorted((data / "crazypad").glob("m_*.csv")):
        yield f"crazypad/{log.stem}", log, maps / "crazypad_crazyflie.yaml", published / "crazyflie_21.yaml"


def refined(program, log, mapped, vehicle):
    words = [program, "flightlog", log, "--vehicle", vehicle, "--refine", "--json"]
    if mapped:
        words += ["--map", mapped]
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True)
    return (json.loads(done.stdout), "") if done.returncode == 0 else (None, done.stderr.strip())


def cell(errors, metric):
    row = errors[metric]
    return "/".join("–" if e is None else f"{e:.3g}" for e in row)


def rows(name, result):
    ladder = result.get("ladder")
    if not ladder:
        print(f"| {name} | no ladder: neither attitude nor rates were logged, or too little flight |" + " |" * 4)
        return
    rungs = {r["rung"]: r for r in ladder["rungs"]}
    shown = [r for r in SHOWN if r in rungs]
    chosen = ladder["chosen"]
    for rung in shown + ([] if chosen in shown else [chosen]):
        r = rungs[rung]
        said = "**ident**, " if rung == chosen else ""
        why = "" if r["kept"] else f" ({r['why_not']})"
        print(f"| {name} | {said}{rung}{why} | " + " | ".join(cell(r["errors"], m) for m, _ in METRICS) + " |")
    print(f"| {name} | no model | " + " | ".join(cell(ladder["no_model"], m) for m, _ in METRICS) + " |")


def main(program, data):
    print("| flight | model | " + " | ".join(f"{m} {u}" for m, u in METRICS) + " |\n|---|---|---|---|---|")
    estimates = []
    for name, log, mapped, vehicle in flights(Path(data)):
        result, error = refined(program, log, mapped, vehicle)
        if result is None:
            print(f"| {name} | refused: {error.replace('|', '/')} | | | |")
            continue
        rows(name, result)
        sys.stdout.flush()
        ladder = result.get("ladder")
        if ladder:
            found = {r["rung"]: r for r in ladder["rungs"]}[ladder["chosen"]]["parameters"]
            if ladder["chosen"] == "full":
                found = {k: p for k, p in result["parameters"].items() if p["identifiable"]}
            text = ", ".join(f"{k} {p['value']:.3g} ± {1.96 * p['std']:.1g}" for k, p in found.items())
            estimates.append(f"| {name} | {ladder['chosen']} | {text} |")
    print("\n| flight | model taken | constants with the half width of their 95 % intervals |\n|---|---|---|")
    print("\n".join(estimates))


if __name__ == "__main__":
    main(*sys.argv[1:])
