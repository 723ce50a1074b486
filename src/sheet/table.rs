//! Tables: columns as wide as their cells, three rules, no boxes.

use kurbo::Point;

use super::figure::{Group, Mark, Pen, Shape};
use super::rich::Rich;

/// How the cells of a column stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Align {
    /// At the left edge.
    Left,
    /// In the middle.
    Middle,
    /// At the right edge.
    Right,
}

/// In which direction the columns follow each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// The first column at the left.
    Rightward,
    /// The first column at the right; what stands at the left elsewhere stands at the right.
    Leftward,
    /// The first column, of labels, at the right of the others, which follow each other to the right as the
    /// terms of an equation do.
    LabelsRight,
}

/// A table. All rows have as many cells as there are columns; missing cells are empty.
#[derive(Debug, Clone)]
pub struct Table {
    /// Alignment of each column.
    pub columns: Vec<Align>,
    /// Cells of the head.
    pub head: Vec<Rich>,
    /// Cells of each row.
    pub rows: Vec<Vec<Rich>>,
    /// Size of the type.
    pub size: f64,
    /// Blank between columns.
    pub gap: f64,
    /// Order of the columns on the page.
    pub flow: Flow,
}

/// A drawn piece of the page with its upper left corner at the origin.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// The ink.
    pub group: Group,
    /// Width, mm.
    pub width: f64,
    /// Height, mm.
    pub height: f64,
}

impl Table {
    fn widths(&self) -> Vec<f64> {
        (0..self.columns.len())
            .map(|c| {
                let cells = std::iter::once(&self.head).chain(&self.rows).filter_map(|row| row.get(c));
                cells.map(|cell| cell.width(self.size)).fold(0.0, f64::max)
            })
            .collect()
    }

    /// Width of the whole.
    #[must_use]
    pub fn width(&self) -> f64 {
        let columns = self.columns.len() as f64;
        self.widths().iter().sum::<f64>() + self.gap * columns
    }

    /// The same with smaller type until it is no wider than `width`, or the type is 2.2 mm.
    #[must_use]
    pub fn fitted(mut self, width: f64) -> Self {
        while self.width() > width && self.size > 2.3 {
            self.size -= 0.1;
            self.gap = (self.gap - 0.1).max(1.2);
        }
        self
    }

    /// Whether it fits into `width` without smaller type.
    #[must_use]
    pub fn fits(&self, width: f64) -> bool {
        self.width() <= width
    }

    /// The columns before `column`, and the first column with those from `column` on.
    #[must_use]
    pub fn split(&self, column: usize) -> (Self, Self) {
        let head = |cells: &[Rich]| cells.iter().take(column).cloned().collect::<Vec<_>>();
        let tail = |cells: &[Rich]| {
            cells.iter().take(1).chain(cells.iter().skip(column)).cloned().collect::<Vec<_>>()
        };
        let part = |columns: Vec<Align>, cut: &dyn Fn(&[Rich]) -> Vec<Rich>| Self {
            columns,
            head: cut(&self.head),
            rows: self.rows.iter().map(|row| cut(row)).collect(),
            size: self.size,
            gap: self.gap,
            flow: self.flow,
        };
        let after = self.columns.iter().take(1).chain(self.columns.iter().skip(column)).copied().collect();
        (part(self.columns.iter().take(column).copied().collect(), &head), part(after, &tail))
    }

    /// Between the last row and the rule under it.
    fn below(&self) -> f64 {
        self.size * if self.flow == Flow::Rightward { 0.12 } else { 0.3 }
    }

    /// Height of a row.
    fn pitch(&self) -> f64 {
        self.size * 1.62
    }

    /// Height of rows `from..to` under the head.
    #[must_use]
    pub fn height(&self, from: usize, to: usize) -> f64 {
        // Row after row, as they are drawn: the same sum to the last digit.
        let head = self.pitch() + self.below();
        self.rows.iter().take(to).skip(from).fold(head, |y, _| y + self.pitch()) + self.below()
    }

    /// Draws rows `from..to` under the head.
    #[must_use]
    pub fn draw(&self, class: &str, from: usize, to: usize) -> Block {
        let widths = self.widths();
        let width = self.width();
        let pitch = self.pitch();
        let mut group = Group::new(class);
        let rule = |y: f64, pen: f64| {
            Mark::stroke(Shape::Line(Point::new(0.0, y), Point::new(width, y)), Pen::solid(pen)).class("rule")
        };
        // Arrows over the letters of the head need more room than capitals, and Arabic letters reach further down.
        let below = self.below();
        let head = pitch + below;
        group.mark(rule(0.0, 0.35));
        self.row(&mut group, &self.head, &widths, pitch - 0.38 * self.size);
        group.mark(rule(head, 0.18));
        let mut y = head;
        for row in self.rows.iter().take(to).skip(from) {
            self.row(&mut group, row, &widths, y + pitch - 0.5 * self.size);
            y += pitch;
        }
        let bottom = self.height(from, to);
        group.mark(rule(bottom, 0.35));
        Block { group, width, height: bottom }
    }

    /// How many rows fit under the head in this height.
    #[must_use]
    pub fn rows_in(&self, height: f64) -> usize {
        /// More rows than any paper has: type of no size would fit without end.
        const MOST: f64 = 10_000.0;
        let left = height - self.pitch() - 0.06 * self.size - 2.0 * self.below();
        (left / self.pitch()).floor().clamp(0.0, MOST) as usize
    }

    fn row(&self, group: &mut Group, cells: &[Rich], widths: &[f64], base: f64) {
        let mut x = self.gap / 2.0;
        let mut columns: Vec<_> = cells.iter().zip(widths).zip(&self.columns).collect();
        match self.flow {
            Flow::Rightward => {}
            Flow::Leftward => columns.reverse(),
            Flow::LabelsRight if columns.is_empty() => {}
            Flow::LabelsRight => columns.rotate_left(1),
        }
        for ((cell, width), align) in columns {
            let line = cell.set(self.size);
            let free = width - line.width;
            let shift = match (align, self.flow) {
                (Align::Middle, _) => free / 2.0,
                (Align::Left, Flow::Rightward) => 0.0,
                // Numbers run the same way everywhere, so their last digits stand below each other.
                (Align::Right, _) | (Align::Left, Flow::Leftward | Flow::LabelsRight) => free,
            };
            line.put(group, Point::new(x + shift, base), "cell");
            x += width + self.gap;
        }
    }
}
