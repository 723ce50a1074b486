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
            Kind::NormalMissing | Kind::CoriolisMissing => format!("{at} was left out"),
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
            Kind::NormalAwayFromCentre => "The normal part of B against A points from B toward A.",
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
                "The tangential part belongs to the length between its two points."
            }
            Kind::AlphaIgnored => {
                "A link with an angular acceleration has a tangential part ε·l besides its normal part."
            }
            Kind::AlphaSign => "Draw the sense of the angular acceleration on the skeleton and follow it.",
            Kind::RelativeReversed => "V of B against A leads from a to b in the polygon.",
            Kind::WrongPole => {
                "Absolute vectors begin at the pole, relative ones at the image of the point behind the stroke."
            }
            Kind::WrongLine => "Look which two points each line of the polygon belongs to.",
            Kind::NeighbourRead => "Look which letter of the polygon belongs to the point that is asked.",
        }
    }
}
