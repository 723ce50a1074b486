//! Figures to file formats; the bytes never vary.
//!
//! **Architecture Invariant:** nothing here knows a mechanism; a [`Figure`](crate::sheet::figure::Figure)
//! is ink with classes.

pub mod number;
#[cfg(feature = "png")]
pub mod png;
pub mod svg;
