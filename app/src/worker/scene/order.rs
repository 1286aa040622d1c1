//! Letters to the thread that plans.

use super::{News, Wish};
use crate::worker::{Answer, Mailbox, Office};

/// A letter: a wish, or to stop.
#[derive(Clone, Debug)]
pub struct Order {
    pub number: u64,
    pub wish: Option<Wish>,
}

/// Where letters come from, and answers go.
#[derive(Clone, Copy)]
pub struct Desk<'a> {
    pub office: &'a Office,
    pub letters: &'a Mailbox<Order>,
}

impl Desk<'_> {
    pub fn say(&self, news: News) {
        self.office.say(Answer::Scene(news));
    }

    /// The next wish; none once the window is closed. A stop is answered here.
    pub fn next(&self) -> Option<(u64, Wish)> {
        loop {
            let Order { number, wish } = self.letters.take()?;
            if let Some(wish) = wish {
                return Some((number, wish));
            }
            self.say(News::Stopped);
            self.say(News::Done(number));
        }
    }

    /// The next wish if it is of the same scene; else whatever comes next.
    pub fn next_of(&self, wish: &Wish) -> Result<(u64, Wish), Option<(u64, Wish)>> {
        match self.next() {
            Some((number, next)) if next.source == wish.source && next.reading == wish.reading => Ok((number, next)),
            other => Err(other),
        }
    }
}
