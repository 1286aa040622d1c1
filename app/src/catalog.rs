//! THE list: every representation, interpolation and metric by name.
//!
//! A newcomer writes one file and adds one line here; command line, app, contract tests and result tables follow.
//! (A metric that `evaluate` should report also needs its line in `measure/target.rs`, which evaluates and renders once.)

mod learned;
mod measured;
mod reference;
mod twin;

use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::metric::{LogError, Metric, RelativeLog, Rendered};
use nbrdf_core::nbrdf::PUBLISHED_HIDDEN;
use nbrdf_core::nbrdf::precision::Precision;
use nbrdf_core::path::bounded::Bounded;
use nbrdf_core::path::code_path::CodeInterpolation;
use nbrdf_core::path::even::Even;
use nbrdf_core::path::geodesic::Geodesic;
use nbrdf_core::path::mix::Mix;
use nbrdf_core::path::nearest_end::NearestEnd;
use nbrdf_core::path::weight_path::WeightInterpolation;
use nbrdf_core::representation::analytic::{
    AbcLobe, Analytic, BlinnPhongLobe, GgxLobe, LambertAlone, Parametric, SgdLobes, WardLobe,
};
use nbrdf_core::representation::factored_microfacet::FactoredMicrofacet;
use nbrdf_core::representation::network::Network;
use nbrdf_core::representation::pca_tables::PcaOptions;
use nbrdf_core::representation::refined::Refined;
use nbrdf_core::representation::table::Tables;
use nbrdf_core::{Interpolation, Representation};

pub use learned::Catalog;
pub use reference::Reference;

use twin::{WithNetwork, independent_network, shared_start_network};

/// Numbers in a code of the learned representations.
pub const DIM: usize = 32;

/// How a representation makes its codes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variant {
    /// By one pass of its encoder.
    FeedForward,
    /// By its encoder and a few fixed steps against the target: still at once, a part of encoding.
    Unrolled,
    /// By projection onto a linear basis.
    Projection,
    /// By a fit to the material.
    Fitted,
    /// By asking the material in every cell.
    Tabulated,
    /// By an encoder or a projection, then a few steps against the target itself.
    Refined,
}

impl Variant {
    /// Name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::FeedForward => "feed_forward",
            Self::Unrolled => "unrolled",
            Self::Projection => "projection",
            Self::Fitted => "fitted",
            Self::Tabulated => "tabulated",
            Self::Refined => "refined",
        }
    }
}

type Shared = Arc<dyn Representation>;

/// A representation in the list.
pub struct RepresentationEntry {
    /// Name on the command line, in reports and in codes.
    pub name: &'static str,
    /// How its codes are made.
    pub variant: Variant,
    /// One line for people.
    pub about: &'static str,
    build: fn(&Catalog) -> Result<Shared>,
}

/// An interpolation in the list.
pub struct InterpolationEntry {
    /// Name on the command line and in reports.
    pub name: &'static str,
    /// Name for people.
    pub title: &'static str,
    /// One line for people.
    pub about: &'static str,
    build: fn(&Catalog) -> Result<Box<dyn Interpolation>>,
}

