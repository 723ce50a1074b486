//! The embedded typefaces and what they measure.
//!
//! The sheet measures every word with the very files that the renderer draws with, so that a label
//! which is clear of the ink here is clear of it on paper. System fonts are never looked at.

use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

use kurbo::{BezPath, Point, Rect, Vec2};
use rustybuzz::Direction;
use ttf_parser::gpos::{PairAdjustment, PositioningSubtable};
use ttf_parser::{GlyphId, Tag};

/// A cut of one of the two families used on the sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Face {
    /// Units, digits, words.
    Upright,
    /// Quantities and points.
    Italic,
    /// Titles.
    Bold,
    /// Words in Arabic script.
    Arabic,
    /// Titles in Arabic script.
    ArabicBold,
}

/// The family's name in the font files, and what may stand for it where they are not installed.
pub const FAMILIES: &str =
    "'Libertinus Serif', 'Linux Libertine O', 'Linux Libertine', 'STIX Two Text', 'Times New Roman', serif";

/// The family's name alone.
pub const FAMILY: &str = "Libertinus Serif";

/// The family's name of Arabic script alone.
pub const ARABIC_FAMILY: &str = "Amiri";

/// The family of Arabic script, and what may stand for it where it is not installed.
pub const ARABIC_FAMILIES: &str =
    "Amiri, 'Scheherazade New', 'Noto Naskh Arabic', 'Traditional Arabic', 'Times New Roman', serif";

/// Whether a character belongs to the Arabic script: its letters, marks, punctuation and digits, and the
/// joiners between its letters.
#[must_use]
pub const fn is_arabic(c: char) -> bool {
    matches!(c,
        '\u{600}'..='\u{6ff}' | '\u{750}'..='\u{77f}' | '\u{8a0}'..='\u{8ff}' | '\u{200c}' | '\u{200d}'
        | '\u{fb50}'..='\u{fdff}' | '\u{fe70}'..='\u{fefc}')
}

/// Whether a character is a digit of the Arabic script: such a number runs from left to right.
#[must_use]
pub const fn is_arabic_digit(c: char) -> bool {
    matches!(c, '\u{660}'..='\u{66c}' | '\u{6f0}'..='\u{6f9}')
}

/// What some text uses of a face.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Used {
    /// Its characters with their glyphs.
    pub characters: BTreeMap<char, u16>,
    /// All its glyphs, those of joined letters among them.
    pub glyphs: BTreeSet<u16>,
    /// What pairs of glyphs that stand beside each other move the pen, font units.
    pub kerning: BTreeMap<(u16, u16), i32>,
}

impl Used {
    /// Adds a run of text.
    pub fn add(&mut self, face: Face, text: &str) {
        let Some(m) = metrics(face) else { return };
        let mut last: Option<GlyphId> = None;
        for c in text.chars() {
            let glyph = m.glyph(c).map(|glyph| glyph.id);
            if let Some(glyph) = glyph {
                self.characters.insert(c, glyph.0);
                self.glyphs.insert(glyph.0);
            }
            if let (Some(left), Some(right), false) = (last, glyph, face.is_arabic()) {
                self.kerning.entry((left.0, right.0)).or_insert_with(|| m.kern(left, right));
            }
            last = glyph;
        }
        if face.is_arabic() {
            shape_with(face, text, |glyph, _| {
                self.glyphs.insert(glyph.0);
            });
        }
        self.glyphs.insert(0);
    }
}

/// More shaped words than a long sheet has; beyond them the store starts anew.
const MOST_KNOWN: usize = 50_000;

impl Face {
    /// All cuts.
    pub const ALL: [Self; 5] = [Self::Upright, Self::Italic, Self::Bold, Self::Arabic, Self::ArabicBold];

    /// Whether it is a face of the Arabic script, whose letters join and run from right to left.
    #[must_use]
    pub const fn is_arabic(self) -> bool {
        matches!(self, Self::Arabic | Self::ArabicBold)
    }

