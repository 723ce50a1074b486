//! A typeface with the glyphs of one figure only, as WOFF: what an SVG brings along, so that it looks alike where the
//! typefaces are not installed.
//!
//! Latin faces are cut down by the crate `subsetter`, whose fonts are meant for PDF; what a browser needs beside the
//! glyphs (characters, kerning, metrics) is added here. The joined letters of Arabic script need the typeface's own
//! substitutions, which speak of glyphs by number: there the numbers stay, glyphs that nobody uses are empty, and of the
//! substitutions stay those that the figure's letters may come to.

use std::collections::BTreeMap;
use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use write_fonts::read::collections::IntSet;
use write_fonts::types::{GlyphId, Tag};

use crate::sheet::font::{Face, Used};

/// Tables by their tags.
type Tables = BTreeMap<[u8; 4], Vec<u8>>;

/// The face with what `used` names; `None` where the font file is not as it should be.
pub(super) fn woff(face: Face, used: &Used) -> Option<Vec<u8>> {
    let tables = if face.is_arabic() { joined(face, used)? } else { plain(face, used)? };
    let flavour = if tables.contains_key(b"CFF ") { *b"OTTO" } else { [0, 1, 0, 0] };
    Some(packed(flavour, &tables))
}

/// Glyphs one by one, with numbers of their own.
fn plain(face: Face, used: &Used) -> Option<Tables> {
    let mut numbers = subsetter::GlyphRemapper::new();
    used.glyphs.iter().for_each(|glyph| {
        numbers.remap(*glyph);
    });
    let mut tables = tables(&subsetter::subset(face.bytes(), 0, &numbers).ok()?)?;
    let whole = self::tables(face.bytes())?;
    tables.insert(*b"OS/2", whole.get(b"OS/2")?.clone());
    tables.insert(*b"post", glyphs_without_names(whole.get(b"post")?)?);
    let characters = used.characters.iter().filter_map(|(c, glyph)| Some((*c, numbers.get(*glyph)?)));
    tables.insert(*b"cmap", characters_table(&characters.collect()));
    let pairs = used.kerning.iter().filter_map(|((left, right), by)| {
        Some(((numbers.get(*left)?, numbers.get(*right)?), i16::try_from(*by).ok()?))
    });
    let pairs: BTreeMap<(u16, u16), i16> = pairs.filter(|(_, by)| *by != 0).collect();
    if !pairs.is_empty() {
        tables.insert(*b"kern", kerning_table(&pairs));
    }
    Some(tables)
}

/// Glyphs with the numbers that they have.
fn joined(face: Face, used: &Used) -> Option<Tables> {
    let mut tables = tables(face.bytes())?;
    let short_offsets = word(tables.get(b"head")?, 50)? == 0;
    let places: Vec<usize> = {
        let loca = tables.get(b"loca")?;
        if short_offsets {
            loca.chunks_exact(2).map(|b| 2 * usize::from(u16::from_be_bytes([b[0], b[1]]))).collect()
        } else {
            loca.chunks_exact(4).map(|b| u32::from_be_bytes([b[0], b[1], b[2], b[3]]) as usize).collect()
        }
    };
    let outlines = tables.get(b"glyf")?.clone();
    let outline = |glyph: usize| outlines.get(*places.get(glyph)?..*places.get(glyph + 1)?);
    // A composite glyph is made of others.
    let mut kept = used.glyphs.clone();
    let mut open: Vec<u16> = kept.iter().copied().collect();
    while let Some(glyph) = open.pop() {
        for part in parts(outline(usize::from(glyph)).unwrap_or_default()) {
            if kept.insert(part) {
                open.push(part);
            }
        }
    }
    let is_kept = |glyph: usize| u16::try_from(glyph).is_ok_and(|glyph| kept.contains(&glyph));
    let (mut glyf, mut loca) = (Vec::new(), Vec::new());
    for glyph in 0..places.len().checked_sub(1)? {
        loca.extend(u32::try_from(glyf.len()).ok()?.to_be_bytes());
        if is_kept(glyph) {
            glyf.extend(outline(glyph)?);
            glyf.resize(glyf.len().next_multiple_of(4), 0);
        }
    }
    loca.extend(u32::try_from(glyf.len()).ok()?.to_be_bytes());
    let wide = usize::from(word(tables.get(b"hhea")?, 34)?);
    for (glyph, metrics) in tables.get_mut(b"hmtx")?.chunks_mut(4).take(wide).enumerate() {
        if !is_kept(glyph) {
            metrics.fill(0);
        }
    }
    tables.get_mut(b"head")?.get_mut(50..52)?.copy_from_slice(&[0, 1]);
    tables.insert(*b"glyf", glyf);
    tables.insert(*b"loca", loca);
    let substitutions = substitutions_of(tables.get(b"GSUB")?, used)?;
    tables.insert(*b"GSUB", substitutions);
    tables.insert(*b"cmap", characters_table(&used.characters));
    tables.insert(*b"post", glyphs_without_names(tables.get(b"post")?)?);
    // Every word stands in its own place: the fine spacing between its letters is less than is seen, and large.
    let needed: [&[u8; 4]; 13] = [
        b"GDEF", b"GSUB", b"OS/2", b"cmap", b"glyf", b"head", b"hhea", b"hmtx", b"loca", b"maxp", b"name",
        b"post", b"prep",
    ];
    tables.retain(|tag, _| needed.contains(&tag));
    Some(tables)
}

