//! What is said to a student of a mistake: what it is, and where to look.

use super::judge::Mistake;
use super::kind::Kind;
use super::phrase::{Phrase, Row, say};

impl Mistake {
    /// The mistake in words, with the one that was made beside it.
    #[must_use]
    pub fn text(&self) -> Phrase {
        match &self.also {
            Some(also) => say!("{}; and {}", self.own_text(), also.text()),
            None => self.own_text(),
        }
    }

    /// The mistake alone in words.
    #[must_use]
    pub fn own_text(&self) -> Phrase {
        let text = self.kind_text();
        match &self.how {
            Some(how) => say!("{} ({})", text, how),
            None => text,
        }
    }

    /// The mistake without what exactly was done, which differs from student to student.
    pub(super) fn kind_text(&self) -> Phrase {
        Phrase::said(told(self.kind), vec![self.at.clone()])
    }

    /// What the student should look at, as a sentence.
    #[must_use]
    pub fn look(&self) -> Phrase {
        Phrase::said(look(self.kind), Vec::new())
    }
}

/// What a mistake is, with a blank for what it is about.
fn told(kind: Kind) -> &'static Row {
    match kind {
        Kind::SenseReversed => &["{}: the opposite sense", "{}: الاتجاه معكوس", "{}: جهت وارونه"],
        Kind::PerpendicularForParallel => &[
            "{}: drawn parallel instead of perpendicular, or the other way round",
            "{}: رُسم موازيا بدل العمودي أو العكس",
            "{}: موازی به جای عمود رسم شده، یا برعکس",
        ],
        Kind::NormalAwayFromCentre => {
            &["{} points away from its centre", "{}: الاتجاه بعيدا عن المركز", "{}: جهت آن دور از مرکز است"]
        }
        Kind::NormalOfWrongLink => &[
            "{} with ω, velocity, length or direction of another link",
            "{}: بقيمة ω أو بسرعة أو طول أو اتجاه وصلة أخرى",
            "{}: با ω، سرعت، طول یا راستای بندی دیگر",
        ],
        Kind::NormalMissing | Kind::CoriolisMissing | Kind::SlipMissing | Kind::ForceLeftOut => {
            &["{} was left out", "{}: أُغفل", "{}: جا افتاده"]
        }
        Kind::CoriolisWithoutTwo => &["{} without the factor 2", "{}: بلا العامل 2", "{}: بدون ضریب 2"],
        Kind::CoriolisWrongOmega => {
            &["{} with the ω of another link", "{}: بقيمة ω لوصلة أخرى", "{}: با ω بندی دیگر"]
        }
        Kind::CoriolisWrongTurn => {
            &["{} turned the wrong way", "{}: التدوير بالاتجاه الخطأ", "{}: در جهت نادرست چرخانده شده"]
        }
        Kind::RpmAsRad => &[
            "{}: revolutions per minute used as rad/s",
            "{}: استُعملت الدورات في الدقيقة كأنها rad/s",
            "{}: دور بر دقیقه به جای rad/s به کار رفته",
        ],
        Kind::RevAsRad => &[
            "{}: revolutions per second used as rad/s: 2π is missing",
            "{}: استُعملت الدورات في الثانية كأنها rad/s: ينقص 2π",
            "{}: دور بر ثانیه به جای rad/s به کار رفته: 2π جا افتاده",
        ],
        Kind::RadAsRpm => &[
            "{}: rad/s and revolutions per minute mixed up",
            "{}: خلط بين rad/s والدورات في الدقيقة",
            "{}: rad/s و دور بر دقیقه اشتباه گرفته شده",
        ],
        Kind::CmAsMm => &[
            "{}: centimetres and millimetres mixed up",
            "{}: خلط بين السنتيمتر والميليمتر",
            "{}: سانتی‌متر و میلی‌متر اشتباه گرفته شده",
        ],
        Kind::InchAsFoot => {
            &["{}: inches and feet mixed up", "{}: خلط بين البوصة والقدم", "{}: اینچ و فوت اشتباه گرفته شده"]
        }
        Kind::MetreMixed => &[
            "{}: metres mixed up with centimetres or millimetres",
            "{}: خلط بين المتر والسنتيمتر أو الميليمتر",
            "{}: متر با سانتی‌متر یا میلی‌متر اشتباه گرفته شده",
        ],
        Kind::ScaleForgotten => &[
            "{}: the length on paper without its scale factor",
            "{}: الطول على الورق بلا معامل المقياس",
            "{}: طول روی کاغذ بدون ضریب مقیاس",
        ],
        Kind::ScaleInverted => &[
            "{}: divided by the scale factor instead of multiplied",
            "{}: قسمة على معامل المقياس بدل الضرب",
            "{}: به جای ضرب، بر ضریب مقیاس تقسیم شده",
        ],
        Kind::ScaleWrong => &[
            "{}: another scale factor than the drawing's",
            "{}: معامل مقياس غير معامل الرسم",
            "{}: ضریب مقیاسی جز ضریب رسم",
        ],
        Kind::CalculatorInRadians => &[
            "{}: the calculator was set to radians",
            "{}: الآلة الحاسبة على الراديان",
            "{}: ماشین‌حساب روی رادیان بوده",
        ],
        Kind::WrongAssembly => &[
            "{}: the other assembly of the mechanism",
            "{}: التجميع الآخر للتركيبة",
            "{}: سرهم‌بندی دیگر مکانیزم",
        ],
        Kind::ImageMirrored => &["{} is mirrored", "{}: معكوس كما في المرآة", "{}: آینه‌ای شده"],
        Kind::TangentialWrongLength => &[
            "{} with the length of another link or part",
            "{}: بطول وصلة أخرى أو جزء آخر",
            "{}: با طول بند یا بخشی دیگر",
        ],
        Kind::AlphaIgnored => &[
            "{}: the angular acceleration was left out",
            "{}: أُغفل التسارع الزاوي",
            "{}: شتاب زاویه‌ای جا افتاده",
        ],
        Kind::AlphaSign => &[
            "{}: the angular acceleration with the opposite sense",
            "{}: التسارع الزاوي بالاتجاه المعاكس",
            "{}: شتاب زاویه‌ای با جهت وارونه",
        ],
        Kind::RelativeReversed => {
            &["{} taken the wrong way round", "{}: أُخذ بترتيب معكوس", "{}: وارونه گرفته شده"]
        }
        Kind::WrongPole => &[
            "{} measured from the wrong point of the polygon",
            "{}: القياس من نقطة أخرى من المخطط",
            "{}: از نقطه‌ای دیگر از دیاگرام اندازه گرفته شده",
        ],
        Kind::WrongLine => &[
            "{}: a line drawn by the wrong line of the skeleton",
            "{}: مستقيم مرسوم حسب خط آخر من المخطط الحركي",
            "{}: خطی که از روی خط نادرستی از دیاگرام سینماتیکی رسم شده",
        ],
        Kind::NeighbourRead => &[
            "{} measured to the wrong point of the polygon",
            "{}: القياس إلى نقطة أخرى من المخطط",
            "{}: تا نقطه‌ای دیگر از دیاگرام اندازه گرفته شده",
        ],
        Kind::InertiaAlongAcceleration => &[
            "{} with the acceleration of its mass centre",
            "{}: باتجاه تسارع مركز كتلتها",
            "{}: در جهت شتاب مرکز جرم",
        ],
        Kind::OffsetOtherSide => {
            &["{} laid off to the other side", "{}: الإزاحة إلى الجهة الأخرى", "{}: به سوی دیگر جدا شده"]
        }
        Kind::CoupleWithAlpha => &[
            "{} with the sense of the angular acceleration",
            "{}: باتجاه التسارع الزاوي",
            "{}: در جهت شتاب زاویه‌ای",
        ],
        Kind::WeightAsMass => {
            &["{}: the weight used as a mass", "{}: استُعمل الوزن كأنه كتلة", "{}: وزن به جای جرم به کار رفته"]
        }
        Kind::MassAsWeight => &[
            "{}: the mass used as a weight",
            "{}: استُعملت الكتلة كأنها وزن",
            "{}: جرم به جای وزن به کار رفته",
        ],
        Kind::ReactionForAction => &[
            "{}: the reaction in the place of the force",
            "{}: رد الفعل بدل القوة",
            "{}: عکس‌العمل به جای نیرو",
        ],
        Kind::ArmToPin => &[
            "{}: the distance of the pin in the place of the arm",
            "{}: بعد المسمار بدل الذراع",
            "{}: فاصلهٔ پین به جای بازو",
        ],
        Kind::ArmUnscaled => {
            &["{}: an arm as it is on paper", "{}: الذراع كما هو على الورق", "{}: بازو چنان‌که روی کاغذ است"]
        }
        Kind::GuideForceNotSquare => {
            &["{} is not square to its guide", "{}: ليست عمودية على دليلها", "{}: بر راهنمای خود عمود نیست"]
        }
        Kind::OtherTangent => {
            &["{}: the tangent on the other side", "{}: المماس من الجهة الأخرى", "{}: مماس سوی دیگر"]
        }
        Kind::FrictionAngleReversed => &[
            "{}: the angle of friction to the other side",
            "{}: زاوية الاحتكاك إلى الجهة الأخرى",
            "{}: زاویهٔ اصطکاک به سوی دیگر",
        ],
        Kind::CircleIsJournal => {
            &["{} has the radius of the journal", "{}: بنصف قطر المسمار", "{}: با شعاع خود پین"]
        }
        Kind::TorqueGiven => &[
            "{}: what the mechanism gives, not what it needs",
            "{}: ما تعطيه الآلية لا ما تحتاجه",
            "{}: آنچه مکانیزم می‌دهد، نه آنچه نیاز دارد",
        ],
        Kind::StaticLeftOut => &[
            "{}: loads, weights and springs were left out",
            "{}: أُغفلت الأحمال والأوزان والنوابض",
            "{}: بارها، وزن‌ها و فنرها جا افتاده",
        ],
        Kind::InertiaLeftOut => &["{}: inertia was left out", "{}: أُغفلت العطالة", "{}: اینرسی جا افتاده"],
        Kind::LoadsInShaking => &["{} with the loads", "{}: مع الأحمال", "{}: همراه با بارها"],
        Kind::LargestArea => &["{}: the largest area", "{}: أكبر مساحة", "{}: بزرگ‌ترین مساحت"],
        Kind::OneTurnForTwo => &[
            "{}: another number of turns than a cycle has",
            "{}: عدد دورات غير عدد دورات الدورة الكاملة",
            "{}: شمار دورهایی جز آنچه یک چرخه دارد",
        ],
        Kind::HalfFluctuation => &["{}: half of the range", "{}: نصف المدى", "{}: نیمی از دامنه"],
        Kind::NormalNotSquared => {
            &["{}: ω·l in the place of ω²·l", "{}: ω·l بدل ω²·l", "{}: ω·l به جای ω²·l"]
        }
        Kind::CoriolisWrongVelocity => &[
            "{} with another velocity than that of sliding",
            "{}: بسرعة غير سرعة الانزلاق",
            "{}: با سرعتی جز سرعت لغزش",
        ],
        Kind::RateFromWrongVector => &[
            "{} calculated from another vector than its own",
            "{}: من متجه غير متجهها",
            "{}: از برداری جز بردار خود محاسبه شده",
        ],
        Kind::ProportionFromOtherEnd => &[
            "{}: divided off from the other end of its link",
            "{}: التقسيم من الطرف الآخر للوصلة",
            "{}: از سر دیگر بند تقسیم شده",
        ],
        Kind::DegAsRad => {
            &["{}: degrees in the place of radians", "{}: الدرجات بدل الراديان", "{}: درجه به جای رادیان"]
        }
        Kind::FigureTurned => &[
            "{} is turned against the skeleton",
            "{}: مدوّر بالنسبة إلى المخطط الحركي",
            "{}: نسبت به دیاگرام سینماتیکی چرخیده",
        ],
        Kind::ScaleTwice => &[
            "{}: multiplied by the scale factor twice",
            "{}: ضُرب بمعامل المقياس مرتين",
            "{}: دو بار در ضریب مقیاس ضرب شده",
        ],
        Kind::InputAngle => {
            &["{} laid off at another angle", "{}: رُسم بزاوية أخرى", "{}: با زاویه‌ای دیگر رسم شده"]
        }
        Kind::LengthLaidOff => {
            &["{} laid off otherwise than given", "{}: رُسم بغير ما أُعطي", "{}: جز آنچه داده شده رسم شده"]
        }
        Kind::FrictionLeftOut => &["{}: friction was left out", "{}: أُغفل الاحتكاك", "{}: اصطکاک جا افتاده"],
        Kind::LoadElsewhere => {
            &["{} laid off at another point", "{}: رُسم عند نقطة أخرى", "{}: در نقطه‌ای دیگر رسم شده"]
        }
        Kind::ParallelAxis => {
            &["{}: not about the mass centre", "{}: ليس حول مركز الكتلة", "{}: نه حول مرکز جرم"]
        }
        Kind::RatioInverted => &["{}: the ratio the other way up", "{}: النسبة مقلوبة", "{}: نسبت وارونه"],
        Kind::RoundedCoarsely => {
            &["{}: rounded to two figures", "{}: مقرب إلى رقمين", "{}: به دو رقم گرد شده"]
        }
        Kind::DiameterForRadius => &[
            "{}: diameter and radius mixed up",
            "{}: خلط بين القطر ونصف القطر",
            "{}: قطر و شعاع اشتباه گرفته شده",
        ],
        Kind::PivotMisplaced => &[
            "the pivot {} stands elsewhere than given",
            "المرتكز {} ليس حيث أُعطي",
            "تکیه‌گاه {} جای دیگری جز آنچه داده شده است",
        ],
        Kind::LoadWrong => &[
            "{}: calculated wrongly from what is given",
            "{}: محسوب خطأ من المعطيات",
            "{}: از داده‌ها نادرست محاسبه شده",
        ],
        Kind::RateNotSquared => &["{}: ω in the place of ω²", "{}: ω بدل ω²", "{}: ω به جای ω²"],
        Kind::WrongCentreLine => &[
            "{}: found on a line on which it does not lie",
            "{}: على مستقيم لا يقع عليه",
            "{}: روی خطی یافته شده که بر آن نیست",
        ],
        Kind::Interchanged => &["{} interchanged", "{}: متبادل", "{}: جابه‌جا شده"],
        Kind::InputSpeed => &[
            "{} with another speed than the given one",
            "{}: بسرعة غير المعطاة",
            "{}: با سرعتی جز آنچه داده شده",
        ],
        Kind::GuideMisplaced => &[
            "the guide of {} stands elsewhere than given",
            "دليل {} ليس حيث أُعطي",
            "راهنمای {} جای دیگری جز آنچه داده شده است",
        ],
        Kind::PointLaidOff => &[
            "{} stands elsewhere on its link than given",
            "{}: ليست حيث أُعطيت على وصلتها",
            "{}: روی بند خود جای دیگری جز آنچه داده شده است",
        ],
        Kind::ImageOnLine => &[
            "{} taken on the line of the other two images",
            "{}: أُخذت على مستقيم الصورتين الأخريين",
            "{}: روی خط دو تصویر دیگر گرفته شده",
        ],
        Kind::MomentReversed => {
            &["{}: its moment with the wrong sign", "{}: عزمها بإشارة معكوسة", "{}: گشتاور آن با علامت وارونه"]
        }
        Kind::FrictionMisread => &[
            "{} with another coefficient of friction than given",
            "{}: بمعامل احتكاك غير المعطى",
            "{}: با ضریب اصطکاکی جز آنچه داده شده",
        ],
        Kind::WrongFormula => {
            &["{}: calculated by another formula", "{}: محسوب بعلاقة أخرى", "{}: با رابطه‌ای دیگر محاسبه شده"]
        }
        Kind::DirectionMeasured => &[
            "{}: the direction measured otherwise than counter-clockwise from the x axis",
            "{}: الزاوية مقيسة بغير عكس عقارب الساعة من المحور x",
            "{}: راستا جز پادساعتگرد از محور x سنجیده شده",
        ],
    }
}

