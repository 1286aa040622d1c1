import json

import numpy as np
import pytest

import evaluate
from nbrdf_jax import autoencoder, interpolation, library, split
from nbrdf_jax.evaluation import of_network
from nbrdf_jax.judge import KEYS, Seen, figures
from nbrdf_jax.learned import Learned
from nbrdf_jax.refine import Refiner
from nbrdf_jax.walk_quality import KEYS as WALK_KEYS


def row(variant, names, codes, found):
    stats = {key: {"mean": float(np.mean([one[key] for one in found]))} for key in KEYS}
    materials = [{"name": name, "code": [float(x) for x in code]} | one for name, code, one in zip(names, codes, found)]
    return {"name": "znbrdf", "variant": variant, "database": "merl", **stats, "materials": materials}


@pytest.fixture(scope="module")
def honest(module_networks, module_checkpoint):
    """A report whose numbers are right, by construction, as text."""
    model, read = autoencoder.read(module_checkpoint), library.read(module_networks)
    learned = Learned(read, read, model)
    names = split.held_out(read, "merl")
    codes = np.stack([learned.encode(read[name]) for name in names])

    def judged(codes):
        return [figures(Seen.of(of_network(read[name])), Seen.of(learned.decoded("znbrdf", code))) for name, code in zip(names, codes)]

    variants = (("unrolled", codes - 0.1), ("feed_forward", codes), ("refined", codes + 0.1))
    rows = [row(variant, names, own, judged(own)) for variant, own in variants]
    other = {"name": "pca_45", "variant": "projection", "log_error": {"mean": 1.0}}
    return json.dumps({"schema": 1, "reference": "builtin", "rows": [other, *rows]})


def run(content, networks, checkpoint, tmp_path, *more):
    path = tmp_path / "evaluate.json"
    path.write_text(content if isinstance(content, str) else json.dumps(content))
    fixed = ["--report", str(path), "--checkpoint", str(checkpoint), "--networks", str(networks), "--shared", str(networks), "-o", str(tmp_path / "out")]
    return evaluate.main([*fixed, *more])


def test_an_honest_report_is_confirmed_on_a_page_that_holds_everything(honest, module_networks, module_checkpoint, tmp_path, capsys):
    assert run(honest, module_networks, module_checkpoint, tmp_path) == 0
    out = capsys.readouterr().out
    assert "unrolled" in out and "feed_forward" in out and "refined" in out and "DISAGREES" not in out
    page = (tmp_path / "out" / "report.html").read_text()
    assert "<svg" in page and "src=" not in page and "href=\"http" not in page
    assert "report-1.svg" in (tmp_path / "out" / "report.md").read_text()


@pytest.mark.parametrize(("which", "key"), [(1, "log_error"), (2, "studio_psnr"), (3, "point_flip")])
def test_a_wrong_mean_is_caught(honest, module_networks, module_checkpoint, tmp_path, capsys, which, key):
    wrong = json.loads(honest)
    wrong["rows"][which][key]["mean"] *= 1.01
    assert run(wrong, module_networks, module_checkpoint, tmp_path) == 1
    assert "DISAGREES" in capsys.readouterr().out


def test_a_larger_tolerance_admits_more(honest, module_networks, module_checkpoint, tmp_path):
    wrong = json.loads(honest)
    wrong["rows"][1]["log_error"]["mean"] *= 1.01
    assert run(wrong, module_networks, module_checkpoint, tmp_path, "--tolerance", "0.02") == 0


def test_a_refined_code_that_is_not_the_one_measured_is_caught(honest, module_networks, module_checkpoint, tmp_path):
    wrong = json.loads(honest)
    wrong["rows"][3]["materials"][0]["code"][0] += 1.0
    assert run(wrong, module_networks, module_checkpoint, tmp_path) == 1


def test_a_missing_held_out_material_is_refused(honest, module_networks, module_checkpoint, tmp_path, capsys):
    wrong = json.loads(honest)
    wrong["rows"][2]["materials"].pop()
    assert run(wrong, module_networks, module_checkpoint, tmp_path) == 3
    assert "m7" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "says"),
    [("", "JSON"), ("{}", "schema"), ('{"schema": 2}', "schema"), ('{"schema": 1, "reference": "builtin", "rows": []}', "znbrdf"),
     ('{"schema": 1, "reference": "builtin", "split": "validation", "rows": []}', "held_out"),
     ('{"schema": 1, "reference": "builtin", "rows": [{"name": "znbrdf", "variant": "refined"}]}', "log_error")],
)  # fmt: skip
def test_an_invalid_report_is_named_with_exit_code_3(text, says, module_networks, module_checkpoint, tmp_path, capsys):
    assert run(text, module_networks, module_checkpoint, tmp_path) == 3
    error = capsys.readouterr().err
    assert "evaluate.json" in error and says in error