/// The `GSUB` table with what these glyphs may come to: lookups keep their numbers, and those that none reaches are empty.
/// Features that are not applied unasked (style sets, figures of fractions) are none that anything reaches.
fn substitutions_of(table: &[u8], used: &Used) -> Option<Vec<u8>> {
    const ASKED: [&[u8; 4]; 3] = [b"dnom", b"numr", b"pnum"];
    let whole = gsub::read(table)?;
    let unasked = |tag: Tag| {
        let tag = tag.to_be_bytes();
        ASKED.contains(&&tag) || tag.starts_with(b"ss")
    };
    let features = whole.feature_list().ok()?;
    let features = features.feature_records().iter().enumerate();
    let kept: IntSet<u16> = features
        .filter(|(_, record)| !unasked(record.feature_tag()))
        .filter_map(|(index, _)| u16::try_from(index).ok())
        .collect();
    let mut lookups = whole.collect_lookups(&kept).ok()?;
    let letters = used.characters.values().chain(&used.glyphs);
    let mut glyphs: IntSet<GlyphId> = letters.map(|glyph| GlyphId::from(*glyph)).collect();
    whole.closure_glyphs(&lookups, &mut glyphs).ok()?;
    whole.closure_lookups(&glyphs, &mut lookups).ok()?;
    gsub::cut_down(&whole, &lookups, &glyphs)
}

/// The parts of the crate `write-fonts` that cut a table of substitutions down.
mod gsub {
    use write_fonts::dump_table;
    use write_fonts::from_obj::ToOwnedTable;
    use write_fonts::read::collections::IntSet;
    use write_fonts::read::{FontData, FontRead};
    use write_fonts::tables::gsub::{Gsub, SingleSubst, SubstitutionLookup};
    use write_fonts::tables::layout::{ChainedSequenceContext, CoverageTable, SequenceContext};
    use write_fonts::types::{GlyphId, GlyphId16};

    pub(super) type Whole<'a> = write_fonts::read::tables::gsub::Gsub<'a>;

    pub(super) fn read(table: &[u8]) -> Option<Whole<'_>> {
        Whole::read(FontData::new(table)).ok()
    }

    /// The table with these lookups, as far as they speak of these glyphs.
    pub(super) fn cut_down(
        whole: &Whole<'_>,
        lookups: &IntSet<u16>,
        glyphs: &IntSet<GlyphId>,
    ) -> Option<Vec<u8>> {
        let mut table: Gsub = whole.to_owned_table();
        let has = |glyph: GlyphId16| glyphs.contains(GlyphId::from(glyph));
        let meets = |coverage: &CoverageTable| coverage.iter().any(has);
        for (index, lookup) in table.lookup_list.lookups.iter_mut().enumerate() {
            let reached = u16::try_from(index).is_ok_and(|index| lookups.contains(index));
            match &mut **lookup {
                SubstitutionLookup::Single(lookup) => lookup.subtables.retain_mut(|own| {
                    reached
                        && match &mut **own {
                            SingleSubst::Format1(own) => meets(&own.coverage),
                            SingleSubst::Format2(own) => {
                                own.substitute_glyph_ids =
                                    covered(&mut own.coverage, &own.substitute_glyph_ids, has);
                                !own.substitute_glyph_ids.is_empty()
                            }
                        }
                }),
                SubstitutionLookup::Multiple(lookup) => lookup.subtables.retain_mut(|own| {
                    let own = &mut **own;
                    own.sequences = covered(&mut own.coverage, &own.sequences, has);
                    reached && !own.sequences.is_empty()
                }),
                SubstitutionLookup::Ligature(lookup) => lookup.subtables.retain_mut(|own| {
                    let own = &mut **own;
                    own.ligature_sets = covered(&mut own.coverage, &own.ligature_sets, has);
                    reached && !own.ligature_sets.is_empty()
                }),
                SubstitutionLookup::Alternate(lookup) => {
                    lookup.subtables.retain(|own| reached && meets(&own.coverage));
                }
                SubstitutionLookup::Contextual(lookup) => lookup.subtables.retain(|own| {
                    reached
                        && match own.as_inner() {
                            SequenceContext::Format1(own) => meets(&own.coverage),
                            SequenceContext::Format2(own) => meets(&own.coverage),
                            SequenceContext::Format3(own) => own.coverages.iter().all(|own| meets(own)),
                        }
                }),
                SubstitutionLookup::ChainContextual(lookup) => lookup.subtables.retain(|own| {
                    reached
                        && match own.as_inner() {
                            ChainedSequenceContext::Format1(own) => meets(&own.coverage),
                            ChainedSequenceContext::Format2(own) => meets(&own.coverage),
                            ChainedSequenceContext::Format3(own) => {
                                let before = own.backtrack_coverages.iter();
                                let after = own.input_coverages.iter().chain(&own.lookahead_coverages);
                                before.chain(after).all(|own| meets(own))
                            }
                        }
                }),
                SubstitutionLookup::Extension(_) | SubstitutionLookup::Reverse(_) => {}
            }
        }
        dump_table(&table).ok()
    }

    /// Of entries, one for each covered glyph, those of the glyphs that `has` names; the others are covered no more.
    fn covered<T: Clone>(
        coverage: &mut CoverageTable,
        entries: &[T],
        has: impl Fn(GlyphId16) -> bool,
    ) -> Vec<T> {
        let all: Vec<(GlyphId16, T)> =
            coverage.iter().zip(entries.iter().cloned()).filter(|(glyph, _)| has(*glyph)).collect();
        *coverage = all.iter().map(|(glyph, _)| *glyph).collect();
        all.into_iter().map(|(_, entry)| entry).collect()
    }
}

