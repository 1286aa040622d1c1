"""Reflectances of glTF, OpenPBR and Principled materials in NumPy, float64.

Written from the specifications (glTF 2.0 appendix B and four KHR extensions; OpenPBR 1.1; Blender 4's Principled BSDF),
not from the Rust code: what layers keep for those below is integrated here over half vectors, on fine grids.
"""

import json

import numpy as np

GLTF_PLAIN = {
    "ior": 1.5, "specularFactor": 1.0, "specularColorFactor": [1.0, 1.0, 1.0],
    "clearcoatFactor": 0.0, "clearcoatRoughnessFactor": 0.0, "sheenColorFactor": [0.0, 0.0, 0.0], "sheenRoughnessFactor": 0.0,
}
GLTF = {
    "plastic": {"baseColorFactor": [0.6, 0.2, 0.1], "metallicFactor": 0.0, "roughnessFactor": 0.4},
    "gold": {"baseColorFactor": [1.0, 0.77, 0.34], "metallicFactor": 1.0, "roughnessFactor": 0.25},
    "between": {"baseColorFactor": [0.3, 0.5, 0.7], "metallicFactor": 0.4, "roughnessFactor": 0.7, "ior": 1.8},
    "tinted": {"baseColorFactor": [0.2, 0.2, 0.5], "metallicFactor": 0.1, "roughnessFactor": 0.5, "specularFactor": 0.6, "specularColorFactor": [2.0, 1.0, 0.5]},
    "coated": {"baseColorFactor": [0.5, 0.05, 0.05], "metallicFactor": 0.6, "roughnessFactor": 0.6, "clearcoatFactor": 0.8, "clearcoatRoughnessFactor": 0.2},
    "velvet": {"baseColorFactor": [0.2, 0.1, 0.3], "metallicFactor": 0.0, "roughnessFactor": 0.9, "sheenColorFactor": [0.9, 0.6, 0.3], "sheenRoughnessFactor": 0.6},
}
OPEN_PBR_PLAIN = {"base_diffuse_roughness": 0.0, "specular_color": [1.0, 1.0, 1.0], "specular_ior": 1.5, "coat_weight": 0.0, "coat_roughness": 0.0}
OPEN_PBR = {
    "plastic": {"base_color": [0.6, 0.2, 0.1], "base_metalness": 0.0, "specular_roughness": 0.4},
    "metal": {"base_color": [0.9, 0.6, 0.3], "base_metalness": 1.0, "specular_roughness": 0.6, "specular_color": [0.8, 0.9, 1.0]},
    "clay": {"base_color": [0.7, 0.4, 0.3], "base_metalness": 0.0, "specular_roughness": 0.9, "base_diffuse_roughness": 0.8, "specular_ior": 1.3},
    "paint": {"base_color": [0.5, 0.1, 0.1], "base_metalness": 0.3, "specular_roughness": 0.5, "specular_ior": 1.8, "coat_weight": 0.7, "coat_roughness": 0.25},
}
PRINCIPLED_PLAIN = {"IOR": 1.5, "Specular Tint": [1.0, 1.0, 1.0], "Coat Weight": 0.0, "Coat Roughness": 0.0}
PRINCIPLED = {
    "plastic": {"Base Color": [0.6, 0.2, 0.1], "Metallic": 0.0, "Roughness": 0.4},
    "metal": {"Base Color": [0.9, 0.6, 0.3], "Metallic": 1.0, "Roughness": 0.7, "Specular Tint": [0.8, 0.9, 1.0]},
    "satin": {"Base Color": [0.3, 0.4, 0.5], "Metallic": 0.25, "Roughness": 0.6, "IOR": 2.0, "Specular Tint": [1.0, 0.7, 0.4]},
    "paint": {"Base Color": [0.5, 0.1, 0.1], "Metallic": 0.3, "Roughness": 0.5, "IOR": 1.6, "Coat Weight": 0.7, "Coat Roughness": 0.25},
}

