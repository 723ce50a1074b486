//! A driven link that two pairs hold, neither of which is a pin on a solved link.

use crate::board::{Direction, Line, Point};
use crate::mechanism::structure::{Drive, Hold};
use crate::mechanism::{LinkId, PointId};

use super::super::draughtsman::Draughtsman;
use super::groups::Sliding;
use super::rolling::Contact;
use super::{About, Balance, Item, Pull, SlideForce, Taken, TakenFor, pulls};

/// The pairs of a driven bar.
pub(super) struct Bar {
    pub(super) link: LinkId,
    pub(super) pins: [PointId; 2],
    pub(super) holds: [Hold; 2],
    pub(super) under: [bool; 2],
}

/// What holds the bar at one of its two ends.
enum Side {
    /// A pin of the bar rides, itself or with a link or block.
    Rides {
        slide: usize,
        sliding: Sliding,
        items: Vec<Item>,
        touch: Point,
    },
    /// The bar carries the guide of a solved pin.
    Carries {
        slide: usize,
        sliding: Sliding,
        items: Vec<Item>,
    },
    Touches {
        roll: usize,
        wheel: LinkId,
        contact: Contact,
    },
    /// A rod holds a pin of the bar.
    Turns {
        rod: LinkId,
        base: PointId,
        items: Vec<Item>,
        touch: Point,
        /// Of the bar's force on the rod what moments about the base give.
        across: Option<Pull>,
    },
}