/// The glyphs of which a composite glyph is made.
fn parts(outline: &[u8]) -> Vec<u16> {
    const WORDS: u16 = 0x1;
    const SCALE: u16 = 0x8;
    const MORE: u16 = 0x20;
    const TWO_SCALES: u16 = 0x40;
    const MATRIX: u16 = 0x80;
    let mut all = Vec::new();
    if word(outline, 0).is_none_or(|contours| contours < 0x8000) {
        return all;
    }
    let mut at = 10;
    while let (Some(flags), Some(glyph)) = (word(outline, at), word(outline, at + 2)) {
        all.push(glyph);
        at += 4 + if flags & WORDS != 0 { 4 } else { 2 };
        at += match flags {
            f if f & SCALE != 0 => 2,
            f if f & TWO_SCALES != 0 => 4,
            f if f & MATRIX != 0 => 8,
            _ => 0,
        };
        if flags & MORE == 0 {
            break;
        }
    }
    all
}

fn word(bytes: &[u8], at: usize) -> Option<u16> {
    Some(u16::from_be_bytes(bytes.get(at..at + 2)?.try_into().ok()?))
}

fn long(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_be_bytes(bytes.get(at..at + 4)?.try_into().ok()?))
}

/// The tables of a font file.
fn tables(font: &[u8]) -> Option<Tables> {
    let mut all = Tables::new();
    for i in 0..usize::from(word(font, 4)?) {
        let entry = font.get(12 + 16 * i..28 + 16 * i)?;
        let (from, length) = (long(entry, 8)? as usize, long(entry, 12)? as usize);
        all.insert(entry[..4].try_into().ok()?, font.get(from..from + length)?.to_vec());
    }
    Some(all)
}

/// The `post` table in its form without the names of the glyphs.
fn glyphs_without_names(post: &[u8]) -> Option<Vec<u8>> {
    let mut all = post.get(..32)?.to_vec();
    all[..4].copy_from_slice(&[0, 3, 0, 0]);
    Some(all)
}

/// What a binary search wants to know of so many entries of this size: range, steps, rest.
fn search(count: usize, size: usize) -> [u16; 3] {
    let steps = count.max(1).ilog2();
    let range = size << steps;
    let narrow = |n: usize| u16::try_from(n).unwrap_or(u16::MAX);
    [narrow(range), narrow(steps as usize), narrow((size * count).saturating_sub(range))]
}

/// A `cmap` of format 4, each character a segment of its own.
fn characters_table(characters: &BTreeMap<char, u16>) -> Vec<u8> {
    let narrow = |(c, glyph): (&char, &u16)| Some((u16::try_from(u32::from(*c)).ok()?, *glyph));
    let mut segments: Vec<(u16, u16)> =
        characters.iter().filter_map(narrow).filter(|(c, _)| *c != u16::MAX).collect();
    // The last segment is prescribed.
    segments.push((u16::MAX, 0));
    let count = segments.len();
    let mut out: Vec<u16> = vec![0, 1, 3, 1, 0, 12, 4, (16 + 8 * count) as u16, 0, (2 * count) as u16];
    out.extend(search(count, 2));
    out.extend(segments.iter().map(|(c, _)| c));
    out.push(0);
    out.extend(segments.iter().map(|(c, _)| c));
    out.extend(segments.iter().map(|(c, glyph)| glyph.wrapping_sub(*c)));
    out.extend(segments.iter().map(|_| 0_u16));
    out.into_iter().flat_map(u16::to_be_bytes).collect()
}

