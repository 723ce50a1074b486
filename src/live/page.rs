//! The page: one file of hypertext with the finished sheet, the diagrams that move, and the script that moves them.

use serde_json::{Value, json};

use super::diagrams::{Diagrams, Panel, Shows};
use super::{Live, LiveError, hash, words};
use crate::graphical::construction::Reading;
use crate::markup::escaped;
use crate::mechanism::LinkId;
use crate::mechanism::quantity::{Answer, Nature, Quantity, Unit};
use crate::plan::Extent;
use crate::render::{number::decimal, svg};
use crate::scene::Scene;
use crate::sheet::figure::{Figure, Group, Node};
use crate::sheet::font::ARABIC_FAMILIES;
use crate::sheet::moving::{self, Draughts, Lengths, Said};
use crate::sheet::{Language, Part, prompt};
use crate::solve::{Solved, solve};
use crate::sweep::{InputKind, Sweep};

/// The scripts, in the order in which they are joined.
const SCRIPTS: [&str; 25] = [
    include_str!("page/libm.js"),
    include_str!("page/program.js"),
    include_str!("page/numbers.js"),
    include_str!("page/course.js"),
    ENTRY,
    TEXT,
    include_str!("page/ink.js"),
    include_str!("page/values.js"),
    include_str!("page/trace.js"),
    include_str!("page/drag.js"),
    SAVE,
    include_str!("page/page.js"),
    include_str!("page/diagrams.js"),
    include_str!("page/playing.js"),
    include_str!("page/travel.js"),
    include_str!("page/hand.js"),
    include_str!("page/light.js"),
    include_str!("page/table.js"),
    include_str!("page/steps.js"),
    include_str!("page/place.js"),
    include_str!("page/curves.js"),
    include_str!("page/choices.js"),
    include_str!("page/out.js"),
    include_str!("page/keys.js"),
    include_str!("page/app.js"),
];
/// What a drawing needs besides in which something is found by trial.
const TRIAL: &str = include_str!("page/trial.js");
/// What it needs over whose skeleton centres or constructions are drawn.
const LAYERS: &str = include_str!("page/layers.js");
const STYLE: &str = include_str!("page/page.css");
const ENTRY: &str = include_str!("page/entry.js");
const TEXT: &str = include_str!("page/text.js");
const SAVE: &str = include_str!("page/save.js");
/// Of a page that does not move.
const SWITCH: &str = include_str!("page/switch.js");
const STILL: &str = include_str!("page/still.js");
const QUESTION: &str = include_str!("page/question.js");

/// Characters that numbers may need besides those of the sheet.
const ALSO: &str = "0123456789.,;−×∠°()/²³·≡: mcinradsekg";

/// What a page shows besides the drawing itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// The finished sheets, one for each language; the first is shown at first.
    pub sheets: Vec<(Language, Figure)>,
    /// Seconds for the whole course when it plays.
    pub seconds: f64,
}

