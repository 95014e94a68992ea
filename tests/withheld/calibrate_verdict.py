#!/usr/bin/env python3
"""Coefficients of the probability that a cause found is right (src/ident/gap/verdict/right_name.cc).

    calibrate_verdict.py CAMPAIGN[:ANSWERS] ...

Reads truth and answers of withheld campaigns (README.md), takes every cause that a diagnosis found with the
quantities that it rests on (`candidates[].why`), and fits a logistic model by maximum a posteriori. With several
campaigns each is predicted by the fit to the others as well. The answers with the true effect taken out count too:
there whatever was found stands in for it.
"""
import json
import pathlib
import sys

import numpy as np

# Quantity, and its transformation: as in probability_right().
TERMS = [
    ("base", lambda x: 1.0),
    ("left", lambda x: x["left"] + 3),
    ("varies", lambda x: x["varies"] + 1),
    ("closes", lambda x: x["closes"] - 0.5),
    ("told", lambda x: x["told"] - 3),
    ("beside", lambda x: max(x["beside"] - 1, 0.0)),
]
PRIOR_STD = 1.5  # of each coefficient about zero


def rows_of(campaign):
    folder, _, answers = campaign.partition(":")
    folder = pathlib.Path(folder)
    for truth_file in sorted((folder / "truth").glob("*.json")):
        truth = json.loads(truth_file.read_text())
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
                if not why or why["seen"] or why["look_alike_untried"] or why["in_sets"] < 0.05:
                    continue
                right = c["effect"] in (names | also) - gone
                limit = min((e["size_over_limit"] for e in truth["effects"]), default=0)
                yield why, right, truth["kind"] + suffix, c["effect"], truth_file.stem, limit


def flat(x):
    return [x] if isinstance(x, str) else [y for item in x for y in flat(item)]


def fit(X, y):
    b = np.zeros(X.shape[1])
    for _ in range(50):
        p = 1 / (1 + np.exp(-X @ b))
        H = X.T @ (X * (p * (1 - p))[:, None]) + np.eye(len(b)) / PRIOR_STD**2
        b += np.linalg.solve(H, X.T @ (y - p) - b / PRIOR_STD**2)
    return b


def main():
    data = {c: list(rows_of(c)) for c in sys.argv[1:]}
    design = {c: np.array([[f(r[0]) for _, f in TERMS] for r in rows]).reshape(-1, len(TERMS)) for c, rows in data.items()}
    label = {c: np.array([float(r[1]) for r in rows]) for c, rows in data.items()}
    X, y = np.vstack(list(design.values())), np.concatenate(list(label.values()))
    b = fit(X, y)
    print(f"{len(y)} causes found, {int(y.sum())} right")
    for (name, _), value in zip(TERMS, b):
        print(f"{name:8s} {value:+.2f}")
    p = 1 / (1 + np.exp(-X @ b))
    for low in np.arange(0, 1, 0.2):
        at = (p >= low) & (p < low + 0.2 + 1e-9)
        if at.any():
            print(f"stated {low:.1f} to {low + 0.2:.1f}: {at.sum():4d} causes, right {y[at].mean():.2f}")
    for c in data:
        if len(data) > 1 and len(label[c]):
            others = [k for k in data if k != c]
            other = fit(np.vstack([design[k] for k in others]), np.concatenate([label[k] for k in others]))
            q = 1 / (1 + np.exp(-design[c] @ other))
            print(f"{c}, by the others: named {int((q > 0.8).sum())}, of these right {int(label[c][q > 0.8].sum())}; "
                  f"right and not named {int(label[c][q <= 0.8].sum())}")
    rows = [r for rows in data.values() for r in rows]
    for r, q in sorted(zip(rows, p), key=lambda t: abs(t[1] - t[0][1]), reverse=True)[:15]:
        print(f"  {r[4]} {r[2]:16s} {r[3]:22s} right {int(r[1])} stated {q:.2f} size {r[5]:.1f} "
              + " ".join(f"{k}={r[0][k]:.2f}" for k in ("left", "varies", "closes", "told", "beside")))


if __name__ == "__main__":
    main()
