//! What is said to a student of a mistake: what it is, and where to look.

use super::judge::Mistake;
use super::kind::Kind;

impl Mistake {
    /// The mistake in words, with the one that was made beside it.
    #[must_use]
    pub fn text(&self) -> String {
        let both: Vec<String> = self.parts().map(Self::own_text).collect();
        both.join("; and ")
    }

    /// The mistake alone in words.
    #[must_use]
    pub fn own_text(&self) -> String {
        let at = &self.at;
        let text = match self.kind {
            Kind::SenseReversed => format!("{at}: the opposite sense"),
            Kind::PerpendicularForParallel => {
                format!("{at}: drawn parallel instead of perpendicular, or the other way round")
            }
            Kind::NormalAwayFromCentre => format!("{at} points away from its centre"),
            Kind::NormalOfWrongLink => format!("{at} with ω, velocity, length or direction of another link"),
            Kind::NormalMissing | Kind::CoriolisMissing | Kind::SlipMissing => format!("{at} was left out"),
            Kind::CoriolisWithoutTwo => format!("{at} without the factor 2"),
            Kind::CoriolisWrongOmega => format!("{at} with the ω of another link"),
            Kind::CoriolisWrongTurn => format!("{at} turned the wrong way"),
            Kind::RpmAsRad => format!("{at}: revolutions per minute used as rad/s"),
            Kind::RevAsRad => format!("{at}: revolutions per second used as rad/s: 2π is missing"),
            Kind::RadAsRpm => format!("{at}: rad/s and revolutions per minute mixed up"),
            Kind::CmAsMm => format!("{at}: centimetres and millimetres mixed up"),
            Kind::InchAsFoot => format!("{at}: inches and feet mixed up"),
            Kind::MetreMixed => format!("{at}: metres mixed up with centimetres or millimetres"),
            Kind::ScaleForgotten => format!("{at}: the length on paper without its scale factor"),
            Kind::ScaleInverted => format!("{at}: divided by the scale factor instead of multiplied"),
            Kind::ScaleWrong => format!("{at}: another scale factor than the drawing's"),
            Kind::CalculatorInRadians => format!("{at}: the calculator was set to radians"),
            Kind::WrongAssembly => format!("{at}: the other assembly of the mechanism"),
            Kind::ImageMirrored => format!("{at} is mirrored"),
            Kind::TangentialWrongLength => format!("{at} with the length of another link or part"),
            Kind::AlphaIgnored => format!("{at}: the angular acceleration was left out"),
            Kind::AlphaSign => format!("{at}: the angular acceleration with the opposite sense"),
            Kind::RelativeReversed => format!("{at} taken the wrong way round"),
            Kind::WrongPole => format!("{at} measured from the wrong point of the polygon"),
            Kind::WrongLine => format!("{at}: a line drawn by the wrong line of the skeleton"),
            Kind::NeighbourRead => format!("{at} measured to the wrong point of the polygon"),
            Kind::InertiaAlongAcceleration => format!("{at} with the acceleration of its mass centre"),
            Kind::OffsetOtherSide => format!("{at} laid off to the other side"),
            Kind::CoupleWithAlpha => format!("{at} with the sense of the angular acceleration"),
            Kind::WeightAsMass => format!("{at}: the weight used as a mass"),
            Kind::MassAsWeight => format!("{at}: the mass used as a weight"),
            Kind::ReactionForAction => format!("{at}: the reaction in the place of the force"),
            Kind::ArmToPin => format!("{at}: the distance of the pin in the place of the arm"),
            Kind::ArmUnscaled => format!("{at}: an arm as it is on paper"),
            Kind::ForceLeftOut => format!("{at} was left out"),
            Kind::GuideForceNotSquare => format!("{at} is not square to its guide"),
            Kind::OtherTangent => format!("{at}: the tangent on the other side"),
            Kind::FrictionAngleReversed => format!("{at}: the angle of friction to the other side"),
            Kind::CircleIsJournal => format!("{at} has the radius of the journal"),
            Kind::TorqueGiven => format!("{at}: what the mechanism gives, not what it needs"),
            Kind::StaticLeftOut => format!("{at}: loads, weights and springs were left out"),
            Kind::InertiaLeftOut => format!("{at}: inertia was left out"),
            Kind::LoadsInShaking => format!("{at} with the loads"),
            Kind::LargestArea => format!("{at}: the largest area"),
            Kind::OneTurnForTwo => format!("{at}: another number of turns than a cycle has"),
            Kind::HalfFluctuation => format!("{at}: half of the range"),
            Kind::NormalNotSquared => format!("{at}: ω·l in the place of ω²·l"),
            Kind::CoriolisWrongVelocity => format!("{at} with another velocity than that of sliding"),
            Kind::RateFromWrongVector => format!("{at} calculated from another velocity than its own"),
            Kind::ProportionFromOtherEnd => format!("{at}: divided off from the other end of its link"),
            Kind::DegAsRad => format!("{at}: degrees in the place of radians"),
            Kind::FigureTurned => format!("{at} is turned against the skeleton"),
            Kind::ScaleTwice => format!("{at}: multiplied by the scale factor twice"),
            Kind::InputAngle => format!("{at} laid off at another angle"),
            Kind::LengthLaidOff => format!("{at} laid off otherwise than given"),
            Kind::FrictionLeftOut => format!("{at}: friction was left out"),
            Kind::LoadElsewhere => format!("{at} laid off at another point"),
            Kind::ParallelAxis => format!("{at}: not about the mass centre"),
            Kind::RatioInverted => format!("{at}: the ratio the other way up"),
            Kind::RoundedCoarsely => format!("{at}: rounded to two figures"),
            Kind::DiameterForRadius => format!("{at}: diameter and radius mixed up"),
            Kind::PivotMisplaced => format!("the pivot {at} stands elsewhere than given"),
            Kind::LoadWrong => format!("{at}: calculated wrongly from what is given"),
            Kind::RateNotSquared => format!("{at}: ω in the place of ω²"),
            Kind::WrongCentreLine => format!("{at}: found on a line on which it does not lie"),
            Kind::Interchanged => format!("{at} interchanged"),
            Kind::InputSpeed => format!("{at} with another speed than the given one"),
            Kind::GuideMisplaced => format!("the guide of {at} stands elsewhere than given"),
            Kind::PointLaidOff => format!("{at} stands elsewhere on its link than given"),
            Kind::ImageOnLine => format!("{at} taken on the line of the other two images"),
            Kind::MomentReversed => format!("{at}: its moment with the wrong sign"),
            Kind::FrictionMisread => format!("{at} with another coefficient of friction than given"),
            Kind::WrongFormula => format!("{at}: calculated by another formula"),
            Kind::DirectionMeasured => {
                format!("{at}: the direction measured otherwise than counter-clockwise from the x axis")
            }
        };
        self.how.as_ref().map_or_else(|| text.clone(), |how| format!("{text} ({how})"))
    }

