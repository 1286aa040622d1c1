"""The section of docs/exports.md on Mitsuba says what was found, also where it is no good news."""

import make_exports


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
        "mitsuba": "3.0", "materials": ["brass"], "variants": ["scalar_rgb"], "command": "x", "sigmas": 4.0, "most_noise": 0.0025,
        "tolerance": {"lamps": tolerance, "map": tolerance}, "rows": rows,
    }  # fmt: skip


def test_the_heading_counts_all_verdicts():
    heading = make_exports.in_mitsuba(record(0.00001)).splitlines()[0]
    assert heading == "## In Mitsuba 3.0: 1 of 3 comparisons agree, 1 is apart, 1 too noisy to tell"


def test_the_table_counts_them_for_every_model_and_light_in_order():
    lines = make_exports.renderers(record(0.00001)).splitlines()[2:]
    assert lines == [
        "| `.bsdf` in `measured` | the network | one lamp | 0 | 0 | 1 | 2.00 % | brass | none |",
        "| `.bsdf` in `measured` | the same table | one lamp | 1 | 0 | 0 | 0.0010 % | brass | none |",
        "| networks, `mitsuba_nbrdf.py` | the network | a map, directions drawn by both | 0 | 1 | 0 | 0.10 % | brass | 0.40 % |",
    ]


def test_resolution_is_named_as_the_cause_only_where_the_table_itself_is_read_alike():
    cause = "what the table's resolution leaves out"
    assert cause in make_exports.in_mitsuba(record(0.00001)) and cause not in make_exports.in_mitsuba(record(0.015))
