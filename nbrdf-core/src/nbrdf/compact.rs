//! A network without the units that can never fire, as a network of smaller hidden widths.

use super::{INPUTS, Nbrdf};

impl Nbrdf {
    /// The same function with fewer weights: bit for bit the same values for unit vectors (lengths within 10⁻⁶ of 1). What
    /// [`pruned`](Self::pruned) has proved of this network is not proved again. A layer in which no unit ever fires keeps
    /// one, since hidden widths are at least 1.
    pub fn compact(&self) -> Self {
        let [first, second] = self.live().units.map(|units| if units.is_empty() { vec![0] } else { units });
        let hidden = [first.len(), second.len()];
        let units = [(0..INPUTS).collect(), first, second, vec![0, 1, 2]];
        let mut weights = Vec::new();
        for (layer, (kernel, bias)) in self.layout().layers.into_iter().enumerate() {
            let (kernel, bias) = (&self.weights[kernel], &self.weights[bias]);
            for row in &units[layer] {
                weights.extend(units[layer + 1].iter().map(|column| kernel[row * bias.len() + column]));
            }
            weights.extend(units[layer + 1].iter().map(|&column| bias[column]));
        }
        Self::of_valid(hidden, weights)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::library::builtin;
    use crate::nbrdf::fit::{random_hidden, random_network};
    use crate::nbrdf::{PUBLISHED_WEIGHTS, weight_count};
    use crate::sampling::rus32k;
    use crate::{Brdf, Rgb};

    fn bits(network: &Nbrdf) -> Vec<[u32; 3]> {
        let mut out = vec![Rgb::BLACK; rus32k().len()];
        network.eval_signed_into(rus32k(), &mut out);
        out.iter().map(|f| f.0.map(f32::to_bits)).collect()
    }

    #[test]
    fn fewer_units_give_the_same_bits_of_every_built_in_material() {
        let mut kept = 0;
        for entry in builtin::independent() {
            let compact = entry.network.compact();
            assert_eq!(bits(&compact), bits(&entry.network), "{}", entry.name);
            kept += compact.weights().len();
        }
        let whole = 134 * PUBLISHED_WEIGHTS;
        println!("{} of {PUBLISHED_WEIGHTS} weights left on average", kept / 134);
        assert!(kept < whole * 9 / 10, "{kept} of {whole}");
    }

    #[test]
    fn random_networks_of_any_widths_give_the_same_bits_pruned_before_or_not() {
        for seed in 0..4 {
            for network in [random_network(seed, 0), random_hidden(seed, 0, [3, 5]), random_hidden(seed, 0, [1, 1])] {
                let compact = network.compact();
                assert_eq!(bits(&compact), bits(&network), "{seed} {:?}", network.hidden());
                assert_eq!(network.pruned().compact(), compact);
                assert_eq!(compact.weights().len(), weight_count(compact.hidden()));
            }
        }
    }

    #[test]
    fn a_layer_that_never_fires_keeps_one_unit() {
        let biases_alone = |bias: f32| {
            let mut weights = vec![0.0; PUBLISHED_WEIGHTS];
            weights[PUBLISHED_WEIGHTS - 3..].fill(bias);
            Nbrdf::published(weights).unwrap()
        };
        for network in [biases_alone(0.3), biases_alone(-0.3)] {
            let compact = network.compact();
            assert_eq!(compact.hidden(), [1, 1]);
            assert_eq!(bits(&compact), bits(&network));
        }
    }
}
