//! The typical mistakes, by name.

/// A typical mistake.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// A vector or a rotation has the opposite sense.
    SenseReversed,
    /// A line was drawn parallel that should be perpendicular, or the other way round.
    PerpendicularForParallel,
    /// A normal part points away from its centre.
    NormalAwayFromCentre,
    /// A normal part was calculated or drawn with another link's ω, velocity, length or direction.
    NormalOfWrongLink,
    /// A normal part was left out.
    NormalMissing,
    /// Coriolis was left out.
    CoriolisMissing,
    /// Coriolis without its factor 2.
    CoriolisWithoutTwo,
    /// Coriolis with the ω of another link.
    CoriolisWrongOmega,
    /// Coriolis turned the wrong way.
    CoriolisWrongTurn,
    /// Revolutions per minute were used as rad/s.
    RpmAsRad,
    /// Centimetres were used as millimetres, or the other way round.
    CmAsMm,
    /// Inches were used as feet, or the other way round.
    InchAsFoot,
    /// A length on paper was handed in without its scale factor.
    ScaleForgotten,
    /// A length on paper was divided by its scale factor.
    ScaleInverted,
    /// The other assembly of the mechanism.
    WrongAssembly,
    /// The image of a link has the wrong reading sense.
    ImageMirrored,
    /// A tangential part, or ε from it, with another length.
    TangentialWrongLength,
    /// An angular acceleration was left out.
    AlphaIgnored,
    /// An angular acceleration was used with the opposite sense.
    AlphaSign,
    /// A relative vector was taken the wrong way round.
    RelativeReversed,
    /// A vector was measured from the wrong point of its polygon.
    WrongPole,
    /// Revolutions per second were used as rad/s.
    RevAsRad,
    /// Radians per second were taken for revolutions per minute, or the other way round in the answer.
    RadAsRpm,
    /// Metres were mixed up with centimetres or millimetres.
    MetreMixed,
    /// A diagram was read with another scale factor than it was drawn with.
    ScaleWrong,
    /// The calculator computed in radians, and degrees were typed or written.
    CalculatorInRadians,
    /// A line was drawn parallel or perpendicular to the wrong line of the skeleton.
    WrongLine,
    /// A vector was measured to a neighbouring point of its polygon.
    NeighbourRead,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 28] = [
        Self::SenseReversed,
        Self::PerpendicularForParallel,
        Self::NormalAwayFromCentre,
        Self::NormalOfWrongLink,
        Self::NormalMissing,
        Self::CoriolisMissing,
        Self::CoriolisWithoutTwo,
        Self::CoriolisWrongOmega,
        Self::CoriolisWrongTurn,
        Self::RpmAsRad,
        Self::CmAsMm,
        Self::InchAsFoot,
        Self::ScaleForgotten,
        Self::ScaleInverted,
        Self::WrongAssembly,
        Self::ImageMirrored,
        Self::TangentialWrongLength,
        Self::AlphaIgnored,
        Self::AlphaSign,
        Self::RelativeReversed,
        Self::WrongPole,
        Self::RevAsRad,
        Self::RadAsRpm,
        Self::MetreMixed,
        Self::ScaleWrong,
        Self::CalculatorInRadians,
        Self::WrongLine,
        Self::NeighbourRead,
    ];

    /// Its name in a report.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::SenseReversed => "sense-reversed",
            Self::PerpendicularForParallel => "perpendicular-for-parallel",
            Self::NormalAwayFromCentre => "normal-away-from-centre",
            Self::NormalOfWrongLink => "normal-of-wrong-link",
            Self::NormalMissing => "normal-missing",
            Self::CoriolisMissing => "coriolis-missing",
            Self::CoriolisWithoutTwo => "coriolis-without-two",
            Self::CoriolisWrongOmega => "coriolis-wrong-omega",
            Self::CoriolisWrongTurn => "coriolis-wrong-turn",
            Self::RpmAsRad => "rpm-as-rad",
            Self::CmAsMm => "cm-as-mm",
            Self::InchAsFoot => "inch-as-foot",
            Self::ScaleForgotten => "scale-forgotten",
            Self::ScaleInverted => "scale-inverted",
            Self::WrongAssembly => "wrong-assembly",
            Self::ImageMirrored => "image-mirrored",
            Self::TangentialWrongLength => "tangential-wrong-length",
            Self::AlphaIgnored => "alpha-ignored",
            Self::AlphaSign => "alpha-sign",
            Self::RelativeReversed => "relative-reversed",
            Self::WrongPole => "wrong-pole",
            Self::RevAsRad => "rev-as-rad",
            Self::RadAsRpm => "rad-as-rpm",
            Self::MetreMixed => "metre-mixed",
            Self::ScaleWrong => "scale-wrong",
            Self::CalculatorInRadians => "calculator-in-radians",
            Self::WrongLine => "wrong-line",
            Self::NeighbourRead => "neighbour-read",
        }
    }
}