def test_missing_files_are_named_with_exit_code_3(honest, module_networks, module_checkpoint, tmp_path, capsys):
    for networks, checkpoint in ((tmp_path / "none.zip", module_checkpoint), (module_networks, tmp_path / "none.safetensors")):
        assert run(honest, networks, checkpoint, tmp_path) == 3
        assert "no such file" in capsys.readouterr().err


def test_a_builtin_reference_needs_its_library(honest, module_checkpoint, tmp_path, capsys):
    path = tmp_path / "evaluate.json"
    path.write_text(honest)
    assert evaluate.main(["--report", str(path), "--checkpoint", str(module_checkpoint)]) == 3
    assert "--networks" in capsys.readouterr().err


def test_without_the_program_there_are_no_reports(tmp_path, capsys):
    assert evaluate.main(["--binary", str(tmp_path / "none"), "-o", str(tmp_path)]) == 3
    assert "cargo build" in capsys.readouterr().err


def test_a_comparison_of_walks_is_confirmed_and_a_wrong_one_caught(honest, module_networks, module_checkpoint, tmp_path, capsys):
    read = library.read(module_networks)
    learned = Learned(read, read, autoencoder.read(module_checkpoint))
    walks = interpolation.recompute(learned, ["raw_weights", "log1p_mix"], {}, 1)

    def method(found):
        spreads = {key: {part: getattr(found.spread(key), part) for part in ("mean", "median", "p90", "max")} for key in WALK_KEYS}
        return {"name": found.name, **spreads, "energy_violations": found.violations(), "energy_violations_beyond": found.violations("albedo_max_beyond")}

    content = {"schema": 1, "reference": "builtin", "pairs": 1, "methods": [*map(method, walks), method(walks[0]) | {"name": "charting"}]}
    path = tmp_path / "compare.json"
    path.write_text(json.dumps(content))
    assert run(honest, module_networks, module_checkpoint, tmp_path, "--compare", str(path)) == 0
    assert "raw_weights" in capsys.readouterr().out
    content["methods"][0]["mix_ssim"]["p90"] *= 1.001
    path.write_text(json.dumps(content))
    assert run(honest, module_networks, module_checkpoint, tmp_path, "--compare", str(path)) == 1


def test_a_page_that_prints_what_was_found_holds_and_a_doctored_one_is_an_error(honest, module_networks, module_checkpoint, tmp_path, capsys):
    means = {row["variant"]: row["studio_psnr"]["mean"] for row in json.loads(honest)["rows"] if row["name"] == "znbrdf"}
    rows = [f"| `znbrdf` {variant.replace('_', '-')} | {mean:.3f} |" for variant, mean in means.items()]
    against = ["against PCA-32's projection", "The encoder alone against it", "against PCA-32's *refined* codes"]
    text = ["## In short", "", *(f"- {start}: log_error 1.00 ×." for start in against), "- Nothing else.", "", "## Representations, 20 held-out MERL materials", "", "| representation | studio PSNR |", "| --- | ---: |", *rows, ""]
    page = tmp_path / "results.md"
    for content, code, says in (
        ("\n".join(text), 0, "3 printed figures hold, 0 hold within a stated allowance, 0 do not hold, 3 were not recomputed"),
        ("\n".join(text).replace(f"{means['refined']:.3f}", f"{means['refined'] + 0.1:.3f}"), 1, "DOES NOT HOLD"),
        ("\n".join(text).replace("unrolled", "rolled"), 1, "prints nothing of the kind"),
    ):
        page.write_text(content)
        assert run(honest, module_networks, module_checkpoint, tmp_path, "--results", str(page)) == code
        assert says in capsys.readouterr().out


def test_a_record_is_of_everything(tmp_path, capsys):
    with pytest.raises(SystemExit) as exit:
        evaluate.main(["--quick", "--record", str(tmp_path / "agreement.json")])
    assert exit.value.code == 2 and "everything" in capsys.readouterr().err


def test_refining_makes_a_code_better_and_a_refined_one_hardly_worse(module_networks, module_checkpoint):
    read = library.read(module_networks)
    learned = Learned(read, read, autoencoder.read(module_checkpoint))
    material = of_network(learned.decode(np.linspace(-1, 1, 11)))
    refiner = Refiner(learned.model)

    def error(code):
        return figures(Seen.of(material), Seen.of(learned.decoded("znbrdf", code)))["log_error"]

    start = np.linspace(-1, 1, 11) + 0.3
    assert error(refiner(start, material)) < 0.3 * error(start)
    assert error(refiner(np.linspace(-1, 1, 11), material)) < 1e-3


def test_a_published_material_is_no_distance_from_itself(merl):
    for name in split.held_out(merl, "merl")[:2]:
        seen = Seen.of(of_network(merl[name]))
        found = figures(seen, seen)
        assert found["log_error"] == found["studio_flip"] == 0 and found["point_psnr"] == 100 and found["studio_ssim"] == pytest.approx(1)
