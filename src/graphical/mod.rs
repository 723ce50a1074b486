//! The method: position, velocity polygon, acceleration polygon, written in the board's operations.
//!
//! **Architecture Invariant:** nothing here knows `nalgebra` or the analytic solver; every direction,
//! intersection and unknown length is drawn on the board and read off it.

pub mod construction;