/// A page of a scene whose drawing moves; of one that does not, with the reason in English.
///
/// # Errors
/// [`LiveError::Number`] where a number on the way is none.
pub fn page(
    scene: &Scene,
    solved: &Solved,
    live: Result<&Live<'_>, String>,
    options: &Options,
) -> Result<(String, Option<String>), LiveError> {
    let construction = &solved.solution.construction;
    let first = options.sheets.first().map_or(Language::English, |(language, _)| *language);
    let moving = live.and_then(|live| match Diagrams::of(scene, construction, live.sweep(), first) {
        Ok(diagrams) => Ok((live, diagrams)),
        Err(why) => Err(why.to_string()),
    });
    let languages: Vec<Language> = options.sheets.iter().map(|(language, _)| *language).collect();
    let still = moving.as_ref().err().cloned();
    let (mut data, panels) = match &moving {
        Ok((live, diagrams)) => {
            let mut data = live.json(first);
            if let (Some(data), Value::Object(more)) = (data.as_object_mut(), diagrams.json()) {
                data.extend(more);
            }
            (data, panels(&diagrams.panels))
        }
        Err(_) => {
            (json!({ "format": super::FORMAT, "version": super::VERSION, "still": still }), String::new())
        }
    };
    let mut texts = serde_json::Map::new();
    for language in &languages {
        let draughts = Draughts::new(scene, construction, *language);
        let panels = moving.as_ref().map_or(&[][..], |(_, diagrams)| &diagrams.panels);
        let steps = moving.as_ref().ok().map(|(live, diagrams)| {
            let input = super::course::unit(scene, live.sweep()).si;
            diagrams.said(live.sweep(), input, *language)
        });
        let sweep = moving.as_ref().ok().map(|(live, _)| live.sweep());
        let steps = steps.unwrap_or_else(|| draughts.said(Lengths::Drawn).iter().map(step).collect());
        let own = text(scene, &draughts, *language, (panels, steps), sweep);
        texts.insert(language.words().tag.to_owned(), own);
    }
    data["texts"] = Value::Object(texts);
    let wished = &scene.sheet.live;
    data["seconds"] = json!(wished.play_seconds.unwrap_or(options.seconds));
    let traces = wished.traces.iter().map(|point| &scene.mechanism.point(*point).name);
    data["opens"] = json!({
        "traces": traces.collect::<Vec<_>>(), "diagrams": wished.diagrams,
        "refit": moving.as_ref().is_ok_and(|(_, diagrams)| diagrams.refit),
        "closed": moving.as_ref().map_or_else(|_| Vec::new(), |(_, diagrams)| diagrams.closed(&wished.panels)),
    });
    if let Ok((live, _)) = &moving {
        let quantities = quantities(scene, live);
        data["rows"] = json!(rows(live, scene, &construction.answers, &quantities));
        data["quantities"] = quantities.into();
    }
    let script = match &moving {
        Err(_) => joined(&[SWITCH, TEXT, STILL]),
        Ok((live, diagrams)) => {
            let besides = [(live.sweep().tries(), TRIAL), (diagrams.has_layers(), LAYERS)];
            let besides = besides.iter().filter(|(needed, _)| *needed).map(|(_, script)| *script);
            joined(&besides.fold(SCRIPTS.to_vec(), with))
        }
    };
    Ok((document(scene, options, &panels, &script, Some(&data), still.as_deref()), still))
}

/// What is said of a step of a page that does not move.
fn step(said: &Said) -> Value {
    let sentences: Vec<&str> = said.sentences.iter().map(|sentence| sentence.text.as_str()).collect();
    json!({ "step": said.step, "head": said.head, "equations": said.equations, "sentences": sentences })
}

/// A figure whose ink tells in which step it was drawn.
fn stepped(figure: &Figure) -> Figure {
    fn tell(group: &mut Group) {
        if let Some(life) = group.life {
            group.data.push(("step", life.born.step.to_string()));
        }
        for node in &mut group.children {
            if let Node::Group(own) = node {
                tell(own);
            }
        }
    }
    let mut figure = figure.clone();
    tell(&mut figure.root);
    figure
}

/// The page of a question: what the question sheet shows, and fields for the answers. Nothing of the solution is in it.
#[must_use]
pub fn question(scene: &Scene, options: &Options) -> String {
    let languages: Vec<Language> = options.sheets.iter().map(|(language, _)| *language).collect();
    let said = |of: &dyn Fn(&words::Words) -> &'static str| {
        in_each(&languages, |language| escaped(of(words::of(language))))
    };
    let mut fields = format!("<form id=\"answers\"><h2>{}</h2>", said(&|own| own.answer));
    for (index, asked) in scene.mechanism.asked.iter().enumerate() {
        fields.push_str("<fieldset>");
        for part in parts(asked.quantity) {
            let unit = match part {
                Part::Direction => "°".to_owned(),
                _ => moving::unit(&asked.unit.symbol),
            };
            let id = format!("a{index}-{}", part.name());
            fields.push_str(&format!(
                "<p><label for=\"{id}\">{}</label> <input id=\"{id}\" inputmode=\"decimal\" autocomplete=\"off\" \
                 data-name=\"{}\" data-part=\"{}\" data-unit=\"{}\"> <span>{}</span></p>",
                in_each(&languages, |language| prompt(scene, asked, *part, language)),
                escaped(&asked.name),
                part.name(),
                escaped(&asked.unit.symbol),
                escaped(&unit),
            ));
        }
        fields.push_str("</fieldset>");
    }
    fields.push_str(&format!(
        "<p><button id=\"save\" type=\"submit\">{}</button> <span id=\"told\" role=\"status\">\
         <span class=\"bad\" hidden>{}</span><span class=\"denied\" hidden>{}</span>\
         <span class=\"good\" hidden>✓</span></span></p>\
         <textarea id=\"out\" hidden readonly rows=\"8\" aria-labelledby=\"told\"></textarea></form>",
        said(&|own| own.save_answers),
        said(&|own| own.not_read),
        said(&|own| own.denied),
    ));
    let script = joined(&[SWITCH, ENTRY, SAVE, QUESTION]);
    document(scene, options, &fields, &script, None, None)
}

