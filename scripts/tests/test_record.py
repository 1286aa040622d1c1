import json

import pytest

import record_ablation
import record_seeds
import record_sizes


def report(error, order=1, split="held_out"):
    rows = [
        {"name": "znbrdf", "variant": variant, "database": "merl", "count": 20} | {key: {"mean": error and error * scale} for key in record_seeds.KEYS}
        for variant, scale in (("unrolled", 1.0), ("refined", 0.5))
    ]
    return {"schema": 1, "reference": "published", "split": split, "rows": rows[::order]}


def test_rows_are_joined_by_what_they_are_and_not_by_their_place(tmp_path):
    (tmp_path / "seed-10.json").write_text(json.dumps(report(3.0, order=-1)))
    (tmp_path / "seed-2.json").write_text(json.dumps(report(1.0)))
    out = tmp_path / "out.json"
    assert record_seeds.main([str(tmp_path), "24000"], out) == 0
    recorded = json.loads(out.read_text())
    assert (recorded["seeds"], recorded["steps"]) == ([2, 10], 24000)
    assert [row["log_error"]["mean"] for row in recorded["rows"]] == [2.0, 1.0]
    assert recorded["rows"][0]["log_error"]["sd"] == pytest.approx(2**0.5)


@pytest.mark.parametrize("second", [None, "", "[]", '{"rows": [{}]}', json.dumps(report(1.0) | {"rows": report(1.0)["rows"][:1]}), json.dumps(report(None)), json.dumps(report(1.0, split="validation"))])
def test_what_is_no_report_is_named_with_exit_code_3(second, tmp_path, capsys):
    (tmp_path / "seed-0.json").write_text(json.dumps(report(1.0)))
    if second is not None:
        (tmp_path / "seed-1.json").write_text(second)
    assert record_seeds.main([str(tmp_path), "24000"], tmp_path / "out.json") == 3
    assert ("seed-1.json" if second is not None else "two reports") in capsys.readouterr().err
    assert not (tmp_path / "out.json").exists()


def test_an_ablation_holds_pca_once_and_znbrdf_for_every_length(tmp_path):
    for steps, error in ((8000, 2.0), (24000, 1.0)):
        read = report(error, split="validation")
        read["rows"].append({**read["rows"][0], "name": "pca_tables", "variant": "projection"})
        (tmp_path / f"steps-{steps}.json").write_text(json.dumps(read))
    out = tmp_path / "out.json"
    assert record_ablation.main([str(tmp_path)], out) == 0
    rows = json.loads(out.read_text())["rows"]
    assert [(row["name"], row.get("steps"), row["log_error"]) for row in rows] == [
        ("znbrdf", 8000, 2.0), ("znbrdf", 8000, 1.0), ("pca_tables", None, 2.0), ("znbrdf", 24000, 1.0), ("znbrdf", 24000, 0.5),
    ]  # fmt: skip
    (tmp_path / "empty").mkdir()
    assert record_ablation.main([str(tmp_path / "empty")], out) == 3


def test_codes_of_every_length_are_recorded_by_rising_length(tmp_path):
    for dim, error in ((32, 1.0), (4, 3.0)):
        (tmp_path / f"size-{dim}.json").write_text(json.dumps(report(error)))
    out = tmp_path / "out.json"
    assert record_sizes.main([str(tmp_path), "8000"], out) == 3, "without the codes that are compared"
    for name in ("plain", "ordered"):
        (tmp_path / f"{name}.json").write_text(json.dumps(report(1.0, split="validation")))
    assert record_sizes.main([str(tmp_path), "8000"], out) == 0
    recorded = json.loads(out.read_text())
    assert [(row["dim"], row["unrolled"]["log_error"], row["refined"]["log_error"]) for row in recorded["rows"]] == [(4, 3.0, 1.5), (32, 1.0, 0.5)]
    (tmp_path / "empty").mkdir()
    assert record_sizes.main([str(tmp_path / "empty"), "8000"], out) == 3
