//! The ways to store a material, in the order of reports.

use std::sync::Arc;

use anyhow::Result;
use nbrdf_core::nbrdf::PUBLISHED_HIDDEN;
use nbrdf_core::nbrdf::precision::Precision;
use nbrdf_core::representation::analytic::{
    AbcLobe, Analytic, BlinnPhongLobe, GgxLobe, LambertAlone, Parametric, SgdLobes, WardLobe,
};
use nbrdf_core::representation::basis::{Basis as _, BasisFile};
use nbrdf_core::representation::charting;
use nbrdf_core::representation::factored_microfacet::FactoredMicrofacet;
use nbrdf_core::representation::network::Network;
use nbrdf_core::representation::pca_tables::PcaOptions;
use nbrdf_core::representation::refined::Refined;
use nbrdf_core::representation::table::Tables;

use super::twin::{WithNetwork, shared_start_network};
use super::{Catalog, Family, Learned, RepresentationEntry, Shared, Variant};

type Build = fn(&Catalog) -> Result<Shared>;

/// Every representation. A name's first line is its plain form, a `Refined` line its refined one.
pub const REPRESENTATIONS: &[RepresentationEntry] = &[
    entry(
        "znbrdf",
        Family::Code,
        Variant::Unrolled,
        "ZNBRDF: probe encoder and three steps, colour channels treated alike",
        |catalog| Ok(catalog.znbrdf()),
    ),
    entry("znbrdf", Family::Code, Variant::FeedForward, "ZNBRDF's probe encoder alone", |catalog| {
        Ok(catalog.autoencoder())
    }),
    entry("znbrdf", Family::Code, Variant::Refined, "ZNBRDF, its code refined against the target", |catalog| {
        Ok(catalog.refined())
    }),
    entry(
        "published_autoencoder",
        Family::Code,
        Variant::FeedForward,
        "675-675-32-100-675 over flattened weights (Sztrajman et al. 2021)",
        |catalog| Ok(catalog.published()),
    ),
    learned(
        "pca_tables",
        "PCA of ln(f cos + 0.001) tables, 32 components",
        |catalog| Ok(catalog.pca(PcaOptions::PROTOCOL)?),
        COMPONENTS,
        |catalog| Ok(catalog.pca(PcaOptions::PROTOCOL)?.to_file()),
    ),
    entry(
        "pca_tables",
        Family::Linear,
        Variant::Refined,
        "PCA of log tables, its code refined against the target",
        |catalog| Ok(Arc::new(Refined::new(catalog.pca(PcaOptions::PROTOCOL)?))),
    ),
    learned(
        "pca_45",
        "PCA of ln(f cos + 0.001) tables, 45 components (Matusik et al. 2003)",
        |catalog| Ok(catalog.pca(PcaOptions::LOG_45)?),
        COMPONENTS,
        |catalog| Ok(catalog.pca(PcaOptions::LOG_45)?.to_file()),
    ),
    learned(
        "pca_plain_45",
        "PCA of f cos tables, 45 components: what logarithms are for",
        |catalog| Ok(catalog.pca(PcaOptions::PLAIN_45)?),
        COMPONENTS,
        |catalog| Ok(catalog.pca(PcaOptions::PLAIN_45)?.to_file()),
    ),
    learned(
        "pca_relative_45",
        "PCA of log tables relative to the median, 45 components (Nielsen et al. 2015)",
        |catalog| Ok(catalog.pca(PcaOptions::RELATIVE_45)?),
        COMPONENTS,
        |catalog| Ok(catalog.pca(PcaOptions::RELATIVE_45)?.to_file()),
    ),
    learned(
        "pca_weights",
        "PCA of shared-start weights",
        |catalog| Ok(catalog.pca_of_shared_start()?),
        WEIGHTS,
        |catalog| Ok(catalog.pca_weights()?.to_file()),
    ),
    learned(
        "charting_15",
        "place on the manifold of log tables, 15 numbers (Brand 2002, Matusik et al. 2003)",
        |catalog| Ok(catalog.charting_15()?),
        COORDINATES,
        |catalog| Ok(catalog.charting_15()?.to_file()),
    ),
    learned(
        "charting_2",
        "place on the manifold of log tables, 2 numbers: a map",
        |catalog| Ok(catalog.charting_2()?),
        COORDINATES,
        |catalog| Ok(catalog.charting_2()?.to_file()),
    ),
    learned(
        "linear_combination",
        "sum of the measured training materials (Matusik et al. 2003)",
        |catalog| Ok(catalog.linear_combination()?),
        MATERIALS,
        |catalog| Ok(catalog.linear_combination()?.to_file()),
    ),
    learned(
        "linear_combination_800",
        "the same sum, found from 800 random samples",
        |catalog| Ok(catalog.linear_combination_800()?),
        MATERIALS,
        |catalog| Ok(catalog.linear_combination_800()?.to_file()),
    ),
    learned(
        "optimal_sampling_20",
        "reflectance in 20 chosen directions (Nielsen et al. 2015)",
        |catalog| Ok(catalog.optimal_sampling_20()?),
        DIRECTIONS,
        |catalog| Ok(catalog.optimal_sampling_20()?.to_file()),
    ),
    learned(
        "optimal_sampling_5",
        "reflectance in 5 chosen directions",
        |catalog| Ok(catalog.optimal_sampling_5()?),
        DIRECTIONS,
        |catalog| Ok(catalog.optimal_sampling_5()?.to_file()),
    ),
    entry(
        "nbrdf",
        Family::Network,
        Variant::Fitted,
        "NBRDF: a 6-21-21-3 network of its own, fitted from the shared start",
        |_| Ok(own_network(Network::new("nbrdf", PUBLISHED_HIDDEN, Precision::Single))),
    ),
    entry(
        "nbrdf_pruned",
        Family::Network,
        Variant::Fitted,
        "NBRDF without the units that can never fire: the same values",
        |_| Ok(own_network(Network::new("nbrdf_pruned", PUBLISHED_HIDDEN, Precision::Single).pruned())),
    ),
    entry("nbrdf_half", Family::Network, Variant::Fitted, "NBRDF, weights in half precision", |_| {
        Ok(own_network(Network::new("nbrdf_half", PUBLISHED_HIDDEN, Precision::Half)))
    }),
    entry("nbrdf_byte", Family::Network, Variant::Fitted, "NBRDF, weights in bytes with a scale for each unit", |_| {
        Ok(own_network(Network::new("nbrdf_byte", PUBLISHED_HIDDEN, Precision::Byte)))
    }),
    entry("nbrdf_6", Family::Network, Variant::Fitted, "a 6-6-6-3 network of its own", |_| {
        Ok(Arc::new(Network::new("nbrdf_6", [6, 6], Precision::Single)))
    }),
    entry("nbrdf_10", Family::Network, Variant::Fitted, "a 6-10-10-3 network of its own", |_| {
        Ok(Arc::new(Network::new("nbrdf_10", [10, 10], Precision::Single)))
    }),
    entry("nbrdf_16", Family::Network, Variant::Fitted, "a 6-16-16-3 network of its own", |_| {
        Ok(Arc::new(Network::new("nbrdf_16", [16, 16], Precision::Single)))
    }),
    entry("nbrdf_32", Family::Network, Variant::Fitted, "a 6-32-32-3 network of its own", |_| {
        Ok(Arc::new(Network::new("nbrdf_32", [32, 32], Precision::Single)))
    }),
    formula::<LambertAlone>("a diffuse base alone: 3 numbers"),
    formula::<BlinnPhongLobe>("a base under a Blinn-Phong lobe, Fresnel free: 10 numbers"),
    formula::<WardLobe>("a base under Ward's lobe of bounded albedo: 7 numbers"),
    formula::<GgxLobe>("a base under a GGX lobe, Fresnel free: 10 numbers"),
    formula::<AbcLobe>("a base under an ABC lobe: 9 numbers"),
    formula::<SgdLobes>("the shifted gamma distribution, every channel on its own: 30 numbers"),
    entry(
        "factored_microfacet",
        Family::Factored,
        Variant::Fitted,
        "a microfacet lobe with tables for D, F and G (Bagher et al. 2016)",
        |_| Ok(Arc::new(FactoredMicrofacet)),
    ),
    entry(
        "table_nearest",
        Family::Table,
        Variant::Tabulated,
        "90 x 90 x 180 cells over half and difference angles, the nearest one",
        |_| Ok(Arc::new(Tables::NEAREST)),
    ),
    entry("table", Family::Table, Variant::Tabulated, "the same, interpolated", |_| Ok(Arc::new(Tables::TRILINEAR))),
    entry("table_half", Family::Table, Variant::Tabulated, "the same in 16 bits, interpolated", |_| {
        Ok(Arc::new(Tables::HALF))
    }),
    entry(
        "table_standard",
        Family::Table,
        Variant::Tabulated,
        "as many cells over the angles of light and view, interpolated",
        |_| Ok(Arc::new(Tables::STANDARD)),
    ),
];