/// The question for a window that is narrower than its paper; none where the scene cannot be drawn to another scale.
fn strip(scene: &Scene, language: Language) -> Option<Figure> {
    /// On a narrower one letters are as large as those of the page, mm.
    const NARROW: f64 = 118.0;
    let on = |paper: &str| {
        let mut small = scene.clone();
        small.sheet.paper = Some(paper.to_owned());
        let solved = solve(&small, Extent::WholeSkeleton, crate::sheet::scale::for_scene).ok()?;
        Some(crate::sheet::question_strip(&small, &solved.solution.construction, language))
    };
    let usual = on("A5")?;
    if usual.width <= NARROW {
        return Some(usual);
    }
    Some(on("A6").filter(|small| small.width < usual.width).unwrap_or(usual))
}

/// The same in every language of the page; the first is shown at first.
fn in_each(languages: &[Language], of: impl Fn(Language) -> String) -> String {
    let one = |(index, language): (usize, &Language)| {
        let hidden = if index == 0 { "" } else { " hidden" };
        format!("<span lang=\"{}\"{hidden}>{}</span>", language.words().tag, of(*language))
    };
    languages.iter().enumerate().map(one).collect()
}

/// Of a page that does not move and has several languages: which one is shown.
fn switch(languages: &[Language]) -> String {
    let [first, _, ..] = languages else { return String::new() };
    let option = |language: &Language| {
        let (tag, name) = (language.words().tag, words::of(*language).own_name);
        let direction = if language.words().right_to_left { "rtl" } else { "ltr" };
        format!("<option value=\"{tag}\" lang=\"{tag}\" dir=\"{direction}\">{name}</option>")
    };
    let options: String = languages.iter().map(option).collect();
    format!(
        "<p><select id=\"language\" aria-label=\"{}\" hidden>{options}</select></p>",
        escaped(words::of(*first).language)
    )
}

/// The numbers that an answer has.
fn parts(quantity: Quantity) -> &'static [Part] {
    match kind(quantity) {
        "place" => &[Part::X, Part::Y],
        "vector" => &[Part::Magnitude, Part::Direction],
        _ => &[Part::Value],
    }
}

/// How the value of a quantity is told.
fn kind(quantity: Quantity) -> &'static str {
    match quantity.nature() {
        Nature::Vector => "vector",
        Nature::Place => "place",
        Nature::Rotation => "rotation",
        Nature::Signed | Nature::Size => "number",
    }
}

/// How a quantity is told that has these outputs: what else is called a vector may have but one.
fn told(quantity: Quantity, outputs: &[usize], unit: &Unit) -> Value {
    let kind = match kind(quantity) {
        "vector" if outputs.len() == 1 => "number",
        kind => kind,
    };
    let mut told =
        json!({ "kind": kind, "outputs": outputs, "unit": moving::unit(&unit.symbol), "si": unit.si });
    // A sweep has the size and the direction of a force in columns of their own.
    if matches!(quantity, Quantity::Force(..)) && outputs.len() == 2 {
        told["sized"] = true.into();
    }
    told
}

/// Scripts with one more, before the last, which begins.
fn with<'s>(mut scripts: Vec<&'s str>, one: &'s str) -> Vec<&'s str> {
    scripts.insert(scripts.len() - 1, one);
    scripts
}

