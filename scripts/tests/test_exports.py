"""What `nbrdf export` writes, read by others: h5py and NumPy; and the record of how far exports are from their sources."""

import json

import h5py
import numpy as np
import pytest

import record_exports


def test_h5py_reads_the_weights_of_a_keras_file_to_the_bit_and_where_keras_looks_for_them(exported):
    arrays = np.load(exported / "chrome.npz")
    with h5py.File(exported / "chrome.h5") as file:
        layers = [name.decode() for name in file.attrs["layer_names"]]
        assert layers == ["dense_1", "dense_2", "dense_3"]
        for index, layer in enumerate(layers, 1):
            names = [name.decode() for name in file[layer].attrs["weight_names"]]
            kernel, bias = (file[layer][name] for name in names)
            assert kernel.dtype == bias.dtype == np.float32
            np.testing.assert_array_equal(kernel, arrays[f"fc{index}"])
            np.testing.assert_array_equal(bias, arrays[f"b{index}"])


def test_the_architecture_beside_it_is_plain_and_of_the_same_shapes(exported):
    model = json.loads((exported / "chrome.json").read_text())
    first, *layers = model["config"]["layers"]
    assert [layer["class_name"] for layer in layers] == ["Dense"] * 3
    assert [layer["config"]["units"] for layer in layers] == [21, 21, 3]
    assert (first["class_name"], first["config"]["batch_input_shape"]) == ("InputLayer", [None, 6])


def test_errors_are_recorded_with_the_worst_first(tmp_path):
    def export(name, error):
        return {"material": name, "files": [{"bytes": 10}, {"bytes": 5}], "error": {"log_error": error, "studio_psnr": 60 - error, "image_mean_error": error, "image_pixel_error": error}}

    (tmp_path / "npz.json").write_text(json.dumps({"form": "npz", "exports": [export("a", 1.0), export("b", 3.0)]}))
    (tmp_path / "forms.json").write_text("{}")
    out = tmp_path / "out.json"
    assert record_exports.main([str(tmp_path)], out) == 0
    (row,) = json.loads(out.read_text())["rows"]
    assert (row["form"], row["materials"], row["mean_bytes"]) == ("npz", 2, 15)
    assert (row["log_error"]["mean"], row["log_error"]["max"], row["log_error"]["worst"][0]) == (2.0, 3.0, "b 3.0")
    assert (row["studio_psnr"]["max"], row["studio_psnr"]["worst"][0]) == (57.0, "b 57.0")


@pytest.mark.parametrize("text", ["", "[]", '{"form": "npz", "exports": [{}]}', None])
def test_what_is_no_report_is_named_with_exit_code_3(text, tmp_path, capsys):
    if text is not None:
        (tmp_path / "npz.json").write_text(text)
    assert record_exports.main([str(tmp_path)], tmp_path / "out.json") == 3
    assert str(tmp_path) in capsys.readouterr().err
    assert not (tmp_path / "out.json").exists()
