"""Neural BRDFs in Mitsuba 3: a BSDF plugin named `nbrdf`, for every variant, scalar and vectorized.

    import mitsuba as mi
    mi.set_variant("llvm_ad_rgb")          # or scalar_rgb, cuda_ad_rgb
    import mitsuba_nbrdf                   # registers the plugin; after the variant is set

    bsdf = mi.load_dict({"type": "nbrdf", "filename": "chrome.npz"})

    <bsdf type="nbrdf">                    <!-- in a scene that Python loads -->
        <string name="filename" value="chrome.safetensors"/>
    </bsdf>

Parameters:

| name | what |
|---|---|
| `filename` | a network as `nbrdf export` or `nbrdf decode` writes it (`.npz`, `.safetensors`), or a code (`.json`) |
| `checkpoint` | the ZNBRDF checkpoint that a code was made with (`autoencoder/assets/znbrdf.safetensors`) |
| `share`, `width` | of the lobe that lights are drawn from; found by a short search at loading where left out |

What it computes: f_r = max(0, exp(y) − 1) of the network 6 → n → m → 3 (A. Sztrajman, G. Rainer, T. Ritschel, T. Weyrich,
*Neural BRDF Representation and Importance Sampling*, 2021, doi 10.1111/cgf.14335), read at the half vector
(sin θ_h, 0, cos θ_h) and the light in its frame; `eval` returns f_r cos θ, as Mitsuba asks for. Lights are drawn from
share · GGX visible normals of roughness `width` + (1 − share) · cosine. Front side only, opaque, isotropic, RGB variants.

Needs numpy, and safetensors for that form; nothing else of this repository. Vectorized variants compile the weights into
the kernel: a new material compiles once, and runs at the speed of a built-in plugin.
"""

import hashlib
import json
from pathlib import Path

import drjit as dr
import mitsuba as mi
import numpy as np

INPUTS, OUTPUTS = 6, 3
SHARES = (0.0, 0.25, 0.5, 0.75, 0.9)
WIDTHS = tuple(np.geomspace(0.004, 0.7, 12))
LARGEST_EXPONENT = 60.0


class InvalidFile(ValueError):
    """A file is not what it should be; the message says what was expected and found."""


def read(path: str | Path, checkpoint: str | Path | None = None) -> list[tuple[np.ndarray, np.ndarray]]:
    """Kernel [in, out] and bias [out] of each of the three layers, float32, of a network or a code."""
    path = Path(path)
    if not path.is_file():
        raise InvalidFile(f"{path}: expected a network or a code, found no such file: check the path")
    match path.suffix:
        case ".npz":
            arrays = np.load(path)
            try:
                layers = [(arrays[f"fc{i}"], arrays[f"b{i}"]) for i in (1, 2, 3)]
            except KeyError as missing:
                raise InvalidFile(f"{path}: expected arrays fc1 b1 fc2 b2 fc3 b3, found none named {missing}") from missing
        case ".safetensors":
            layers = _of_tensors(path)
        case ".json":
            layers = _of_code(path, checkpoint)
        case other:
            raise InvalidFile(f"{path}: expected .npz, .safetensors or .json, found '{other}'")
    shapes = [kernel.shape for kernel, _ in layers]
    fits = shapes[0][0] == INPUTS and shapes[2][1] == OUTPUTS and shapes[0][1] == shapes[1][0] and shapes[1][1] == shapes[2][0]
    if not fits or any(bias.shape != kernel.shape[1:] for kernel, bias in layers):
        raise InvalidFile(f"{path}: expected kernels (6, n), (n, m), (m, 3) with their biases, found {shapes}")
    return [(kernel.astype(np.float32), bias.astype(np.float32)) for kernel, bias in layers]


def _of_tensors(path: Path) -> list[tuple[np.ndarray, np.ndarray]]:
    from safetensors import safe_open

    with safe_open(path, framework="numpy") as file:
        if "weights" not in file.keys():
            raise InvalidFile(f"{path}: expected a tensor 'weights', found {', '.join(file.keys())}")
        widths = (file.metadata() or {}).get("hidden", "21,21")
        first, second = (int(width) for width in widths.strip("[]").split(","))
        return _layers(file.get_tensor("weights"), (INPUTS, first, second, OUTPUTS))


