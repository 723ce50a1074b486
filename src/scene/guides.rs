//! Guides, and the sliding pairs on them.

use super::diagnostic::{Fault, Res};
use super::draft::{Draft, is_straight};
use super::json::{Fields, Value};
use super::keys;
use super::links::{index_of, own_coordinates};
use super::units::Measure;
use crate::mechanism::{
    Direction, Form, Given, Guide, GuidePoint, LinkId, Path, Place, PointId, Rider, Slide,
};

/// Reads `slides`.
pub(super) fn slides(value: Option<&Value<'_>>, draft: &mut Draft<'_>) -> Res<()> {
    let Some(value) = value else { return Ok(()) };
    for item in value.list("a list of sliding pairs")? {
        let slide = slide(item, draft)?;
        if let Rider::Pin { block: Some(block), .. } = slide.rider {
            draft.mechanism.links[block.0].block = true;
        }
        draft.mechanism.slides.push(slide);
        draft.anchors.slides.push(item.at);
    }
    Ok(())
}

fn slide(item: &Value<'_>, draft: &Draft<'_>) -> Res<Slide> {
    let fields = Fields::of(item, keys::SLIDE, "a sliding pair: {\"pin\": …, \"on\": {…}}")?;
    let on = fields.need("on", "the guide, such as {\"link\": 1, \"through\": \"O\", \"angle\": 0}")?;
    let rider = match (fields.get("pin"), fields.entry("link")) {
        (Some(pin), None) => {
            fields.refuse(&["turned"], "a pin has no direction; only a sliding `link` has")?;
            pin_rider(pin, fields.get("block"), draft)?
        }
        (None, Some(link)) => {
            fields.refuse(&["block"], "a sliding `link` is itself the block")?;
            link_rider(&link.value, fields.get("turned"), draft)?
        }
        (Some(_), Some(link)) => {
            let fault = Fault::new(link.at, "a pin slides or a link does, not both");
            return Err(fault.mend("the link of the guide stands in `on`, the number of a block in `block`"));
        }
        (None, None) => {
            return Err(Fault::new(item.at, "what slides is missing")
                .mend("name a `pin`, or the number of a sliding `link`"));
        }
    };
    let guide = guide(on, None, draft)?;
    let rides_on_itself = match rider {
        Rider::Pin { point, block } => draft.stands_in(point, guide.link) || block == Some(guide.link),
        Rider::Link { link, .. } => {
            let first = draft.riding_point(&rider);
            link == guide.link || first.is_some_and(|p| draft.stands_in(p, guide.link))
        }
    };
    if rides_on_itself {
        let what = match draft.riding_point(&rider) {
            Some(point) => {
                let point = draft.say_point(point);
                format!("{point} stands in {} and cannot slide on it", draft.say(guide.link))
            }
            None => format!("{} cannot slide on itself", draft.say(guide.link)),
        };
        return Err(Fault::new(on.at, what).mend("the guide must belong to another link"));
    }
    if matches!(rider, Rider::Link { .. }) && !is_straight(&guide) {
        return Err(Fault::new(on.at, "a link slides without turning, so its guide must be straight")
            .mend("for an arc let a `pin` slide, or pin the link at the arc's centre"));
    }
    Ok(Slide { rider, guide })
}

fn pin_rider(pin: &Value<'_>, block: Option<&Value<'_>>, draft: &Draft<'_>) -> Res<Rider> {
    let point = draft.point(pin)?;
    let Some(value) = block else { return Ok(Rider::Pin { point, block: None }) };
    let block = draft.link_at(value)?;
    let name = draft.say_point(point);
    if draft.wide_blocks.contains(&block) && draft.link(block).points.first() == Some(&point) {
        return Ok(Rider::Link { link: block, turned: Some(Given::exact(0.0)) });
    }
    let own = draft.link(block);
    // Points that a mass or a load has by own coordinates are no joints.
    if own.points.first() != Some(&point) || own.points.len() != 1 + own.extra.len() {
        let what = format!("block {} has joints other than {name}", draft.link(block).number);
        return Err(Fault::new(value.at, what).mend(format!(
            "a block has its pin as its only joint; a larger link slides as \"link\": {}",
            draft.link(block).number
        )));
    }
    if draft.link(block).block {
        let what = format!("block {} slides in another pair already", draft.link(block).number);
        return Err(Fault::new(value.at, what).mend("number a second block, or let it slide as `link`"));
    }
    Ok(Rider::Pin { point, block: Some(block) })
}

fn link_rider(value: &Value<'_>, turned: Option<&Value<'_>>, draft: &Draft<'_>) -> Res<Rider> {
    let link = draft.moving_link(value)?;
    let placed = draft.link(link).form == Form::Placed;
    let turned = match (turned, placed) {
        (Some(turned), true) => {
            let what = format!("{} is dimensioned by placement and rides as placed", draft.say(link));
            return Err(Fault::new(turned.at, what).mend("leave out `turned`, or give the link's dimensions"));
        }
        (None, true) => None,
        (Some(turned), false) => Some(draft.scales.given(turned, Measure::Angle)?),
        (None, false) => Some(Given::exact(0.0)),
    };
    Ok(Rider::Link { link, turned })
}

