//! **linkgram** draws the graphical solution of a planar mechanism: the kinematic skeleton, the velocity
//! and the acceleration polygon, built link by link with scale factors, and checks every number with an
//! independent solver.

pub mod analytic;
pub mod board;
pub mod catalogue;
pub mod check;
pub mod cli;
pub mod double_double;
pub mod drawing;
pub mod exam;
mod files;
pub mod given;
pub mod golden;
pub mod grade;
pub mod graphical;
pub mod limits;
pub mod mechanism;
mod parallel;
pub mod plan;
pub mod render;
pub mod report;
pub mod scene;
pub mod sheet;
pub mod solve;
pub mod sweep;
mod terminal;
pub mod tradeoff;
pub mod wide;