    /// The font file.
    #[must_use]
    pub const fn bytes(self) -> &'static [u8] {
        match self {
            Self::Upright => include_bytes!("../render/fonts/LibertinusSerif-Regular.otf"),
            Self::Italic => include_bytes!("../render/fonts/LibertinusSerif-Italic.otf"),
            Self::Bold => include_bytes!("../render/fonts/LibertinusSerif-Bold.otf"),
            Self::Arabic => include_bytes!("../render/fonts/Amiri-Regular.ttf"),
            Self::ArabicBold => include_bytes!("../render/fonts/Amiri-Bold.ttf"),
        }
    }

    /// Whether the file has a glyph for this character.
    #[must_use]
    pub fn has(self, c: char) -> bool {
        metrics(self).is_some_and(|m| m.glyph(c).is_some())
    }

    /// How far the pen moves over `text` at `size` mm, kerning included.
    #[must_use]
    pub fn advance(self, text: &str, size: f64) -> f64 {
        if self.is_arabic() {
            return shaped(self, text).map_or(0.0, |s| s.advance * size);
        }
        self.walk(text, size, |_, _| {})
    }

    /// The box of the glyphs' ink, y down, origin at the pen's start on the base line.
    #[must_use]
    pub fn ink(self, text: &str, size: f64) -> Option<Rect> {
        if self.is_arabic() {
            let ink = shaped(self, text)?.ink?;
            return Some(Rect::new(ink.x0 * size, ink.y0 * size, ink.x1 * size, ink.y1 * size));
        }
        let m = metrics(self)?;
        let k = size / m.em;
        let mut ink: Option<Rect> = None;
        self.walk(text, size, |glyph, pen| {
            if let Some(b) = glyph.ink(m) {
                let glyph = Rect::new(pen + b.x0 * k, b.y0 * k, pen + b.x1 * k, b.y1 * k);
                ink = Some(ink.map_or(glyph, |r| r.union(glyph)));
            }
        });
        ink
    }

    /// The outline of the glyphs at a size of 1, y down, origin at the pen's start on the base line; to be filled by
    /// the non-zero rule.
    #[must_use]
    pub fn outline(self, text: &str) -> BezPath {
        let mut path = BezPath::new();
        let Some(m) = metrics(self) else { return path };
        let k = 1.0 / m.em;
        let mut trace = |glyph: GlyphId, at: Vec2| {
            m.face.outline_glyph(glyph, &mut Pencil { path: &mut path, at, k });
        };
        if self.is_arabic() {
            shape_with(self, text, &mut trace);
        } else {
            self.walk(text, m.em, |glyph, pen| trace(glyph.id, Vec2::new(pen, 0.0)));
        }
        path
    }

    fn walk(self, text: &str, size: f64, mut visit: impl FnMut(&Glyph, f64)) -> f64 {
        let Some(m) = metrics(self) else {
            return 0.55 * size * text.chars().count() as f64;
        };
        let k = size / m.em;
        let mut pen = 0.0;
        let mut last: Option<GlyphId> = None;
        for c in text.chars() {
            let Some(glyph) = m.glyph(c) else {
                // A character of another script: some other font will draw it, about this wide.
                pen += 0.6 * size;
                last = None;
                continue;
            };
            if let Some(left) = last {
                pen += f64::from(m.kern(left, glyph.id)) * k;
            }
            visit(&glyph, pen);
            pen += f64::from(glyph.advance) * k;
            last = Some(glyph.id);
        }
        pen
    }
}

/// Writes down the outline of a glyph that stands at `at`, in font units.
struct Pencil<'a> {
    path: &'a mut BezPath,
    at: Vec2,
    k: f64,
}

impl Pencil<'_> {
    fn point(&self, x: f32, y: f32) -> Point {
        Point::new((f64::from(x) + self.at.x) * self.k, (self.at.y - f64::from(y)) * self.k)
    }
}

impl ttf_parser::OutlineBuilder for Pencil<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        self.path.move_to(self.point(x, y));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.path.line_to(self.point(x, y));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.path.quad_to(self.point(x1, y1), self.point(x, y));
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.path.curve_to(self.point(x1, y1), self.point(x2, y2), self.point(x, y));
    }

    fn close(&mut self) {
        self.path.close_path();
    }
}

