//! Colours by meaning. A theme changes paint and nothing else: line types, widths, heads and labels tell
//! everything that a colour tells.

use crate::sheet::figure::{Group, Tone};

/// How a figure is coloured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Theme {
    /// Black on white, for print and for examinations.
    #[default]
    Mono,
    /// Velocities blue, accelerations vermillion (Okabe and Ito's colours, told apart by the colour-blind),
    /// all else black on white.
    Colour,
    /// Light on dark, for the projector: velocities sky blue, accelerations orange.
    Dark,
}

/// A colour as its three parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rgb(pub [u8; 3]);

/// What a stroke is about, as far as colours tell it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum About {
    /// Links, places, construction, words.
    #[default]
    All,
    /// A velocity, or an angular velocity.
    Velocity,
    /// An acceleration, or an angular acceleration.
    Acceleration,
}

/// Where in the figure's tree a renderer stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Place {
    /// The diagram around.
    diagram: About,
    /// What the strokes here are about.
    pub about: About,
    /// Whether it stood there before: beside what is new it stands back.
    pub old: bool,
}

impl Place {
    /// Where ink stands back.
    #[must_use]
    pub fn of_the_old() -> Self {
        Self { old: true, ..Self::default() }
    }

    /// The same for words, which are about nothing.
    #[must_use]
    pub fn of_words(self) -> Self {
        Self { about: About::All, ..self }
    }

    /// The place inside this group.
    #[must_use]
    pub fn inside(self, group: &Group) -> Self {
        let has = |word: &str| group.class.split(' ').any(|w| w == word);
        let mut inside = self;
        inside.old |= has("old");
        if has("polygon") {
            inside.diagram = if has("acceleration") { About::Acceleration } else { About::Velocity };
        }
        if has("vector") || has("detail-vector") {
            // On the skeleton a vector says itself what it is.
            inside.about = if has("velocity") { About::Velocity } else { inside.diagram };
        } else if has("rotation") {
            inside.about = if has("second") { About::Acceleration } else { About::Velocity };
        }
        inside
    }
}

impl Theme {
    /// All themes.
    pub const ALL: [Self; 3] = [Self::Mono, Self::Colour, Self::Dark];

    /// Its name on the command line and in a scene.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mono => "mono",
            Self::Colour => "colour",
            Self::Dark => "dark",
        }
    }

    /// The theme of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|theme| theme.name() == name)
    }

    /// The colour of a tone.
    #[must_use]
    pub const fn tone(self, tone: Tone, about: About) -> Rgb {
        Rgb(match (self, tone, about) {
            (Self::Colour, Tone::Ink, About::Velocity) => [0x00, 0x72, 0xb2],
            (Self::Colour, Tone::Ink, About::Acceleration) => [0xd5, 0x5e, 0x00],
            (Self::Dark, Tone::Ink, About::Velocity) => [0x56, 0xb4, 0xe9],
            (Self::Dark, Tone::Ink, About::Acceleration) => [0xe6, 0x9f, 0x00],
            (Self::Dark, Tone::Ink, About::All) => [0xf0, 0xf0, 0xf0],
            (Self::Dark, Tone::Paper, _) => [0x14, 0x17, 0x1a],
            (Self::Dark, Tone::Tint, _) => [0x2b, 0x38, 0x45],
            (_, Tone::Ink, _) => [0x00, 0x00, 0x00],
            (_, Tone::Paper, _) => [0xff, 0xff, 0xff],
            (_, Tone::Tint, _) => [0xe4, 0xeb, 0xf2],
        })
    }

    /// The colour of a tone in its place: ink that stands back is grey.
    #[must_use]
    pub const fn colour(self, tone: Tone, place: Place) -> Rgb {
        match (self, tone, place.old) {
            (Self::Dark, Tone::Ink, true) => Rgb([0x78, 0x7c, 0x80]),
            (_, Tone::Ink, true) => Rgb([0x92, 0x92, 0x92]),
            _ => self.tone(tone, place.about),
        }
    }

    /// Whether the paper itself must be painted.
    #[must_use]
    pub const fn paints_paper(self) -> bool {
        matches!(self, Self::Dark)
    }
}

impl Rgb {
    /// Six hexadecimal digits.
    #[must_use]
    pub fn hex(self) -> String {
        let [r, g, b] = self.0;
        format!("{r:02x}{g:02x}{b:02x}")
    }

    /// Contrast with another colour, from 1 to 21 (WCAG 2.1, relative luminance).
    #[cfg(test)]
    fn contrast(self, other: Self) -> f64 {
        let luminance = |Self(parts): Self| {
            let [r, g, b] = parts.map(|part| {
                let s = f64::from(part) / 255.0;
                if s <= 0.040_45 { s / 12.92 } else { libm::pow((s + 0.055) / 1.055, 2.4) }
            });
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let (a, b) = (luminance(self), luminance(other));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// WCAG 2.1, criterion 1.4.11 asks 3 : 1 of lines, 1.4.3 asks 4.5 : 1 of words.
    #[test]
    fn every_line_and_every_word_stands_out_from_the_paper() {
        for theme in Theme::ALL {
            for ground in [Tone::Paper, Tone::Tint] {
                let ground = theme.tone(ground, About::All);
                for about in [About::Velocity, About::Acceleration] {
                    assert!(theme.tone(Tone::Ink, about).contrast(ground) >= 3.0, "{theme:?} {about:?}");
                }
                assert!(theme.tone(Tone::Ink, About::All).contrast(ground) >= 4.5, "{theme:?}");
            }
            // What stands back is seen, and told from what is new.
            let old = theme.colour(Tone::Ink, Place::of_the_old());
            assert!(old.contrast(theme.tone(Tone::Paper, About::All)) >= 3.0, "{theme:?}");
            assert!(old.contrast(theme.tone(Tone::Ink, About::All)) >= 3.0, "{theme:?}");
        }
    }

    #[test]
    fn colours_follow_the_diagram() {
        let velocity = Place::default().inside(&Group::new("velocity polygon"));
        assert_eq!(velocity.about, About::All, "construction lines stay black");
        assert_eq!(velocity.inside(&Group::new("vector absolute")).about, About::Velocity);
        let acceleration = Place::default().inside(&Group::new("acceleration polygon"));
        assert_eq!(acceleration.inside(&Group::new("vector normal")).about, About::Acceleration);
        assert_eq!(Place::default().inside(&Group::new("rotation second")).about, About::Acceleration);
    }
}