# theta_i, theta_o, phi_o [degrees] with phi_i = 0: facing, mirror, off mirror, back, grazing
ANGLES = [(5, 5, 180), (30, 30, 180), (30, 40, 170), (60, 60, 180), (60, 20, 90), (70, 10, 0), (20, 70, 45), (50, 50, 0), (80, 75, 180), (85, 30, 120), (15, 80, 180), (45, 45, 150)]


def direction(theta, phi):
    theta, phi = np.radians(theta), np.radians(phi)
    return np.array([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])


# --- lobes --------------------------------------------------------------------------------------------------------


def ggx_d(cos_h, alpha):
    return alpha**2 / (np.pi * (cos_h**2 * (alpha**2 - 1) + 1) ** 2)


def smith_lambda(cos, alpha):
    return 0.5 * (np.sqrt(1 + alpha**2 * (1 / cos**2 - 1)) - 1)


def g_correlated(i, o, alpha):
    return 1 / (1 + smith_lambda(i, alpha) + smith_lambda(o, alpha))


def g_separable(i, o, alpha):
    one = lambda cos: 2 * cos / (cos + np.sqrt(alpha**2 + (1 - alpha**2) * cos**2))
    return one(i) * one(o)


def schlick(f0, cos):
    return f0 + (1 - f0) * (1 - cos) ** 5


def dielectric(ior, cos):
    """Fresnel's equations for unpolarised light, by the cosine of refraction."""
    inside = np.sqrt(1 - (1 - cos**2) / ior**2)
    s = (cos - ior * inside) / (cos + ior * inside)
    p = (ior * cos - inside) / (ior * cos + inside)
    return 0.5 * (s**2 + p**2)


def f82(f0, tint, cos):
    edge = 1 / 7
    dip = schlick(f0, edge) * (1 - tint) / (edge * (1 - edge) ** 6)
    return schlick(f0, cos) - cos * (1 - cos) ** 6 * dip


def directional(alpha, view, fresnel):
    """int F D G / (4 i o) i dw_i over half vectors: dw_i = 4 (o.h) dw_h."""
    s = (np.arange(1500) + 0.5) / 1500 * np.pi / 2
    theta = np.arctan(alpha * np.tan(s))
    jacobian = alpha * np.cos(theta) ** 2 / np.cos(s) ** 2
    phi = (np.arange(720) + 0.5) / 720 * np.pi
    theta_, phi_ = theta[:, None], phi[None, :]
    out = np.array([np.sqrt(1 - view**2), view])
    facing = out[0] * np.sin(theta_) * np.cos(phi_) + out[1] * np.cos(theta_)
    light = 2 * facing * np.cos(theta_) - view
    seen = (facing > 0) & (light > 0)
    facing, light = np.where(seen, facing, 0.5), np.where(seen, light, 0.5)
    value = fresnel(facing) * ggx_d(np.cos(theta_), alpha) * g_correlated(light, view, alpha) * facing / view
    weight = np.sin(theta_) * jacobian[:, None] * (np.pi / 2 / 1500) * (2 * np.pi / 720)
    return float(np.sum(np.where(seen, value, 0) * weight))


def mean(function):
    """2 int f cos dcos"""
    nodes, weights = np.polynomial.legendre.leggauss(24)
    cosines = 0.5 * (nodes + 1)
    return float(sum(weight * function(cos) * cos for cos, weight in zip(cosines, weights)))


def charlie(cos_h, i, o, alpha):
    d = (2 + 1 / alpha) * (1 - cos_h**2) ** (0.5 / alpha) / (2 * np.pi)
    t = (1 - alpha) ** 2
    a, b, c, dd, e = (lo + (hi - lo) * t for lo, hi in ((21.5473, 25.3245), (3.82987, 3.32435), (0.19823, 0.16801), (-1.97760, -1.27393), (-4.32054, -4.85967)))
    curve = lambda x: a / (1 + b * x**c) + dd * x + e
    lam = lambda cos: np.where(cos < 0.5, np.exp(curve(cos)), np.exp(2 * curve(0.5) - curve(1 - cos)))
    return d / ((1 + lam(i) + lam(o)) * 4 * i * o)


