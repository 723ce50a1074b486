//! What reports say, in every language: sentences and parts of sentences with blanks.
//!
//! The table has a column for each language, so that a sentence which a language lacks does not compile, and neither does
//! [`say!`](crate::grade::say) with a sentence that is not in the table.

use crate::sheet::Language;

/// A sentence, or a part of one, in English, Arabic and Persian; `{}` is filled with names and numbers.
pub(super) type Row = [&'static str; 3];

/// Something that a report says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Phrase {
    /// In English.
    english: String,
    /// Its words and what fills their blanks; a name or a number has none.
    said: Option<(&'static Row, Vec<Phrase>)>,
}

impl Phrase {
    pub(super) fn said(row: &'static Row, parts: Vec<Self>) -> Self {
        let english = filled(row[0], parts.iter().map(|part| part.english.as_str()));
        Self { english, said: Some((row, parts)) }
    }

    /// In this language.
    #[must_use]
    pub fn told(&self, language: Language) -> String {
        let column = match language {
            Language::English => return self.english.clone(),
            Language::Arabic | Language::ArabicAjala => 1,
            Language::Persian => 2,
        };
        let Some((row, parts)) = &self.said else { return self.english.clone() };
        let parts: Vec<String> = parts.iter().map(|part| part.told(language)).collect();
        let words = match language {
            Language::ArabicAjala => of_ajala(row[column]),
            _ => row[column].to_owned(),
        };
        filled(&words, parts.iter().map(String::as_str))
    }
}

/// The Arabic of the textbooks that say عجلة for acceleration.
fn of_ajala(text: &str) -> String {
    let mut text = text.to_owned();
    for (one, other) in [("التسارعات", "العجلات"), ("التسارع", "العجلة"), ("تسارع", "عجلة"), ("منحى", "اتجاه")]
    {
        text = text.replace(one, other);
    }
    text
}

/// A text whose blanks are filled in their order.
fn filled<'p>(text: &str, mut parts: impl Iterator<Item = &'p str>) -> String {
    let mut pieces = text.split("{}");
    let mut whole = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        whole.push_str(parts.next().unwrap_or_default());
        whole.push_str(piece);
    }
    whole
}

impl std::ops::Deref for Phrase {
    type Target = str;

    fn deref(&self) -> &str {
        &self.english
    }
}

impl PartialEq<str> for Phrase {
    fn eq(&self, other: &str) -> bool {
        self.english == other
    }
}

impl PartialEq<&str> for Phrase {
    fn eq(&self, other: &&str) -> bool {
        self.english == *other
    }
}

impl PartialEq<Phrase> for String {
    fn eq(&self, other: &Phrase) -> bool {
        *self == other.english
    }
}

impl PartialEq<String> for Phrase {
    fn eq(&self, other: &String) -> bool {
        self.english == *other
    }
}

impl std::fmt::Display for Phrase {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.english)
    }
}

impl From<&str> for Phrase {
    fn from(name: &str) -> Self {
        Self { english: name.to_owned(), said: None }
    }
}

impl From<String> for Phrase {
    fn from(name: String) -> Self {
        Self { english: name, said: None }
    }
}

impl From<&String> for Phrase {
    fn from(name: &String) -> Self {
        Self::from(name.as_str())
    }
}

impl From<&Self> for Phrase {
    fn from(phrase: &Self) -> Self {
        phrase.clone()
    }
}

/// What may fill a blank.
pub(super) trait Part {
    /// As a part of a sentence.
    fn phrase(&self) -> Phrase;
}

impl Part for Phrase {
    fn phrase(&self) -> Phrase {
        self.clone()
    }
}

impl Part for &Phrase {
    fn phrase(&self) -> Phrase {
        (*self).clone()
    }
}

/// Names and numbers, which are the same in every language.
macro_rules! as_they_are {
    ($($type:ty),*) => {
        $(impl Part for $type {
            fn phrase(&self) -> Phrase {
                Phrase::from(self.to_string())
            }
        })*
    };
}
as_they_are!(str, &str, String, &String, u32, usize, f64);

/// A sentence of the table by its English words, its blanks filled in their order.
macro_rules! say {
    ($text:literal $(, $part:expr)* $(,)?) => {
        $crate::grade::phrase::Phrase::said(
            const { $crate::grade::phrase::row($text) },
            vec![$($crate::grade::phrase::Part::phrase(&$part)),*],
        )
    };
}
pub(super) use say;