/// Reads a guide. `default` is its link where `link` may be left out.
pub(super) fn guide(value: &Value<'_>, default: Option<LinkId>, draft: &Draft<'_>) -> Res<Guide> {
    read(value, default, Named::OfLink, draft)
}

/// Reads a line or an arc that is no guide of a pair: of the frame where it names no link, and by any points.
pub(super) fn path(value: &Value<'_>, draft: &Draft<'_>) -> Res<Guide> {
    read(value, Some(LinkId::FRAME), Named::Any, draft)
}

/// Which points a guide may name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Named {
    /// Those of its link, with which it moves.
    OfLink,
    /// Any: it is a line of this instant.
    Any,
}

impl Named {
    fn point(self, value: &Value<'_>, link: LinkId, draft: &Draft<'_>) -> Res<PointId> {
        match self {
            Self::OfLink => draft.point_in(value, link),
            Self::Any => draft.point(value),
        }
    }
}

fn read(value: &Value<'_>, default: Option<LinkId>, named: Named, draft: &Draft<'_>) -> Res<Guide> {
    let fields = Fields::of(value, keys::GUIDE, "a guide: {\"link\": …, \"through\": …, \"angle\": …}")?;
    let link = match (fields.get("link"), default) {
        (Some(link), _) => draft.link_at(link)?,
        (None, Some(link)) => link,
        (None, None) => {
            return Err(Fault::new(
                value.at,
                "`link` is missing: the number of the link that carries the guide",
            )
            .mend("the frame is link 1"));
        }
    };
    let path = if fields.get("centre").is_some() || fields.get("radius").is_some() {
        fields.refuse(
            &["through", "angle", "toward", "turned", "offset"],
            "an arc has a `centre` and a `radius` only",
        )?;
        let centre = fields.need("centre", "an arc has a `centre` and a `radius`")?;
        let radius = fields.need("radius", "an arc has a `centre` and a `radius`")?;
        Path::Arc {
            centre: guide_point(centre, link, named, draft)?,
            radius: draft.scales.positive(radius, "the radius")?,
        }
    } else {
        straight(&fields, link, named, draft)?
    };
    Ok(Guide { link, path })
}

fn straight(fields: &Fields<'_, '_>, link: LinkId, named: Named, draft: &Draft<'_>) -> Res<Path> {
    let through = fields.need(
        "through",
        "a straight guide goes through a point of its link or through [x, y]; an arc has a `centre`",
    )?;
    let through = guide_point(through, link, named, draft)?;
    let direction = match (fields.get("angle"), fields.entry("toward")) {
        (Some(_), Some(toward)) => {
            return Err(Fault::new(toward.at, "a guide has an `angle` or goes `toward` a point, not both"));
        }
        (None, Some(toward)) => {
            let point = named.point(&toward.value, link, draft)?;
            if own_place(through, link, draft).is_some_and(|p| Some(p) == own_of(point, link, draft))
                || through == GuidePoint::Point(point)
            {
                let what = format!("a guide through {0} toward {0} has no direction", draft.say_point(point));
                return Err(
                    Fault::new(toward.value.at, what).mend("name another point of the link, or an `angle`")
                );
            }
            Direction::Toward(point)
        }
        (Some(angle), None) => Direction::Angle(draft.scales.given(angle, Measure::Angle)?),
        (None, None) => Direction::Angle(Given::exact(0.0)),
    };
    let optional = |key: &str, measure: Measure| {
        fields.get(key).map_or(Ok(Given::exact(0.0)), |value| draft.scales.given(value, measure))
    };
    Ok(Path::Straight {
        through,
        direction,
        turned: optional("turned", Measure::Angle)?,
        offset: optional("offset", Measure::Length)?,
    })
}

fn guide_point(value: &Value<'_>, link: LinkId, named: Named, draft: &Draft<'_>) -> Res<GuidePoint> {
    match value.kind {
        super::json::Kind::Text(_) => Ok(GuidePoint::Point(named.point(value, link, draft)?)),
        super::json::Kind::List(_) => Ok(GuidePoint::Own(draft.scales.place(value)?)),
        _ => Err(value.unexpected("a point of the link or coordinates [x, y]")),
    }
}

/// Own coordinates of a point of a link, where they are stated.
fn own_of(point: PointId, link: LinkId, draft: &Draft<'_>) -> Option<[f64; 2]> {
    if draft.link(link).form == Form::Placed {
        return match draft.mechanism.point(point).place {
            Place::Fixed(p) | Place::Placed(p) => Some([p[0].value, p[1].value]),
            Place::Stated(_) | Place::Near(_) | Place::Unknown => None,
        };
    }
    own_coordinates(draft.link(link), index_of(draft, link, point)?).map(|(place, _)| place)
}

fn own_place(point: GuidePoint, link: LinkId, draft: &Draft<'_>) -> Option<[f64; 2]> {
    match point {
        GuidePoint::Point(point) => own_of(point, link, draft),
        GuidePoint::Own(place) => Some([place[0].value, place[1].value]),
    }
}