/// The scripts as one, in a scope of its own, without their comments and the blanks that only people need.
fn joined(scripts: &[&str]) -> String {
    let all: String = scripts.iter().map(|script| bare(script)).collect();
    format!("(() => {{\n'use strict';\n{all}}})();\n")
}

/// A script without lines of comment, notes of types and indentation. No text of a script holds what opens a note.
fn bare(script: &str) -> String {
    let mut out = String::with_capacity(script.len());
    let mut rest = script;
    while let Some((before, after)) = rest.split_once("/**") {
        out.push_str(before);
        rest = after.split_once("*/").map_or("", |(_, rest)| rest.trim_start_matches(' '));
    }
    out.push_str(rest);
    let lines = out.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with("//"));
    // Where a line ends in what goes on, or ends a block, its end says nothing; nor does it where the next one goes on, or the end of
    // the last statement of a block.
    let goes_on = |line: &str| line == "}" || line.ends_with([';', '{', ',', '(']);
    lines.fold(String::new(), |mut all, line| {
        let says_nothing =
            |end: char| end == '\n' && line.starts_with('.') || end == ';' && line.starts_with('}');
        if all.ends_with(says_nothing) {
            all.pop();
        }
        all + &tight(line) + if goes_on(line) { "" } else { "\n" }
    })
}

/// A line of a script without the blanks beside its signs. Texts stay as they are, and lines with a pattern, whose strokes have no
/// blanks beside them as those of a division have, or with one template in another. Signs of sums do not run together.
fn tight(line: &str) -> String {
    const SIGNS: &str = ",=(){}[]:?&|;<>*!";
    if line.replace(" / ", "").contains('/') || line.matches('`').count() > 2 {
        return line.to_owned();
    }
    let mut out = String::with_capacity(line.len());
    let mut quote: Option<char> = None;
    let mut rest = line.chars().peekable();
    while let Some(c) = rest.next() {
        let beside = [out.chars().next_back(), rest.peek().copied()];
        if c == ' ' && quote.is_none() {
            let of_sum = |sign: char| matches!(sign, '+' | '-');
            let runs_together = beside.into_iter().all(|sign| sign.is_some_and(of_sum));
            let is_sign = |sign: char| SIGNS.contains(sign) || of_sum(sign) && !runs_together;
            if beside.into_iter().flatten().any(is_sign) {
                continue;
            }
        }
        // Before the end of a block the end of a statement says nothing.
        if c == '}' && quote.is_none() && out.ends_with(';') {
            out.pop();
        }
        out.push(c);
        match quote {
            // An escaped sign is none.
            Some(_) if c == '\\' => out.extend(rest.next()),
            Some(open) if c == open => quote = None,
            None if matches!(c, '\'' | '"' | '`') => quote = Some(c),
            _ => {}
        }
    }
    out
}

/// A drawing in fewer bytes: the commonest size of type is said once, and a run says its height only where that changes.
fn lean(svg: &str) -> String {
    // The size that most texts have is said once.
    let sizes =
        svg.split(" font-size=\"").skip(1).filter_map(|rest| rest.split_once('"')).map(|(own, _)| own);
    let mut times: std::collections::BTreeMap<&str, usize> = std::collections::BTreeMap::new();
    sizes.for_each(|own| *times.entry(own).or_default() += 1);
    let most = times.into_iter().max_by_key(|(_, times)| *times).map_or("3.5", |(own, _)| own);
    let size = format!(" font-size=\"{most}\"");
    let mut out = String::with_capacity(svg.len());
    let mut height: Option<&str> = None;
    for (index, piece) in svg.split("<tspan ").enumerate() {
        if index == 0 {
            out.push_str(&piece.replacen("<svg ", &format!("<svg{size} "), 1));
            continue;
        }
        let (attributes, text) = piece.split_once('>').unwrap_or((piece, ""));
        let own =
            attributes.split_once(" y=\"").and_then(|(_, rest)| rest.split_once('"')).map(|(own, _)| own);
        let mut kept = attributes.replace(&size, "");
        if let (Some(own), true) = (own, own == height) {
            kept = kept.replacen(&format!(" y=\"{own}\""), "", 1);
        }
        height = own.filter(|_| !text.contains("</text>"));
        out.push_str("<tspan ");
        out.push_str(&kept);
        out.push('>');
        out.push_str(text);
    }
    // The face of Arabic script has its class in the style of the page.
    let family = format!(" font-family=\"{ARABIC_FAMILIES}\"");
    let out = out.replace(&family, &format!(" class=\"{}\"", svg::ARABIC_CLASS));
    let out = hatched_at_once(&alone(&out.replace(">\n<", "><")));
    let out = out.replace("#000000", "#000").replace("#ffffff", "#fff");
    // Said once in the style of the page.
    let out = out.replace(" fill=\"none\" stroke=\"#000\"", "");
    let styled = |class: &str| STYLED.iter().any(|known| class.split(' ').any(|own| own == *known));
    let out = without(&out, &|name, value| {
        (name.starts_with("data-") && name != "data-step") || (name == "class" && !styled(value))
    });
    out.replace("<g/>", "")
}