def _layers(flat: np.ndarray, widths: tuple[int, ...]) -> list[tuple[np.ndarray, np.ndarray]]:
    """Layer by layer: the kernel row by row, then the bias."""
    layers, start = [], 0
    for rows, columns in zip(widths, widths[1:]):
        middle, end = start + rows * columns, start + (rows + 1) * columns
        layers.append((flat[start:middle].reshape(rows, columns), flat[middle:end]))
        start = end
    if start != len(flat):
        raise InvalidFile(f"expected {start} weights of a network {widths}, found {len(flat)}")
    return layers


def _of_code(path: Path, checkpoint: str | Path | None) -> list[tuple[np.ndarray, np.ndarray]]:
    """The decoder of ZNBRDF: a trunk gives layers 1 and 2, a head one column of layer 3 for each channel."""
    from safetensors.numpy import load_file

    code = json.loads(path.read_text())
    if code.get("model") != "znbrdf" or checkpoint is None:
        raise InvalidFile(f"{path}: expected a code of znbrdf and its checkpoint (parameter `checkpoint`), found a code of {code.get('model')} and {checkpoint}")
    mark = hashlib.sha256(Path(checkpoint).read_bytes()).hexdigest()[:16]
    if code.get("checkpoint") != mark:
        raise InvalidFile(f"{path}: expected a code of the checkpoint {mark}, which is {checkpoint}, found one of {code.get('checkpoint')}")
    tensors = {name: tensor.astype(np.float64) for name, tensor in load_file(checkpoint).items()}

    def perceptron(name: str, x: np.ndarray) -> np.ndarray:
        for index in range(3):
            x = x @ tensors[f"{name}.{index}.weight"].T + tensors[f"{name}.{index}.bias"]
            x = x / (1 + np.exp(-x)) if index < 2 else x
        return x

    channel = tensors["encoder.channel.bias"].shape[0]
    numbers = np.asarray(code["code"], np.float64)
    own = numbers[len(numbers) - 3 * channel :].reshape(3, channel)
    common = np.concatenate((numbers[: -3 * channel], own.mean(axis=0)))
    trunk = perceptron("decoder.trunk", common)
    columns = perceptron("decoder.head", np.concatenate((np.tile(common, (3, 1)), own), axis=1)).T
    flat = tensors["start"] + tensors["spread"] * np.concatenate((trunk, columns.ravel()))
    second = columns.shape[0] - 1
    first = (len(trunk) - second) // (INPUTS + 1 + second)
    return _layers(flat, (INPUTS, first, second, OUTPUTS))


def reflectance(layers: list[tuple[np.ndarray, np.ndarray]], view: np.ndarray, light: np.ndarray) -> np.ndarray:
    """f_r [n, 3] in 1/sr for unit vectors [n, 3] above the surface; plain numpy."""
    half = view + light
    half /= np.maximum(np.linalg.norm(half, axis=1, keepdims=True), 1e-20)
    sine, cosine = np.hypot(half[:, 0], half[:, 1]), half[:, 2]
    along = np.where(sine > 0, half[:, 0] / np.maximum(sine, 1e-20), 1.0)
    across = np.where(sine > 0, half[:, 1] / np.maximum(sine, 1e-20), 0.0)
    x, y = light[:, 0] * along + light[:, 1] * across, light[:, 1] * along - light[:, 0] * across
    inputs = (sine, 0 * sine, cosine, x * cosine - light[:, 2] * sine, y, x * sine + light[:, 2] * cosine)
    return forward(layers, np.stack(inputs, axis=1))


def forward(layers: list[tuple[np.ndarray, np.ndarray]], signal: np.ndarray) -> np.ndarray:
    """f_r [..., 3] of inputs [..., 6]."""
    (first, second, third) = layers
    signal = np.maximum(signal @ first[0] + first[1], 0)
    signal = np.maximum(signal @ second[0] + second[1], 0)
    return np.maximum(np.expm1(np.minimum(signal @ third[0] + third[1], LARGEST_EXPONENT)), 0)


