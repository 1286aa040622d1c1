"""The section on Mitsuba, of docs/mitsuba.json."""

from collections import Counter, defaultdict

from results_table import fine_percent, table

LIGHTS = {
    "point": "one lamp",
    "studio": "eleven lamps",
    "studio_drawn": "eleven lamps, one drawn for each sample",
    "drawn_by_material": "a map, directions drawn by the material",
    "drawn_by_both": "a map, directions drawn by both",
}
MODELS = {"bsdf": "`.bsdf` in `measured`", "scene": "the exported scene", "plugin": "networks, `mitsuba_nbrdf.py`"}
NETWORKS = {"published": "the published networks", "built-in": "the built-in refits of the published networks"}
AGAINST = {"network": "the network", "table": "the same table"}


def distance(row: dict) -> float:
    """Of the light that is elsewhere where there is no noise, of the means where there is."""
    return row.get("elsewhere", row["difference"])


def renderers(record: dict) -> str:
    """Verdicts and largest differences of every model under every light."""
    kinds = defaultdict(list)
    for row in record["rows"]:
        kinds[row["model"], row["against"], row["light"]].append(row)
    order = lambda kind: [list(names).index(name) for names, name in zip((MODELS, AGAINST, LIGHTS), kind)]  # noqa: E731
    rows = []
    for model, against, light in sorted(kinds, key=order):
        group = kinds[model, against, light]
        worst = max(group, key=distance)
        counts = [str(sum(row["verdict"] == verdict for row in group)) for verdict in ("agrees", "too noisy to tell", "apart")]
        noise = max(row["noise"] for row in group)
        rows.append([
            MODELS[model], AGAINST[against], LIGHTS[light], *counts, fine_percent(distance(worst)), worst["material"],
            fine_percent(noise) if noise else "none",
        ])  # fmt: skip
    return table(["in Mitsuba", "against", "light", "agree", "too noisy", "apart", "largest difference", "of", "largest noise"], rows)


def as_they_come(record: dict) -> str:
    """Which scenes are rendered with the noise of their own sampler."""
    drawn = list(dict.fromkeys(row["material"] for row in record["rows"] if row["light"] == "studio_drawn"))
    if not drawn:
        return ""
    return f"The scenes of {', '.join(drawn)} are also rendered just as `mi.load_file` reads them: they draw one lamp for each sample, and are judged as pictures under a map are. "


def heading(record: dict) -> str:
    """Counts of verdicts."""
    verdicts = Counter(row["verdict"] for row in record["rows"])
    noisy, apart = verdicts["too noisy to tell"], verdicts["apart"]
    return f"{verdicts['agrees']} of {len(record['rows'])} comparisons agree, {apart or 'none'} {'is' if apart == 1 else 'are'} apart, {noisy or 'none'} too noisy to tell"


def section(record: dict) -> str:
    """The section of the comparison with Mitsuba, whatever it found."""
    finding = heading(record)
    codes = [name for name in dict.fromkeys(row["material"] for row in record["rows"]) if name not in record["materials"]]
    besides = f"; {', '.join(codes)}" if codes else ""
    lamps, around = record["tolerance"]["lamps"], record["tolerance"]["map"]
    tables = [row for row in record["rows"] if row["model"] == "bsdf" and "elsewhere" in row]
    stored, read = (max(distance(row) for row in tables if row["against"] == against) for against in AGAINST)
    cause = ": what differs is what the table's resolution leaves out, not how it is read" if read < 0.1 * stored else ""
    every = ""
    if record.get("all"):
        count, worst = record["all"]["materials"], record["all"]["worst"]
        every = f"""
The tables of all {count} materials of MERL, made of {NETWORKS[record["networks"]]}, under both lights in `{record["all"]["variant"]}`: {len(record["all"]["apart"]) or "none"} of {record["all"]["comparisons"]} comparisons apart; the furthest from its
network is `{worst["network"]["material"]}` ({fine_percent(distance(worst["network"]))}), from the same table as nbrdf reads it `{worst["table"]["material"]}` ({fine_percent(distance(worst["table"]))}).
"""
    return f"""## In Mitsuba {record["mitsuba"]}: {finding}

Spheres of {len(record["materials"])} materials ({", ".join(record["materials"])}; {NETWORKS[record["networks"]]}{besides}) in {" and ".join(f"`{name}`" for name in record["variants"])} against `nbrdf render`
(`{record["command"]}`; [mitsuba.json](mitsuba.json)). Under lamps both send one ray through the middle of each pixel, and Mitsuba lights
one lamp at a time, those of the exported scene too: there is no noise, and *difference* is the share of the light that is in another place. {as_they_come(record)}Tables
are shown in the size and under the lamps that their resolution is chosen by; the map is a light that it is not chosen by. Agreed is
within {fine_percent(lamps["table"])} for a table against the network that it was made of, which is what an export allows, and within {fine_percent(lamps["same"])} for
the same reflectance in both. Under a map, where light is drawn by the material, or by material and map together, there is noise, and *difference* is that of the means;
agreed is where it is within {fine_percent(around["table"])} for a table and {fine_percent(around["same"])} for the same reflectance, each plus {record["sigmas"]:.0f} standard errors, and blocks of the picture within theirs, but for as many as chance explains. Where the
standard error (*noise*) is above {fine_percent(record["most_noise"])} of the mean, it is too noisy to tell, and counts as neither.

{renderers(record)}

Under lamps tables in Mitsuba are within {fine_percent(stored)} of their networks, and within {fine_percent(read)} of the same tables as nbrdf reads
them{cause}.
{every}"""
