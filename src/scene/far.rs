//! Places that no drawing can use: so far from the mechanism that their last digit is as large as a link of it.

use super::diagnostic::{Fault, Res};
use super::draft::Draft;
use super::placing::size;
use crate::mechanism::{GuidePoint, LinkId, Path, Place};

/// A rough place, or a point of a guide, may be so many times as far away as the mechanism is large. A double has some six
/// digits left there.
const FAR: f64 = 1e9;

/// Refuses rough places and points of guides that are absurdly far away.
pub(super) fn refuse(draft: &Draft<'_>) -> Res<()> {
    let size = size(draft);
    if size <= 0.0 {
        return Ok(());
    }
    // The known places lie together, wherever that is.
    let known = draft.mechanism.points.iter().find_map(|point| point.place.exact());
    let middle = known.map_or([0.0; 2], |place| place.map(|x| x.value));
    let away = |at: [f64; 2]| libm::hypot(at[0] - middle[0], at[1] - middle[1]);
    let far = |distance: f64| {
        let large = draft.scales.say_length(size);
        format!("{:.0e} times as far away as the mechanism is large ({large})", distance / size)
    };
    let mend = format!("a place within {} of the mechanism", draft.scales.say_length(FAR * size));
    for (index, point) in draft.mechanism.points.iter().enumerate() {
        if let Place::Near(at) = point.place
            && away(at) > FAR * size
        {
            let what = format!("the rough place of {} lies {}", point.name, far(away(at)));
            let anchor = draft.anchors.places.get(index).copied().flatten();
            return Err(Fault::new(anchor.unwrap_or(draft.anchors.points[index]), what).mend(mend));
        }
    }
    for (index, slide) in draft.mechanism.slides.iter().enumerate() {
        let (Path::Straight { through: GuidePoint::Own(at), .. }
        | Path::Arc { centre: GuidePoint::Own(at), .. }) = slide.guide.path
        else {
            continue;
        };
        let at = at.map(|x| x.value);
        let distance = if slide.guide.link == LinkId::FRAME { away(at) } else { libm::hypot(at[0], at[1]) };
        if distance > FAR * size {
            let what = format!("the guide's point lies {}", far(distance));
            return Err(Fault::new(draft.anchors.slides[index], what).mend(mend));
        }
    }
    Ok(())
}