/// A polygon with the two lines of what holds the bar; then moments give the effort.
pub(super) fn driven_bar(d: &mut Draughtsman<'_>, bar: &Bar, input: Drive, balance: &mut Balance) {
    let Bar { link, pins, holds, under } = *bar;
    let on_bar = balance.on(link);
    let mut all = pulls(&on_bar);
    let mut links = vec![link];
    let mut sides: Vec<(Side, Direction)> = Vec::new();
    for i in 0..2 {
        let at = d.at(pins[i]);
        sides.push(match holds[i] {
            Hold::Slide(slide) => {
                let (_, normal) = d.pressing_at(balance, slide, at);
                let sliding = d.sliding(slide, None);
                let sliding = match sliding.inner {
                    // A link rides for the bar, or carries the guide on which a solved one rides.
                    Some(inner) if !under[i] && !d.mechanism.point(pins[i]).links.contains(&inner) => {
                        d.sliding_link(slide, d.mechanism.slides[slide].guide.link)
                    }
                    _ => sliding,
                };
                let items = balance.on_some(sliding.inner);
                if under[i] {
                    (Side::Carries { slide, sliding, items }, normal)
                } else {
                    all.extend(pulls(&items));
                    links.extend(sliding.inner);
                    let touch = match sliding.inner {
                        Some(inner) => d.inner_touch(balance, pins[i], [link, inner]),
                        None => at,
                    };
                    (Side::Rides { slide, sliding, items, touch }, normal)
                }
            }
            Hold::Contact { roll, wheel } => {
                let contact = d.contact_at(roll);
                (Side::Touches { roll, wheel: d.rolling_side(roll, link, wheel), contact }, contact.push)
            }
            Hold::Ram(_) => {
                balance.refused = Some(super::groups::NO_BALANCE);
                return;
            }
            Hold::Rod { rod, base } => {
                let items = balance.on(rod);
                let at_base = d.touch_at(balance, base, rod);
                let touch = d.inner_touch(balance, pins[i], [link, rod]);
                let reason = d.reason(&[rod]);
                let (along, _) = d.board.toward(at_base, touch, reason);
                let square = d.board.quarter_turn(along);
                let moments = d.moments(&items, at_base);
                let across = moments.map(|moments| {
                    let found = TakenFor::Across { pin: pins[i], by: link, on: rod, from: base };
                    balance.taken.push(Taken { links: vec![rod], about: About::Point(base), found });
                    let line = Line { through: touch, along: square };
                    let size = d.balancing(Some(moments), line, at_base, &[rod]);
                    d.pull_along(square, size)
                });
                all.extend(across.map(Draughtsman::opposite));
                (Side::Turns { rod, base, items, touch, across }, along)
            }
        });
    }
    let lines = [sides[0].1, sides[1].1];
    let forces = d.two_lines(&all, lines, &[link]);
    let handed_on = sides.iter().filter_map(|(side, _)| match side {
        Side::Rides { sliding, items, .. } if !items.is_empty() => sliding.inner,
        _ => None,
    });
    let together: Vec<LinkId> = std::iter::once(link).chain(handed_on).collect();
    if together.len() > 1 {
        balance.as_one.push(together);
    }
    let mut items = on_bar;
    for (i, (side, _)) in sides.into_iter().enumerate() {
        let (at, force, pin) = (d.at(pins[i]), forces[i], pins[i]);
        items.push(match side {
            Side::Rides { slide, sliding, items, touch } => {
                let mut of_inner = pulls(&items);
                of_inner.push(force);
                let head = d.chained(&of_inner);
                let on_bar = Pull { tail: d.board.origin(), head };
                let mut about = items;
                if Draughtsman::rubs_at(balance, pin) {
                    let back = Draughtsman::opposite(on_bar);
                    about.push(Item { pull: Some(back), at: touch, couple: None });
                }
                let couple = if sliding.inner.is_some() { d.keeping(&about, at) } else { None };
                if let Some(inner) = sliding.inner {
                    let back = Draughtsman::opposite(on_bar);
                    d.note_inner_pin(balance, pin, [(link, on_bar), (inner, back)]);
                }
                d.note_slide(balance, slide, &sliding, pin, SlideForce { pull: force, at, couple });
                Item { pull: Some(on_bar), at: touch, couple: None }
            }
            Side::Carries { slide, sliding, items } => {
                let on_inner = Draughtsman::opposite(force);
                let mut of_inner = pulls(&items);
                of_inner.push(on_inner);
                let of_pin = d.closing(&of_inner);
                let mut about = items;
                if let (true, Some(block)) = (Draughtsman::rubs_at(balance, pin), sliding.inner) {
                    let touch = d.touch_at(balance, pin, block);
                    about.push(Item { pull: Some(of_pin), at: touch, couple: None });
                }
                let couple = if sliding.inner.is_some() { d.keeping(&about, at) } else { None };
                d.note_slide(balance, slide, &sliding, pin, SlideForce { pull: on_inner, at, couple });
                match sliding.inner {
                    Some(block) => d.note_pin(balance, pin, block, of_pin),
                    None => {
                        let item = Item { pull: Some(on_inner), at, couple: None };
                        balance.push_on_pin(d, pin, item);
                    }
                }
                let felt = couple.map(|couple| d.board.opposite(couple));
                Item { pull: Some(force), at, couple: felt }
            }
            Side::Touches { roll, wheel, contact } => {
                d.presses(balance, roll, (wheel, link), force, &contact);
                Item { pull: Some(force), at: contact.at, couple: None }
            }
            Side::Turns { rod, base, items, touch, across } => {
                let parts: Vec<Pull> = across.map(Draughtsman::opposite).into_iter().chain([force]).collect();
                let on_bar = Pull { tail: d.board.origin(), head: d.chained(&parts) };
                let on_bar = d.pin_force_as_used(pin, link, on_bar);
                let on_rod = Draughtsman::opposite(on_bar);
                d.note_inner_pin(balance, pin, [(link, on_bar), (rod, on_rod)]);
                let mut of_rod = pulls(&items);
                of_rod.push(on_rod);
                let reaction = d.closing(&of_rod);
                d.note_pin(balance, base, rod, reaction);
                Item { pull: Some(on_bar), at: touch, couple: None }
            }
        });
    }
    let about = d.at(pins[0]);
    let moments = d.moments(&items, about);
    d.note_effort(balance, input, moments, (&links, pins[0]));
}