/// Characters in a page of the table of glyphs.
const PAGE: usize = 64;
/// Pages of the table: as far as the signs of mathematics. What lies beyond is looked up in the font.
const PAGES: usize = 0x2300 / PAGE;
/// Pairs of glyphs whose kerning is kept; a power of two.
const PAIRS: usize = 4096;

/// A glyph by its character.
#[derive(Debug, Clone, Default)]
struct Glyph {
    id: GlyphId,
    /// Font units.
    advance: u16,
    /// The box of its ink, once somebody has asked: outlines are slow to read.
    ink: OnceLock<Option<Rect>>,
}

impl Glyph {
    /// The box of its ink, font units with y down.
    fn ink(&self, metrics: &Metrics) -> Option<Rect> {
        *self.ink.get_or_init(|| metrics.glyph_box(self.id))
    }
}

/// A face read once for all. What was looked up is kept, for the same letters come again and again while lines are
/// broken and labels are placed.
struct Metrics {
    face: ttf_parser::Face<'static>,
    em: f64,
    glyphs: Vec<OnceLock<Vec<Option<Glyph>>>>,
    /// Subtables by lookup; every lookup applies, in each the first subtable that has the pair.
    kerning: Vec<Vec<PairAdjustment<'static>>>,
    /// The pair of glyphs in the upper half, its kerning in the lower; zero where there is none yet. Two pairs of one
    /// place drive each other out.
    kerned: Vec<AtomicU64>,
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
        let glyphs = (0..PAGES).map(|_| OnceLock::new()).collect();
        let kerned = (0..PAIRS).map(|_| AtomicU64::new(0)).collect();
        Some(Self { face, em, glyphs, kerning, kerned })
    }

    fn glyph(&self, c: char) -> Option<Cow<'_, Glyph>> {
        let read = |code: u32| {
            let id = self.face.glyph_index(char::from_u32(code)?)?;
            let advance = self.face.glyph_hor_advance(id).unwrap_or(0);
            Some(Glyph { id, advance, ink: OnceLock::new() })
        };
        let code = u32::from(c);
        let (page, at) = (code as usize / PAGE, code as usize % PAGE);
        match self.glyphs.get(page) {
            Some(glyphs) => {
                let first = (page * PAGE) as u32;
                let glyphs = glyphs.get_or_init(|| (first..first + PAGE as u32).map(read).collect());
                glyphs.get(at)?.as_ref().map(Cow::Borrowed)
            }
            None => read(code).map(Cow::Owned),
        }
    }

    fn glyph_box(&self, glyph: GlyphId) -> Option<Rect> {
        let b = self.face.glyph_bounding_box(glyph)?;
        let [x0, y0, x1, y1] = [b.x_min, b.y_max, b.x_max, b.y_min].map(f64::from);
        Some(Rect::new(x0, -y0, x1, -y1))
    }

    /// What a pair of glyphs moves the pen, font units.
    fn kern(&self, left: GlyphId, right: GlyphId) -> i32 {
        let pair = u64::from(left.0) << 16 | u64::from(right.0);
        let place = (pair.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32) as usize % PAIRS;
        let Some(kept) = self.kerned.get(place) else { return self.look_up_kerning(left, right) };
        let found = kept.load(Ordering::Relaxed);
        if found >> 32 == pair && found != 0 {
            return found as u32 as i32;
        }
        let kerning = self.look_up_kerning(left, right);
        kept.store(pair << 32 | u64::from(kerning as u32), Ordering::Relaxed);
        kerning
    }

    fn look_up_kerning(&self, left: GlyphId, right: GlyphId) -> i32 {
        let of_lookup = |pairs: &Vec<PairAdjustment<'static>>| {
            pairs.iter().find_map(|pair| {
                let index = pair.coverage().get(left)?;
                let (first, _) = match pair {
                    PairAdjustment::Format1 { sets, .. } => sets.get(index)?.get(right)?,
                    PairAdjustment::Format2 { classes, matrix, .. } => {
                        matrix.get((classes.0.get(left), classes.1.get(right)))?
                    }
                };
                Some(i32::from(first.x_advance))
            })
        };
        self.kerning.iter().filter_map(of_lookup).sum()
    }
}

