# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Who shows the least error: which pictures compete, who wins a scene, and how often."""

HANDED_OVER = ("name", "budget_s", "seconds", "samples", "denoised", "picture")
# Beyond it a peer has rendered something else. Within it noise may take a right one, and what
# renderers do themselves: Russian roulette in LuxCore adds up to 2 %.
MEAN_TOLERANCE = 0.03
DENOISED = ", denoised"  # ends the names of those with a denoiser
LATE = 1.1  # of a budget: pictures that took longer are late
JUDGED = (0.3, 1.0)  # budgets of the summary


def judge(pictures):
    """Marks pictures of renderers whose mean is off, and late ones. The mean is that of the longest
    rendering, which may be there for that alone. Denoisers may change it: there the same renderer
    without one is asked."""
    means = {}
    for picture in sorted(pictures, key=lambda picture: picture["budget_s"]):
        means[picture["name"]] = picture["mean_ratio"]
    for picture in pictures:
        plain = picture["name"].removesuffix(DENOISED)
        mean = means.get(plain, means[picture["name"]])
        # There is no ratio to a black reference.
        agrees = mean is not None and abs(mean - 1.0) <= MEAN_TOLERANCE
        picture["judged_mean"] = mean
        picture["comparable"] = plain.startswith("Weft") or agrees
        picture["late"] = picture["seconds"] > LATE * picture["budget_s"]


def best(pictures, budget, wanted):
    found = [p for p in pictures if p["budget_s"] == budget and p["comparable"] and wanted(p)]
    return min(found, key=lambda picture: picture["hdrflip"], default=None)


def winners(pictures, budget):
    """The best of Weft in time, and of the peers without and with a denoiser."""
    own = best(pictures, budget, lambda p: p["name"].startswith("Weft") and not p["late"])
    plain, denoised = (best(pictures, budget, lambda p: not p["name"].startswith("Weft")
                            and p["denoised"] == kind) for kind in (False, True))
    return own, plain, denoised


def verdict(pictures, budget):
    """Of one scene and budget; `wins` is null where there is no peer to compare with."""
    own, plain, denoised = winners(pictures, budget)
    result = {"budget_s": budget, "wins": None, "wins_denoised": None}
    for key, found in (("weft", own), ("peer", plain), ("denoised", denoised)):
        result[key] = found and {"name": found["name"], "hdrflip": found["hdrflip"]}
    if plain:
        result["wins"] = own is not None and own["hdrflip"] < plain["hdrflip"]
    if denoised:
        result["wins_denoised"] = own is not None and own["hdrflip"] < denoised["hdrflip"]
    return result


def handed_over(pictures, notes):
    """What `weft tradeoff --peers` reads: pictures of others that show the same light."""
    others = [picture for picture in pictures if not picture["name"].startswith("Weft")]
    different = sorted({picture["name"] for picture in others if not picture["comparable"]})
    return {"weft_peers": 1,
            "pictures": [{key: picture[key] for key in HANDED_OVER if key in picture}
                         for picture in others if picture["comparable"]],
            "notes": notes + [f"{name}: left out, its mean is off by more than "
                              f"{100 * MEAN_TOLERANCE:g} %" for name in different]}


def summary(results):
    """Over all scenes: how many Weft wins, and of how many with a peer."""
    found = {"scenes": len(results)}
    for budget in JUDGED:
        for key, name in (("wins", "weft_wins"), ("wins_denoised", "weft_wins_denoised")):
            judged = [verdict[key] for result in results for verdict in result["verdicts"]
                      if verdict["budget_s"] == budget and verdict[key] is not None]
            found[f"{name}_{budget:g}s"] = sum(judged) if judged else None
            found[f"{name}_{budget:g}s_of"] = len(judged)
    found["scenes_with_peer"] = sum(any(verdict["peer"] for verdict in result["verdicts"])
                                    for result in results)
    return found
