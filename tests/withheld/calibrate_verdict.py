#!/usr/bin/env python3
"""Coefficients of the probability that a cause found is right (src/ident/gap/verdict/right_name.cc).

    calibrate_verdict.py CAMPAIGN[:ANSWERS] ...

Reads truth and answers of withheld and field campaigns (README.md of either), takes every cause that a diagnosis found with the
quantities that it rests on (`candidates[].why`), and fits a logistic model by maximum a posteriori. With several
campaigns each is predicted by the fit to the others as well. The answers with the true effect taken out count too:
there whatever was found stands in for it.
"""
import json
import math
import pathlib
import sys

# Quantity, its transformation, mean and deviation of its coefficient's prior: as in probability_right().
TERMS = [
    ("base", lambda x: 1.0, 3.0, 1.0),
    ("left", lambda x: max(x["left"], 0.0), -1.9, 0.2),  # of 50 flights with and without their true causes
    ("varies", lambda x: max(x["varies"], -1.0), -1.0, 0.3),
    ("closes", lambda x: x["closes"] - 0.5, 1.0, 0.5),
    ("weak", lambda x: min(x["told"] - 2.5, 0.0), 0.0, 1.5),
]


def rows_of(campaign):
    folder, _, answers = campaign.partition(":")
    folder = pathlib.Path(folder)
    for truth_file in sorted((folder / "truth").glob("*.json")):
        truth = json.loads(truth_file.read_text())
        if "present" in truth:
            yield from rows_of_field(folder / (answers or "answers") / (truth_file.stem + ".gap.json"), truth)
            continue
        names = {e["name"] for e in truth["effects"]}
        also = set(flat(truth["accompanying"]))
        taken_out = set()
        exclude = truth_file.with_suffix(".exclude")
        if exclude.exists():
            taken_out = set(exclude.read_text().strip().split(","))
        for suffix, gone in (("", set()), (".excluded", taken_out)):
            answer_file = folder / (answers or "answers") / (truth_file.stem + suffix + ".json")
            if not answer_file.exists() or answer_file.stat().st_size == 0:
                continue
            answer = json.loads(answer_file.read_text())
            for c in answer.get("candidates", []):
                why = c.get("why")
                if not is_found(why):
                    continue
                right = c["effect"] in (names | also) - gone
                limit = min((e["size_over_limit"] for e in truth["effects"]), default=0)
                yield why, right, truth["kind"] + suffix, c["effect"], truth_file.stem, limit


def is_found(why):
    return why and not why["seen"] and why["beside_left_out"] >= 0.9 and why["in_sets"] >= 0.3


def rows_of_field(answer_file, truth):
    if not answer_file.exists() or answer_file.stat().st_size == 0:
        return
    there = set(truth["present"]) | set(truth["implied"])
    for c in json.loads(answer_file.read_text()).get("candidates", []):
        if is_found(c.get("why")):
            yield c["why"], c["effect"] in there, "plain" if truth["plain"] else "full", c["effect"], answer_file.stem, 0


def flat(x):
    return [x] if isinstance(x, str) else [y for item in x for y in flat(item)]


def solve(A, b):
    """Gauss-Jordan with pivots; A is small and positive definite."""
    n, M = len(b), [row[:] + [v] for row, v in zip(A, b)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda r: abs(M[r][i]))
        M[i], M[pivot] = M[pivot], M[i]
        M[i] = [v / M[i][i] for v in M[i]]
        for r in range(n):
            if r != i:
                M[r] = [v - M[r][i] * w for v, w in zip(M[r], M[i])]
    return [row[n] for row in M]


def stated(x, b):
    return 1 / (1 + math.exp(-sum(v * w for v, w in zip(x, b))))


def fit(X, y):
    n, prior, std = len(TERMS), [t[2] for t in TERMS], [t[3] for t in TERMS]
    b = prior[:]
    for _ in range(50):
        H = [[(i == k) / std[i] ** 2 for k in range(n)] for i in range(n)]
        g = [-(b[i] - prior[i]) / std[i] ** 2 for i in range(n)]
        for x, label in zip(X, y):
            p = stated(x, b)
            for i in range(n):
                g[i] += x[i] * (label - p)
                for k in range(n):
                    H[i][k] += x[i] * x[k] * p * (1 - p)
        b = [v + d for v, d in zip(b, solve(H, g))]
    return b


def main():
    data = {c: list(rows_of(c)) for c in sys.argv[1:]}
    design = {c: [[f(r[0]) for _, f, *_ in TERMS] for r in rows] for c, rows in data.items()}
    label = {c: [float(r[1]) for r in rows] for c, rows in data.items()}
    X = [x for rows in design.values() for x in rows]
    y = [v for rows in label.values() for v in rows]
    b = fit(X, y)
    print(f"{len(y)} causes found, {int(sum(y))} right")
    for (name, *_), value in zip(TERMS, b):
        print(f"{name:8s} {value:+.2f}")
    p = [stated(x, b) for x in X]
    for low in (0.0, 0.2, 0.4, 0.6, 0.8):
        at = [v for v, q in zip(y, p) if low <= q < low + 0.2 + 1e-9]
        if at:
            print(f"stated {low:.1f} to {low + 0.2:.1f}: {len(at):4d} causes, right {sum(at) / len(at):.2f}")
    for c in data if len(data) > 1 else []:
        others = [k for k in data if k != c]
        other = fit([x for k in others for x in design[k]], [v for k in others for v in label[k]])
        q = [stated(x, other) for x in design[c]]
        named = [v for v, w in zip(label[c], q) if w > 0.7]
        missed = [v for v, w in zip(label[c], q) if w <= 0.7]
        print(f"{c}, by the others: named {len(named)}, of these right {int(sum(named))}; "
              f"right and not named {int(sum(missed))}")
    rows = [r for rows in data.values() for r in rows]
    for r, q in sorted(zip(rows, p), key=lambda t: -abs(t[1] - t[0][1]))[:15]:
        print(f"  {r[4]} {r[2]:16s} {r[3]:22s} right {int(r[1])} stated {q:.2f} size {r[5]:.1f} "
              + " ".join(f"{k}={r[0][k]:.2f}" for k in ("left", "varies", "closes", "told")))


if __name__ == "__main__":
    main()
