"""The section of docs/exports.md on Mitsuba says what was found, also where it is no good news."""

import exports_mitsuba


def row(model: str, against: str, light: str, verdict: str, **figures: float) -> dict:
    return {"material": "brass", "model": model, "against": against, "light": light, "verdict": verdict, "noise": 0.0, "difference": 0.001} | figures


def record(table: float) -> dict:
    tolerance = {"same": 0.0001, "table": 0.01}
    rows = [
        row("plugin", "network", "drawn_by_both", "too noisy to tell", noise=0.004),
        row("bsdf", "table", "point", "agrees", elsewhere=table),
        row("bsdf", "network", "point", "apart", elsewhere=0.02),
    ]
    return {
        "mitsuba": "3.0", "networks": "published", "materials": ["brass"], "variants": ["scalar_rgb"], "command": "x", "sigmas": 4.0, "most_noise": 0.0025,
        "tolerance": {"lamps": tolerance, "map": tolerance}, "rows": rows,
    }  # fmt: skip


def test_the_heading_counts_all_verdicts():
    heading = exports_mitsuba.section(record(0.00001)).splitlines()[0]
    assert heading == "## In Mitsuba 3.0: 1 of 3 comparisons agree, 1 is apart, 1 too noisy to tell"


def test_the_table_counts_them_for_every_model_and_light_in_order():
    lines = exports_mitsuba.renderers(record(0.00001)).splitlines()[2:]
    assert lines == [
        "| `.bsdf` in `measured` | the network | one lamp | 0 | 0 | 1 | 2.00 % | brass | none |",
        "| `.bsdf` in `measured` | the same table | one lamp | 1 | 0 | 0 | 0.0010 % | brass | none |",
        "| networks, `mitsuba_nbrdf.py` | the network | a map, directions drawn by both | 0 | 1 | 0 | 0.10 % | brass | 0.40 % |",
    ]


def test_it_says_which_networks_the_tables_were_made_of():
    every = {"materials": 100, "variant": "llvm_ad_rgb", "comparisons": 400, "apart": [], "worst": {"network": record(0.0)["rows"][2], "table": record(0.0)["rows"][1]}}
    for networks, named in exports_mitsuba.NETWORKS.items():
        text = exports_mitsuba.section(record(0.0) | {"networks": networks, "all": every})
        assert f"(brass; {named})" in text and f"all 100 materials of MERL, made of {named}, under" in text


def test_it_names_the_scenes_that_are_rendered_as_they_come_if_there_are_any():
    rows = record(0.0)["rows"]
    drawn = rows + [row("scene", against, "studio_drawn", "agrees", noise=0.002) for against in ("network", "table")]
    said = "The scenes of brass are also rendered just as"
    assert said in exports_mitsuba.section(record(0.0) | {"rows": drawn}) and "just as" not in exports_mitsuba.section(record(0.0))


def test_resolution_is_named_as_the_cause_only_where_the_table_itself_is_read_alike():
    cause = "what the table's resolution leaves out"
    assert cause in exports_mitsuba.section(record(0.00001)) and cause not in exports_mitsuba.section(record(0.015))