/// Where to look.
fn look(kind: Kind) -> &'static Row {
    match kind {
        Kind::SenseReversed => &[
            "Draw the sense as a small arrow on the skeleton and follow it.",
            "ارسم الاتجاه سهما صغيرا على المخطط الحركي واتبعه.",
            "جهت را با پیکانی کوچک روی دیاگرام سینماتیکی بکشید و از آن پیروی کنید.",
        ],
        Kind::PerpendicularForParallel => &[
            "What turns about a point moves square to the line to it; what slides moves along its guide.",
            "ما يدور حول نقطة يتحرك عموديا على الخط إليها، وما ينزلق يتحرك على امتداد دليله.",
            "آنچه حول نقطه‌ای می‌چرخد عمود بر خط تا آن حرکت می‌کند؛ آنچه می‌لغزد در راستای راهنمای خود.",
        ],
        Kind::NormalAwayFromCentre => &[
            "A normal part points along its link, toward the point about which the other one turns.",
            "المركّبة الناظمية على امتداد وصلتها نحو النقطة التي تدور حولها الأخرى.",
            "مؤلفهٔ عمودی در راستای بند خود و به سوی نقطه‌ای است که دیگری حول آن می‌چرخد.",
        ],
        Kind::NormalOfWrongLink => &[
            "V, ω, length and direction of a normal part are those of one link.",
            "V و ω والطول والاتجاه في المركّبة الناظمية لوصلة واحدة.",
            "V، ω، طول و راستای یک مؤلفهٔ عمودی همه از یک بندند.",
        ],
        Kind::NormalMissing => &[
            "Whatever turns has a normal part ω²·l toward the centre, with or without an angular acceleration.",
            "كل ما يدور له مركّبة ناظمية ω²·l نحو المركز، مع تسارع زاوي أو بدونه.",
            "هر چه می‌چرخد مؤلفهٔ عمودی ω²·l به سوی مرکز دارد، با شتاب زاویه‌ای یا بی آن.",
        ],
        Kind::CoriolisMissing => &[
            "A point that slides along a link that turns has the part 2·V·ω; only if V or ω is zero there is none.",
            "النقطة المنزلقة على وصلة تدور لها المركّبة 2·V·ω، ولا تنعدم إلا إذا كانت V أو ω صفرا.",
            "نقطه‌ای که روی بندی چرخان می‌لغزد مؤلفهٔ 2·V·ω دارد؛ تنها اگر V یا ω صفر باشد نیست.",
        ],
        Kind::CoriolisWithoutTwo => &[
            "Coriolis is 2·V·ω: the 2 belongs to it.",
            "كوريوليس هي 2·V·ω: العامل 2 جزء منها.",
            "کوریولیس 2·V·ω است: 2 از آن است.",
        ],
        Kind::CoriolisWrongOmega => &[
            "Coriolis takes the ω of the link that carries the guide.",
            "كوريوليس تأخذ ω للوصلة الحاملة للدليل.",
            "کوریولیس ω بندی را می‌گیرد که راهنما را دارد.",
        ],
        Kind::CoriolisWrongTurn => &[
            "Turn the sliding velocity by 90° in the sense in which the link with the guide turns.",
            "أدر سرعة الانزلاق 90° باتجاه دوران الوصلة الحاملة للدليل.",
            "سرعت لغزش را 90° در جهت چرخش بند راهنما بچرخانید.",
        ],
        Kind::RpmAsRad => &[
            "Multiply revolutions per minute by 2π/60 first.",
            "اضرب أولا الدورات في الدقيقة بالعدد 2π/60.",
            "نخست دور بر دقیقه را در 2π/60 ضرب کنید.",
        ],
        Kind::RevAsRad => &["A revolution is 2π radians.", "الدورة 2π راديان.", "یک دور 2π رادیان است."],
        Kind::RadAsRpm => &[
            "Write the unit beside every ω: 1 rad/s is 9.55 rpm.",
            "اكتب الوحدة بجانب كل ω: 1 rad/s هو 9.55 rpm.",
            "یکا را کنار هر ω بنویسید: 1 rad/s برابر 9.55 rpm است.",
        ],
        Kind::CmAsMm | Kind::MetreMixed => &[
            "Write the unit beside every length before you calculate.",
            "اكتب الوحدة بجانب كل طول قبل الحساب.",
            "پیش از محاسبه یکا را کنار هر طول بنویسید.",
        ],
        Kind::InchAsFoot => &[
            "A foot is 12 inches: write the unit beside every length.",
            "القدم 12 بوصة: اكتب الوحدة بجانب كل طول.",
            "هر فوت 12 اینچ است: یکا را کنار هر طول بنویسید.",
        ],
        Kind::ScaleForgotten => &[
            "Multiply the millimetres that you read by the scale of that diagram.",
            "اضرب الميليمترات المقروءة بمقياس ذلك المخطط.",
            "میلی‌مترهای خوانده را در مقیاس آن دیاگرام ضرب کنید.",
        ],
        Kind::ScaleInverted => &[
            "The scale says how much one centimetre stands for: multiply by it.",
            "المقياس يبين ما يمثله السنتيمتر الواحد: اضرب به.",
            "مقیاس می‌گوید هر سانتی‌متر چه مقدار است: در آن ضرب کنید.",
        ],
        Kind::ScaleWrong => &[
            "Compare the scale that is written at the diagram with the one that you read with.",
            "قارن المقياس المكتوب عند المخطط بالمقياس الذي قرأت به.",
            "مقیاسی را که کنار دیاگرام نوشته شده با مقیاسی که با آن خوانده‌اید مقایسه کنید.",
        ],
        Kind::CalculatorInRadians => &[
            "Set the calculator to degrees; sin 30 must show 0.5.",
            "اضبط الآلة الحاسبة على الدرجات؛ يجب أن يظهر sin 30 = 0.5.",
            "ماشین‌حساب را روی درجه بگذارید؛ sin 30 باید 0.5 نشان دهد.",
        ],
        Kind::WrongAssembly => &[
            "Two places satisfy the lengths: take the one that the figure shows.",
            "وضعان يحققان الأطوال: خذ الوضع الذي يظهره الشكل.",
            "دو جا طول‌ها را برآورده می‌کند: آن را بگیرید که شکل نشان می‌دهد.",
        ],
        Kind::ImageMirrored => &[
            "The image of a link is read round its corners in the same sense as the link itself.",
            "تُقرأ رؤوس صورة الوصلة بالاتجاه نفسه الذي تُقرأ به الوصلة.",
            "گوشه‌های تصویر بند در همان جهت خود بند خوانده می‌شود.",
        ],
        Kind::TangentialWrongLength => &[
            "Velocity or tangential part, ω or ε and the length belong to the same two points of one link.",
            "السرعة أو المركّبة المماسية و ω أو ε والطول كلها للنقطتين نفسيهما من وصلة واحدة.",
            "سرعت یا مؤلفهٔ مماسی، ω یا ε و طول همه از همان دو نقطهٔ یک بندند.",
        ],
        Kind::AlphaIgnored => &[
            "A link with an angular acceleration has a tangential part ε·l besides its normal part.",
            "للوصلة ذات التسارع الزاوي مركّبة مماسية ε·l إلى جانب الناظمية.",
            "بندی که شتاب زاویه‌ای دارد کنار مؤلفهٔ عمودی مؤلفهٔ مماسی ε·l نیز دارد.",
        ],
        Kind::AlphaSign => &[
            "Draw the sense of the angular acceleration on the skeleton and follow it.",
            "ارسم اتجاه التسارع الزاوي على المخطط الحركي واتبعه.",
            "جهت شتاب زاویه‌ای را روی دیاگرام سینماتیکی بکشید و از آن پیروی کنید.",
        ],
        Kind::RelativeReversed => &[
            "A relative vector leads from the image of the point behind the stroke to that of the point before it.",
            "المتجه النسبي من صورة النقطة المنسوب إليها إلى صورة النقطة المنسوبة.",
            "بردار نسبی از تصویر نقطهٔ پس از خط کسری به تصویر نقطهٔ پیش از آن می‌رود.",
        ],
        Kind::WrongPole => &[
            "Absolute vectors begin at the pole, relative ones at the image of the point behind the stroke.",
            "المتجهات المطلقة تبدأ من القطب، والنسبية من صورة النقطة المنسوب إليها.",
            "بردارهای مطلق از قطب آغاز می‌شوند و نسبی‌ها از تصویر نقطهٔ پس از خط کسری.",
        ],
        Kind::WrongLine => &[
            "Look which two points each line of the polygon belongs to.",
            "انظر إلى أي نقطتين يعود كل مستقيم من المخطط.",
            "ببینید هر خط دیاگرام از آنِ کدام دو نقطه است.",
        ],
        Kind::NeighbourRead => &[
            "Look which letter of the polygon belongs to the point that is asked.",
            "انظر أي حرف من المخطط يعود إلى النقطة المطلوبة.",
            "ببینید کدام حرف دیاگرام از آنِ نقطهٔ خواسته است.",
        ],
        Kind::InertiaAlongAcceleration => &[
            "An inertia force points against the acceleration of its mass centre: from g′ to o′.",
            "قوة العطالة بعكس تسارع مركز الكتلة: من g′ إلى o′.",
            "نیروی اینرسی خلاف شتاب مرکز جرم است: از g′ به o′.",
        ],
        Kind::OffsetOtherSide => &[
            "Lay h off to the side on which the inertia force turns against α.",
            "خذ h إلى الجهة التي تدير فيها قوة العطالة بعكس α.",
            "h را به سویی جدا کنید که نیروی اینرسی در آن خلاف α می‌چرخاند.",
        ],
        Kind::CoupleWithAlpha => &[
            "An inertia torque is −I·α: its sense is against that of α.",
            "عزم العطالة هو −I·α: اتجاهه بعكس α.",
            "گشتاور اینرسی −I·α است: جهت آن خلاف α است.",
        ],
        Kind::WeightAsMass => &[
            "Divide a weight by g before you multiply it by an acceleration.",
            "اقسم الوزن على g قبل ضربه بالتسارع.",
            "پیش از ضرب وزن در شتاب آن را بر g تقسیم کنید.",
        ],
        Kind::MassAsWeight => &[
            "A weight is M·g; in M·A stands the mass itself.",
            "الوزن M·g، أما في M·A فالكتلة نفسها.",
            "وزن M·g است؛ در M·A خود جرم می‌آید.",
        ],
        Kind::ReactionForAction => &[
            "The first index is the link that pushes, the second the one that is pushed: interchanged, the sense is the opposite.",
            "الدليل الأول للوصلة الدافعة والثاني للمدفوعة، وبتبديلهما ينعكس الاتجاه.",
            "اندیس نخست بندی است که فشار می‌دهد و دومی بندی که فشار می‌بیند: با جابه‌جایی جهت وارونه می‌شود.",
        ],
        Kind::ArmToPin => &[
            "An arm is square to the line of its force.",
            "الذراع عمودي على خط عمل قوته.",
            "بازو بر خط اثر نیروی خود عمود است.",
        ],
        Kind::ArmUnscaled => &[
            "Multiply arms that you measure by the scale of the skeleton.",
            "اضرب الأذرع المقيسة بمقياس المخطط الحركي.",
            "بازوهای اندازه‌گرفته را در مقیاس دیاگرام سینماتیکی ضرب کنید.",
        ],
        Kind::ForceLeftOut => &[
            "Cut the link free and count what acts on it, before you draw its polygon or take moments.",
            "حرر الوصلة وعدّ ما يؤثر فيها قبل رسم مضلعها أو أخذ العزوم.",
            "پیش از رسم چندضلعی یا گشتاور گرفتن، بند را آزاد کنید و آنچه بر آن اثر می‌کند بشمارید.",
        ],
        Kind::GuideForceNotSquare => &[
            "Without friction a guide only presses square to itself.",
            "بلا احتكاك لا يضغط الدليل إلا عموديا على نفسه.",
            "بدون اصطکاک راهنما تنها عمود بر خود فشار می‌دهد.",
        ],
        Kind::OtherTangent => &[
            "The force on a link passes its friction circle so that its moment about the pin is against the turning of the link.",
            "تمس القوة على الوصلة دائرة الاحتكاك بحيث يكون عزمها حول المسمار بعكس دوران الوصلة.",
            "نیروی وارد بر بند چنان بر دایرهٔ اصطکاک مماس است که گشتاورش حول پین خلاف چرخش بند باشد.",
        ],
        Kind::FrictionAngleReversed => &[
            "The force on what slides leans from the normal against its sliding.",
            "القوة على المنزلق تميل عن الناظم بعكس انزلاقه.",
            "نیروی وارد بر لغزنده از عمود خلاف لغزش آن کج می‌شود.",
        ],
        Kind::CircleIsJournal => &[
            "The radius of the friction circle is r·sin φ, not r.",
            "نصف قطر دائرة الاحتكاك r·sin φ لا r.",
            "شعاع دایرهٔ اصطکاک r·sin φ است، نه r.",
        ],
        Kind::TorqueGiven => &[
            "T is the torque of the surroundings on the driven link: it balances the moments of the others.",
            "T عزم المحيط على الوصلة القائدة: يوازن عزوم البقية.",
            "T گشتاور پیرامون بر بند محرک است: گشتاورهای دیگر را متعادل می‌کند.",
        ],
        Kind::StaticLeftOut | Kind::InertiaLeftOut => &[
            "The total is the static part and that of inertia.",
            "المجموع هو الجزء الساكن وجزء العطالة.",
            "مجموع، بخش ایستایی و بخش اینرسی است.",
        ],
        Kind::LoadsInShaking => &[
            "The shaking force is the sum of the inertia forces alone.",
            "قوة الارتجاج مجموع قوى العطالة وحدها.",
            "نیروی لرزاننده تنها مجموع نیروهای اینرسی است.",
        ],
        Kind::LargestArea => &[
            "E_f is the highest level of energy less the lowest: add the areas up in their order.",
            "E_f أعلى مستوى للطاقة ناقص أدناه: اجمع المساحات بترتيبها.",
            "E_f بالاترین تراز انرژی منهای پایین‌ترین است: مساحت‌ها را به ترتیب جمع کنید.",
        ],
        Kind::OneTurnForTwo => &[
            "The mean is the work of a cycle over its angle: 4π for four strokes, 2π for two.",
            "المتوسط شغل الدورة على زاويتها: 4π لأربعة أشواط و 2π لشوطين.",
            "میانگین، کار یک چرخه بخش بر زاویهٔ آن است: 4π برای چهارزمانه، 2π برای دوزمانه.",
        ],
        Kind::HalfFluctuation => &[
            "±x % about the mean is a range of 2·x %.",
            "±x % حول المتوسط مدى قدره 2·x %.",
            "±x ٪ حول میانگین دامنه‌ای برابر 2·x ٪ است.",
        ],
        Kind::NormalNotSquared => &[
            "A normal part is ω²·l, or V²/l.",
            "المركّبة الناظمية ω²·l أو V²/l.",
            "مؤلفهٔ عمودی ω²·l یا V²/l است.",
        ],
        Kind::CoriolisWrongVelocity => &[
            "2·ω·V: V is the velocity of what slides against its guide.",
            "2·ω·V: السرعة V هي سرعة المنزلق بالنسبة إلى دليله.",
            "2·ω·V: V سرعت لغزنده نسبت به راهنمای آن است.",
        ],
        Kind::RateFromWrongVector => &[
            "ω of a link is the relative velocity of two of its points over the length between them, ε the tangential part over it.",
            "ω للوصلة هي السرعة النسبية لنقطتين منها مقسومة على الطول بينهما، و ε المركّبة المماسية مقسومة عليه.",
            "ω بند سرعت نسبی دو نقطهٔ آن بخش بر طول میان آن‌هاست و ε مؤلفهٔ مماسی بخش بر همان طول.",
        ],
        Kind::ProportionFromOtherEnd => &[
            "The image divides the image of its link as the point divides the link, from the same end.",
            "تقسم الصورة صورة الوصلة كما تقسم النقطة الوصلة، من الطرف نفسه.",
            "تصویر، تصویر بند را چنان تقسیم می‌کند که نقطه بند را، از همان سر.",
        ],
        Kind::DegAsRad => &[
            "180° are π radians; V = ω·l wants ω in rad/s.",
            "180° هي π راديان؛ وفي V = ω·l تكون ω بوحدة rad/s.",
            "180° برابر π رادیان است؛ در V = ω·l باید ω بر حسب rad/s باشد.",
        ],
        Kind::FigureTurned => &[
            "Draw the lines of a polygon by those of the skeleton, with two set squares.",
            "ارسم مستقيمات المخطط حسب خطوط المخطط الحركي بمثلثي رسم.",
            "خط‌های دیاگرام را با دو گونیا از روی خط‌های دیاگرام سینماتیکی بکشید.",
        ],
        Kind::ScaleTwice => &[
            "Multiply the millimetres that you read by the scale of that diagram, once.",
            "اضرب الميليمترات المقروءة بمقياس ذلك المخطط مرة واحدة.",
            "میلی‌مترهای خوانده را تنها یک بار در مقیاس آن دیاگرام ضرب کنید.",
        ],
        Kind::InputAngle => &[
            "Angles of the input count counter-clockwise from the x axis to the line from its first joint to its second.",
            "تقاس زاوية الدخل بعكس عقارب الساعة من المحور x إلى الخط من مفصله الأول إلى الثاني.",
            "زاویهٔ ورودی پادساعتگرد از محور x تا خط مفصل نخست به دوم آن سنجیده می‌شود.",
        ],
        Kind::LengthLaidOff => &[
            "Compare the lengths of your skeleton with the given ones at its scale.",
            "قارن أطوال مخططك الحركي بالأطوال المعطاة حسب مقياسه.",
            "طول‌های دیاگرام سینماتیکی خود را در مقیاس آن با طول‌های داده‌شده مقایسه کنید.",
        ],
        Kind::FrictionLeftOut => &[
            "With friction the force in a pin touches its friction circle, and that of a guide leans by φ against the sliding.",
            "مع الاحتكاك تمس قوة المسمار دائرة احتكاكه، وتميل قوة الدليل بزاوية φ بعكس الانزلاق.",
            "با اصطکاک، نیروی پین بر دایرهٔ اصطکاک آن مماس است و نیروی راهنما به اندازهٔ φ خلاف لغزش کج می‌شود.",
        ],
        Kind::LoadElsewhere => &[
            "Look at which point of its link the load acts.",
            "انظر عند أي نقطة من وصلته يؤثر الحمل.",
            "ببینید بار در کدام نقطهٔ بند خود اثر می‌کند.",
        ],
        Kind::ParallelAxis => &[
            "I about the mass centre is I about another point less M·d².",
            "I حول مركز الكتلة هو I حول نقطة أخرى ناقص M·d².",
            "I حول مرکز جرم برابر I حول نقطه‌ای دیگر منهای M·d² است.",
        ],
        Kind::RatioInverted => &[
            "Write down which number stands over which: i : j is that of i over that of j, ω = V/l, h = T/F.",
            "اكتب أي عدد يُقسم على أيّ: i : j هو ما للوصلة i على ما للوصلة j، و ω = V/l، و h = T/F.",
            "بنویسید کدام عدد بر کدام است: i : j یعنی آنِ i بر آنِ j، ω = V/l، h = T/F.",
        ],
        Kind::RoundedCoarsely => &[
            "Hand in three figures: what follows is no better than what you round to.",
            "اكتب ثلاثة أرقام معنوية: ما يلي ليس أدق مما قربت إليه.",
            "سه رقم بدهید: آنچه در پی می‌آید دقیق‌تر از گردکردن شما نیست.",
        ],
        Kind::DiameterForRadius => &[
            "Look whether the radius or the diameter is given.",
            "انظر هل أُعطي نصف القطر أم القطر.",
            "ببینید شعاع داده شده یا قطر.",
        ],
        Kind::PivotMisplaced => &[
            "Lay off the fixed points once more before the links.",
            "ارسم النقاط الثابتة من جديد قبل الوصلات.",
            "نقطه‌های ثابت را پیش از بندها یک بار دیگر بگذارید.",
        ],
        Kind::LoadWrong => &[
            "Compare with what is given: every number with its sign and its unit.",
            "قارن بالمعطيات: كل عدد مع إشارته ووحدته.",
            "با داده‌ها مقایسه کنید: هر عدد با علامت و یکای آن.",
        ],
        Kind::RateNotSquared => &[
            "The energy of what turns grows with ω²: K_s = E_f/(I·ω²).",
            "طاقة ما يدور تزداد مع ω²: K_s = E_f/(I·ω²).",
            "انرژی آنچه می‌چرخد با ω² زیاد می‌شود: K_s = E_f/(I·ω²).",
        ],
        Kind::WrongCentreLine => &[
            "The centre of links i and j lies on the line through those that both have with one third link.",
            "يقع مركز الوصلتين i و j على المستقيم المار من مركزيهما مع وصلة ثالثة واحدة.",
            "مرکز بندهای i و j روی خط مراکز آن دو با یک بند سوم است.",
        ],
        Kind::Interchanged => &[
            "Look which of the two belongs to which name.",
            "انظر أيهما يعود إلى أي اسم.",
            "ببینید کدام‌یک از آنِ کدام نام است.",
        ],
        Kind::InputSpeed => &[
            "Read the given speed once more, with its unit.",
            "اقرأ السرعة المعطاة من جديد مع وحدتها.",
            "سرعت داده‌شده را با یکای آن یک بار دیگر بخوانید.",
        ],
        Kind::GuideMisplaced => &[
            "Lay off the line of the guide once more: its offset, on its side, and its angle.",
            "ارسم خط الدليل من جديد: إزاحته وجهتها وزاويته.",
            "خط راهنما را یک بار دیگر بکشید: جابه‌جایی، سوی آن و زاویه‌اش.",
        ],
        Kind::PointLaidOff => &[
            "Lay off the third point of the link once more, by its lengths, its angle and its side.",
            "ارسم النقطة الثالثة من الوصلة من جديد بأطوالها وزاويتها وجهتها.",
            "نقطهٔ سوم بند را یک بار دیگر با طول‌ها، زاویه و سوی آن بگذارید.",
        ],
        Kind::ImageOnLine => &[
            "A point that does not lie on the line of two others has its image beside the line of theirs: the triangles are similar.",
            "النقطة التي ليست على مستقيم نقطتين أخريين صورتها خارج مستقيم صورتيهما: المثلثان متشابهان.",
            "نقطه‌ای که روی خط دو نقطهٔ دیگر نیست تصویرش بیرون خط تصویرهای آن‌هاست: مثلث‌ها متشابه‌اند.",
        ],
        Kind::MomentReversed => &[
            "Draw the sense in which each force turns the link about that point: those that turn the same way have one sign.",
            "ارسم اتجاه تدوير كل قوة للوصلة حول تلك النقطة: ما يدير بالاتجاه نفسه له إشارة واحدة.",
            "جهتی را که هر نیرو بند را حول آن نقطه می‌چرخاند بکشید: هم‌جهت‌ها یک علامت دارند.",
        ],
        Kind::FrictionMisread => &[
            "Read f or φ once more: tan φ = f.",
            "اقرأ f أو φ من جديد: tan φ = f.",
            "f یا φ را یک بار دیگر بخوانید: tan φ = f.",
        ],
        Kind::SlipMissing => &[
            "The pin slides in its guide: the point under it has another velocity.",
            "ينزلق المسمار في دليله: للنقطة التي تحته سرعة أخرى.",
            "پین در راهنمای خود می‌لغزد: نقطهٔ زیر آن سرعتی دیگر دارد.",
        ],
        Kind::WrongFormula => &[
            "Write the formula down with its letters before you put numbers in.",
            "اكتب العلاقة بحروفها قبل التعويض بالأعداد.",
            "پیش از گذاشتن عددها رابطه را با حروف بنویسید.",
        ],
        Kind::DirectionMeasured => &[
            "Directions count counter-clockwise from the x axis.",
            "تقاس الزوايا بعكس عقارب الساعة من المحور x.",
            "راستاها پادساعتگرد از محور x سنجیده می‌شوند.",
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_mistake_says_what_it_is_about_in_every_language() {
        for kind in Kind::ALL {
            assert!(told(kind).iter().all(|text| text.matches("{}").count() == 1), "{kind:?}");
            assert!(look(kind).iter().all(|text| text.ends_with('.') && !text.contains("{}")), "{kind:?}");
        }
    }
}
