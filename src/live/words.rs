//! The words of the page's own controls, one table for each language, complete in each.

use serde_json::Value;

use crate::sheet::Language;

macro_rules! words {
    ($($key:ident),* $(,)?) => {
        /// The words of one language.
        pub(super) struct Words {
            $(pub(super) $key: &'static str,)*
        }

        impl Words {
            /// For the script of the page.
            pub(super) fn json(&self) -> Value {
                let mut all = serde_json::Map::new();
                $(all.insert(stringify!($key).to_owned(), Value::from(self.$key));)*
                Value::Object(all)
            }
        }
    };
}

words! {
    position, of_input, own_position, play, stop, step, steps, all_steps, back, on, values, quantity, value, sense,
    here, not_here, in_line, at_infinity, limit, change_point, dead_position, least, greatest, events, slower, faster,
    scale, fixed, refit, help, keys_off, theme, language, copy, save, save_table, print, link_here,
    denied, no_script, still, cw, ccw, apart, take_apart, reached_limit, sheet, traces, diagram, beyond, full, close,
    help_keys, moving_page, seconds_a_turn, copied, answer,
    page_version, at_start_only,
}

/// The words of a language.
pub(super) const fn of(language: Language) -> &'static Words {
    match language {
        Language::English => &ENGLISH,
        Language::Arabic | Language::ArabicAjala => &ARABIC,
        Language::Persian => &PERSIAN,
    }
}

const ENGLISH: Words = Words {
    position: "Position",
    of_input: "Input",
    own_position: "The scene's own position",
    play: "Play",
    stop: "Stop",
    step: "Step",
    steps: "Steps",
    all_steps: "All steps",
    back: "Back",
    on: "On",
    values: "Values",
    quantity: "Quantity",
    value: "Value",
    sense: "Sense or direction",
    here: "at this position",
    not_here: "indeterminate here",
    in_line: "links {links} in line",
    at_infinity: "at infinity",
    limit: "Limit of the input",
    change_point: "Change point",
    dead_position: "Dead position",
    least: "Least {name}",
    greatest: "Greatest {name}",
    events: "What happens on the way",
    slower: "{times} × slower than in truth",
    faster: "{times} × faster than in truth",
    scale: "Scale",
    fixed: "one for the course",
    refit: "fitted to each position",
    help: "Help",
    keys_off: "Keys",
    theme: "Light or dark",
    language: "Language",
    copy: "Copy the drawings",
    save: "Save the drawings",
    save_table: "Save the table",
    print: "Print",
    link_here: "Link to this position",
    denied: "Here a page may not save or copy. Take it from this field:",
    no_script: "This drawing moves in a browser that runs scripts: save the file and open it there.",
    still: "This drawing does not move: {why}.",
    cw: "cw",
    ccw: "ccw",
    apart: "This part of the course cannot be reached from here without taking the mechanism apart.",
    take_apart: "Take apart and assemble at {at}",
    reached_limit: "Here the input goes no further.",
    sheet: "The sheet at the scene's own position",
    traces: "Traces",
    diagram: "Diagram over the input",
    beyond: "{name} is {length} mm long and leaves the drawing",
    full: "Full window",
    close: "Close",
    help_keys: "← and →: 1°, with Shift 10°, with Alt 0.1° (of a slide 1/360 of its range). Home: the scene's own \
                position. Page Up, Page Down: what happens next. Space: play and stop. [ and ]: a step back and on. \
                S: scale. D: diagram. F: full window. ?: this help. Esc: let go. No key works while a field is being \
                filled in.",
    moving_page: "Drag a joint, or the slider. Everything is the drawing itself at that position.",
    seconds_a_turn: "Seconds for the course",
    copied: "Copied",
    answer: "Answers",
    page_version: "This page's script does not know this version of the drawing.",
    at_start_only: "Said of the scene's own position:",
};

