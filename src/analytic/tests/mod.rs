//! What the solver must find. Every expected number comes from elsewhere: the recomputed textbook cases,
//! closed forms, laws, and differences of positions.

mod bench;
mod cases;
mod laws;