/// Texts of one run, without an element for that.
fn alone(markup: &str) -> String {
    let mut out = String::with_capacity(markup.len());
    for (index, piece) in markup.split("<text").enumerate() {
        if index > 0 {
            out.push_str("<text");
        }
        let run = piece.split_once("><tspan ").and_then(|(own, rest)| {
            let (attributes, rest) = rest.split_once('>')?;
            let (text, after) = rest.split_once("</tspan></text>")?;
            let is_one = index > 0 && !own.contains('>') && !text.contains('<');
            is_one.then(|| format!("{own} {attributes}>{text}</text>{after}"))
        });
        out.push_str(run.as_deref().unwrap_or(piece));
    }
    out
}

/// Strokes of a hatch that follow each other and are drawn alike, as one path.
fn hatched_at_once(markup: &str) -> String {
    const OPEN: &str = "<path class=\"hatch\" d=\"";
    let mut out = String::with_capacity(markup.len());
    let mut last: Option<&str> = None;
    for (index, piece) in markup.split(OPEN).enumerate() {
        let parts = piece.split_once('"').and_then(|(d, rest)| rest.split_once("/>").map(|r| (d, r.0, r.1)));
        let (Some((d, pen, after)), true) = (parts, index > 0) else {
            out.push_str(piece);
            continue;
        };
        let close = last.filter(|known| *known == pen).map(|known| known.len() + "\"/>".len());
        match close {
            Some(close) => {
                out.truncate(out.len() - close);
                out.push(' ');
            }
            None => out.push_str(OPEN),
        }
        out.push_str(d);
        out.push('"');
        out.push_str(pen);
        out.push_str("/>");
        out.push_str(after);
        last = after.is_empty().then_some(pen);
    }
    out
}

/// Classes of a sheet that the style of the page names.
const STYLED: [&str; 3] = ["velocity", "acceleration", svg::ARABIC_CLASS];

/// Markup without some of its attributes, which are told by name and value.
fn without(markup: &str, is_left_out: &dyn Fn(&str, &str) -> bool) -> String {
    let mut out = String::with_capacity(markup.len());
    let mut is_tag = false;
    for piece in markup.split_inclusive(['<', '>']) {
        if !is_tag {
            out.push_str(piece);
            is_tag = piece.ends_with('<');
            continue;
        }
        is_tag = false;
        let mut rest = piece;
        while let Some((before, after)) = rest.split_once(' ') {
            out.push_str(before);
            let attribute = after.split_once("=\"").and_then(|(name, value)| {
                let (value, rest) = value.split_once('"')?;
                Some((name, value, rest))
            });
            let Some((name, value, after)) = attribute else {
                out.push(' ');
                rest = after;
                continue;
            };
            if !is_left_out(name, value) {
                out.push_str(&format!(" {name}=\"{value}\""));
            }
            rest = after;
        }
        out.push_str(rest);
    }
    out
}

/// What texts are full of: in the data of a page each is one character of those that nobody else uses.
const TAGS: [(char, &str); 6] = [
    ('\u{e000}', "<i>"),
    ('\u{e001}', "</i>"),
    ('\u{e002}', "<sub>"),
    ('\u{e003}', "</sub>"),
    ('\u{e004}', "<sup>"),
    ('\u{e005}', "</sup>"),
];

