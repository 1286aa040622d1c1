//! What the user chose; every change is a plain function, so that tests need no window.

use egui::ThemePreference;
use nbrdf_core::{Database, Vec3};

use crate::catalog::INTERPOLATIONS;
use crate::worker::{Card, Lighting};

/// Marks on the scrubber from end to end.
pub const TICKS: u8 = 16;
/// Exposure goes this many stops either way.
pub const MAX_EXPOSURE: f32 = 4.0;
/// Seconds from end to end while playing.
const TRAVEL: f32 = 5.0;

/// One of the two ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// At t = 0.
    A,
    /// At t = 1.
    B,
}

impl End {
    /// Its letter.
    pub const fn letter(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::B => "B",
        }
    }
}

/// Everything the user can change.
#[derive(Clone, Debug, PartialEq)]
pub struct Session {
    /// Names of the materials at A and B.
    pub ends: [String; 2],
    /// Where on the path, 0..1.
    pub t: f32,
    /// Whether t moves by itself, and which way.
    pub playing: Option<End>,
    /// Exposure in stops.
    pub exposure: f32,
    /// The light.
    pub lighting: Lighting,
    /// Interpolations shown, by catalog name, in catalog order.
    pub methods: Vec<&'static str>,
    /// Whether whole paths are shown below the spheres.
    pub strips: bool,
    /// Dark, light, or as the system.
    pub theme: ThemePreference,
    /// What names must contain to be listed.
    pub search: String,
    /// Whose materials are listed.
    pub database: Option<Database>,
}

impl Default for Session {
    fn default() -> Self {
        Self {
            ends: ["gold-paint", "blue-acrylic"].map(str::to_owned),
            t: 0.5,
            playing: None,
            exposure: 0.0,
            lighting: Lighting::Studio,
            methods: vec!["latent", "raw_weights", "pca_tables"],
            strips: true,
            theme: ThemePreference::System,
            search: String::new(),
            database: None,
        }
    }
}

impl Session {
    /// Puts a material at an end.
    pub fn choose(&mut self, end: End, name: &str) {
        name.clone_into(&mut self.ends[end as usize]);
    }

    /// Exchanges the ends; the picture in between stays where it was.
    pub fn swap(&mut self) {
        self.ends.swap(0, 1);
        self.t = 1.0 - self.t;
    }

    /// Goes to the next tick after (`+1`) or before (`-1`) the present place, and so on.
    pub fn step(&mut self, ticks: i8) {
        self.playing = None;
        let place = self.t * f32::from(TICKS);
        let from = if ticks > 0 { (place + 1e-3).floor() } else { (place - 1e-3).ceil() };
        self.t = ((from + f32::from(ticks)) / f32::from(TICKS)).clamp(0.0, 1.0);
    }

    /// Goes to a place on the path.
    pub fn go_to(&mut self, t: f32) {
        self.playing = None;
        self.t = t.clamp(0.0, 1.0);
    }

    /// Starts or stops playing; at B it starts backwards.
    pub fn toggle_play(&mut self) {
        self.playing = match self.playing {
            Some(_) => None,
            None if self.t >= 1.0 => Some(End::A),
            None => Some(End::B),
        };
    }

    /// Moves on while playing, back and forth.
    pub fn advance(&mut self, seconds: f32) {
        let Some(towards) = self.playing else { return };
        let way = if towards == End::B { seconds } else { -seconds } / TRAVEL;
        self.t = (self.t + way).clamp(0.0, 1.0);
        if self.t <= 0.0 {
            self.playing = Some(End::B);
        } else if self.t >= 1.0 {
            self.playing = Some(End::A);
        }
    }

    /// Shows a method or hides it.
    pub fn toggle_method(&mut self, name: &str) {
        let was_on = |method: &str| self.methods.contains(&method);
        let is_on = |method: &&str| was_on(method) != (*method == name);
        self.methods = INTERPOLATIONS.iter().map(|entry| entry.name).filter(is_on).collect();
    }

    /// Moves the point light so that a mirror sphere shows it at `x` (right), `y` (up), in radii from the middle.
    pub fn point_at(&mut self, x: f32, y: f32) {
        // Further out the lamp would stand behind the sphere and show nothing.
        let scale = 0.75 / x.hypot(y).max(0.75);
        let (x, y) = (x * scale, y * scale);
        let z = (1.0 - x * x - y * y).sqrt();
        self.lighting = Lighting::Point(Vec3::new(2.0 * z * x, 2.0 * z * y, 2.0 * z * z - 1.0));
    }

