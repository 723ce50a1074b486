//! `linkgram help`: the reference by topic, and the options of the commands.

use std::fmt::Write;

use clap::CommandFactory;

use super::{Arguments, Ending, Failure, print};

/// What may be looked up: a name, what it is about, and the text, which is a file of `docs/`.
const TOPICS: [(&str, &str); 10] = [
    ("scene", include_str!("../../docs/scene.md")),
    ("quantities", include_str!("../../docs/quantities.md")),
    ("forces", include_str!("../../docs/forces.md")),
    ("formats", include_str!("../../docs/formats.md")),
    ("grading", include_str!("../../docs/grading.md")),
    ("exams", include_str!("../../docs/exams.md")),
    ("sweeps", include_str!("../../docs/sweeps.md")),
    ("live", include_str!("../../docs/live.md")),
    ("golden", include_str!("../../docs/golden.md")),
    ("accuracy", include_str!("../../docs/accuracy.md")),
];

pub(super) fn run(topic: &[String]) -> Result<Ending, Failure> {
    let Some(first) = topic.first() else {
        let mut out = Arguments::command().render_help().to_string();
        let _ = writeln!(out, "\nTopics:");
        for (name, text) in TOPICS {
            let _ = writeln!(out, "  {name:<12}{}", title(text));
        }
        let _ = writeln!(
            out,
            "\n`linkgram help TOPIC` prints a topic, `linkgram help COMMAND` the options of a command."
        );
        print(&out)?;
        return Ok(Ending::Fine);
    };
    if let ([_], Some((_, text))) = (topic, TOPICS.iter().find(|(name, _)| name == first)) {
        print(text)?;
        return Ok(Ending::Fine);
    }
    let mut whole = Arguments::command();
    whole.build();
    let mut command = &mut whole;
    for name in topic {
        let found = command.find_subcommand_mut(name).filter(|found| !found.is_hide_set());
        command = match found {
            Some(found) => found,
            None => return Err(unknown(name)),
        };
    }
    print(&command.render_long_help().to_string())?;
    Ok(Ending::Fine)
}

/// What a topic is about, by its first line.
fn title(text: &str) -> &str {
    let first = text.lines().next().unwrap_or_default();
    first.split_once(": ").map_or(first, |(_, about)| about)
}

fn unknown(name: &str) -> Failure {
    let command = Arguments::command();
    let commands = command.get_subcommands().map(clap::Command::get_name);
    let known: Vec<&str> = TOPICS.iter().map(|(topic, _)| *topic).chain(commands).collect();
    let mend = crate::scene::nearest(name, &known).map_or_else(
        || "`linkgram help` lists topics and commands".to_owned(),
        |nearest| format!("did you mean {nearest}? `linkgram help` lists topics and commands"),
    );
    Failure(format!("there is no help on {name}: {mend}"))
}
