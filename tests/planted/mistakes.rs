//! The mistakes that students make.

/// What sort of mistake; the names are those of the report.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Kind {
    SenseReversed,
    PerpendicularForParallel,
    NormalAwayFromCentre,
    NormalOfWrongLink,
    CoriolisMissing,
    CoriolisWithoutTwo,
    CoriolisWrongOmega,
    CoriolisWrongTurn,
    RpmAsRad,
    CmAsMm,
    InchAsFoot,
    ScaleForgotten,
    ScaleInverted,
    WrongAssembly,
    ImageMirrored,
    TangentialWrongLength,
    AlphaIgnored,
    AlphaSign,
    RelativeReversed,
    WrongPole,
    RevAsRad,
    RadAsRpm,
    MetreMixed,
    ScaleWrong,
    CalculatorInRadians,
    WrongLine,
    NeighbourRead,
    /// Not of the list: a length 1.37 times too long, a line 17° off.
    Unforeseen,
}

impl Kind {
    /// All that a grader is to know.
    pub(crate) const FORESEEN: [Self; 27] = [
        Self::SenseReversed,
        Self::PerpendicularForParallel,
        Self::NormalAwayFromCentre,
        Self::NormalOfWrongLink,
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

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::SenseReversed => "sense-reversed",
            Self::PerpendicularForParallel => "perpendicular-for-parallel",
            Self::NormalAwayFromCentre => "normal-away-from-centre",
            Self::NormalOfWrongLink => "normal-of-wrong-link",
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
            Self::Unforeseen => "(unforeseen)",
        }
    }
}

/// One mistake: which, where, and in which of the ways in which it can be made there.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Mistake {
    pub(crate) kind: Kind,
    /// The quantity at whose step it is made.
    pub(crate) at: String,
    pub(crate) how: &'static str,
}