def charlie_albedo(view, alpha):
    t = (np.arange(1000) + 0.5) / 1000
    cos, phi = t[:, None] ** 2, ((np.arange(400) + 0.5) / 400 * np.pi)[None, :]
    sin, sin_o = np.sqrt(1 - cos**2), np.sqrt(1 - view**2)
    length = np.sqrt((sin * np.cos(phi) + sin_o) ** 2 + (sin * np.sin(phi)) ** 2 + (cos + view) ** 2)
    value = charlie((cos + view) / length, cos, view, alpha) * cos
    return float(np.sum(value * 2 * t[:, None]) / 1000 * 2 * np.pi / 400)


def eon(color, roughness, i, o, dot):
    a = 1 / (1 + (0.5 - 2 / (3 * np.pi)) * roughness)
    s = dot - i * o
    single = color / np.pi * a * (1 + roughness * (s / max(i, o) if s > 0 else s))
    average = a * (1 + roughness * (2 / 3 - 28 / (15 * np.pi)))
    if average >= 1:
        return single

    def albedo(cos):
        theta = np.arccos(cos)
        shape = np.sin(theta) * (theta - np.sin(theta) * cos) + 2 / 3 * (np.tan(theta) * (1 - np.sin(theta) ** 3) - np.sin(theta))
        return a * (1 + roughness / np.pi * shape)

    many = color**2 * average / (1 - color * (1 - average))
    return single + many / np.pi * (1 - albedo(i)) * (1 - albedo(o)) / (1 - average)


# --- models -------------------------------------------------------------------------------------------------------


def cosines(light, view):
    half = (light + view) / np.linalg.norm(light + view)
    return light[2], view[2], half[2], float(view @ half)


def gltf(p, light, view):
    i, o, h, d = cosines(light, view)
    base = np.array(p["baseColorFactor"])

    def lobe(roughness):
        alpha = roughness**2
        return ggx_d(h, alpha) * g_separable(i, o, alpha) / (4 * i * o)

    specular = lobe(p["roughnessFactor"])
    f0 = np.minimum(((1 - p["ior"]) / (1 + p["ior"])) ** 2 * np.array(p["specularColorFactor"]), 1)
    fresnel, weight = schlick(f0, d), p["specularFactor"]
    layered = (1 - weight * fresnel.max()) * base / np.pi + weight * fresnel * specular
    value = layered * (1 - p["metallicFactor"]) + schlick(base, d) * specular * p["metallicFactor"]
    sheen = np.array(p["sheenColorFactor"])
    if sheen.max() > 0:
        alpha = p["sheenRoughnessFactor"] ** 2
        left = min(1 - sheen.max() * charlie_albedo(cos, alpha) for cos in (i, o))
        value = sheen * charlie(h, i, o, alpha) + value * left
    if p["clearcoatFactor"] > 0:
        share = p["clearcoatFactor"] * schlick(0.04, o)
        value = value * (1 - share) + share * lobe(p["clearcoatRoughnessFactor"])
    return value