/// What a word of joined letters measures at a size of 1.
#[derive(Debug, Clone, Copy)]
struct Shaped {
    advance: f64,
    ink: Option<Rect>,
}

/// Shapes a text of the Arabic script. Words come again and again while lines are broken and labels are
/// placed, so what was shaped once is kept; the result depends on the text alone.
fn shaped(face: Face, text: &str) -> Option<Shaped> {
    thread_local! {
        static KNOWN: RefCell<HashMap<(Face, String), Option<Shaped>>> = RefCell::new(HashMap::new());
    }
    KNOWN.with_borrow_mut(|known| {
        if known.len() > MOST_KNOWN {
            known.clear();
        }
        *known.entry((face, text.to_owned())).or_insert_with(|| shape(face, text))
    })
}

fn shape(face: Face, text: &str) -> Option<Shaped> {
    let m = metrics(face)?;
    let mut ink: Option<Rect> = None;
    let pen = shape_with(face, text, |glyph, at| {
        if let Some(own) = m.glyph_box(glyph) {
            let own = own + at;
            ink = Some(ink.map_or(own, |r| r.union(own)));
        }
    })?;
    let k = 1.0 / m.em;
    let ink = ink.map(|r| Rect::new(r.x0 * k, r.y0 * k, r.x1 * k, r.y1 * k));
    Some(Shaped { advance: pen * k, ink })
}

/// Calls `visit` for every glyph of a text of the Arabic script with its place in font units, y down; how far the pen
/// has moved at the end.
fn shape_with(face: Face, text: &str, mut visit: impl FnMut(GlyphId, Vec2)) -> Option<f64> {
    static READ: OnceLock<[Option<rustybuzz::Face<'static>>; 2]> = OnceLock::new();
    let read = |face: Face| rustybuzz::Face::from_slice(face.bytes(), 0);
    let faces = READ.get_or_init(|| [Face::Arabic, Face::ArabicBold].map(read));
    let shaper = faces[usize::from(face == Face::ArabicBold)].as_ref()?;
    let mut buffer = rustybuzz::UnicodeBuffer::new();
    buffer.push_str(text);
    let number = text.chars().all(is_arabic_digit);
    buffer.set_direction(if number { Direction::LeftToRight } else { Direction::RightToLeft });
    buffer.set_script(rustybuzz::script::ARABIC);
    let glyphs = rustybuzz::shape(shaper, &[], buffer);
    let mut pen = 0.0;
    for (glyph, position) in glyphs.glyph_infos().iter().zip(glyphs.glyph_positions()) {
        let id = u16::try_from(glyph.glyph_id).map_or(GlyphId(0), GlyphId);
        visit(id, Vec2::new(pen + f64::from(position.x_offset), -f64::from(position.y_offset)));
        pen += f64::from(position.x_advance);
    }
    Some(pen)
}

fn metrics(face: Face) -> Option<&'static Metrics> {
    static READ: [OnceLock<Option<Metrics>>; 5] = [const { OnceLock::new() }; 5];
    READ[face as usize].get_or_init(|| Metrics::read(face)).as_ref()
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
    fn every_letter_of_arabic_and_persian_has_a_glyph() {
        for c in "ابتثجحخدذرزسشصضطظعغفقكلمنهويءآأؤإئةىپچژگکی،؛؟\u{200c}۰۱۲۳۴۵۶۷۸۹٠١٢٣٤٥٦٧٨٩".chars()
        {
            assert!(Face::Arabic.has(c) && Face::ArabicBold.has(c), "Amiri lacks {c}");
        }
    }

    #[test]
    fn arabic_letters_join() {
        // The letters of a word are narrower than the same letters apart, and so is lam with alef.
        for (word, letters) in [("تسارع", "ت س ا ر ع"), ("لا", "ل ا")] {
            let blanks = Face::Arabic.advance(" ", 10.0) * letters.matches(' ').count() as f64;
            let apart = Face::Arabic.advance(letters, 10.0) - blanks;
            assert!(Face::Arabic.advance(word, 10.0) < 0.9 * apart, "{word}");
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
