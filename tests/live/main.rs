//! The live page: what it holds is what a sweep computes, to the last bit.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

mod exact;
mod page;
mod watch;