/// Every representation. A name's first line is its plain form, a `Refined` line its refined one.
pub const REPRESENTATIONS: &[RepresentationEntry] = &[
    RepresentationEntry {
        name: "znbrdf",
        variant: Variant::Unrolled,
        about: "ZNBRDF: probe encoder and three steps, colour channels treated alike",
        build: |catalog| Ok(catalog.znbrdf()),
    },
    RepresentationEntry {
        name: "znbrdf",
        variant: Variant::FeedForward,
        about: "ZNBRDF's probe encoder alone",
        build: |catalog| Ok(catalog.autoencoder()),
    },
    RepresentationEntry {
        name: "znbrdf",
        variant: Variant::Refined,
        about: "ZNBRDF, its code refined against the target",
        build: |catalog| Ok(catalog.refined()),
    },
    RepresentationEntry {
        name: "published_autoencoder",
        variant: Variant::FeedForward,
        about: "675-675-32-100-675 over flattened weights (Sztrajman et al. 2021)",
        build: |catalog| Ok(catalog.published()),
    },
    RepresentationEntry {
        name: "pca_tables",
        variant: Variant::Projection,
        about: "PCA of ln(f cos + 0.001) tables",
        build: |catalog| Ok(catalog.pca(PcaOptions::PROTOCOL)?),
    },
    RepresentationEntry {
        name: "pca_tables",
        variant: Variant::Refined,
        about: "PCA of log tables, its code refined against the target",
        build: |catalog| Ok(Arc::new(Refined::new(catalog.pca(PcaOptions::PROTOCOL)?))),
    },
    RepresentationEntry {
        name: "pca_45",
        variant: Variant::Projection,
        about: "PCA of ln(f cos + 0.001) tables, 45 components (Matusik et al. 2003)",
        build: |catalog| Ok(catalog.pca(PcaOptions::LOG_45)?),
    },
    RepresentationEntry {
        name: "pca_plain_45",
        variant: Variant::Projection,
        about: "PCA of f cos tables, 45 components: what logarithms are for",
        build: |catalog| Ok(catalog.pca(PcaOptions::PLAIN_45)?),
    },
    RepresentationEntry {
        name: "pca_relative_45",
        variant: Variant::Projection,
        about: "PCA of log tables relative to the median, 45 components (Nielsen et al. 2015)",
        build: |catalog| Ok(catalog.pca(PcaOptions::RELATIVE_45)?),
    },
    RepresentationEntry {
        name: "pca_weights",
        variant: Variant::Projection,
        about: "PCA of shared-start weights",
        build: |catalog| Ok(catalog.pca_weights()?),
    },
    RepresentationEntry {
        name: "nbrdf",
        variant: Variant::Fitted,
        about: "NBRDF: a 6-21-21-3 network of its own, fitted from the shared start",
        build: |_| Ok(own_network("nbrdf", Precision::Single)),
    },
    RepresentationEntry {
        name: "nbrdf_half",
        variant: Variant::Fitted,
        about: "NBRDF, weights in half precision",
        build: |_| Ok(own_network("nbrdf_half", Precision::Half)),
    },
    RepresentationEntry {
        name: "nbrdf_byte",
        variant: Variant::Fitted,
        about: "NBRDF, weights in bytes with a scale for each unit",
        build: |_| Ok(own_network("nbrdf_byte", Precision::Byte)),
    },
    RepresentationEntry {
        name: "nbrdf_10",
        variant: Variant::Fitted,
        about: "a 6-10-10-3 network of its own",
        build: |_| Ok(Arc::new(Network::new("nbrdf_10", [10, 10], Precision::Single))),
    },
    RepresentationEntry {
        name: "nbrdf_32",
        variant: Variant::Fitted,
        about: "a 6-32-32-3 network of its own",
        build: |_| Ok(Arc::new(Network::new("nbrdf_32", [32, 32], Precision::Single))),
    },
    fitted::<LambertAlone>("a diffuse base alone: 3 numbers"),
    fitted::<BlinnPhongLobe>("a base under a Blinn-Phong lobe, Fresnel free: 10 numbers"),
    fitted::<WardLobe>("a base under Ward's lobe of bounded albedo: 7 numbers"),
    fitted::<GgxLobe>("a base under a GGX lobe, Fresnel free: 10 numbers"),
    fitted::<AbcLobe>("a base under an ABC lobe: 9 numbers"),
    fitted::<SgdLobes>("the shifted gamma distribution, every channel on its own: 30 numbers"),
    RepresentationEntry {
        name: "charting_15",
        variant: Variant::Projection,
        about: "place on the manifold of log tables, 15 numbers (Brand 2002, Matusik et al. 2003)",
        build: |catalog| Ok(catalog.charting_15()?),
    },
    RepresentationEntry {
        name: "charting_2",
        variant: Variant::Projection,
        about: "place on the manifold of log tables, 2 numbers: a map",
        build: |catalog| Ok(catalog.charting_2()?),
    },
];

/// Networks of the published widths, fitted from the shared start.
fn own_network(name: &'static str, precision: Precision) -> Shared {
    let inner = Network::new(name, PUBLISHED_HIDDEN, precision);
    Arc::new(WithNetwork { inner, source: shared_start_network })
}

/// A formula, fitted.
const fn fitted<P: Parametric>(about: &'static str) -> RepresentationEntry {
    RepresentationEntry {
        name: P::NAME,
        variant: Variant::Fitted,
        about,
        build: |_| Ok(Arc::new(Analytic::<P>::new())),
    }
}

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
        build: |catalog| Ok(Box::new(CodeInterpolation::new("pca_weights", catalog.pca_weights()?))),
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

/// Every metric, in the order of reports.
pub fn metrics() -> Vec<Box<dyn Metric>> {
    let directions: [Box<dyn Metric>; 2] = [Box::new(LogError), Box::new(RelativeLog)];
    directions.into_iter().chain(Rendered::all().map(|metric| Box::new(metric) as Box<dyn Metric>)).collect()
}

impl RepresentationEntry {
    /// Makes it; may learn a basis first.
    pub fn build(&self, catalog: &Catalog) -> Result<Shared> {
        (self.build)(catalog)
    }
}

impl InterpolationEntry {
    /// Makes it; may learn a basis first.
    pub fn build(&self, catalog: &Catalog) -> Result<Box<dyn Interpolation>> {
        (self.build)(catalog)
    }
}