/// JSON as it may stand inside a script element.
fn embedded(data: &Value) -> String {
    let mut text = data.to_string();
    for (short, tag) in TAGS {
        // Who uses it all the same keeps it.
        text = text.replace(short, &format!("\\u{:04x}", u32::from(short))).replace(tag, &short.to_string());
    }
    text.replace('<', "\\u003c").replace('\u{2028}', "\\u2028").replace('\u{2029}', "\\u2029")
}

fn panels(all: &[Panel]) -> String {
    let mut out = String::new();
    for (index, panel) in all.iter().enumerate() {
        let shown = panel.shown;
        let n = |x: f64| decimal(x, 3);
        let over = if panel.over.is_empty() { "" } else { " over" };
        out.push_str(&format!(
            "<figure class=\"panel{over}\" id=\"figure{index}\"><svg id=\"panel{index}\" role=\"img\" \
             aria-labelledby=\"title{index}\" aria-describedby=\"state{index}\" xmlns=\"http://www.w3.org/2000/svg\" \
             viewBox=\"{} {} {} {}\" width=\"{}mm\" height=\"{}mm\" font-family=\"{}\" stroke-linejoin=\"round\">{}</svg>\
             <figcaption dir=\"auto\"><span id=\"title{index}\">{}</span> <bdi id=\"scale{index}\" dir=\"auto\">{}</bdi>\
             <span id=\"beyond{index}\"></span><span id=\"state{index}\" class=\"unseen\"></span></figcaption>\
             </figure>",
            n(shown.x0),
            n(shown.y0),
            n(shown.width()),
            n(shown.height()),
            n(shown.width()),
            n(shown.height()),
            escaped(crate::sheet::font::FAMILIES),
            hatched_at_once(&svg::fragment(&panel.ink).replace(">\n<", "><")),
            panel.title,
            panel.scale_text,
        ));
    }
    out
}

fn document(
    scene: &Scene,
    options: &Options,
    panels: &str,
    script: &str,
    data: Option<&Value>,
    still: Option<&str>,
) -> String {
    let language = options.sheets.first().map_or(Language::English, |(language, _)| *language);
    let (tag, own) = (language.words().tag, words::of(language));
    let is_moving = data.is_some() && still.is_none();
    // What moves tells itself in every language; the finished sheet is there once.
    let shown = if is_moving { 1 } else { options.sheets.len() };
    let set: Vec<&Figure> = options.sheets.iter().take(shown).map(|(_, sheet)| sheet).collect();
    let faces = svg::faces(&set, ALSO);
    let style = format!("{faces}\n{STYLE}");
    let policy = format!(
        "default-src 'none'; script-src {}; style-src {}; font-src data:; img-src data: blob:; base-uri 'none'; \
         form-action 'none'",
        hash::source(script),
        hash::source(&style),
    );
    let languages: Vec<Language> = options.sheets.iter().map(|(language, _)| *language).collect();
    let title = escaped(scene.title.in_language(tag).unwrap_or(language.words().untitled));
    let titled = |language: Language| {
        let words = language.words();
        escaped(scene.title.in_language(words.tag).unwrap_or(words.untitled)).to_string()
    };
    let heading = if is_moving { title.to_string() } else { in_each(&languages, titled) };
    let choice = if is_moving { String::new() } else { switch(&languages) };
    let direction = if language.words().right_to_left { "rtl" } else { "ltr" };
    let sheets: String = options
        .sheets
        .iter()
        .take(shown)
        .enumerate()
        .map(|(index, (language, figure))| {
            let hidden = if index == 0 { "" } else { " hidden" };
            let tag = language.words().tag;
            let strip = if data.is_none() { strip(scene, *language) } else { None };
            let wide = if strip.is_some() { " wide-only" } else { "" };
            let strip = strip.map_or(String::new(), |strip| {
                let ink = lean(&svg::write(&strip));
                format!("<div class=\"sheet narrow-only\" lang=\"{tag}\" dir=\"ltr\"{hidden}>{ink}</div>")
            });
            // On its own, so that it never interferes with what moves.
            format!(
                "{strip}<div class=\"sheet{wide}\" lang=\"{tag}\" dir=\"ltr\"{hidden}>{}</div>",
                match still {
                    Some(_) => lean(&svg::write(&stepped(figure))),
                    None => lean(&svg::write(figure)),
                }
            )
        })
        .collect();
    let still_text = still.map_or(String::new(), |why| {
        let said = in_each(&languages, |language| {
            // Reasons are told in English only: in a line that runs the other way they keep their own direction.
            let why = format!("<bdi lang=\"en\" dir=\"ltr\">{}</bdi>", escaped(why));
            escaped(words::of(language).still).replace("{why}", &why)
        });
        format!("<p class=\"still\" id=\"still\">{said}</p>")
    });
    let data = data.map_or(String::new(), |data| {
        format!("<script type=\"application/json\" id=\"linkgram-live\">{}</script>\n", embedded(data))
    });
    let stage = if data.is_empty() {
        format!(
            "<details id=\"sheet\" open><summary>{}</summary>{sheets}</details>{panels}",
            in_each(&languages, |language| escaped(words::of(language).question_sheet))
        )
    } else {
        format!(
            "<div id=\"live\" hidden><div id=\"stage\" dir=\"ltr\">{panels}</div><div id=\"controls\"></div></div>\
             <details id=\"sheet\" open><summary>{}</summary>{sheets}</details>",
            escaped(own.sheet)
        )
    };
    format!(
        "<!DOCTYPE html>\n<html lang=\"{tag}\" dir=\"{direction}\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"referrer\" content=\"no-referrer\">\n<meta name=\"color-scheme\" content=\"light dark\">\n\
         <title>{title}</title>\n<style>{style}</style>\n</head>\n<body>\n<main>\n<h1 id=\"title\">{heading}</h1>{choice}\n\
         <noscript><p class=\"still\">{}</p></noscript>{still_text}\n{stage}\n</main>\n{data}<script>{script}</script>\n\
         </body>\n</html>\n",
        escaped(own.no_script),
    )
}