    /// Turns the map that surrounds the spheres by so many radii of a sphere; false where there is none.
    pub fn turn_by(&mut self, radii: f32) -> bool {
        let Lighting::Around { turn, .. } = &mut self.lighting else { return false };
        // Half a sphere across is a quarter of a turn; the far side is reached by going on.
        let around = std::f32::consts::TAU;
        *turn = (*turn + radii * std::f32::consts::FRAC_PI_2 + 0.5 * around).rem_euclid(around) - 0.5 * around;
        true
    }

    /// Where a mirror sphere shows the point light, in radii from the middle, if there is one.
    pub fn highlight(&self) -> Option<[f32; 2]> {
        let Lighting::Point(direction) = self.lighting else { return None };
        let half = (direction.normalize() + Vec3::Z).normalize();
        Some([half.x, half.y])
    }

    /// Exposure, light and t as at the start; materials and methods stay.
    pub fn reset(&mut self) {
        let Self { t, exposure, lighting, playing, .. } = Self::default();
        (self.t, self.exposure, self.lighting, self.playing) = (t, exposure, lighting, playing);
    }

    /// Whether a material is listed: every word of the search is in its name.
    pub fn lists(&self, name: &str) -> bool {
        let plain = |text: &str| text.to_lowercase().replace(['_', '-', '/'], " ");
        let (name_plain, search) = (plain(name), plain(&self.search));
        search.split_whitespace().all(|word| name_plain.contains(word))
            && self.database.is_none_or(|database| Database::of(name) == database)
    }

    /// The spheres from left to right.
    pub fn cards(&self) -> Vec<Card> {
        let methods = self.methods.iter().map(|&method| Card::Method(method));
        std::iter::once(Card::A).chain(methods).chain([Card::B]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_go_from_tick_to_tick_and_stop_at_the_ends() {
        let mut session = Session { t: 0.52, ..Session::default() };
        session.step(1);
        assert_eq!(session.t, 9.0 / 16.0);
        session.step(-1);
        assert_eq!(session.t, 0.5);
        session.step(-100);
        assert_eq!(session.t, 0.0);
    }

    #[test]
    fn playing_turns_round_at_the_ends() {
        let mut session = Session { t: 0.9, ..Session::default() };
        session.toggle_play();
        session.advance(1.0);
        assert_eq!((session.t, session.playing), (1.0, Some(End::A)));
        session.advance(100.0);
        assert_eq!((session.t, session.playing), (0.0, Some(End::B)));
    }

    #[test]
    fn the_highlight_follows_the_pointer() {
        let mut session = Session::default();
        session.point_at(0.3, -0.4);
        let [x, y] = session.highlight().unwrap();
        assert!((x - 0.3).abs() < 1e-5 && (y + 0.4).abs() < 1e-5);
        session.point_at(5.0, 0.0);
        assert!((session.highlight().unwrap()[0] - 0.75).abs() < 1e-5);
    }

    #[test]
    fn dragging_turns_a_map_and_never_beyond_half_a_turn() {
        let mut session = Session { lighting: Lighting::Around { map: 0, turn: 0.0 }, ..Session::default() };
        for (radii, quarters) in [(1.0, 1.0), (2.0, -1.0)] {
            assert!(session.turn_by(radii));
            let Lighting::Around { turn, .. } = session.lighting else { panic!("{:?}", session.lighting) };
            assert!((turn - quarters * std::f32::consts::FRAC_PI_2).abs() < 1e-5, "{turn}");
        }
        assert!(!Session::default().turn_by(1.0));
    }

    #[test]
    fn search_takes_words_in_any_order_and_any_hyphen() {
        let session = Session { search: "fabric BLUE".to_owned(), ..Session::default() };
        assert!(session.lists("blue-fabric") && !session.lists("blue-rubber"));
        let rgl = Session { database: Some(Database::Rgl), ..Session::default() };
        assert!(rgl.lists("rgl/paper_white") && !rgl.lists("chrome"));
    }

    #[test]
    fn methods_stay_in_catalog_order() {
        let mut session = Session::default();
        session.toggle_method("linear_mix");
        session.toggle_method("aligned_weights");
        session.toggle_method("latent");
        assert_eq!(session.methods, ["raw_weights", "aligned_weights", "pca_tables", "linear_mix"]);
    }

    #[test]
    fn swapping_the_ends_keeps_the_picture() {
        let mut session = Session { t: 0.25, ..Session::default() };
        session.swap();
        assert_eq!((session.ends[0].as_str(), session.t), ("blue-acrylic", 0.75));
    }
}
