//! **linkgram** draws the graphical solution of a planar mechanism: the kinematic skeleton, the velocity
//! and the acceleration polygon, built link by link with scale factors, and checks every number with an
//! independent solver.
//!
//! # A tour
//!
//! A **scene** is a JSON text: the links, what drives them, and what is asked. [`scene::read`] turns it into a
//! [`Scene`](scene::Scene), in SI units and radians, or says in one sentence what is wrong, where, and how to mend it.
//!
//! ```
//! let text = r#"{
//!     "units": { "length": "mm" },
//!     "fixed": { "O2": [0, 0] },
//!     "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 160 } },
//!     "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": [0, 0], "angle": 0 } }],
//!     "near": { "B": [150, 0] },
//!     "input": { "link": 2, "angle": 90, "omega": "10 rad/s ccw" },
//!     "find": ["v(B)", "x(B)"]
//! }"#;
//! let scene = linkgram::scene::read(text, "slider-crank.json")?;
//! assert_eq!(scene.mechanism.asked[0].name, "v(B)");
//!
//! let error = linkgram::scene::read(&text.replace("length", "lenght"), "slider-crank.json").unwrap_err();
//! assert!(error.to_string().contains("did you mean `length`?"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! To **solve** it is to draw it: [`solve::solve_numbers`] takes the mechanism apart, plans the steps that the questions need and
//! draws them on the board; each asked quantity is read off the drawing, with a bound of its error. The crank of this
//! slider-crank stands at 90°, so that its rod only translates: the slider is as fast as the crank pin.
//!
//! ```
//! use linkgram::mechanism::quantity::Answer;
//! # let text = r#"{
//! #     "units": { "length": "mm" },
//! #     "fixed": { "O2": [0, 0] },
//! #     "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 160 } },
//! #     "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": [0, 0], "angle": 0 } }],
//! #     "near": { "B": [150, 0] },
//! #     "input": { "link": 2, "angle": 90, "omega": "10 rad/s ccw" },
//! #     "find": ["v(B)", "x(B)"]
//! # }"#;
//! # let scene = linkgram::scene::read(text, "slider-crank.json")?;
//!
//! let solved = linkgram::solve::solve_numbers(&scene, linkgram::solve::Settings::default())?;
//! let Some(Answer::Vector { value, bound }) = solved.answer(&scene, "v(B)") else { panic!("v(B) is determined") };
//! assert!((value[0] - -0.5).abs() <= *bound && value[1].abs() <= *bound); // 50 mm · 10 rad/s, in m/s
//! assert!(*bound < 1e-14);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The **second solver** ([`analytic`]) shares nothing with the drawing but the mechanism. [`check::check`] solves both
//! ways and holds only if every number differs by no more than the sum of both bounds.
//!
//! ```
//! # let text = r#"{
//! #     "units": { "length": "mm" },
//! #     "fixed": { "O2": [0, 0] },
//! #     "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 160 } },
//! #     "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": [0, 0], "angle": 0 } }],
//! #     "near": { "B": [150, 0] },
//! #     "input": { "link": 2, "angle": 90, "omega": "10 rad/s ccw" },
//! #     "find": ["v(B)", "x(B)"]
//! # }"#;
//! # let scene = linkgram::scene::read(text, "slider-crank.json")?;
//! let published_values_may_err_by = 0.05;
//! assert!(linkgram::check::check(&scene, published_values_may_err_by).ok);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The **sheet** is what a draughtsman hands in. [`drawing::figure`] composes it, as question, solution or step by step,
//! in the language that is wished; [`render::render`] writes it as SVG, PNG, PDF, TikZ or JSON.
//!
//! ```
//! use linkgram::drawing::{self, Wish};
//! use linkgram::render::{Format, Options, render};
//! # let text = r#"{
//! #     "units": { "length": "mm" },
//! #     "fixed": { "O2": [0, 0] },
//! #     "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 160 } },
//! #     "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": [0, 0], "angle": 0 } }],
//! #     "near": { "B": [150, 0] },
//! #     "input": { "link": 2, "angle": 90, "omega": "10 rad/s ccw" },
//! #     "find": ["v(B)", "x(B)"]
//! # }"#;
//! # let scene = linkgram::scene::read(text, "slider-crank.json")?;
//!
//! let figure = drawing::figure(&scene, &Wish::default())?;
//! let svg = render(&figure, Format::Svg, &Options::default())?;
//! assert!(svg.starts_with(b"<svg"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A **sweep** draws once, keeps the drawing as a list of operations, and runs that over the range of the input: limits,
//! dead positions, extremes, strokes with their time ratios, and a table as fine as is wished. The slider goes twice the
//! crank's length.
//!
//! ```
//! use linkgram::sweep::Sweep;
//! # let text = r#"{
//! #     "units": { "length": "mm" },
//! #     "fixed": { "O2": [0, 0] },
//! #     "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 160 } },
//! #     "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": [0, 0], "angle": 0 } }],
//! #     "near": { "B": [150, 0] },
//! #     "input": { "link": 2, "angle": 90, "omega": "10 rad/s ccw" },
//! #     "find": ["v(B)", "x(B)"]
//! # }"#;
//! # let scene = linkgram::scene::read(text, "slider-crank.json")?;
//!
//! let sweep = Sweep::new(&scene.mechanism, None)?;
//! assert!(sweep.whole_turn);
//! assert!(sweep.strokes().iter().any(|stroke| (stroke.length - 0.1).abs() < 1e-12));
//! assert_eq!(sweep.positions(&sweep.equal_steps(360)).len(), 361);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The programs in `examples/*.rs` do the same from files. [`golden`] keeps figures from changing unseen, [`grade`] judges
//! drawings that are handed in, [`exam`] makes variants of a scene.
//!
//! # Where things are
//!
//! | to read and to say | to solve | to draw | to use it |
//! |---|---|---|---|
//! | [`scene`], [`mechanism`], [`catalogue`] | [`plan`], [`board`], [`graphical`], [`sweep`], [`analytic`], [`solve`], [`check`] | [`sheet`], [`render`], [`drawing`] | [`exam`], [`grade`], [`golden`], [`tradeoff`] |
//!
//! Angles are in radians, everything else in SI units, x to the right, y up, counter-clockwise positive; only a scene and a
//! sheet know other units. `ARCHITECTURE.md` says what each part may know of the others.
//!
//! # Features
//!
//! | feature (all are on by default) | brings |
//! |---|---|
//! | `cli` | the command `linkgram` and the crates of a command line |
//! | `png` | pictures of dots, and golden pictures |
//! | `pdf` | PDF |

pub mod analytic;
pub mod board;
pub mod catalogue;
pub mod check;
#[cfg(feature = "cli")]
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
pub mod live;
mod lots;
mod markup;
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
pub mod tolerance;
pub mod tradeoff;
pub mod wide;
