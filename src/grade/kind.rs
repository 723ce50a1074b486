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
    /// An inertia force points with the acceleration of its mass centre.
    InertiaAlongAcceleration,
    /// An inertia force passes its mass centre on the wrong side.
    OffsetOtherSide,
    /// An inertia torque has the sense of the angular acceleration.
    CoupleWithAlpha,
    /// A weight was used as a mass.
    WeightAsMass,
    /// A mass was used as a weight.
    MassAsWeight,
    /// A force was taken for its reaction: F₂₃ for F₃₂.
    ReactionForAction,
    /// The distance of a pin was taken for the arm of a force.
    ArmToPin,
    /// An arm was taken as it is on paper, without the scale of the skeleton.
    ArmUnscaled,
    /// A force was left out of a polygon or of moments.
    ForceLeftOut,
    /// The force of a guide was not drawn square to it.
    GuideForceNotSquare,
    /// The force of a pin touches its friction circle on the other side.
    OtherTangent,
    /// The force of a rough guide leans the other way.
    FrictionAngleReversed,
    /// The journal itself was taken for the friction circle.
    CircleIsJournal,
    /// The effort that a mechanism gives was handed in for the one that it needs.
    TorqueGiven,
    /// Loads, weights and springs were left out of the total.
    StaticLeftOut,
    /// Inertia was left out of the total.
    InertiaLeftOut,
    /// The shaking force was taken with the loads.
    LoadsInShaking,
    /// The largest area was taken for the fluctuation of energy.
    LargestArea,
    /// A cycle was reckoned over another number of turns than it has.
    OneTurnForTwo,
    /// A fluctuation of ±x % was taken as x %.
    HalfFluctuation,
    /// A normal part was calculated as ω·l.
    NormalNotSquared,
    /// Coriolis with another velocity than that of sliding.
    CoriolisWrongVelocity,
    /// A rate was calculated from the velocity of another point or link.
    RateFromWrongVector,
    /// A point of a link was divided off from the wrong end.
    ProportionFromOtherEnd,
    /// Degrees per second were used for radians per second.
    DegAsRad,
    /// A direction was measured clockwise or from the y axis.
    DirectionMeasured,
    /// A polygon is turned against the skeleton.
    FigureTurned,
    /// A length on paper was multiplied by its scale factor twice.
    ScaleTwice,
    /// The input was laid off at another angle than the given one.
    InputAngle,
    /// A length of the skeleton was laid off otherwise.
    LengthLaidOff,
    /// Friction was left out.
    FrictionLeftOut,
    /// A load was laid off at another point.
    LoadElsewhere,
    /// A moment of inertia about another point than the mass centre.
    ParallelAxis,
    /// A ratio was handed in the other way up.
    RatioInverted,
    /// A number is right as far as it was written, in two figures.
    RoundedCoarsely,
    /// A diameter was used for a radius, or the other way round.
    DiameterForRadius,
    /// A fixed pivot stands elsewhere on the skeleton.
    PivotMisplaced,
    /// A load was calculated wrongly from what is given.
    LoadWrong,
    /// The angular velocity stands without its square.
    RateNotSquared,
    /// A centre lies on a line through centres that have no third link in common.
    WrongCentreLine,
    /// A number was reckoned by another formula than its own.
    WrongFormula,
    /// Two answers were handed in for each other.
    Interchanged,
    /// The input was taken with another speed than the given one.
    InputSpeed,
    /// A guide stands elsewhere on the skeleton, or at another angle.
    GuideMisplaced,
    /// A point stands elsewhere on its link.
    PointLaidOff,
    /// The image of a point was taken on the line of two others, on which the point does not lie.
    ImageOnLine,
    /// A moment was counted with the wrong sign.
    MomentReversed,
    /// Another coefficient of friction than the given one was used.
    FrictionMisread,
    /// A point under a block has the velocity of its pin: the sliding was forgotten.
    SlipMissing,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 77] = [
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
        Self::InertiaAlongAcceleration,
        Self::OffsetOtherSide,
        Self::CoupleWithAlpha,
        Self::WeightAsMass,
        Self::MassAsWeight,
        Self::ReactionForAction,
        Self::ArmToPin,
        Self::ArmUnscaled,
        Self::ForceLeftOut,
        Self::GuideForceNotSquare,
        Self::OtherTangent,
        Self::FrictionAngleReversed,
        Self::CircleIsJournal,
        Self::TorqueGiven,
        Self::StaticLeftOut,
        Self::InertiaLeftOut,
        Self::LoadsInShaking,
        Self::LargestArea,
        Self::OneTurnForTwo,
        Self::HalfFluctuation,
        Self::NormalNotSquared,
        Self::CoriolisWrongVelocity,
        Self::RateFromWrongVector,
        Self::ProportionFromOtherEnd,
        Self::DegAsRad,
        Self::DirectionMeasured,
        Self::FigureTurned,
        Self::ScaleTwice,
        Self::InputAngle,
        Self::LengthLaidOff,
        Self::FrictionLeftOut,
        Self::LoadElsewhere,
        Self::ParallelAxis,
        Self::RatioInverted,
        Self::RoundedCoarsely,
        Self::DiameterForRadius,
        Self::PivotMisplaced,
        Self::LoadWrong,
        Self::RateNotSquared,
        Self::WrongCentreLine,
        Self::WrongFormula,
        Self::Interchanged,
        Self::InputSpeed,
        Self::GuideMisplaced,
        Self::PointLaidOff,
        Self::ImageOnLine,
        Self::MomentReversed,
        Self::FrictionMisread,
        Self::SlipMissing,
    ];

    /// Whether something is left out by it, which is then nothing.
    pub(super) fn leaves_out(self) -> bool {
        matches!(
            self,
            Self::NormalMissing
                | Self::CoriolisMissing
                | Self::AlphaIgnored
                | Self::ForceLeftOut
                | Self::StaticLeftOut
                | Self::InertiaLeftOut
                | Self::FrictionLeftOut
                | Self::SlipMissing
        )
    }

    /// Whether it multiplies numbers by a unit or a scale.
    pub(super) fn enlarges(self) -> bool {
        matches!(
            self,
            Self::CmAsMm
                | Self::InchAsFoot
                | Self::MetreMixed
                | Self::ScaleForgotten
                | Self::ScaleInverted
                | Self::ScaleTwice
                | Self::ScaleWrong
        )
    }

    /// Whether a diagram was read by another scale, or by none.
    pub(super) fn is_of_scale(self) -> bool {
        matches!(self, Self::ScaleWrong | Self::ScaleForgotten | Self::ScaleInverted | Self::ScaleTwice)
    }

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
            Self::InertiaAlongAcceleration => "inertia-along-acceleration",
            Self::OffsetOtherSide => "offset-other-side",
            Self::CoupleWithAlpha => "inertia-torque-with-alpha",
            Self::WeightAsMass => "weight-as-mass",
            Self::MassAsWeight => "mass-as-weight",
            Self::ReactionForAction => "reaction-for-action",
            Self::ArmToPin => "arm-to-pin",
            Self::ArmUnscaled => "arm-in-drawing-units",
            Self::ForceLeftOut => "force-left-out",
            Self::GuideForceNotSquare => "guide-force-not-square",
            Self::OtherTangent => "other-tangent",
            Self::FrictionAngleReversed => "friction-angle-reversed",
            Self::CircleIsJournal => "journal-for-friction-circle",
            Self::TorqueGiven => "given-for-needed",
            Self::StaticLeftOut => "static-part-left-out",
            Self::InertiaLeftOut => "inertia-left-out",
            Self::LoadsInShaking => "loads-in-shaking-force",
            Self::LargestArea => "largest-area",
            Self::OneTurnForTwo => "one-turn-for-two",
            Self::HalfFluctuation => "half-fluctuation",
            Self::NormalNotSquared => "normal-not-squared",
            Self::CoriolisWrongVelocity => "coriolis-wrong-velocity",
            Self::RateFromWrongVector => "rate-from-wrong-vector",
            Self::ProportionFromOtherEnd => "proportion-from-other-end",
            Self::DegAsRad => "deg-as-rad",
            Self::DirectionMeasured => "direction-measured-otherwise",
            Self::FigureTurned => "figure-turned",
            Self::ScaleTwice => "scale-twice",
            Self::InputAngle => "input-angle",
            Self::LengthLaidOff => "length-laid-off",
            Self::FrictionLeftOut => "friction-left-out",
            Self::LoadElsewhere => "load-elsewhere",
            Self::ParallelAxis => "parallel-axis",
            Self::RatioInverted => "ratio-inverted",
            Self::RoundedCoarsely => "rounded-coarsely",
            Self::DiameterForRadius => "diameter-for-radius",
            Self::PivotMisplaced => "pivot-misplaced",
            Self::LoadWrong => "load-wrong",
            Self::RateNotSquared => "rate-not-squared",
            Self::WrongCentreLine => "wrong-centre-line",
            Self::WrongFormula => "wrong-formula",
            Self::Interchanged => "interchanged",
            Self::InputSpeed => "input-speed",
            Self::GuideMisplaced => "guide-misplaced",
            Self::PointLaidOff => "point-laid-off",
            Self::ImageOnLine => "image-on-line",
            Self::MomentReversed => "moment-reversed",
            Self::FrictionMisread => "friction-misread",
            Self::SlipMissing => "slip-missing",
        }
    }
}
