//! What film strips show.

use std::collections::HashMap;

use nbrdf::worker::{Answer, Request, Tour, Worker};

use super::*;

/// Mean brightness of the middle frame of each strip, once everything is shown.
fn middles(session: &Session) -> HashMap<Card, f64> {
    let mut worker = Worker::start(Stock::built_in(), || {});
    let number = worker.show(Request { strip: 32, size: 32, ..session.shown() });
    let middle = Tour::Along.frames(2) / 2;
    let (mut found, mut is_done) = (HashMap::new(), false);
    let patience = Instant::now() + Duration::from_secs(120);
    while !is_done {
        assert!(Instant::now() < patience, "still waiting for the strips");
        std::thread::sleep(Duration::from_millis(5));
        for answer in worker.answers() {
            match answer {
                Answer::Frame(card, step, picture) if step == middle => {
                    let sum: u64 = picture.rgba.iter().map(|&byte| u64::from(byte)).sum();
                    found.insert(card, sum as f64 / picture.rgba.len() as f64);
                }
                Answer::Done(done) => is_done |= done == number,
                _ => {}
            }
        }
    }
    found
}

#[test]
fn strips_show_a_path_as_it_is_edited_where_edits_apply() {
    let [latent, tables] = ["latent", "linear_mix"].map(Card::Method);
    let mut session = Session { methods: Methods(vec!["latent", "linear_mix"]), ..Session::default() };
    let plain = middles(&session);
    session.blend.edits[0] = 0.25;
    let edited = middles(&session);
    assert!(edited[&latent] > plain[&latent] + 2.0, "lighter: {plain:?} {edited:?}");
    assert_eq!(edited[&tables], plain[&tables], "a mix has no code to edit");
}