fn text(
    scene: &Scene,
    draughts: &Draughts<'_>,
    language: Language,
    (panels, steps): (&[Panel], Vec<Value>),
    sweep: Option<&Sweep>,
) -> Value {
    // What is varied has the symbol of the sheet.
    let input = sweep.and_then(|sweep| match sweep.input {
        InputKind::Angle(link) => Some(draughts.symbol(Quantity::Angle(link))),
        InputKind::Time => Some("<i>t</i>".to_owned()),
        InputKind::Slide(_) => None,
    });
    let tag = language.words().tag;
    let layers = draughts.layers();
    let titles: Vec<String> = panels
        .iter()
        .map(|panel| match panel.shows {
            Shows::Diagram => escaped(&draughts.title(panel.kind)),
            Shows::Layer(index) => layers.get(index).map_or_else(String::new, |layer| layer.title.clone()),
            Shows::Circle => draughts.circle().map_or_else(String::new, |(_, title)| escaped(&title)),
        })
        .collect();
    let scales: Vec<String> = panels
        .iter()
        .map(|panel| match panel.shows {
            Shows::Circle => String::new(),
            Shows::Layer(_) => isolated(&draughts.scales(panel.si_per_mm, &panel.over), language),
            Shows::Diagram => isolated(&draughts.scale(panel.kind.dimension(), panel.si_per_mm), language),
        })
        .collect();
    let mut symbols = serde_json::Map::new();
    for asked in &scene.mechanism.asked {
        symbols.insert(asked.name.clone(), draughts.symbol(asked.quantity).into());
    }
    let arrows: Vec<&str> = panels.iter().flat_map(Panel::arrows).collect();
    for column in sweep.iter().flat_map(|sweep| &sweep.columns) {
        let name = draughts.quantity_name(column.asked.quantity);
        if arrows.contains(&name.as_str()) {
            symbols.entry(name).or_insert_with(|| draughts.symbol(column.asked.quantity).into());
        }
    }
    // Terms of equations that are written otherwise than the quantity by itself.
    let mut terms = serde_json::Map::new();
    let turning = scene.mechanism.moving().flat_map(|link| [Quantity::Omega(link), Quantity::Alpha(link)]);
    let turning = turning.map(|quantity| (draughts.symbol(quantity), draughts.quantity_name(quantity)));
    for (symbol, name) in draughts.terms().into_iter().chain(turning) {
        if *symbols.entry(name.clone()).or_insert_with(|| symbol.clone().into()) != symbol {
            terms.insert(symbol, name.into());
        }
    }
    let scale = language.words().scale;
    json!({
        "title": scene.title.in_language(tag).unwrap_or(language.words().untitled),
        "rtl": language.words().right_to_left,
        "panels": titles,
        "scales": scales,
        "symbols": symbols,
        "steps": steps,
        "terms": terms,
        "senses": draughts.senses(),
        "flat": language.words().flat_crossing,
        "scale": scale,
        "input": input,
        "words": words::of(language).json(),
    })
}

