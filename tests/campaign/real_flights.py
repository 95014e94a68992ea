#!/usr/bin/python3
"""Refines and diagnoses recordings of real flights and prints data/REAL_FLIGHT.md.

    tests/campaign/real_flights.py build/ident ../shared/data/flight > data/REAL_FLIGHT.md
"""
import csv
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parents[2] / "data"

HEAD = """# `ident flightlog --refine` and `ident gap` on real flights

Recordings of others, read as they are through the maps of [maps](maps), against what a stranger knows of such vehicles
([published](published): `crazyflie_arplab.yaml`, `crazyflie_21.yaml`). Made by

    tests/campaign/real_flights.py build/ident {data} > data/REAL_FLIGHT.md

The recordings are not part of the project; their origin and licences:

| folder | what | source |
|---|---|---|
| `arplab_crazyflie` | a brushed Crazyflie, 1 kHz: commands, rates, specific force | Eschmann, Albani, Loianno, Data-Driven System Identification of Quadrotors Subject to Motor Delays; github arplaboratory/data-driven-system-identification 2d267dd, MIT |
| `nanobench` | a Crazyflie 2.1 under motion capture, 100 Hz | Ullah, Baca; github syediu/nanobench-iros2026 0ae7d68, BSD-3-Clause |
| `neurobem` | a racing quadrotor with rotor speeds, 400 Hz | Bauersfeld, Kaufmann et al., NeuroBEM, RSS 2021 |
| `neuralswarm` | a 67 g quadrotor close to the ground | Shi, Hönig et al., Neural-Swarm, IEEE T-RO 2022 |
| `crazypad` | two Crazyflie 2.1, 100 Hz: commands and velocity, no rates; normal, and one blade cut | Masalimov et al., Data 2024, 9, 79; github AerialRoboticsUUST/CrazyPAD 5448265, MIT |

Values with their 95 % intervals' half width; (..) where a flight does not determine them. The lag of the motors is `2 zeta_m/omega_m`.
Prediction errors are those of held-out flight, in noise standard deviations, 0.1, 0.5 and 1 s ahead, of the model as stated and
as refined. Codes are the warnings of the program that are not said of every log.
"""

COMMON = {"spikes", "correlated", "not_identifiable", "filter_lag", "filtered_noise"}
SHOWN = (("kT", 1e8, 2), ("Jxx", 1e5, 2), ("Jyy", 1e5, 2), ("Jzz", 1e5, 2), ("Jp", 1e8, 1))


def ident(program, *arguments):
    done = subprocess.run([program, *map(str, arguments), "--json"], capture_output=True, text=True)
    return (json.loads(done.stdout), "") if done.returncode == 0 else (None, done.stderr.strip())


def entry(result, name, scale, digits):
    p = result["parameters"].get(name)
    if not p or p.get("std") is None:
        return ""
    text = f"{p['value'] * scale:.{digits}f} ± {1.96 * p['std'] * scale:.{digits}f}"
    return text if p["identifiable"] else f"({text})"


def codes(result):
    return ", ".join(sorted({w["code"] for w in result["warnings"]} - COMMON))


def refined(name, result, error):
    if result is None:
        return f"| {name} | refused: {error.replace('|', '/')} |" + " |" * 8
    value = {k: p["value"] for k, p in result["parameters"].items()}
    horizons = " ".join(f"{h['before']:.3g} → {h['after']:.3g}," for h in result.get("held_out") or
                        result["fit"].get("held_out", [])).rstrip(",")
    lag = f"{2e3 * value['zeta_m'] / value['omega_m']:.0f}" if "zeta_m" in value else ""
    cells = [entry(result, *shown) for shown in SHOWN] + [lag]
    return f"| {name} | " + " | ".join(cells) + f" | {horizons} | {codes(result)} |"


def refinement_head():
    print("\n| flights | kT [1e-8 N s^2/rad^2] | Jxx | Jyy | Jzz [1e-5 kg m^2] | Jp [1e-8] | lag [ms] | predicts | codes |")
    print("|---|---|---|---|---|---|---|---|---|")