/// The row with this English sentence; there must be one.
pub(super) const fn row(english: &str) -> &'static Row {
    let mut place = 0;
    while place < PHRASES.len() {
        if is_one(PHRASES[place][0].as_bytes(), english.as_bytes()) {
            return &PHRASES[place];
        }
        place += 1;
    }
    panic!("the table has no such sentence")
}

const fn is_one(a: &[u8], b: &[u8]) -> bool {
    if a.len() != b.len() {
        return false;
    }
    let mut place = 0;
    while place < a.len() {
        if a[place] != b[place] {
            return false;
        }
        place += 1;
    }
    true
}

#[rustfmt::skip]
const PHRASES: &[Row] = &[
    // What a mistake is about.
    ["the input", "الدخل", "ورودی"],
    ["the answers", "الإجابات", "پاسخ‌ها"],
    ["the given angle", "الزاوية المعطاة", "زاویهٔ داده‌شده"],
    ["the directions", "الزوايا الدالة على منحى المتجهات", "راستاها"],
    ["the velocities", "السرعات", "سرعت‌ها"],
    ["the accelerations", "التسارعات", "شتاب‌ها"],
    ["the length {}", "الطول {}", "طول {}"],
    ["all lengths", "كل الأطوال", "همهٔ طول‌ها"],
    ["the lengths by which is divided", "الأطوال التي يُقسم عليها", "طول‌هایی که بر آن‌ها تقسیم می‌شود"],
    ["the length of link {}", "طول الوصلة {}", "طول بند {}"],
    ["the answers' unit", "وحدة الإجابات", "یکای پاسخ‌ها"],
    ["every reading", "كل القراءات", "همهٔ خوانده‌ها"],
    ["the lengths measured on the skeleton", "الأطوال المقيسة على المخطط الحركي", "طول‌های اندازه‌گرفته از دیاگرام سینماتیکی"],
    ["link {}", "الوصلة {}", "بند {}"],
    ["the skeleton", "المخطط الحركي", "دیاگرام سینماتیکی"],
    ["every normal part", "كل المركّبات الناظمية", "همهٔ مؤلفه‌های عمودی"],
    ["every normal part that is found", "كل المركّبات الناظمية المحسوبة", "همهٔ مؤلفه‌های عمودی محاسبه‌شده"],
    ["every line", "كل المستقيمات", "همهٔ خط‌ها"],
    ["the guide", "الدليل", "راهنما"],
    ["the image of {}", "صورة {}", "تصویر {}"],
    ["the image of link {}", "صورة الوصلة {}", "تصویر بند {}"],
    ["the velocity polygon", "مخطط السرعة", "دیاگرام سرعت"],
    ["the acceleration polygon", "مخطط التسارع", "دیاگرام شتاب"],
    ["every inertia force", "كل قوى العطالة", "همهٔ نیروهای اینرسی"],
    ["every offset", "كل إزاحات قوى العطالة", "همهٔ جابه‌جایی‌های نیروهای اینرسی"],
    ["every inertia torque", "كل عزوم العطالة", "همهٔ گشتاورهای اینرسی"],
    ["the mass of link {}", "كتلة الوصلة {}", "جرم بند {}"],
    ["the masses", "الكتل", "جرم‌ها"],
    ["every weight", "كل الأوزان", "همهٔ وزن‌ها"],
    ["the friction circle at {}", "دائرة الاحتكاك عند {}", "دایرهٔ اصطکاک در {}"],
    ["every pair", "كل الازدواجات", "همهٔ زوج‌ها"],
    ["the pins", "المسامير", "پین‌ها"],
    ["the guides", "الأدلة", "راهنماها"],
    ["every friction circle", "كل دوائر الاحتكاك", "همهٔ دایره‌های اصطکاک"],
    ["the guide of {}", "دليل {}", "راهنمای {}"],
    ["the whole", "المجموع", "مجموع"],
    ["the areas of the diagram", "مساحات المخطط", "مساحت‌های نمودار"],
    ["the diagram", "المخطط", "نمودار"],
    ["the period", "الدور", "دورهٔ تناوب"],
    ["the load on link {}", "الحمل على الوصلة {}", "بار وارد بر بند {}"],
    ["line of {}", "خط عمل {}", "خط اثر {}"],
    ["{} (velocity polygon)", "{} (مخطط السرعة)", "{} (دیاگرام سرعت)"],
    ["{} (acceleration polygon)", "{} (مخطط التسارع)", "{} (دیاگرام شتاب)"],
    ["{} (skeleton)", "{} (المخطط الحركي)", "{} (دیاگرام سینماتیکی)"],

    // What exactly was done.
    ["with {}", "مع {}", "با {}"],
    ["V of {} over {}", "V للنقطة {} مقسومة على {}", "V نقطهٔ {} بخش بر {}"],
    ["{} to {}", "البعد من {} إلى {}", "فاصلهٔ {} تا {}"],
    ["the distance of {}", "بعد {}", "فاصلهٔ {}"],
    ["distances of {} and {} interchanged", "بعدا {} و {} متبادلان", "فاصله‌های {} و {} جابه‌جا"],
    ["counted from the other side", "مقيسة من الجهة الأخرى", "از سوی دیگر سنجیده"],
    ["counted clockwise", "مقيسة باتجاه عقارب الساعة", "ساعتگرد سنجیده"],
    ["counted from the y axis", "مقيسة من المحور y", "از محور y سنجیده"],
    ["sine and cosine interchanged", "الجيب والتجيب متبادلان", "سینوس و کسینوس جابه‌جا"],
    ["{} stands {} too far clockwise", "{} أبعد مما يجب بمقدار {} باتجاه عقارب الساعة", "{} به اندازهٔ {} بیش از حد ساعتگرد"],
    ["{} stands {} too far counter-clockwise", "{} أبعد مما يجب بمقدار {} بعكس عقارب الساعة", "{} به اندازهٔ {} بیش از حد پادساعتگرد"],
    ["{} away", "على بعد {}", "به فاصلهٔ {}"],
    ["turned by {}", "مع تدوير بزاوية {}", "با چرخش {}"],
    ["{} for {}", "{} بدل {}", "{} به جای {}"],
    ["clockwise", "باتجاه عقارب الساعة", "ساعتگرد"],
    ["clockwise from the y axis", "باتجاه عقارب الساعة من المحور y", "ساعتگرد از محور y"],
    ["from the y axis", "من المحور y", "از محور y"],
    ["read {} times too large", "مقروءة أكبر {} مرة", "{} برابر بزرگ‌تر خوانده"],
    ["read {} times too small", "مقروءة أصغر {} مرة", "{} برابر کوچک‌تر خوانده"],
    ["read about {} times too large", "مقروءة أكبر بنحو {} مرة", "حدود {} برابر بزرگ‌تر خوانده"],
    ["read about {} times too small", "مقروءة أصغر بنحو {} مرة", "حدود {} برابر کوچک‌تر خوانده"],
    ["about the point of contact, as if that were at rest", "حول نقطة التماس كأنها ساكنة", "حول نقطهٔ تماس، گویی ساکن است"],
    ["with the length {}", "بالطول {}", "با طول {}"],
    ["∥ {} instead of {}", "∥ {} بدل {}", "∥ {} به جای {}"],
    ["⊥ {} instead of {}", "⊥ {} بدل {}", "⊥ {} به جای {}"],
    ["∥ {}", "∥ {}", "∥ {}"],
    ["⊥ {}", "⊥ {}", "⊥ {}"],
    ["from {}", "من {}", "از {}"],
    ["that of {}", "ما هو للنقطة {}", "آنِ {}"],
    ["of its acceleration", "من تسارعها", "از شتاب آن"],
    ["by {}° clockwise", "بزاوية {}° باتجاه عقارب الساعة", "به اندازهٔ {}° ساعتگرد"],
    ["by {}° counter-clockwise", "بزاوية {}° بعكس عقارب الساعة", "به اندازهٔ {}° پادساعتگرد"],
    ["{} read for {}", "قُرئ {} بدل {}", "{} به جای {} خوانده"],
    ["the sum of both ω for their difference", "مجموع ω للوصلتين بدل فرقهما", "مجموع دو ω به جای تفاضل آن‌ها"],
    ["one ω alone", "ω لوصلة واحدة فقط", "تنها یک ω"],
    ["Coriolis was not taken off", "لم تُطرح مركّبة كوريوليس", "مؤلفهٔ کوریولیس کم نشده"],
    ["the line through {} and {}", "المستقيم المار من {} و {}", "خط گذرنده از {} و {}"],
    ["with its couple", "مع مزدوجته", "با کوپل آن"],
    ["left out of the moments of link {}", "أُغفل في عزوم الوصلة {}", "از گشتاورهای بند {} جا افتاده"],
    ["left out of the polygon of link {}", "أُغفل في مضلع الوصلة {}", "از چندضلعی بند {} جا افتاده"],
    ["left out at link {}", "أُغفل عند الوصلة {}", "در بند {} جا افتاده"],
    ["left out at link {}, its couple kept", "أُغفلت عند الوصلة {} وبقيت مزدوجتها", "در بند {} جا افتاده و کوپل آن مانده"],
    ["left out of the moments of link {}, its couple kept", "أُغفلت في عزوم الوصلة {} وبقيت مزدوجتها", "از گشتاورهای بند {} جا افتاده و کوپل آن مانده"],
    ["in the moments of link {}", "في عزوم الوصلة {}", "در گشتاورهای بند {}"],
    ["with the same sense on link {}", "بالاتجاه نفسه على الوصلة {}", "با همان جهت بر بند {}"],
    ["about {} to the pin", "حول {} إلى المسمار", "حول {} تا پین"],
    ["a length of {}", "طول قدره {}", "طولی برابر {}"],
    ["vertical", "شاقوليا", "قائم"],
    ["horizontal", "أفقيا", "افقی"],
    ["along link {}", "على امتداد الوصلة {}", "در راستای بند {}"],
    ["square to link {}", "عموديا على الوصلة {}", "عمود بر بند {}"],
    ["the rod was not taken off the area", "لم يُطرح مقطع الساق من المساحة", "سطح میله از مساحت کم نشده"],
    ["the area of the rod alone", "مقطع الساق وحده", "تنها سطح میله"],
    ["a unit is off by {}", "وحدة مختلفة بالعامل {}", "یکایی با ضریب {} اشتباه"],
    ["at {}", "عند {}", "در {}"],
    ["I about {} taken for I about the mass centre", "I حول {} بدل I حول مركز الكتلة", "I حول {} به جای I حول مرکز جرم"],
    ["M·d² added that is taken off", "أُضيف M·d² وهو يُطرح", "M·d² افزوده که باید کم شود"],
    ["the scale of angles was left out", "أُغفل مقياس الزوايا", "مقیاس زاویه‌ها جا افتاده"],
    ["the scale of torques was left out", "أُغفل مقياس العزوم", "مقیاس گشتاورها جا افتاده"],
    ["the scale of torques and angles was left out", "أُغفل مقياسا العزوم والزوايا", "مقیاس گشتاورها و زاویه‌ها جا افتاده"],
    ["{} read as {} {} at {}°", "{} مقروءا {} {} عند {}°", "{} به صورت {} {} در {}° خوانده"],
    ["the mean of the values, not of the area", "متوسط القيم لا متوسط المساحة", "میانگین مقدارها، نه میانگین مساحت"],
    ["E_f/T_m in the place of E_f/E", "E_f/T_m بدل E_f/E", "E_f/T_m به جای E_f/E"],
    ["what turns already was not taken off", "لم يُطرح ما يدور من قبل", "آنچه خود می‌چرخد کم نشده"],
    ["what turns already was added", "أُضيف ما يدور من قبل", "آنچه خود می‌چرخد افزوده شده"],
    ["the highest level alone", "المستوى الأعلى وحده", "تنها بالاترین تراز"],
    ["the lowest level alone", "المستوى الأدنى وحده", "تنها پایین‌ترین تراز"],
    ["the lowest level with the wrong sign", "المستوى الأدنى بإشارة معكوسة", "پایین‌ترین تراز با علامت وارونه"],
    ["with half its own length", "بنصف طولها", "با نصف طول خود"],
    ["with twice its own length", "بضعف طولها", "با دو برابر طول خود"],
    ["with the acceleration of {}", "بتسارع {}", "با شتاب {}"],
    ["in the middle of its link", "في منتصف وصلتها", "در میانهٔ بند خود"],
    ["V/l in the place of V²/l", "V/l بدل V²/l", "V/l به جای V²/l"],
    ["V² without its length", "V² دون القسمة على الطول", "V² بدون تقسیم بر طول"],
    ["M·k in the place of M·k²", "M·k بدل M·k²", "M·k به جای M·k²"],
    ["a whole turn", "دورة كاملة", "یک دور کامل"],
    ["half a turn", "نصف دورة", "نیم دور"],
    ["the whole range taken for it and doubled", "أُخذ المدى كله بدله وضوعف", "همهٔ دامنه به جای آن گرفته و دو برابر شده"],
    ["({}, {}) for ({}, {}) {}", "({}، {}) بدل ({}، {}) {}", "({}، {}) به جای ({}، {}) {}"],
    ["{} for {} {}", "{} بدل {} {}", "{} به جای {} {}"],
    ["{} for {} deg", "{}° بدل {}°", "{}° به جای {}°"],
    ["interchanged with {}", "متبادل مع {}", "جابه‌جا با {}"],
    ["half a turn away", "بفارق نصف دورة", "با نیم دور تفاوت"],
    ["a quarter of a turn away", "بفارق ربع دورة", "با یک‌چهارم دور تفاوت"],
    ["through {}", "مارا من {}", "گذرنده از {}"],
    ["on the other side of {}", "على الجهة الأخرى من {}", "در سوی دیگر {}"],
    ["{} for {} {} from {}", "{} بدل {} {} من {}", "{} به جای {} {} از {}"],
    ["x and y interchanged", "x و y متبادلان", "x و y جابه‌جا"],
    ["x with the other sign", "x بالإشارة الأخرى", "x با علامت دیگر"],
    ["y with the other sign", "y بالإشارة الأخرى", "y با علامت دیگر"],
    ["∠{} {} for {} deg", "∠{} = {}° بدل {}°", "∠{} = {}° به جای {}°"],
    ["{} {} for {} {}", "{} = {} بدل {} {}", "{} = {} به جای {} {}"],
    ["about ({}, {}) for ({}, {}) {}", "نحو ({}، {}) بدل ({}، {}) {}", "حدود ({}، {}) به جای ({}، {}) {}"],
    ["about {} % too long", "أطول بنحو {} %", "حدود {} ٪ بلندتر"],
    ["about {} % too short", "أقصر بنحو {} %", "حدود {} ٪ کوتاه‌تر"],
    ["about {} % too fast", "أسرع بنحو {} %", "حدود {} ٪ تندتر"],
    ["about {} % too slow", "أبطأ بنحو {} %", "حدود {} ٪ کندتر"],
    ["about {} {} away", "على بعد نحو {} {}", "به فاصلهٔ حدود {} {}"],
    ["about {}° too far clockwise", "أبعد بنحو {}° باتجاه عقارب الساعة", "حدود {}° بیش از حد ساعتگرد"],
    ["about {}° too far counter-clockwise", "أبعد بنحو {}° بعكس عقارب الساعة", "حدود {}° بیش از حد پادساعتگرد"],
    ["{} {} and {}", "{} {} و {}", "{} {} و {}"],
    ["{} {}", "{} {}", "{} {}"],
    ["from the whole acceleration, not its tangential part", "من التسارع الكلي لا من مركّبته المماسية", "از شتاب کل، نه از مؤلفهٔ مماسی آن"],

    // What is said of a mistake as a whole.
    ["{} ({})", "{} ({})", "{} ({})"],
    ["{}; and {}", "{}؛ و {}", "{}؛ و {}"],
    ["{}: {}", "{}: {}", "{}: {}"],
    ["{}: no known mistake fits", "{}: لا خطأ معروف يفسرها", "{}: هیچ اشتباه شناخته‌ای با آن جور نیست"],
    ["First fault, {}", "الخطأ الأول، {}", "نخستین اشتباه، {}"],
    ["first fault, {}", "الخطأ الأول، {}", "نخستین اشتباه، {}"],
    ["first fault in step {}, {}", "الخطأ الأول في الخطوة {}، {}", "نخستین اشتباه در گام {}، {}"],
    ["{} (step {} of the solution)", "{} (الخطوة {} من الحل)", "{} (گام {} راه‌حل)"],
    ["Probably {}. {}", "على الأرجح: {}. {}", "به احتمال زیاد: {}. {}"],
    ["Perhaps {}. {}", "ربما: {}. {}", "شاید: {}. {}"],
    ["Probably two mistakes at once: {}. {}", "على الأرجح خطآن معا: {}. {}", "به احتمال زیاد دو اشتباه با هم: {}. {}"],
    ["Perhaps two mistakes at once: {}. {}", "ربما خطآن معا: {}. {}", "شاید دو اشتباه با هم: {}. {}"],
    ["No known mistake leads to this value; it is about {} % and {}° off, as by a slip in drawing or reading.", "لا خطأ معروف يؤدي إلى هذه القيمة؛ هي منحرفة نحو {} % و{}° كما بزلة في الرسم أو القراءة.", "هیچ اشتباه شناخته‌ای به این مقدار نمی‌رسد؛ حدود {} % و {}° انحراف دارد، مانند لغزشی در رسم یا خواندن."],
    ["No known mistake leads to this value; it is about {}° off, as by a slip in drawing or reading.", "لا خطأ معروف يؤدي إلى هذه القيمة؛ هي منحرفة نحو {}° كما بزلة في الرسم أو القراءة.", "هیچ اشتباه شناخته‌ای به این مقدار نمی‌رسد؛ حدود {}° انحراف دارد، مانند لغزشی در رسم یا خواندن."],
    ["No known mistake leads to this value; it is about {} % too large, as by a slip in drawing or reading.", "لا خطأ معروف يؤدي إلى هذه القيمة؛ هي أكبر بنحو {} % كما بزلة في الرسم أو القراءة.", "هیچ اشتباه شناخته‌ای به این مقدار نمی‌رسد؛ حدود {} % بزرگ‌تر است، مانند لغزشی در رسم یا خواندن."],
    ["No known mistake leads to this value; it is about {} % too small, as by a slip in drawing or reading.", "لا خطأ معروف يؤدي إلى هذه القيمة؛ هي أصغر بنحو {} % كما بزلة في الرسم أو القراءة.", "هیچ اشتباه شناخته‌ای به این مقدار نمی‌رسد؛ حدود {} % کوچک‌تر است، مانند لغزشی در رسم یا خواندن."],
    ["No known mistake leads to this value; compare your drawing.", "لا خطأ معروف يؤدي إلى هذه القيمة؛ قارن رسمك.", "هیچ اشتباه شناخته‌ای به این مقدار نمی‌رسد؛ رسم خود را مقایسه کنید."],
    ["No known mistake leads to this value; compare your drawing from step {} of the solution on.", "لا خطأ معروف يؤدي إلى هذه القيمة؛ قارن رسمك من الخطوة {} من الحل فما بعد.", "هیچ اشتباه شناخته‌ای به این مقدار نمی‌رسد؛ رسم خود را از گام {} راه‌حل به بعد مقایسه کنید."],

    // Verdicts.
    ["right", "صحيح", "درست"],
    ["follows rightly from another fault", "ناتج صحيح من خطأ آخر", "از اشتباهی دیگر درست به دست آمده"],
    ["wrong", "خطأ", "نادرست"],
    ["not determined here", "غير معين هنا", "در اینجا نامعین"],
    ["right ({})", "صحيح ({})", "درست ({})"],
    ["right as far as it can be measured ({})", "صحيح بقدر ما يمكن قياسه ({})", "درست تا جایی که بتوان اندازه گرفت ({})"],
    ["wrong: {} is right", "خطأ: الصحيح {}", "نادرست: {} درست است"],
    ["wrong in the magnitude: {} is right", "خطأ في القيمة: الصحيح {}", "نادرست در مقدار: {} درست است"],
    ["wrong in the direction: {} is right", "خطأ في منحى المتجه: الصحيح {}", "نادرست در راستا: {} درست است"],
    ["wrong in magnitude and direction: {} is right", "خطأ في القيمة وفي منحى المتجه: الصحيح {}", "نادرست در مقدار و راستا: {} درست است"],
    ["wrong: the magnitude", "خطأ: القيمة", "نادرست: مقدار"],
    ["wrong: the direction", "خطأ: منحى المتجه", "نادرست: راستا"],
    ["wrong: magnitude and direction", "خطأ: القيمة ومنحى المتجه", "نادرست: مقدار و راستا"],
    ["follows rightly from another fault ({} is right)", "ناتج صحيح من خطأ آخر (الصحيح {})", "از اشتباهی دیگر درست به دست آمده ({} درست است)"],
    ["{}, which costs its mark here", "{}، ويكلف علامته هنا", "{}، که نمره‌اش اینجا کم می‌شود"],
    ["{}, no marks", "{}، بلا علامة", "{}، بی‌نمره"],
    ["{}, with marks for the part that is right", "{}، مع علامة للجزء الصحيح", "{}، با نمره برای بخش درست"],
    ["{}, but its sense is not told", "{}، ولكن اتجاه الدوران غير مذكور", "{}، ولی جهت آن گفته نشده"],
    ["{}, but its direction is not told", "{}، ولكن منحى المتجه غير مذكور", "{}، ولی راستای آن گفته نشده"],
    ["not answered: {}", "بلا إجابة: {}", "بی‌پاسخ: {}"],
    ["not read, no marks: {}: {}", "غير مقروء، بلا علامة: {}: {}", "خوانده نشد، بی‌نمره: {}: {}"],
    ["not read: {}: {}", "غير مقروء: {}: {}", "خوانده نشد: {}: {}"],
    ["not read: {}", "غير مقروء: {}", "خوانده نشد: {}"],
    ["{}: not read", "{}: غير مقروء", "{}: خوانده نشد"],
    ["marks: {} of {}", "العلامات: {} من {}", "نمره: {} از {}"],
    ["{} of {} marks", "{} من {} علامة", "{} از {} نمره"],
    ["{} of {}", "{} من {}", "{} از {}"],
    ["no marks", "بلا علامة", "بی‌نمره"],
    ["asked", "المطلوب", "خواسته"],
    ["yours", "إجابتك", "پاسخ شما"],
    ["verdict", "الحكم", "داوری"],
    ["marks", "العلامات", "نمره"],

    // Numbers.
    ["as the answers' file states it", "كما يذكره ملف الإجابات", "چنان‌که پروندهٔ پاسخ‌ها می‌گوید"],
    ["calculated from what is given, no reading is behind it", "محسوب من المعطيات بلا قراءة من الرسم", "از داده‌ها محاسبه می‌شود و خواندنی در کار نیست"],
    ["read off the paper, mm of mm: {}", "مقروء من الورق، mm من mm: {}", "خوانده از کاغذ، mm از mm: {}"],
    ["read: {} mm of {} mm on paper at that place", "مقروء: {} mm من {} mm على الورق في ذلك الموضع", "خوانده: {} mm از {} mm روی کاغذ در آن جا"],
    ["calculated from what is read off the drawing", "محسوب مما يُقرأ من الرسم", "از آنچه از رسم خوانده می‌شود محاسبه می‌شود"],
    ["small on paper: two readings off it are {} % of it, so that {} % does not hold", "صغير على الورق: قراءتان منه {} % من مقداره، فلا يصح حد {} %", "روی کاغذ کوچک است: دو بار خواندن {} % آن است، پس حد {} % برقرار نیست"],
    ["small beside the largest of its kind, and read no finer than a tenth of that: that is {} % of it, so that {} % does not hold", "صغير أمام أكبر ما هو من نوعه، ولا يقرأ بأدق من عشر ذاك: وهو {} % من مقداره، فلا يصح حد {} %", "در برابر بزرگ‌ترین هم‌نوع خود کوچک است و دقیق‌تر از یک‌دهم آن خوانده نمی‌شود: این {} % آن است، پس حد {} % برقرار نیست"],
    ["hard to measure: a careful hand may be off by {} {} here", "صعب القياس: قد تخطئ اليد المتقنة هنا بمقدار {} {}", "سخت اندازه‌گرفتنی: دست دقیق هم اینجا ممکن است {} {} خطا کند"],
    ["hard to measure: a careful hand may be off by {} {} and {}° here", "صعب القياس: قد تخطئ اليد المتقنة هنا بمقدار {} {} و {}°", "سخت اندازه‌گرفتنی: دست دقیق هم اینجا ممکن است {} {} و {}° خطا کند"],
    ["How far an answer may be off: {}.", "مقدار الخطأ المسموح به في كل إجابة: {}.", "خطای مجاز هر پاسخ: {}."],
    ["{} cw", "{} باتجاه عقارب الساعة", "{} ساعتگرد"],
    ["{} ccw", "{} بعكس عقارب الساعة", "{} پادساعتگرد"],
    ["{} at {}°{}", "{} بزاوية {}°{}", "{} در {}°{}"],
    ["{} mm on paper", "{} mm على الورق", "{} mm روی کاغذ"],
    ["{}, magnitude{} {}", "{}، القيمة{} {}", "{}، مقدار{} {}"],
    ["{}, magnitude{} {}, direction{}", "{}، القيمة{} {}، منحى المتجه{}", "{}، مقدار{} {}، راستا{}"],

    // What is told before all answers.
    ["Your drawing lies turned by {}° clockwise; it was turned back before it was compared.", "رسمك مدوّر بزاوية {}° باتجاه عقارب الساعة؛ أُعيد تدويره قبل المقارنة.", "رسم شما {}° ساعتگرد چرخیده است؛ پیش از مقایسه بازگردانده شد."],
    ["Your drawing lies turned by {}° counter-clockwise; it was turned back before it was compared.", "رسمك مدوّر بزاوية {}° بعكس عقارب الساعة؛ أُعيد تدويره قبل المقارنة.", "رسم شما {}° پادساعتگرد چرخیده است؛ پیش از مقایسه بازگردانده شد."],
    ["Your skeleton is {} times larger than at the sheet's scale; it was compared at its own.", "مخططك الحركي أكبر {} مرة مما هو بمقياس الورقة؛ قورن بمقياسه.", "دیاگرام سینماتیکی شما {} برابر بزرگ‌تر از مقیاس برگه است؛ با مقیاس خودش مقایسه شد."],
    ["Your skeleton is {} times smaller than at the sheet's scale; it was compared at its own.", "مخططك الحركي أصغر {} مرة مما هو بمقياس الورقة؛ قورن بمقياسه.", "دیاگرام سینماتیکی شما {} برابر کوچک‌تر از مقیاس برگه است؛ با مقیاس خودش مقایسه شد."],
    ["No scale is stated for {}: their lengths agree at {} {} per mm, and were compared at that.", "لم يُذكر مقياس من أجل {}: أطوالها متفقة عند {} {} لكل mm، وقورنت بذلك.", "برای {} مقیاسی نوشته نشده: طول‌های آن‌ها با {} {} بر mm می‌خواند و با همان مقایسه شد."],
    ["No scale is stated for {}: their lengths were compared at the sheet's {} {} per mm.", "لم يُذكر مقياس من أجل {}: قورنت أطوالها بمقياس الورقة {} {} لكل mm.", "برای {} مقیاسی نوشته نشده: طول‌های آن‌ها با مقیاس برگه {} {} بر mm مقایسه شد."],
    ["The tolerance that these answers state does not count: the examiner sets it.", "التفاوت الذي تذكره هذه الإجابات لا يُعتد به: يحدده الممتحن.", "رواداری‌ای که این پاسخ‌ها می‌گویند به شمار نمی‌آید: آن را آزمونگر تعیین می‌کند."],
    ["These are the answers of variant {}: the number of the variant is wrong, or they are not the student's own. Nothing follows from them.", "هذه إجابات النموذج {}: رقم النموذج خطأ، أو ليست إجابات الطالب نفسه. ولا ينتج منها شيء.", "این‌ها پاسخ‌های برگهٔ {} است: یا شمارهٔ برگه نادرست است یا پاسخ‌ها از خود دانشجو نیست. چیزی از آن‌ها نتیجه نمی‌شود."],
    ["the answers of variant {}", "إجابات النموذج {}", "پاسخ‌های برگهٔ {}"],
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Every sentence has as many blanks in each language, and stands in the table once.
    #[test]
    fn every_sentence_has_the_same_blanks_in_every_language() {
        let blanks = |text: &str| text.matches("{}").count();
        for (place, row) in PHRASES.iter().enumerate() {
            assert!(row.iter().all(|text| blanks(text) == blanks(row[0])), "{row:?}");
            assert!(PHRASES[..place].iter().all(|other| other[0] != row[0]), "{row:?}");
        }
    }

    #[test]
    fn parts_are_told_in_the_same_language() {
        let phrase = say!("V of {} over {}", "A", say!("the distance of {}", "B"));
        assert_eq!(&*phrase, "V of A over the distance of B");
        assert_eq!(phrase.told(Language::Persian), "V نقطهٔ A بخش بر فاصلهٔ B");
        assert_eq!(say!("the accelerations").told(Language::ArabicAjala), "العجلات");
    }
}
