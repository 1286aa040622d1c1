"""Known materials that several golden files are about."""

from typing import Any

from nbrdf_jax.analytic import Microfacet, f0_from_ior

GLOSSY = (f0_from_ior(1.5),) * 3
MATERIALS = {
    "lambert": Microfacet((0.8, 0.5, 0.2)),
    "roughness_start": Microfacet((0.2, 0.15, 0.1), GLOSSY, 0.1),
    "roughness_middle": Microfacet((0.2, 0.15, 0.1), GLOSSY, 0.35),
    "metal_middle": Microfacet((0.2, 0.025, 0.025), (0.52, 0.405, 0.19), 0.3),
    "metal_middle_beckmann": Microfacet((0.2, 0.025, 0.025), (0.52, 0.405, 0.19), 0.3, "beckmann"),
    "metal_middle_gtr1": Microfacet((0.2, 0.025, 0.025), (0.52, 0.405, 0.19), 0.3, "gtr1"),
}
PAIRS = (("lambert", "roughness_middle"), ("roughness_start", "roughness_middle"), ("metal_middle", "roughness_middle"))


def parameters(material: Microfacet) -> dict[str, Any]:
    """What a reader needs to make the material anew."""
    return {"diffuse": list(material.diffuse), "f0": material.f0 and list(material.f0), "alpha": material.alpha, "lobe": material.lobe}