const fn entry(
    name: &'static str,
    family: Family,
    variant: Variant,
    about: &'static str,
    build: Build,
) -> RepresentationEntry {
    RepresentationEntry { name, family, variant, about, build, basis: None }
}

/// What is learned, and can be saved.
const fn learned(
    name: &'static str,
    about: &'static str,
    build: Build,
    (family, most_numbers, has_grids): (Family, usize, bool),
    file: fn(&Catalog) -> Result<BasisFile>,
) -> RepresentationEntry {
    let basis = Some(Learned { file, most_numbers, has_grids });
    RepresentationEntry { basis, ..entry(name, family, Variant::Projection, about, build) }
}

/// Kinds of bases: family, most numbers, and whether there are grids.
const COMPONENTS: (Family, usize, bool) = (Family::Linear, 512, true);
const WEIGHTS: (Family, usize, bool) = (Family::Linear, 512, false);
const COORDINATES: (Family, usize, bool) = (Family::Chart, charting::MAX_DIM, false);
const MATERIALS: (Family, usize, bool) = (Family::Linear, 0, false);
const DIRECTIONS: (Family, usize, bool) = (Family::Linear, 512, false);

/// A formula, fitted.
const fn formula<P: Parametric>(about: &'static str) -> RepresentationEntry {
    entry(P::NAME, Family::Formula, Variant::Fitted, about, |_| Ok(Arc::new(Analytic::<P>::new())))
}

/// A network of the published widths, fitted from the shared start.
fn own_network(inner: Network) -> Shared {
    Arc::new(WithNetwork { inner, source: shared_start_network })
}
