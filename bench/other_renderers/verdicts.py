# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Who shows the least error: which images compete, who wins a scene, and how often."""

HANDED_OVER = ("name", "budget_s", "seconds", "samples", "denoised", "picture")
# Beyond it another renderer has rendered something else. Within it noise may take a right one, and
# what renderers do themselves: Russian roulette in LuxCore adds up to 2 %.
MEAN_TOLERANCE = 0.03
DENOISED = ", denoised"  # ends the names of those with a denoiser
LATE = 1.1  # of a budget: images that took longer are late


def judge(images):
    """Marks images of renderers whose mean is off, and late ones. The mean is that of the longest
    rendering, which may be there for that alone. Denoisers may change it: there the same renderer
    without one is asked."""
    means = {}
    for image in sorted(images, key=lambda image: image["budget_s"]):
        means[image["name"]] = image["mean_ratio"]
    for image in images:
        plain = image["name"].removesuffix(DENOISED)
        mean = means.get(plain, means[image["name"]])
        # There is no ratio to a black reference.
        agrees = mean is not None and abs(mean - 1.0) <= MEAN_TOLERANCE
        image["judged_mean"] = mean
        image["comparable"] = plain.startswith("Weft") or agrees
        image["late"] = image["seconds"] > LATE * image["budget_s"]


def best(images, budget, wanted):
    found = [p for p in images if p["budget_s"] == budget and p["comparable"] and wanted(p)]
    return min(found, key=lambda image: image["hdrflip"], default=None)


def winners(images, budget):
    """The best of Weft in time, and of the other renderers without and with a denoiser."""
    own = best(images, budget, lambda p: p["name"].startswith("Weft") and not p["late"])
    plain, denoised = (best(images, budget, lambda p: not p["name"].startswith("Weft")
                            and p["denoised"] == kind) for kind in (False, True))
    return own, plain, denoised


def verdict(images, budget):
    """Of one scene and budget; `wins` is null where there is no other renderer to compare with."""
    own, plain, denoised = winners(images, budget)
    result = {"budget_s": budget, "wins": None, "wins_denoised": None}
    for key, found in (("weft", own), ("peer", plain), ("denoised", denoised)):
        result[key] = found and {"name": found["name"], "hdrflip": found["hdrflip"]}
    if plain:
        result["wins"] = own is not None and own["hdrflip"] < plain["hdrflip"]
    if denoised:
        result["wins_denoised"] = own is not None and own["hdrflip"] < denoised["hdrflip"]
    return result


def handed_over(images, notes):
    """What `weft tradeoff --peers` reads: images of others that show the same light."""
    others = [image for image in images if not image["name"].startswith("Weft")]
    different = sorted({image["name"] for image in others if not image["comparable"]})
    return {"weft_peers": 1,
            "pictures": [{key: image[key] for key in HANDED_OVER if key in image}
                         for image in others if image["comparable"]],
            "notes": notes + [f"{name}: left out, its mean is off by more than "
                              f"{100 * MEAN_TOLERANCE:g} %" for name in different]}


def summary(results, budgets):
    """Over all scenes: how many Weft wins at each budget, and of how many with another renderer."""
    found = {"scenes": len(results)}
    for budget in budgets:
        for key, name in (("wins", "weft_wins"), ("wins_denoised", "weft_wins_denoised")):
            judged = [verdict[key] for result in results for verdict in result["verdicts"]
                      if verdict["budget_s"] == budget and verdict[key] is not None]
            found[f"{name}_{budget:g}s"] = sum(judged) if judged else None
            found[f"{name}_{budget:g}s_of"] = len(judged)
    found["scenes_with_peer"] = sum(any(verdict["peer"] for verdict in result["verdicts"])
                                    for result in results)
    return found