/// A scale among words that are read from the right: by itself it is read from the left.
fn isolated(text: &str, language: Language) -> String {
    let words = language.words();
    let ends = words.scale.split_once("{scale}").filter(|_| words.right_to_left);
    let inner = ends.and_then(|(before, after)| text.strip_prefix(before)?.strip_suffix(after));
    match (ends, inner) {
        (Some((before, after)), Some(inner)) => format!("{before}\u{2066}{inner}\u{2069}{after}"),
        _ => text.to_owned(),
    }
}

/// The rows of the table of values: what was asked, by name where it is told as the quantity of that name is.
fn rows(
    live: &Live<'_>,
    scene: &Scene,
    answers: &[Reading],
    quantities: &serde_json::Map<String, Value>,
) -> Vec<Value> {
    let columns = &live.sweep().columns;
    let asked = &scene.mechanism.asked;
    asked
        .iter()
        .zip(answers)
        .map(|(asked, reading)| {
            let of = |axis: Option<usize>| {
                columns.iter().position(|c| c.asked.quantity == asked.quantity && c.axis == axis)
            };
            let outputs: Vec<usize> = match of(None) {
                Some(scalar) => vec![scalar],
                None => [of(Some(0)), of(Some(1))].into_iter().flatten().collect(),
            };
            let mut row = told(asked.quantity, &outputs, &asked.unit);
            let same = |known: &Value| ["outputs", "unit"].iter().all(|key| known[key] == row[key]);
            if quantities.get(&asked.name).is_some_and(same) {
                return json!(asked.name);
            }
            row["name"] = json!(asked.name);
            // What is of the whole cycle is the same in every position.
            if let (Quantity::Cycle(_), Answer::Scalar { value, .. }) = (asked.quantity, &reading.answer) {
                row["value"] = json!(value);
            }
            row
        })
        .collect()
}

/// The link by whose turning a quantity comes about.
fn link_of(scene: &Scene, quantity: Quantity) -> Option<LinkId> {
    match quantity {
        Quantity::Omega(link)
        | Quantity::Alpha(link)
        | Quantity::TurningVelocity(.., link)
        | Quantity::TurningNormal(.., link)
        | Quantity::TurningTangential(.., link) => Some(link),
        Quantity::RelativeVelocity(p, q)
        | Quantity::RelativeAcceleration(p, q)
        | Quantity::RelativeNormal(p, q)
        | Quantity::RelativeTangential(p, q) => scene.mechanism.moving().find(|link| {
            let points = &scene.mechanism.link(*link).points;
            points.contains(&p) && points.contains(&q)
        }),
        _ => None,
    }
}

/// Everything that is shown, by the name that the ink calls it.
fn quantities(scene: &Scene, live: &Live<'_>) -> serde_json::Map<String, Value> {
    let mut all = serde_json::Map::new();
    for (index, column) in live.sweep().columns.iter().enumerate() {
        if column.axis == Some(1) {
            continue;
        }
        let outputs: Vec<usize> = if column.axis.is_some() { vec![index, index + 1] } else { vec![index] };
        let mut told = told(column.asked.quantity, &outputs, &column.asked.unit);
        if let Some(link) = link_of(scene, column.asked.quantity) {
            told["link"] = json!(scene.mechanism.link(link).number);
        }
        all.entry(live.name_in_ink(column.asked.quantity)).or_insert(told);
    }
    all
}
