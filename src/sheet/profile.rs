//! How textbooks write vectors: one table per book, and nothing but data.

/// How the velocity of B relative to A is indexed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Relative {
    /// BA: the observed point, then the reference.
    Joined,
    /// B/A.
    Slash,
}

/// The notation of one textbook.
#[derive(Debug, PartialEq, Eq)]
pub struct Profile {
    /// Its name in a scene.
    pub name: &'static str,
    /// Letter of a velocity.
    pub velocity: &'static str,
    /// Letter of an acceleration.
    pub acceleration: &'static str,
    /// Index of a relative vector.
    pub relative: Relative,
    /// Point names in indices are small.
    pub small: bool,
    /// Mark of a normal part.
    pub normal: &'static str,
    /// Mark of a tangential part.
    pub tangential: &'static str,
    /// Mark of the acceleration of Coriolis.
    pub coriolis: &'static str,
    /// A sliding velocity is written against the link (A₂/₄), not against its point under the pin (A₂A₄).
    pub apparent: bool,
    /// The poles of the velocity and of the acceleration diagram: letter, index.
    pub poles: [(&'static str, &'static str); 2],
    /// Image points are named with the letters of their points, not with small ones.
    pub capital_images: bool,
    /// What tells the images of the acceleration diagram from those of velocities: a prime, or nothing.
    pub prime: &'static str,
    /// Letter of angular acceleration where the scene does not choose.
    pub alpha: &'static str,
}

impl Profile {
    /// All notations; the first is the usual one.
    pub const ALL: [Self; 5] = [
        Self {
            name: "standard",
            velocity: "V",
            acceleration: "A",
            relative: Relative::Joined,
            small: false,
            normal: "n",
            tangential: "t",
            coriolis: "c",
            apparent: false,
            poles: [("o", ""), ("o", "")],
            capital_images: false,
            prime: "′",
            alpha: "α",
        },
        Self {
            name: "norton",
            velocity: "V",
            acceleration: "A",
            relative: Relative::Joined,
            small: false,
            normal: "n",
            tangential: "t",
            coriolis: "c",
            apparent: false,
            poles: [("O", "V"), ("O", "A")],
            capital_images: false,
            prime: "′",
            alpha: "α",
        },
        Self {
            name: "uicker",
            velocity: "V",
            acceleration: "A",
            relative: Relative::Joined,
            small: false,
            normal: "n",
            tangential: "t",
            coriolis: "c",
            apparent: true,
            poles: [("O", "V"), ("O", "A")],
            capital_images: true,
            prime: "",
            alpha: "α",
        },
        Self {
            name: "rattan",
            velocity: "v",
            acceleration: "f",
            relative: Relative::Joined,
            small: true,
            normal: "c",
            tangential: "t",
            coriolis: "cr",
            apparent: false,
            poles: [("o", ""), ("o", "")],
            capital_images: false,
            prime: "′",
            alpha: "α",
        },
        Self {
            name: "martin",
            velocity: "V",
            acceleration: "A",
            relative: Relative::Slash,
            small: false,
            normal: "n",
            tangential: "t",
            coriolis: "c",
            apparent: true,
            poles: [("o", ""), ("o", "")],
            capital_images: false,
            prime: "′",
            alpha: "α",
        },
    ];

    /// The notation of this name, or the usual one.
    #[must_use]
    pub fn named(name: Option<&str>) -> &'static Self {
        const ALL: &[Profile] = &Profile::ALL;
        ALL.iter().find(|profile| Some(profile.name) == name).unwrap_or(&ALL[0])
    }

    /// A point's name in an index.
    #[must_use]
    pub fn index(&self, name: &str) -> String {
        if self.small { name.to_lowercase() } else { name.to_owned() }
    }
}
