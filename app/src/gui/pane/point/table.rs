//! All there is at a point as text, for a spreadsheet.

use std::fmt::Write as _;

use nbrdf_core::Directions;

use super::name;
use crate::gui::Session;
use crate::worker::Point;

/// Name, degrees and meaning of each angle of a pair of directions.
pub fn angles(at: Directions) -> [(&'static str, f32, &'static str); 7] {
    // + 0: nobody wants to read −0.
    let degrees = |radians: f32| radians.to_degrees() + 0.0;
    let theta = |v: nbrdf_core::Vec3| degrees(v.x.hypot(v.y).atan2(v.z));
    let phi = |v: nbrdf_core::Vec3| degrees(v.y.atan2(v.x));
    let rusinkiewicz = at.rusinkiewicz();
    [
        ("θ_i", theta(at.light), "Between light and normal"),
        ("φ_i", phi(at.light), "Azimuth of the light, from east to north"),
        ("θ_o", theta(at.view), "Between view and normal"),
        ("φ_o", phi(at.view), "Azimuth of the view, from east to north"),
        ("θ_h", degrees(rusinkiewicz.theta_half), "Between half vector and normal"),
        ("θ_d", degrees(rusinkiewicz.theta_diff), "Between light and half vector"),
        ("φ_d", degrees(rusinkiewicz.phi_diff), "Azimuth of the light around the half vector"),
    ]
}

/// One line for each card and lamp, cells divided by tabs.
pub fn text(session: &Session, point: &Point) -> String {
    let lighting = session.look.scenery.lighting;
    let heads = "card\tlamp\ttheta_i\tphi_i\ttheta_o\tphi_o\ttheta_h\ttheta_d\tphi_d\tf_r_red\tf_r_green\tf_r_blue\t\
                 radiance_red\tradiance_green\tradiance_blue\tshown_red\tshown_green\tshown_blue\n";
    let mut out = heads.to_owned();
    let readings = session.cards().into_iter().filter_map(|card| {
        let (_, reading) = point.readings.iter().find(|(other, _)| *other == card)?;
        Some((card, reading.as_ref().ok()?))
    });
    for (card, reading) in readings {
        let cells = |values: Option<[String; 3]>| values.map_or("\t\t".to_owned(), |values| values.join("\t"));
        let radiance = cells(reading.radiance.map(|value| value.0.map(|channel| channel.to_string())));
        let shown = cells(reading.shown.map(|bytes| bytes.map(|byte| byte.to_string())));
        for (lamp, value) in point.lamps.iter().zip(&reading.values) {
            let own = angles(lamp.directions).map(|(_, degrees, _)| degrees.to_string()).join("\t");
            let value = value.0.map(|channel| channel.to_string()).join("\t");
            let (title, lamp) = (session.title(card), name(lighting, lamp.lamp));
            // Writing to a string cannot fail.
            let _ = writeln!(out, "{title}\t{lamp}\t{own}\t{value}\t{radiance}\t{shown}");
        }
    }
    out
}
