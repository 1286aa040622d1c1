//! The ways between materials, in the order of reports.

use nbrdf_core::Interpolation;
use nbrdf_core::path::bounded::Bounded;
use nbrdf_core::path::code_path::CodeInterpolation;
use nbrdf_core::path::even::Even;
use nbrdf_core::path::geodesic::Geodesic;
use nbrdf_core::path::mix::Mix;
use nbrdf_core::path::nearest_end::NearestEnd;
use nbrdf_core::path::weight_path::WeightInterpolation;
use nbrdf_core::representation::pca_tables::PcaOptions;

use super::InterpolationEntry;
use super::twin::{independent_network, shared_start_network};

/// Every interpolation, in the order of reports.
pub const INTERPOLATIONS: &[InterpolationEntry] = &[
    InterpolationEntry {
        name: "latent",
        title: "Latent",
        about: "straight between ZNBRDF codes",
        build: |catalog| Ok(bounded(CodeInterpolation::new("latent", catalog.znbrdf()))),
    },
    InterpolationEntry {
        name: "latent_refined",
        title: "Latent, refined",
        about: "straight between refined ZNBRDF codes",
        build: |catalog| Ok(bounded(CodeInterpolation::new("latent_refined", catalog.refined()))),
    },
    InterpolationEntry {
        name: "latent_even",
        title: "Latent, even",
        about: "the latent path, every step the same ΔE_ITP",
        build: |catalog| {
            let straight = CodeInterpolation::new("latent", catalog.znbrdf());
            Ok(bounded(Even::new("latent_even", Box::new(straight))))
        },
    },
    InterpolationEntry {
        name: "latent_geodesic",
        title: "Latent, shortest",
        about: "the shortest way between ZNBRDF codes in ΔE_ITP, colours kept near those of the ends",
        build: |catalog| {
            let shortest = Geodesic::new("latent_geodesic", catalog.znbrdf());
            Ok(bounded(Even::new("latent_geodesic", Box::new(shortest))))
        },
    },
    InterpolationEntry {
        name: "latent_refined_geodesic",
        title: "Latent, refined, shortest",
        about: "the shortest way between refined ZNBRDF codes",
        build: |catalog| {
            let shortest = Geodesic::new("latent_refined_geodesic", catalog.refined());
            Ok(bounded(Even::new("latent_refined_geodesic", Box::new(shortest))))
        },
    },
    InterpolationEntry {
        name: "raw_weights",
        title: "Raw weights",
        about: "straight between the 675 weights of independently started networks",
        build: |_| Ok(Box::new(WeightInterpolation::new("raw_weights", Box::new(independent_network)))),
    },
    InterpolationEntry {
        name: "aligned_weights",
        title: "Aligned weights",
        about: "the same, hidden units balanced and matched first",
        build: |_| Ok(Box::new(WeightInterpolation::aligned("aligned_weights", Box::new(independent_network)))),
    },
    InterpolationEntry {
        name: "shared_start",
        title: "Shared start",
        about: "straight between weights fitted from one initial network",
        build: |_| Ok(Box::new(WeightInterpolation::new("shared_start", Box::new(shared_start_network)))),
    },
    InterpolationEntry {
        name: "pca_weights",
        title: "PCA of weights",
        about: "straight between PCA codes of shared-start weights",
        build: |catalog| Ok(Box::new(CodeInterpolation::new("pca_weights", catalog.pca_of_shared_start()?))),
    },
    InterpolationEntry {
        name: "pca_tables",
        title: "PCA of tables",
        about: "straight between PCA codes of log tables",
        build: |catalog| Ok(Box::new(CodeInterpolation::new("pca_tables", catalog.pca(PcaOptions::PROTOCOL)?))),
    },
    InterpolationEntry {
        name: "charting",
        title: "Charting",
        about: "straight in 15 chart coordinates of log tables",
        build: |catalog| Ok(Box::new(CodeInterpolation::new("charting", catalog.charting_15()?))),
    },
    InterpolationEntry {
        name: "linear_mix",
        title: "Linear mix",
        about: "weighted mean of reflectances",
        build: |_| Ok(Box::new(Mix::Linear)),
    },
    InterpolationEntry {
        name: "log_mix",
        title: "Log mix",
        about: "weighted mean of ln(f + 0.001)",
        build: |_| Ok(Box::new(Mix::Log)),
    },
    InterpolationEntry {
        name: "log1p_mix",
        title: "Log(1 + f) mix",
        about: "weighted mean of ln(f + 1)",
        build: |_| Ok(Box::new(Mix::Log1p)),
    },
    InterpolationEntry {
        name: "nearest_end",
        title: "Nearest end",
        about: "doing nothing",
        build: |_| Ok(Box::new(NearestEnd)),
    },
];

/// No light from nothing beyond the ends.
fn bounded(inner: impl Interpolation + 'static) -> Box<dyn Interpolation> {
    Box::new(Bounded::new(Box::new(inner)))
}