def lobe(layers: list[tuple[np.ndarray, np.ndarray]]) -> tuple[float, float]:
    """Share and width of the lobe of least variance over three viewers: E[(f cos θ)² / p] by drawing from candidates."""
    random = np.random.default_rng(0)
    count = 2000
    best, found = np.inf, (0.0, 0.5)
    views = [np.array([np.sin(theta), 0, np.cos(theta)]) for theta in np.radians((10, 45, 72))]
    u, v, choice = random.random((3, count))
    for width in WIDTHS:
        drawn = [_draw(view, width, u, v) for view in views]
        for share in SHARES if width == WIDTHS[0] else SHARES[1:]:
            variance = 0.0
            for view, glossy in zip(views, drawn):
                radius = np.sqrt(u)
                diffuse = np.stack((radius * np.cos(2 * np.pi * v), radius * np.sin(2 * np.pi * v), np.sqrt(1 - u)), axis=1)
                light = np.where((choice < share)[:, None], glossy, diffuse)
                above = light[:, 2] > 1e-6
                light = np.where(above[:, None], light, [0, 0, 1])
                density = share * _density(np.broadcast_to(view, light.shape), light, width) + (1 - share) * light[:, 2] / np.pi
                value = reflectance(layers, np.broadcast_to(view, light.shape), light).mean(axis=1) * light[:, 2]
                weight = np.where(above, value / density, 0)
                variance += weight.var() / max(weight.mean(), 1e-9) ** 2
            if variance < best:
                best, found = variance, (float(share), float(width))
    return found


