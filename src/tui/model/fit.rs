//! The page that fits the scene, the screen and the speed.

use super::{Lens, Model, Speed, pace, room};
use crate::live::{Order, Sampling};
use crate::scene::Scene;
use crate::tui::layout;

/// A contact that is looked into lasts for so long, s.
const CONTACT_SECONDS: f64 = 2.0;
/// Speed of the least motion that is seen there, m/s.
const LEAST_WAY: f64 = 1e-3;
/// The part of a page before a landing that is looked into.
const LEAD: f64 = 0.1;

impl Model {
    /// The order for another sampling, if the page in force no longer suits the
    /// screen or the scene. A page that would become only a little longer or shorter
    /// is finished first, unless it is to be changed `at_once`.
    pub(in crate::tui) fn fit_page(&mut self, turned: bool, at_once: bool) -> Option<Order> {
        let present = self.page.sweep;
        let slower = self.speed.over(self.fitting);
        let mut wanted = sweep(self.bench.scenes(), self.size, present.origin, slower);
        if self.page.now < present.origin {
            // The page is of a time before its first edit.
            wanted.origin = (self.page.now / wanted.span).floor() * wanted.span;
        }
        let ratio = wanted.span / present.span;
        let bears = (0.6..1.7).contains(&ratio) && !turned && !at_once;
        if (ratio - 1.0).abs() < 1e-9 || bears {
            wanted.span = present.span;
        } else {
            // What has been drawn of this page stays, if the new one is long enough.
            let start = present.page_start(self.page.now);
            wanted.origin = if self.page.now - start < wanted.span {
                start
            } else {
                self.page.now
            };
        }
        if wanted == present {
            return None;
        }
        self.page.set_sweep(wanted);
        Some(Order::Sampling(wanted))
    }

    /// Looks into the next landing: just before it time slows down until a contact lasts for
    /// two seconds. Or goes on as before. None among hard spheres, whose collisions take no
    /// time.
    pub(in crate::tui) fn look_into_landing(&mut self) -> Option<Order> {
        if let Some(before) = self.looked_into.take() {
            self.speed = before;
            self.page.lens = None;
            return Some(Order::Speed(before.factor()));
        }
        let contact_time = self.bench.contact_time()?;
        self.looked_into = Some(self.speed);
        self.speed = Speed::nearest(contact_time / CONTACT_SECONDS);
        self.held = false;
        self.page.lens = Some(Lens::new(LEAST_WAY * contact_time));
        let slower = self.speed.over(self.fitting);
        let page = sweep(self.bench.scenes(), self.size, 0.0, slower);
        Some(Order::LookInto {
            speed: self.speed.factor(),
            lead: LEAD * page.span,
        })
    }
}

/// The page of these scenes on a screen of that size, which takes as long to fill at a speed
/// that is `slower` than what suits them, 1 being that.
pub(super) fn sweep(scenes: &[Scene], size: (u16, u16), origin: f64, slower: f64) -> Sampling {
    let cells = layout::trace_width(size, room::contents(scenes));
    Sampling {
        origin,
        span: pace::span(scenes, cells) * slower.min(1.0),
        columns: usize::from(cells.max(1)) * 2,
        // Where the whole of a collision is not on a page, no page of it is the last.
        hold: pace::ends(scenes) && slower >= 1.0,
    }
}
