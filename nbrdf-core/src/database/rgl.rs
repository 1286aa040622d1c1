//! The 34 isotropic RGL materials that have a published network; `_rgb` of the file name dropped.
//!
//! J. Dupuy, W. Jakob, *An Adaptive Parameterization for Efficient Material Acquisition and Rendering* (2018),
//! doi 10.1145/3272127.3275059.

/// Names, sorted.
#[rustfmt::skip]
pub const RGL: [&str; 34] = [
    "rgl/acrylic_felt_green", "rgl/acrylic_felt_pink", "rgl/acrylic_felt_purple", "rgl/acrylic_felt_yellow",
    "rgl/aurora_white", "rgl/cc_amber_citrine", "rgl/cc_blue_agat", "rgl/cc_ibiza_sunset", "rgl/cc_iris_purple_gem",
    "rgl/cg_sunflower", "rgl/chm_light_blue", "rgl/chm_orange", "rgl/cm_military_green", "rgl/cm_white",
    "rgl/colodur_azure_4e", "rgl/colodur_kalahari_2a", "rgl/colodur_napoli_4f", "rgl/ilm_l3_37_matte",
    "rgl/ilm_l3_37_metallic", "rgl/ilm_solo_millennium_falcon", "rgl/irid_flake_paint1_fine", "rgl/irid_flake_paint2",
    "rgl/laika_ceiling_paint_18_gray", "rgl/paper_blue", "rgl/paper_green", "rgl/paper_white", "rgl/paper_yellow",
    "rgl/satin_gold", "rgl/satin_purple", "rgl/satin_white", "rgl/spectralon", "rgl/vch_frozen_amethyst",
    "rgl/vch_golden_yellow", "rgl/vch_ultra_pink",
];