const ARABIC: Words = Words {
    position: "الوضع",
    of_input: "الدخل",
    own_position: "الوضع المعطى",
    play: "تشغيل",
    stop: "إيقاف",
    step: "خطوة",
    steps: "الخطوات",
    all_steps: "كل الخطوات",
    back: "السابقة",
    on: "التالية",
    values: "القيم",
    quantity: "الكمية",
    value: "القيمة",
    sense: "الاتجاه",
    here: "في هذا الوضع",
    not_here: "غير محدد هنا",
    in_line: "الوصلات {links} على استقامة واحدة",
    at_infinity: "في اللانهاية",
    limit: "نهاية حركة الدخل",
    change_point: "نقطة تغيّر",
    dead_position: "وضع ميت",
    least: "أصغر قيمة: {name}",
    greatest: "أكبر قيمة: {name}",
    events: "ما يحدث خلال الحركة",
    slower: "أبطأ من الحقيقة {times} مرة",
    faster: "أسرع من الحقيقة {times} مرة",
    scale: "المقياس",
    fixed: "واحد لكل الحركة",
    refit: "ملائم لكل وضع",
    help: "مساعدة",
    keys_off: "المفاتيح",
    theme: "فاتح أو داكن",
    language: "اللغة",
    copy: "نسخ الرسوم",
    save: "حفظ الرسوم",
    save_table: "حفظ الجدول",
    print: "طباعة",
    link_here: "رابط هذا الوضع",
    denied: "لا يُسمح للصفحة هنا بالحفظ أو النسخ. خذه من هذا الحقل:",
    no_script: "يتحرك هذا الرسم في متصفح يشغّل البرامج: احفظ الملف وافتحه هناك.",
    still: "لا يتحرك هذا الرسم: {why}.",
    cw: "مع عقارب الساعة",
    ccw: "عكس عقارب الساعة",
    apart: "لا يمكن الوصول إلى هذا الجزء من هنا دون فك الآلية.",
    take_apart: "فك الآلية وتركيبها عند {at}",
    reached_limit: "لا يذهب الدخل أبعد من هنا.",
    sheet: "الورقة في الوضع المعطى",
    traces: "المسارات",
    diagram: "منحنى على الدخل",
    beyond: "طول {name} هو {length} mm ويخرج من الرسم",
    full: "ملء النافذة",
    close: "إغلاق",
    help_keys: "← و →: 1°، مع Shift 10°، مع Alt 0.1°. Home: الوضع المعطى. Page Up و Page Down: الحدث التالي. المسافة: \
                تشغيل وإيقاف. [ و ]: خطوة. S: المقياس. D: المنحنى. F: ملء النافذة. ?: المساعدة. Esc: ترك.",
    moving_page: "اسحب مفصلاً أو المنزلق. كل ما يظهر هو الرسم نفسه في ذلك الوضع.",
    seconds_a_turn: "ثوانٍ للحركة كلها",
    copied: "نُسخ",
    answer: "الإجابات",
    page_version: "لا يعرف برنامج هذه الصفحة هذا الإصدار من الرسم.",
    at_start_only: "في الوضع المعطى:",
};

const PERSIAN: Words = Words {
    position: "وضعیت",
    of_input: "ورودی",
    own_position: "وضعیت داده‌شده",
    play: "پخش",
    stop: "توقف",
    step: "گام",
    steps: "گام‌ها",
    all_steps: "همهٔ گام‌ها",
    back: "پیشین",
    on: "بعدی",
    values: "مقادیر",
    quantity: "کمیت",
    value: "مقدار",
    sense: "جهت",
    here: "در این وضعیت",
    not_here: "در اینجا نامعین",
    in_line: "لینک‌های {links} در یک راستا",
    at_infinity: "در بی‌نهایت",
    limit: "حد ورودی",
    change_point: "نقطهٔ تغییر",
    dead_position: "وضعیت مرگ",
    least: "کمترین {name}",
    greatest: "بیشترین {name}",
    events: "رویدادهای مسیر",
    slower: "{times} برابر کندتر از واقعیت",
    faster: "{times} برابر تندتر از واقعیت",
    scale: "مقیاس",
    fixed: "یکی برای همهٔ مسیر",
    refit: "متناسب با هر وضعیت",
    help: "راهنما",
    keys_off: "کلیدها",
    theme: "روشن یا تیره",
    language: "زبان",
    copy: "رونوشت از ترسیم‌ها",
    save: "ذخیرهٔ ترسیم‌ها",
    save_table: "ذخیرهٔ جدول",
    print: "چاپ",
    link_here: "پیوند به این وضعیت",
    denied: "این صفحه در اینجا اجازهٔ ذخیره یا رونوشت ندارد. از این کادر بردارید:",
    no_script: "این ترسیم در مرورگری که اسکریپت اجرا می‌کند حرکت می‌کند: پرونده را ذخیره و در آن باز کنید.",
    still: "این ترسیم حرکت نمی‌کند: {why}.",
    cw: "ساعتگرد",
    ccw: "پادساعتگرد",
    apart: "به این بخش از مسیر بدون باز کردن مکانیزم نمی‌توان رسید.",
    take_apart: "باز کردن و سوار کردن در {at}",
    reached_limit: "ورودی از اینجا فراتر نمی‌رود.",
    sheet: "برگه در وضعیت داده‌شده",
    traces: "مسیرها",
    diagram: "نمودار بر حسب ورودی",
    beyond: "طول {name} برابر {length} mm است و از ترسیم بیرون می‌رود",
    full: "تمام پنجره",
    close: "بستن",
    help_keys: "← و →: 1°، با Shift 10°، با Alt 0.1°. Home: وضعیت داده‌شده. Page Up و Page Down: رویداد بعدی. فاصله: \
                پخش و توقف. [ و ]: یک گام. S: مقیاس. D: نمودار. F: تمام پنجره. ?: راهنما. Esc: رها کردن.",
    moving_page: "یک مفصل یا لغزنده را بکشید. هر چه می‌بینید خود ترسیم در آن وضعیت است.",
    seconds_a_turn: "ثانیه برای همهٔ مسیر",
    copied: "رونوشت شد",
    answer: "پاسخ‌ها",
    page_version: "اسکریپت این صفحه این نسخه از ترسیم را نمی‌شناسد.",
    at_start_only: "در وضعیت داده‌شده:",
};
