//! The pages of a figure: a sheet has its pages below each other, everything else is one page.

use crate::sheet::figure::{Figure, Group};

/// A page of a figure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Page<'a> {
    /// Where it begins on the figure, mm from its upper edge.
    pub top: f64,
    /// Width, mm.
    pub width: f64,
    /// Height, mm.
    pub height: f64,
    /// What stands on it, in the figure's coordinates.
    pub group: &'a Group,
}

/// The pages in their order; at least one.
#[must_use]
pub fn of(figure: &Figure) -> Vec<Page<'_>> {
    let pages = figure.pages();
    if pages.is_empty() {
        return vec![Page { top: 0.0, width: figure.width, height: figure.height, group: &figure.root }];
    }
    let height = figure.height / pages.len() as f64;
    let place = |(i, group)| Page { top: i as f64 * height, width: figure.width, height, group };
    pages.into_iter().enumerate().map(place).collect()
}