    /// What the student should look at, as a sentence.
    #[must_use]
    pub fn look(&self) -> &'static str {
        match self.kind {
            Kind::SenseReversed => "Draw the sense as a small arrow on the skeleton and follow it.",
            Kind::PerpendicularForParallel => {
                "What turns about a point moves square to the line to it; what slides moves along its guide."
            }
            Kind::NormalAwayFromCentre => {
                "A normal part points along its link, toward the point about which the other one turns."
            }
            Kind::NormalOfWrongLink => "V, ω, length and direction of a normal part are those of one link.",
            Kind::NormalMissing => {
                "Whatever turns has a normal part ω²·l toward the centre, with or without an angular acceleration."
            }
            Kind::CoriolisMissing => {
                "A point that slides along a link that turns has the part 2·V·ω; only if V or ω is zero there is none."
            }
            Kind::CoriolisWithoutTwo => "Coriolis is 2·V·ω: the 2 belongs to it.",
            Kind::CoriolisWrongOmega => "Coriolis takes the ω of the link that carries the guide.",
            Kind::CoriolisWrongTurn => {
                "Turn the sliding velocity by 90° in the sense in which the link with the guide turns."
            }
            Kind::RpmAsRad => "Multiply revolutions per minute by 2π/60 first.",
            Kind::RevAsRad => "A revolution is 2π radians.",
            Kind::RadAsRpm => "Write the unit beside every ω: 1 rad/s is 9.55 rpm.",
            Kind::CmAsMm | Kind::MetreMixed => "Write the unit beside every length before you calculate.",
            Kind::InchAsFoot => "A foot is 12 inches: write the unit beside every length.",
            Kind::ScaleForgotten => "Multiply the millimetres that you read by the scale of that diagram.",
            Kind::ScaleInverted => "The scale says how much one centimetre stands for: multiply by it.",
            Kind::ScaleWrong => {
                "Compare the scale that is written at the diagram with the one that you read with."
            }
            Kind::CalculatorInRadians => "Set the calculator to degrees; sin 30 must show 0.5.",
            Kind::WrongAssembly => "Two places satisfy the lengths: take the one that the figure shows.",
            Kind::ImageMirrored => {
                "The image of a link is read round its corners in the same sense as the link itself."
            }
            Kind::TangentialWrongLength => {
                "Velocity or tangential part, ω or ε and the length belong to the same two points of one link."
            }
            Kind::AlphaIgnored => {
                "A link with an angular acceleration has a tangential part ε·l besides its normal part."
            }
            Kind::AlphaSign => "Draw the sense of the angular acceleration on the skeleton and follow it.",
            Kind::RelativeReversed => {
                "A relative vector leads from the image of the point behind the stroke to that of the point before it."
            }
            Kind::WrongPole => {
                "Absolute vectors begin at the pole, relative ones at the image of the point behind the stroke."
            }
            Kind::WrongLine => "Look which two points each line of the polygon belongs to.",
            Kind::NeighbourRead => "Look which letter of the polygon belongs to the point that is asked.",
            Kind::InertiaAlongAcceleration => {
                "An inertia force points against the acceleration of its mass centre: from g′ to o′."
            }
            Kind::OffsetOtherSide => "Lay h off to the side on which the inertia force turns against α.",
            Kind::CoupleWithAlpha => "An inertia torque is −I·α: its sense is against that of α.",
            Kind::WeightAsMass => "Divide a weight by g before you multiply it by an acceleration.",
            Kind::MassAsWeight => "A weight is M·g; in M·A stands the mass itself.",
            Kind::ReactionForAction => {
                "The first index is the link that pushes, the second the one that is pushed: interchanged, the sense is the opposite."
            }
            Kind::ArmToPin => "An arm is square to the line of its force.",
            Kind::ArmUnscaled => "Multiply arms that you measure by the scale of the skeleton.",
            Kind::ForceLeftOut => {
                "Cut the link free and count what acts on it, before you draw its polygon or take moments."
            }
            Kind::GuideForceNotSquare => "Without friction a guide only presses square to itself.",
            Kind::OtherTangent => {
                "The force on a link passes its friction circle so that its moment about the pin is against the turning of the link."
            }
            Kind::FrictionAngleReversed => {
                "The force on what slides leans from the normal against its sliding."
            }
            Kind::CircleIsJournal => "The radius of the friction circle is r·sin φ, not r.",
            Kind::TorqueGiven => {
                "T is the torque of the surroundings on the driven link: it balances the moments of the others."
            }
            Kind::StaticLeftOut => "The total is the static part and that of inertia.",
            Kind::InertiaLeftOut => "The total is the static part and that of inertia.",
            Kind::LoadsInShaking => "The shaking force is the sum of the inertia forces alone.",
            Kind::LargestArea => {
                "E_f is the highest level of energy less the lowest: add the areas up in their order."
            }
            Kind::OneTurnForTwo => {
                "The mean is the work of a cycle over its angle: 4π for four strokes, 2π for two."
            }
            Kind::HalfFluctuation => "±x % about the mean is a range of 2·x %.",
            Kind::NormalNotSquared => "A normal part is ω²·l, or V²/l.",
            Kind::CoriolisWrongVelocity => "2·ω·V: V is the velocity of what slides against its guide.",
            Kind::RateFromWrongVector => {
                "ω of a link is the relative velocity of two of its points over the length between them."
            }
            Kind::ProportionFromOtherEnd => {
                "The image divides the image of its link as the point divides the link, from the same end."
            }
            Kind::DegAsRad => "180° are π radians; V = ω·l wants ω in rad/s.",
            Kind::FigureTurned => {
                "Draw the lines of a polygon by those of the skeleton, with two set squares."
            }
            Kind::ScaleTwice => "Multiply the millimetres that you read by the scale of that diagram, once.",
            Kind::InputAngle => {
                "Angles of the input count counter-clockwise from the x axis to the line from its first joint to its second."
            }
            Kind::LengthLaidOff => "Compare the lengths of your skeleton with the given ones at its scale.",
            Kind::FrictionLeftOut => {
                "With friction the force in a pin touches its friction circle, and that of a guide leans by φ against the sliding."
            }
            Kind::LoadElsewhere => "Look at which point of its link the load acts.",
            Kind::ParallelAxis => "I about the mass centre is I about another point less M·d².",
            Kind::RatioInverted => {
                "Write down which number stands over which: i : j is that of i over that of j, ω = V/l, h = T/F."
            }
            Kind::RoundedCoarsely => {
                "Hand in three figures: what follows is no better than what you round to."
            }
            Kind::DiameterForRadius => "Look whether the radius or the diameter is given.",
            Kind::PivotMisplaced => "Lay off the fixed points once more before the links.",
            Kind::LoadWrong => "Write area and pressure with their units before you multiply.",
            Kind::RateNotSquared => "The energy of what turns grows with ω²: K_s = E_f/(I·ω²).",
            Kind::WrongCentreLine => {
                "The centre of links i and j lies on the line through those that both have with one third link."
            }
            Kind::Interchanged => "Look which of the two belongs to which name.",
            Kind::InputSpeed => "Read the given speed once more, with its unit.",
            Kind::GuideMisplaced => {
                "Lay off the line of the guide once more: its offset, on its side, and its angle."
            }
            Kind::PointLaidOff => {
                "Lay off the third point of the link once more, by its lengths, its angle and its side."
            }
            Kind::ImageOnLine => {
                "A point that does not lie on the line of two others has its image beside the line of theirs: the triangles are similar."
            }
            Kind::MomentReversed => {
                "Draw the sense in which each force turns the link about that point: those that turn the same way have one sign."
            }
            Kind::FrictionMisread => "Read f or φ once more: tan φ = f.",
            Kind::SlipMissing => "The pin slides in its guide: the point under it has another velocity.",
            Kind::WrongFormula => "Write the formula down with its letters before you put numbers in.",
            Kind::DirectionMeasured => "Directions count counter-clockwise from the x axis.",
        }
    }
}
