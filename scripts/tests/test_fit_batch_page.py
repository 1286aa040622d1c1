"""The page of fits of many says what its record says, and the record what both programs did."""

import copy
import json

import pytest

import make_fit_batch
import scale_fit
from nbrdf_jax import data, fit_quality, split

RECORD = json.loads((make_fit_batch.DOCS / "fit_batch.json").read_text())


def test_the_page_is_made_of_the_record_that_lies_beside_it():
    assert (make_fit_batch.DOCS / "fit_batch.md").read_text() == make_fit_batch.page(RECORD)
    assert make_fit_batch.PICTURE.stat().st_size < 200_000


def rows(better: float) -> list[dict]:
    """Two seeds of two materials; errors of `fit_batch.py` are this many times those of `nbrdf fit`."""
    return [
        {"material": name, "by": by, "seed": seed, **{key: (1 + 0.001 * seed) * level * scale for key in fit_quality.KEYS}}
        for name, level in (("brass", 1.0), ("rgl/paper_white", 2.0))
        for by, scale in zip(fit_quality.PROGRAMS, (better, 1.0))
        for seed in (0, 1)
    ]


@pytest.mark.parametrize(("scale", "verdict", "says"), [(1.0, "same", "that of `nbrdf fit` within 10 %"), (1.2, "second", "20.0 % larger"), (0.8, "first", "20.0 % smaller")])
def test_titles_follow_the_figures(merl, rgl, scale, verdict, says):
    quality = fit_quality.compared(rows(scale))
    assert [(row["material"], row["held_out"], row["log_error"]["verdict"]) for row in quality["materials"]] == [("brass", False, verdict), ("rgl/paper_white", True, verdict)]
    assert says in make_fit_batch.finding(quality)
    assert make_fit_batch.page(RECORD | {"quality": RECORD["quality"] | quality}).startswith("# Fitting many materials at once: ")


def test_what_is_not_measured_stays_as_it_is_recorded(tmp_path, monkeypatch):
    out = tmp_path / "fit_batch.json"
    out.write_text(json.dumps({"schema": 2, "quality": {"kept": 1}, "note": "by hand"}))
    monkeypatch.setattr(scale_fit, "DEVICES", (1,))
    report = {"step_of_material_s": {"clock": [3.0, 1.0, 2.0], "processor": [1.0, 0.5, 0.1]}, "seconds": {"compile": 5.0, "targets": 4.0, "judge": 2.0}, "peak_bytes": 3e6, "whole_s": 9.0}
    monkeypatch.setattr(scale_fit, "fit", lambda arguments, devices: copy.deepcopy(report))
    assert scale_fit.main(["scaling", "--most", "10", "-o", str(out)]) == 0
    written = json.loads(out.read_text())
    assert written["quality"] == {"kept": 1} and "note" not in written and written["scaling"]["command"].endswith("scaling --most 10")
    assert [(row["materials"], row["step_of_material_s"], row["processor_s"], row["compile_s"], row["judge_per_material_s"]) for row in written["scaling"]["rows"]] == [(1, 2.0, 0.5, 5.0, 2.0), (10, 2.0, 0.5, 5.0, 0.2)]


@pytest.mark.parametrize("arguments", [["speed"], ["quality", "--seeds", "1"], ["--steps", "0"]])
def test_what_makes_no_sense_is_a_usage_error(arguments):
    with pytest.raises(SystemExit) as stopped:
        scale_fit.main(arguments)
    assert stopped.value.code == 2


def test_materials_of_tables_are_not_held_out(merl, rgl):
    held_out = {*split.held_out(merl, "merl"), *split.held_out(rgl, "rgl")}
    assert not held_out & {name for names in fit_quality.TABLES.values() for name in names}
    assert set(fit_quality.TABLES) == set(data.ARCHIVES)