def open_pbr(p, light, view):
    i, o, h, d = cosines(light, view)
    base, tint = np.array(p["base_color"]), np.array(p["specular_color"])
    coat, coat_ior = p["coat_weight"], 1.6
    rougher = min(1, p["specular_roughness"] ** 4 + 2 * p["coat_roughness"] ** 4) ** 0.25
    alpha = ((1 - coat) * p["specular_roughness"] + coat * rougher) ** 2
    ratio = max(p["specular_ior"] / coat_ior, coat_ior / p["specular_ior"])
    ior = (1 - coat) * p["specular_ior"] + coat * ratio

    def glossy(ior, alpha):
        white = directional(alpha, o, lambda cos: 1.0)
        own = directional(alpha, o, lambda cos: dielectric(ior, cos))
        more, fresnel = (1 - white) / white, dielectric(ior, d)
        reflected = fresnel * ggx_d(h, alpha) * g_correlated(i, o, alpha) / (4 * i * o) * (1 + fresnel * more)
        return reflected, 1 - own * (1 + own / white * more), more

    reflected, passed, more = glossy(ior, alpha)
    diffuse = eon(base, p["base_diffuse_roughness"], i, o, float(light @ view))
    fresnel = f82(base, tint, d)
    metal = fresnel * ggx_d(h, alpha) * g_correlated(i, o, alpha) / (4 * i * o) * (1 + fresnel * more)
    m = p["base_metalness"]
    value = (tint * reflected + passed * diffuse) * (1 - m) + metal * m
    if coat > 0:
        reflected, passed, _ = glossy(coat_ior, p["coat_roughness"] ** 2)
        value = value * (1 - coat * (1 - passed)) + coat * reflected
    return value


def principled(p, light, view):
    i, o, h, d = cosines(light, view)
    base, tint, ior = np.array(p["Base Color"]), np.array(p["Specular Tint"]), p["IOR"]
    alpha = p["Roughness"] ** 2
    white = directional(alpha, o, lambda cos: 1.0)
    average = mean(lambda cos: directional(alpha, cos, lambda _: 1.0))
    missing = (1 - white) / white
    lobe = ggx_d(h, alpha) * g_correlated(i, o, alpha) / (4 * i * o)
    often = lambda once: 1 + once * average / (1 - once * (1 - average)) * missing

    real0 = ((ior - 1) / (ior + 1)) ** 2
    f0 = real0 * tint
    blend = lambda real: f0 + (1 - f0) * np.clip((real - real0) / (1 - real0), 0, 1)
    once = blend((ior - 1) / (4.08567 + 1.00071 * ior))
    specular = blend(dielectric(ior, d)) * lobe * often(once)
    albedo = blend(directional(alpha, o, lambda cos: dielectric(ior, cos)) / white)
    diffuse = (1 - albedo.max()) * base / np.pi

    dip = schlick(base, 1 / 7) * (1 - tint) / (1 / 7 * (6 / 7) ** 6)
    once = base + (1 - base) / 21 - dip / 126
    metal = f82(base, tint, d) * lobe * often(once)
    m, coat = p["Metallic"], p["Coat Weight"]
    value = (specular + diffuse) * (1 - m) + metal * m
    if coat > 0:
        alpha = p["Coat Roughness"] ** 2
        own = dielectric(1.5, d) * ggx_d(h, alpha) * g_correlated(i, o, alpha) / (4 * i * o)
        value = value * (1 - coat * dielectric(1.5, o)) + coat * own
    return value


MODELS = {"gltf": (gltf, GLTF_PLAIN, GLTF), "open_pbr": (open_pbr, OPEN_PBR_PLAIN, OPEN_PBR), "principled": (principled, PRINCIPLED_PLAIN, PRINCIPLED)}


def parametric() -> bytes:
    """f_r [1/sr] of each material at each pair of directions."""
    pairs = [(direction(i, 0), direction(o, phi)) for i, o, phi in ANGLES]
    materials = []
    for model, (evaluate, plain, named) in MODELS.items():
        for name, own in named.items():
            parameters = plain | own
            values = [[float(f"{v:.9g}") for v in evaluate(parameters, light, view)] for light, view in pairs]
            materials.append({"model": model, "name": name, "parameters": parameters, "values": values})
    about = "f_r [1/sr] of each material at each (theta_i, theta_o, phi_o) in degrees, phi_i = 0; scripts/make_golden.py parametric"
    rows = ",\n".join("  " + json.dumps(material) for material in materials)
    return f'{{\n "about": "{about}",\n "angles": {json.dumps(ANGLES)},\n "materials": [\n{rows}\n ]\n}}\n'.encode()