/// A `kern` table of pairs.
fn kerning_table(pairs: &BTreeMap<(u16, u16), i16>) -> Vec<u8> {
    let count = pairs.len().min(usize::from(u16::MAX / 8));
    let mut out: Vec<u16> = vec![0, 1, 0, (14 + 6 * count) as u16, 1, count as u16];
    out.extend(search(count, 6));
    for ((left, right), by) in pairs.iter().take(count) {
        out.extend([*left, *right, by.cast_unsigned()]);
    }
    out.into_iter().flat_map(u16::to_be_bytes).collect()
}

/// Tables as a WOFF file, each compressed where that makes it smaller.
fn packed(flavour: [u8; 4], tables: &Tables) -> Vec<u8> {
    const HEAD: usize = 44;
    const ENTRY: usize = 20;
    let whole: usize = tables.values().map(|table| table.len().next_multiple_of(4)).sum();
    let (mut entries, mut data) = (Vec::new(), Vec::new());
    // One for all tables: what it works on takes more time to lay out than a table to compress.
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
    let begin = HEAD + ENTRY * tables.len();
    for (tag, table) in tables {
        let small = compressed(&mut encoder, table).filter(|small| small.len() < table.len());
        let stored = small.as_ref().unwrap_or(table);
        entries.extend(tag);
        for number in [begin + data.len(), stored.len(), table.len()] {
            entries.extend((number as u32).to_be_bytes());
        }
        entries.extend(sum(table).to_be_bytes());
        data.extend(stored);
        data.resize(data.len().next_multiple_of(4), 0);
    }
    let mut out = Vec::with_capacity(begin + data.len());
    out.extend(b"wOFF");
    out.extend(flavour);
    out.extend(((begin + data.len()) as u32).to_be_bytes());
    out.extend((tables.len() as u16).to_be_bytes());
    out.extend([0, 0]);
    out.extend(((12 + 16 * tables.len() + whole) as u32).to_be_bytes());
    out.extend([0, 1, 0, 0]);
    // Neither metadata nor private data.
    out.extend([0; 20]);
    out.extend(entries);
    out.extend(data);
    out
}

fn compressed(encoder: &mut ZlibEncoder<Vec<u8>>, table: &[u8]) -> Option<Vec<u8>> {
    encoder.write_all(table).ok()?;
    encoder.reset(Vec::new()).ok()
}

/// The check sum of a table: its words added up.
fn sum(table: &[u8]) -> u32 {
    table.chunks(4).fold(0, |sum: u32, bytes| {
        let mut word = [0; 4];
        word[..bytes.len()].copy_from_slice(bytes);
        sum.wrapping_add(u32::from_be_bytes(word))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every character that was asked for is there, as wide as in the whole typeface, and few others are.
    #[test]
    fn a_subset_has_the_glyphs_that_are_used() {
        for (face, text) in [(Face::Upright, "AV 3.5"), (Face::Italic, "aᵇ′"), (Face::Arabic, "تسارع النقطة")]
        {
            let mut used = Used::default();
            used.add(face, text);
            let tables = if face.is_arabic() { joined(face, &used) } else { plain(face, &used) }.unwrap();
            let mut font = Vec::from(if face.is_arabic() { [0, 1, 0, 0] } else { *b"OTTO" });
            font.extend((tables.len() as u16).to_be_bytes());
            font.extend([0; 6]);
            let mut at = 12 + 16 * tables.len();
            for (tag, table) in &tables {
                font.extend(tag);
                font.extend(sum(table).to_be_bytes());
                font.extend((at as u32).to_be_bytes());
                font.extend((table.len() as u32).to_be_bytes());
                at += table.len().next_multiple_of(4);
            }
            for table in tables.values() {
                font.extend(table);
                font.resize(font.len().next_multiple_of(4), 0);
            }
            let cut = ttf_parser::Face::parse(&font, 0).unwrap();
            let whole = ttf_parser::Face::parse(face.bytes(), 0).unwrap();
            for c in text.chars().filter(|c| face.has(*c)) {
                let width = |face: &ttf_parser::Face<'_>| face.glyph_hor_advance(face.glyph_index(c)?);
                assert_eq!(width(&cut), width(&whole), "{c}");
            }
            assert!(cut.glyph_index('Q').is_none() && cut.glyph_index('ظ').is_none());
            let packed = woff(face, &used).unwrap();
            assert!(packed.len() < 40_000, "{face:?}: {}", packed.len());
        }
    }
}
