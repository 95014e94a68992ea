#!/usr/bin/env python3
"""Tables of a scored campaign: summarise.py DIR [ANSWERS]."""
import json
import pathlib
import statistics
import sys

TARGET_RATIO = 1.2  # of the error after to that of the best model
TARGETS = ("gz", "px4-sih", "rotorpy", "mujoco")


def median(values):
    return statistics.median(values) if values else float("nan")


def load(folder, answers):
    for path in sorted((folder / f"scores_of_{answers}").glob("[0-9]*.json")):
        score = json.loads(path.read_text())
        answer = folder / answers / path.stem
        score["seconds"] = float((answer / "seconds").read_text())
        text = (answer / "answer.json").read_text()
        score["verdict"] = json.loads(text).get("verdict", {}) if text else {"status": "error"}
        yield score


def case_line(score):
    p, c = score["prediction"], score["closed_loop"]

    def flown(which):
        return "crash" if c[which]["crashed"] else f'{c[which]["rms"]:.3f}'

    verdict = ": ".join(filter(None, [score["verdict"].get("status", ""),
                                      ", ".join(score["verdict"].get("effects", []))]))
    if not score["file_changed"]:
        verdict += " (file as it was)"
    cells = [f'{score["case"]:d}', score["target"], ", ".join(score["effects"]), verdict,
             *(f'{p[k]["pooled"]:.3f}' for k in ("before", "after", "best")), f'{p["after_over_best"]:.2f}',
             *(flown(k) for k in ("before", "after", "truth_reduced")), f'{score["seconds"]:.1f}']
    return "| " + " | ".join(cells) + " |"


def target_line(name, scores):
    ratio = [s["prediction"]["after_over_best"] for s in scores]
    gain = [s["prediction"]["before_over_after"] for s in scores]
    loops = [s["closed_loop"] for s in scores]
    better = sum(not c["after"]["crashed"] and (c["before"]["crashed"] or c["after"]["rms"] < c["before"]["rms"])
                 for c in loops)
    crashes = [sum(c[k]["crashed"] for c in loops) for k in ("before", "after")]
    held = sum(r <= TARGET_RATIO for r in ratio)
    return (f"| {name} | {len(scores)} | {held} | {median(ratio):.2f} | {max(ratio):.2f} | {median(gain):.1f} "
            f"| {sum(g > 1 for g in gain)} | {better} | {crashes[0]} | {crashes[1]} "
            f'| {median([s["seconds"] for s in scores]):.1f} |')


def main():
    folder = pathlib.Path(sys.argv[1])
    scores = list(load(folder, sys.argv[2] if len(sys.argv) > 2 else "answers"))
    print("| target | cases | after/best <= 1.2 | median | worst | before/after, median | predicts better "
          "| tracks better | crashes before | after | s a case, median |")
    print("|" + "---|" * 11)
    for target in TARGETS:
        of_target = [s for s in scores if s["target"] == target]
        if of_target:
            print(target_line(target, of_target))
    print(target_line("all", scores))
    print("\n| case | target | effects | verdict | before | after | best | after/best | tracking before, m | after "
          "| tuned on the truth | s |")
    print("|" + "---|" * 12)
    for score in scores:
        print(case_line(score))


if __name__ == "__main__":
    main()
