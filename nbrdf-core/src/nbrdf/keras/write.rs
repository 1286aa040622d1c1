//! Networks as Keras files, in the layout of the published ones: groups `dense_1` to `dense_3`, each with a group of its own
//! name that holds kernel and bias; what Keras and the published converter (`h5_to_npy.py`) read.

use hdf5_pure::{AttrValue, FileBuilder};
use serde_json::json;

use super::KerasError;
use crate::Nbrdf;
use crate::nbrdf::INPUTS;

/// Layers in their order.
const LAYERS: [&str; 3] = ["dense_1", "dense_2", "dense_3"];
/// The version that the published files name.
const VERSION: &str = "2.2.4";
const BACKEND: &str = "tensorflow";

/// The bytes of a `.h5` that [`read_keras`](super::read_keras) reads.
///
/// # Errors
/// [`KerasError::Damaged`] if the arrays cannot be put into a file; no network is known of which they cannot.
pub fn write_keras(network: &Nbrdf) -> Result<Vec<u8>, KerasError> {
    let mut file = FileBuilder::new();
    file.set_attr("layer_names", AttrValue::AsciiStringArray(LAYERS.map(str::to_owned).to_vec()));
    file.set_attr("backend", AttrValue::AsciiString(BACKEND.to_owned()));
    file.set_attr("keras_version", AttrValue::AsciiString(VERSION.to_owned()));
    for (name, (kernel, bias)) in LAYERS.into_iter().zip(network.layout().layers) {
        let columns = bias.len();
        let rows = kernel.len() / columns;
        let mut outer = file.create_group(name);
        let names = ["kernel:0", "bias:0"].map(|array| format!("{name}/{array}"));
        outer.set_attr("weight_names", AttrValue::AsciiStringArray(names.to_vec()));
        let mut inner = outer.create_group(name);
        let shape = [rows as u64, columns as u64];
        inner.create_dataset("kernel:0").with_f32_data(&network.weights()[kernel]).with_shape(&shape);
        inner.create_dataset("bias:0").with_f32_data(&network.weights()[bias]).with_shape(&shape[1..]);
        outer.add_group(inner.finish());
        file.add_group(outer.finish());
    }
    Ok(file.finish()?)
}

/// The model's architecture as Keras' `model_from_json` reads it: the input, three Dense layers, and nothing that is run. The
/// network's last step, exp(y) − 1 clamped at 0, is no layer here: published files hold it as marshalled code. Beyond the
/// published layout it has what Keras 3 asks for: where its class is found (`module`), and the input as a layer of its own.
pub fn write_architecture(network: &Nbrdf, name: &str) -> String {
    let [first, second] = network.hidden();
    let layer = |(index, name): (usize, &str)| {
        let units = [first, second, 3][index];
        let activation = if index < 2 { "relu" } else { "linear" };
        let config = json!({
            "name": name, "trainable": true, "dtype": "float32", "units": units, "activation": activation, "use_bias": true,
        });
        json!({"class_name": "Dense", "config": config})
    };
    let input = json!({"name": "input_1", "dtype": "float32", "batch_input_shape": [null, INPUTS], "sparse": false});
    let input = json!({"class_name": "InputLayer", "config": input});
    let layers: Vec<_> = std::iter::once(input).chain(LAYERS.into_iter().enumerate().map(layer)).collect();
    let model = json!({
        "class_name": "Sequential", "config": {"name": name, "layers": layers}, "keras_version": VERSION,
        "backend": BACKEND, "module": "keras", "registered_name": null,
    });
    format!("{model}\n")
}

#[cfg(test)]
mod tests {
    use hdf5_pure::File;

    use super::*;
    use crate::library::builtin;
    use crate::nbrdf::fit::random_hidden;
    use crate::nbrdf::keras::read_keras;

    #[test]
    fn what_is_written_is_read_to_the_bit() {
        let chrome = builtin::shared().get("chrome").unwrap().network.clone();
        for network in [chrome, random_hidden(3, 0, [5, 32])] {
            let read = read_keras(&write_keras(&network).unwrap()).unwrap();
            assert_eq!((read.hidden(), read.weights()), (network.hidden(), network.weights()));
        }
    }

    #[test]
    fn names_are_those_that_keras_looks_for() {
        let network = random_hidden(3, 0, [21, 21]);
        let file = File::from_bytes(write_keras(&network).unwrap()).unwrap();
        let names = |value: &AttrValue| value.as_strings().map(<[String]>::to_vec);
        let root = file.root().attrs().unwrap();
        assert_eq!(names(&root["layer_names"]).unwrap(), LAYERS);
        let layer = file.group("dense_2").unwrap().attrs().unwrap();
        assert_eq!(names(&layer["weight_names"]).unwrap(), ["dense_2/kernel:0", "dense_2/bias:0"]);
        assert_eq!(file.dataset("dense_3/dense_3/kernel:0").unwrap().shape().unwrap(), [21, 3]);
    }

    #[test]
    fn the_architecture_has_three_dense_layers_and_no_code() {
        let text = write_architecture(&random_hidden(3, 0, [21, 20]), "a");
        let model: serde_json::Value = serde_json::from_str(&text).unwrap();
        let (input, layers) = model["config"]["layers"].as_array().unwrap().split_first().unwrap();
        assert_eq!(input["config"]["batch_input_shape"], json!([null, 6]));
        let units: Vec<_> = layers.iter().map(|layer| layer["config"]["units"].as_u64().unwrap()).collect();
        assert_eq!(units, [21, 20, 3]);
        assert!(layers.iter().all(|layer| layer["class_name"] == "Dense"), "{text}");
    }
}
