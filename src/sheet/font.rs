//! The embedded typefaces and what they measure.
//!
//! The sheet measures every word with the very files that the renderer draws with, so that a label
//! which is clear of the ink here is clear of it on paper. System fonts are never looked at.

use std::sync::OnceLock;

use kurbo::Rect;
use ttf_parser::gpos::{PairAdjustment, PositioningSubtable};
use ttf_parser::{GlyphId, Tag};

/// A cut of the one family used on the sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Face {
    /// Units, digits, words.
    Upright,
    /// Quantities and points.
    Italic,
    /// Titles.
    Bold,
}

/// The family's name in the font files, and what may stand for it where they are not installed.
pub const FAMILIES: &str =
    "'Libertinus Serif', 'Linux Libertine O', 'Linux Libertine', 'STIX Two Text', 'Times New Roman', serif";

/// The family's name alone.
pub const FAMILY: &str = "Libertinus Serif";

impl Face {
    /// All cuts.
    pub const ALL: [Self; 3] = [Self::Upright, Self::Italic, Self::Bold];

    /// The font file.
    #[must_use]
    pub const fn bytes(self) -> &'static [u8] {
        match self {
            Self::Upright => include_bytes!("../render/fonts/LibertinusSerif-Regular.otf"),
            Self::Italic => include_bytes!("../render/fonts/LibertinusSerif-Italic.otf"),
            Self::Bold => include_bytes!("../render/fonts/LibertinusSerif-Bold.otf"),
        }
    }

    /// Whether the file has a glyph for this character.
    #[must_use]
    pub fn has(self, c: char) -> bool {
        metrics(self).is_some_and(|m| m.face.glyph_index(c).is_some())
    }

    /// How far the pen moves over `text` at `size` mm, kerning included.
    #[must_use]
    pub fn advance(self, text: &str, size: f64) -> f64 {
        self.walk(text, size, |_, _| {})
    }

    /// The box of the glyphs' ink, y down, origin at the pen's start on the base line.
    #[must_use]
    pub fn ink(self, text: &str, size: f64) -> Option<Rect> {
        let m = metrics(self)?;
        let k = size / m.em;
        let mut ink: Option<Rect> = None;
        self.walk(text, size, |glyph, pen| {
            if let Some(b) = m.glyph_box(glyph) {
                let glyph = Rect::new(pen + b.x0 * k, b.y0 * k, pen + b.x1 * k, b.y1 * k);
                ink = Some(ink.map_or(glyph, |r| r.union(glyph)));
            }
        });
        ink
    }

    fn walk(self, text: &str, size: f64, mut visit: impl FnMut(GlyphId, f64)) -> f64 {
        let Some(m) = metrics(self) else {
            return 0.55 * size * text.chars().count() as f64;
        };
        let k = size / m.em;
        let mut pen = 0.0;
        let mut last: Option<GlyphId> = None;
        for c in text.chars() {
            let Some(glyph) = m.face.glyph_index(c) else {
                // A character of another script: some other font will draw it, about this wide.
                pen += 0.6 * size;
                last = None;
                continue;
            };
            if let Some(left) = last {
                pen += m.kern(left, glyph) * k;
            }
            visit(glyph, pen);
            pen += f64::from(m.face.glyph_hor_advance(glyph).unwrap_or(0)) * k;
            last = Some(glyph);
        }
        pen
    }
}

struct Metrics {
    face: ttf_parser::Face<'static>,
    em: f64,
    /// Boxes of the glyphs met so far, font units with y down: outlines are slow to read.
    boxes: Vec<OnceLock<Option<Rect>>>,
    /// Subtables by lookup; every lookup applies, in each the first subtable that has the pair.
    kerning: Vec<Vec<PairAdjustment<'static>>>,
}

impl Metrics {
    fn read(face: Face) -> Option<Self> {
        let face = ttf_parser::Face::parse(face.bytes(), 0).ok()?;
        let em = f64::from(face.units_per_em());
        let mut kerning = Vec::new();
        if let Some(gpos) = face.tables().gpos {
            let latin = gpos.scripts.find(Tag::from_bytes(b"latn"));
            let script = latin.or_else(|| gpos.scripts.find(Tag::from_bytes(b"DFLT")));
            let features = script.and_then(|s| s.default_language).map(|l| l.feature_indices);
            let mut lookups: Vec<u16> = features
                .into_iter()
                .flatten()
                .filter_map(|index| gpos.features.get(index))
                .filter(|feature| feature.tag == Tag::from_bytes(b"kern"))
                .flat_map(|feature| feature.lookup_indices.into_iter())
                .collect();
            lookups.sort_unstable();
            lookups.dedup();
            for lookup in lookups.into_iter().filter_map(|index| gpos.lookups.get(index)) {
                let pairs = lookup.subtables.into_iter::<PositioningSubtable<'_>>();
                let pairs = pairs.filter_map(|subtable| match subtable {
                    PositioningSubtable::Pair(pair) => Some(pair),
                    _ => None,
                });
                kerning.push(pairs.collect());
            }
        }
        let boxes = (0..face.number_of_glyphs()).map(|_| OnceLock::new()).collect();
        Some(Self { face, em, boxes, kerning })
    }

    fn glyph_box(&self, glyph: GlyphId) -> Option<Rect> {
        let read = || {
            let b = self.face.glyph_bounding_box(glyph)?;
            let [x0, y0, x1, y1] = [b.x_min, b.y_max, b.x_max, b.y_min].map(f64::from);
            Some(Rect::new(x0, -y0, x1, -y1))
        };
        *self.boxes.get(usize::from(glyph.0))?.get_or_init(read)
    }

    fn kern(&self, left: GlyphId, right: GlyphId) -> f64 {
        let of_lookup = |pairs: &Vec<PairAdjustment<'static>>| {
            pairs.iter().find_map(|pair| {
                let index = pair.coverage().get(left)?;
                let (first, _) = match pair {
                    PairAdjustment::Format1 { sets, .. } => sets.get(index)?.get(right)?,
                    PairAdjustment::Format2 { classes, matrix, .. } => {
                        matrix.get((classes.0.get(left), classes.1.get(right)))?
                    }
                };
                Some(f64::from(first.x_advance))
            })
        };
        self.kerning.iter().filter_map(of_lookup).sum()
    }
}

fn metrics(face: Face) -> Option<&'static Metrics> {
    static READ: OnceLock<[Option<Metrics>; 3]> = OnceLock::new();
    let all = READ.get_or_init(|| Face::ALL.map(Metrics::read));
    all[face as usize].as_ref()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sign_of_the_sheet_has_a_glyph() {
        for c in "αεωθ′⊥∥≡∠≈×−·°²≠∞–—,:;()/?".chars() {
            assert!(Face::Upright.has(c), "upright lacks {c}");
        }
        for c in "αεωθ′abcdoABCDOVv".chars() {
            assert!(Face::Italic.has(c), "italic lacks {c}");
        }
    }

    #[test]
    fn kerning_narrows_the_pair_that_every_font_narrows() {
        let apart = Face::Upright.advance("A", 10.0) + Face::Upright.advance("V", 10.0);
        assert!(Face::Upright.advance("AV", 10.0) < apart);
    }

    #[test]
    fn a_capital_stands_on_the_base_line() {
        let ink = Face::Upright.ink("H", 10.0).unwrap();
        assert!(ink.y1.abs() < 0.05 && (ink.height() - 6.5).abs() < 0.3, "{ink:?}");
    }
}