def diagnosed(name, result, error):
    if result is None:
        return f"| {name} | refused: {error.replace('|', '/')} | | |"
    verdict = result["verdict"]
    return f"| {name} | {verdict['status']} | {', '.join(verdict['effects'])} | {result['summary']} |"


def diagnosis_head():
    print("\n| flights | verdict | effects | in words |\n|---|---|---|---|")


def solved(A, b):
    """x of A x = b, by elimination."""
    n = len(b)
    rows = [A[i][:] + [b[i]] for i in range(n)]
    for i in range(n):
        for k in range(i + 1, n):
            f = rows[k][i] / rows[i][i]
            rows[k] = [y - f * x for x, y in zip(rows[i], rows[k])]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (rows[i][n] - sum(rows[i][k] * x[k] for k in range(i + 1, n))) / rows[i][i]
    return x


def felt_curve(log, begin, end, mass, lag):
    """Thrust of a rotor, a + b u + c u^2 N: regression of the specific force on commands behind a first-order lag."""
    A, b = [[0.0] * 3 for _ in range(3)], [0.0] * 3
    last, held = None, [0.0] * 4
    with open(log, newline="") as file:
        for row in csv.DictReader(file):
            t = float(row["t_s"])
            share = 1 - math.exp(-(t - last) / lag) if last is not None else 0.0
            held = [u + share * (float(row[f"motor_m{n}_u16"]) / 65535 - u) for n, u in zip((1, 2, 3, 4), held)]
            last = t
            if not begin < t < end:
                continue
            x = [4.0, sum(held), sum(u * u for u in held)]
            force = float(row["acc_z_g"]) * 9.80665 * mass
            for i in range(3):
                b[i] += x[i] * force
                for k in range(3):
                    A[i][k] += x[i] * x[k]
    return solved(A, b)


def arplab(program, data):
    folder, vehicle = data / "arplab_crazyflie", HERE / "published" / "crazyflie_arplab.yaml"

    def arguments(names):
        maps = [word for n in names for word in ("--map", HERE / "maps" / f"arplab_crazyflie_{n}.yaml")]
        return [folder / f"{n}.csv" for n in names] + maps + ["--vehicle", vehicle]

    sets = [["log10", "log15", "log16"], ["log10"], ["log15"], ["log16"]]
    results = [(" ".join(names), ident(program, "flightlog", *arguments(names), "--refine")) for names in sets]
    print("\n## arplab_crazyflie")
    refinement_head()
    for name, result in results:
        print(refined(name, *result))
    print("\nPublished with the flights: lag about 70 ms, Jxx 1.03, Jyy 1.11, Jzz 1.95. Others know such a vehicle with 1.40, 1.44 and"
          " 2.17 at the same mass (simulators) and with 1.66, 1.67 and 2.93 at 28 g (Förster, System Identification of the Crazyflie"
          " 2.0 Nano Quadrocopter, ETH Zurich 2015; the firmware's). In log10 and log16 the motors are off for moments. With those"
          " rows, in which they coast, the moments about roll and pitch come out as published, 1.05 and 1.10, and other flight is"
          " predicted worse than by what was stated; without them (`not_driven`) the logs agree with each other better. In simulated"
          " flights whose motors coast those rows make the moments 14 to 24 % too small"
          " (tests/flight/coasting_test.cc).\n")
    print("Thrust of a rotor by command over the published curve, with its standard deviation:\n")
    print("| flights | command: thrust over the published |\n|---|---|")
    for name, (result, _) in results:
        curve = (result or {}).get("thrust_by_command") or (result or {"fit": {}})["fit"].get("thrust_by_command") or []
        cells = []
        for point in curve:
            u = point["command"]
            published = 0.02127 - 0.01118 * u + 0.12013 * u * u
            cells.append(f"{u:.2f}: {point['thrust'] / published:.3f} ± {point['std'] / published:.3f}")
        print(f"| {name} | {', '.join(cells) or 'none given'} |")
    a, b, c = felt_curve(folder / "log10.csv", 35, 65, 0.027, 0.07)
    felt = [(a + b * u + c * u * u) / (0.02127 - 0.01118 * u + 0.12013 * u * u) for u in (0.3, 0.45, 0.6, 0.75, 0.9)]
    print(f"\nA plain regression of the specific force in log10 on its commands behind a lag of 70 ms, as in the publication, gives"
          f" {min(felt):.3f} to {max(felt):.3f} times the published curve at commands of 0.3 to 0.9: with the stated mass that"
          " much of what is above it is felt by the accelerometer, whatever the model.")
    diagnosis_head()
    for names in sets[1:]:
        print(diagnosed(" ".join(names), *ident(program, "gap", *arguments(names))))