def _draw(view: np.ndarray, width: float, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Reflections at visible normals of GGX (E. Heitz, *Sampling the GGX Distribution of Visible Normals*, 2018)."""
    stretched = view * [width, width, 1]
    stretched /= np.linalg.norm(stretched)
    tangent = np.array([-stretched[1], stretched[0], 0])
    tangent = tangent / np.linalg.norm(tangent) if np.linalg.norm(tangent) > 0 else np.array([1.0, 0, 0])
    bitangent = np.cross(stretched, tangent)
    radius, phi = np.sqrt(u), 2 * np.pi * v
    x, y = radius * np.cos(phi), radius * np.sin(phi)
    share = 0.5 * (1 + stretched[2])
    y = (1 - share) * np.sqrt(1 - x * x) + share * y
    z = np.sqrt(np.maximum(0, 1 - x * x - y * y))
    normal = (x[:, None] * tangent + y[:, None] * bitangent + z[:, None] * stretched) * [width, width, 1]
    normal[:, 2] = np.maximum(normal[:, 2], 1e-9)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    return 2 * (normal @ view)[:, None] * normal - view


def _density(view: np.ndarray, light: np.ndarray, width: float) -> np.ndarray:
    """Density [1/sr] of these reflections."""
    half = view + light
    half /= np.linalg.norm(half, axis=1, keepdims=True)
    spread = (half[:, 0] ** 2 + half[:, 1] ** 2) / width**2 + half[:, 2] ** 2
    normals = 1 / (np.pi * width**2 * spread**2)
    shadow = 2 / (1 + np.sqrt(1 + width**2 * (view[:, 0] ** 2 + view[:, 1] ** 2) / view[:, 2] ** 2))
    return normals * shadow / (4 * view[:, 2])


class Nbrdf(mi.BSDF):
    """The plugin; see the head of this file."""

    def __init__(self, props: mi.Properties):
        mi.BSDF.__init__(self, props)
        if not mi.variant().endswith("rgb"):
            raise RuntimeError(f"nbrdf: expected a variant that renders RGB, found {mi.variant()}")
        resolve = mi.file_resolver().resolve
        checkpoint = str(resolve(props["checkpoint"])) if "checkpoint" in props else None
        self.file = str(resolve(props["filename"]))
        self.layers = read(self.file, checkpoint)
        given = [name for name in ("share", "width") if name in props]
        share, width = lobe(self.layers) if len(given) < 2 else (0.0, 0.0)
        self.share = min(max(float(props["share"]) if "share" in props else share, 0.0), 0.95)
        self.width = min(max(float(props["width"]) if "width" in props else width, 1e-3), 1.0)
        self.is_scalar = mi.variant().startswith("scalar")
        glossy = mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide
        self.m_components = [glossy]
        self.m_flags = glossy

    def traverse(self, callback):
        """No parameter can be changed in place: weights are part of the kernel."""

    def to_string(self):
        """For logs."""
        return f"Nbrdf[{self.file}, lobe share {self.share:.2f}, width {self.width:.3f}]"

    def eval(self, ctx, si, wo, active=True):
        """f_r cos θ of the light, 0 below either horizon."""
        cosine_view, cosine = mi.Frame3f.cos_theta(si.wi), mi.Frame3f.cos_theta(wo)
        active = active & (cosine_view > 0) & (cosine > 0)
        if not ctx.is_enabled(mi.BSDFFlags.GlossyReflection):
            return mi.Color3f(0)
        if self.is_scalar:
            if not active:
                return mi.Color3f(0)
            value = forward(self.layers, np.array(self._inputs(si.wi, mi.Vector3f(wo)), np.float32))
            return mi.Color3f((value * cosine).tolist())
        return dr.select(active, self._network(self._inputs(si.wi, wo)) * cosine, 0)

    def _inputs(self, view, light):
        """Of the network; the second is 0."""
        half = dr.normalize(view + light)
        sine = dr.sqrt(dr.square(half.x) + dr.square(half.y))
        scale = dr.select(sine > 0, dr.rcp(dr.maximum(sine, 1e-20)), 0)
        along, across = dr.select(sine > 0, half.x * scale, 1), half.y * scale
        x, y = light.x * along + light.y * across, light.y * along - light.x * across
        return [sine, 0, half.z, x * half.z - light.z * sine, y, x * sine + light.z * half.z]

    def _network(self, signal):
        """The same as `forward`, in the kernel."""
        for index, (kernel, bias) in enumerate(self.layers):
            outputs = []
            for column in range(kernel.shape[1]):
                total = mi.Float(float(bias[column]))
                for row, value in enumerate(signal):
                    total = dr.fma(value, float(kernel[row, column]), total)
                outputs.append(dr.maximum(total, 0) if index < 2 else total)
            signal = outputs
        # exp(y) − 1 loses its digits where y is small, and these are the dark materials.
        small = [dr.abs(y) < 1e-2 for y in signal]
        series = [y * (1 + y * (0.5 + y * (1 / 6))) for y in signal]
        exact = [dr.exp(dr.minimum(y, LARGEST_EXPONENT)) - 1 for y in signal]
        return mi.Color3f([dr.maximum(dr.select(s, a, b), 0) for s, a, b in zip(small, series, exact)])

    def pdf(self, ctx, si, wo, active=True):
        """Density [1/sr] of `sample`, 0 below either horizon."""
        cosine_view, cosine = mi.Frame3f.cos_theta(si.wi), mi.Frame3f.cos_theta(wo)
        active = active & (cosine_view > 0) & (cosine > 0)
        if self.is_scalar and not active:
            return 0.0
        half = dr.normalize(si.wi + wo)
        normals = mi.MicrofacetDistribution(mi.MicrofacetType.GGX, self.width, True)
        glossy = normals.pdf(si.wi, half) / (4 * dr.dot(wo, half))
        return dr.select(active, self.share * glossy + (1 - self.share) * cosine * dr.inv_pi, 0)

    def sample(self, ctx, si, sample1, sample2, active=True):
        """A light, and f_r cos θ over its density."""
        active = active & (mi.Frame3f.cos_theta(si.wi) > 0)
        bs = mi.BSDFSample3f() if self.is_scalar else dr.zeros(mi.BSDFSample3f)
        if not ctx.is_enabled(mi.BSDFFlags.GlossyReflection) or (self.is_scalar and not active):
            return bs, mi.Color3f(0)
        normals = mi.MicrofacetDistribution(mi.MicrofacetType.GGX, self.width, True)
        normal, _ = normals.sample(si.wi, sample2)
        glossy, diffuse = mi.reflect(si.wi, normal), mi.warp.square_to_cosine_hemisphere(sample2)
        bs.wo = dr.select(sample1 < self.share, glossy, diffuse)
        bs.pdf = self.pdf(ctx, si, bs.wo, active)
        bs.eta = 1.0
        bs.sampled_type = int(mi.BSDFFlags.GlossyReflection) if self.is_scalar else mi.UInt32(+mi.BSDFFlags.GlossyReflection)
        bs.sampled_component = 0
        is_drawn = active & (bs.pdf > 0)
        value = self.eval(ctx, si, bs.wo, is_drawn)
        return bs, dr.select(is_drawn, value / dr.maximum(bs.pdf, 1e-20), 0)

    def eval_pdf(self, ctx, si, wo, active=True):
        """Both at once."""
        return self.eval(ctx, si, wo, active), self.pdf(ctx, si, wo, active)


mi.register_bsdf("nbrdf", lambda props: Nbrdf(props))
