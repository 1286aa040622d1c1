import numpy as np
import pytest

from nbrdf_jax import metrics
from nbrdf_jax.analytic import LOBES, Microfacet
from nbrdf_jax.coordinates import angles_from_vectors
from nbrdf_jax.delta_e_itp import delta_e_itp
from nbrdf_jax.directions import rus32k
from nbrdf_jax.lights import lamps
from nbrdf_jax.sphere import LitSphere
from nbrdf_jax.ssim import ssim

WHITE = Microfacet((1.0, 1.0, 1.0))


def test_a_white_lambertian_facing_the_point_light_shows_one():
    picture = LitSphere.under("point", 512).render(WHITE)
    assert picture.max() == pytest.approx(1, abs=1e-4)
    row, column, _ = np.unravel_index(picture.argmax(), picture.shape)
    assert abs(row - 255.5) < 4 and column > 256 + 512 * 0.99 / 2 * 0.69  # 45° to the right, level with the eye


def test_up_is_up():
    top, bottom = np.split(LitSphere.under("studio", 64).render(WHITE), 2)
    assert top.sum() > 1.5 * bottom.sum()  # the key light comes from above


def test_studio_has_eleven_lamps_of_known_total():
    directions, irradiance = lamps("studio")
    assert directions.shape == (11, 3) and np.allclose(np.linalg.norm(directions, axis=1), 1)
    assert np.allclose(irradiance.sum(axis=0), [1.39, 1.39, 1.39])
    assert np.allclose(directions[3], [np.sin(np.radians(75)), 0, np.cos(np.radians(75))])
    assert directions[4][2] == pytest.approx(np.cos(np.radians(50)))


def test_the_middle_pixel_faces_the_viewer():
    scene = LitSphere.under("studio", 65)
    middle = np.flatnonzero(np.flatnonzero(scene.covered.ravel()) == 32 * 65 + 32)[0]
    assert np.allclose(scene.view[middle], [0, 0, 1])
    assert np.allclose(scene.light[:, middle], lamps("studio")[0])


def test_surface_frames_are_right_handed():
    scene = LitSphere.under("studio", 16)
    # n · (light × view) of the picture's frame must keep its sign in every surface frame.
    size, normals = 16, []
    for row, column in zip(*np.nonzero(scene.covered)):
        x, y = ((column + 0.5) * 2 / size - 1) / 0.99, -((row + 0.5) * 2 / size - 1) / 0.99
        normals.append([x, y, np.sqrt(1 - x * x - y * y)])
    world = np.cross(lamps("studio")[0][0], [0, 0, 1.0]) @ np.array(normals).T
    assert np.allclose(np.cross(scene.light[0], scene.view)[:, 2], world, atol=1e-12)
    assert np.allclose(scene.light[0][:, 2], np.array(normals) @ lamps("studio")[0][0])
    assert np.isfinite(angles_from_vectors(scene.light[0], scene.view)).all()


@pytest.mark.parametrize("lobe", LOBES)
@pytest.mark.parametrize("alpha", [0.3, 0.6])
def test_every_lobe_is_a_distribution(lobe, alpha):
    cos = (np.arange(200_000) + 0.5) / 200_000
    assert np.mean(LOBES[lobe](cos, alpha) * cos) * 2 * np.pi == pytest.approx(1, abs=2e-4)


def test_a_white_microfacet_of_width_one_returns_one_minus_ln_2():
    # At α = 1 and normal incidence D = 1/π and G = 2 c / (1 + c), so f = 1 / (2π (1 + c)), integrable by hand.
    z = (np.arange(100_000) + 0.5) / 100_000
    light = np.stack((np.sqrt(1 - z * z), np.zeros_like(z), z), axis=1)
    view = np.broadcast_to(np.array([0.0, 0.0, 1.0]), light.shape)
    material = Microfacet((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), 1.0)
    assert np.mean(material(light, view)[:, 0] * z) * 2 * np.pi == pytest.approx(1 - np.log(2), abs=1e-9)


def test_microfacets_are_reciprocal():
    light, view = rus32k()
    material = Microfacet((0.2, 0.1, 0.0), (0.04, 0.3, 1.0), 0.4)
    assert np.allclose(material(light, view), material(view, light), rtol=1e-9)


def test_psnr_is_capped_at_100():
    pixels = np.full((4, 3), 0.3)
    assert metrics.psnr(pixels, pixels) == 100
    assert metrics.psnr(np.zeros((4, 3)), np.ones((4, 3))) == 0
    assert metrics.psnr(np.ones((4, 3)), np.full((4, 3), 7.0)) == 100  # display clips


def test_log_error_of_a_known_pair():
    f, g, cosine = np.full((5, 3), 2.0), np.zeros((5, 3)), np.full(5, 0.5)
    assert metrics.log_error(f, g, cosine) == pytest.approx(np.log(2))
    assert metrics.relative_log(f, g, cosine) == pytest.approx(np.log(1001))


def test_equal_pictures_have_no_distance():
    picture = LitSphere.under("point", 24).render(WHITE)
    assert ssim(picture, picture) == pytest.approx(1)
    assert delta_e_itp(picture[8], picture[8]) == 0


def test_grey_differs_in_intensity_alone():
    # PQ of 100 cd/m² is 0.508078 (BT.2100), so black to white is 720 · that, PQ(0) being almost 0.
    assert delta_e_itp(np.zeros((1, 3)), np.ones((1, 3))) == pytest.approx(720 * 0.508078, abs=0.01)