def nanobench(program, data):
    flights = sorted((data / "nanobench").glob("*.csv"))
    common = ["--map", HERE / "maps" / "nanobench_crazyflie.yaml",
              "--vehicle", HERE / "published" / "crazyflie_21.yaml"]
    print("\n## nanobench\n\nBy the description of the recordings thrust per squared duty varies by 27 % over the flights, by 7 % with the voltage.")
    refinement_head()
    for f in flights:
        print(refined(f.stem, *ident(program, "flightlog", f, *common, "--refine")))
    diagnosis_head()
    for f in flights:
        print(diagnosed(f.stem, *ident(program, "gap", f, *common)))
    print(diagnosed("all seven", *ident(program, "gap", *flights, *common)))


def others(program, data):
    print("\n## neurobem and neuralswarm\n\nA racing quadrotor with measured rotor speeds; a 67 g quadrotor close to the ground, commands and battery.")
    refinement_head()
    flights = [data / "neurobem" / "flight_a.csv", *sorted((data / "neuralswarm").glob("*.csv"))]
    for f in flights:
        print(refined(f.stem, *ident(program, "flightlog", f, "--vehicle", f.parent / "vehicle.yaml", "--refine")))
    diagnosis_head()
    for f in flights:
        print(diagnosed(f.stem, *ident(program, "gap", f, "--vehicle", f.parent / "vehicle.yaml")))


def crazypad(program, data):
    folder, known = data / "crazypad", ["--map", HERE / "maps" / "crazypad_crazyflie.yaml"]
    vehicle = HERE / "published" / "crazyflie_21.yaml"
    print("\n## crazypad\n\nAgainst the model that two normal flights of the same vehicle give.")
    diagnosis_head()
    for one in ("E8", "E9"):
        normal = sorted(folder.glob(f"m_normal_flight__{one}_*.csv"))
        others = normal[2:] + sorted(folder.glob(f"m_cut_propeller_*__{one}_*.csv")) + sorted(
            folder.glob(f"m_weight_*__{one}.csv"))
        with tempfile.TemporaryDirectory() as campaign:
            names = ", ".join(json.dumps(str(f.resolve())) for f in normal[:2])
            (Path(campaign) / "ident.yaml").write_text(
                f"vehicle: {vehicle}\nparameters: parameters.yaml\nmap: {known[1]}\nlogs: [{names}]\n")
            done = subprocess.run([str(Path(program).resolve()), "flightlog", "--refine"],
                                  cwd=campaign, capture_output=True, text=True)
            if done.returncode != 0:
                sys.exit(done.stderr)
            for f in others:
                print(diagnosed(f.stem, *ident(program, "gap", f, *known, "--vehicle", vehicle, "--params",
                                               Path(campaign) / "parameters.yaml")))


def main(program, data):
    print(HEAD.format(data=data).rstrip())
    for part in (arplab, nanobench, others, crazypad):
        part(program, Path(data))
        sys.stdout.flush()


if __name__ == "__main__":
    main(*sys.argv[1:])
