//! Each faulty robot breaks exactly the rule that its fault concerns.

use lightbots_base::Instant;
use lightbots_exam::Options;

use crate::bench::{Bench, Message, Outcome};
use crate::flaws::{Both, Flaw, Hears, Says, deaf_to, edit, on, text};

fn examined(flaw: impl Flaw + 'static) -> Outcome {
    Bench::new(1, flaw, Options::default()).run()
}

/// A flaw that replaces each received command by the result of `change`.
fn hears(mut change: impl FnMut(&str, &str) -> String + 'static) -> impl Flaw {
    Hears(move |_, message: Message, _: &mut Vec<Message>| vec![edit(message, &mut change)])
}

fn numbers(command: &str) -> Vec<f64> {
    command.split_ascii_whitespace().skip(1).filter_map(|field| field.parse().ok()).collect()
}

#[test]
fn reports_in_centimetres() {
    let says = |message: Message| {
        let text = text(&message);
        let mut fields: Vec<String> = text.split(' ').map(str::to_owned).collect();
        if fields.len() >= 3 {
            for field in &mut fields[1..3] {
                *field = field.parse::<f64>().map_or(field.clone(), |metres| format!("{:?}", metres * 100.0));
            }
        }
        vec![(message.0, fields.join(" ").into_bytes())]
    };
    examined(Says(says)).assert_broken(&[9]);
}

#[test]
fn reads_targets_in_centimetres() {
    let flaw = hears(|word, command| match (word, numbers(command).as_slice()) {
        ("TARGET", [x, y]) => format!("TARGET {} {}", x / 100.0, y / 100.0),
        _ => command.to_owned(),
    });
    examined(flaw).assert_broken(&[17]);
}

#[test]
fn reads_no_decimal_comma() {
    let flaw = hears(|word, command| {
        let comma = word == "TARGET" && command.contains(',');
        if comma { String::new() } else { command.to_owned() }
    });
    examined(flaw).assert_broken(&[8]);
}

#[test]
fn writes_a_decimal_comma() {
    let says = |message: Message| {
        let comma = text(&message).replace('.', ",");
        let payload = if on(&message, "UUID") { comma.into_bytes() } else { message.1 };
        vec![(message.0, payload)]
    };
    examined(Says(says)).assert_broken(&[9, 10]);
}

#[test]
fn answers_on_the_wrong_topic() {
    let says = |message: Message| {
        let topic = if on(&message, "UUID") { "T/LightBot/Status".to_owned() } else { message.0 };
        vec![(topic, message.1)]
    };
    examined(Says(says)).assert_broken(&[13]);
}

#[test]
fn answers_twice() {
    let says = |message: Message| vec![message.clone(); if on(&message, "UUID") { 2 } else { 1 }];
    examined(Says(says)).assert_broken(&[13]);
}

#[test]
fn does_not_listen_to_broadcasts() {
    let flaw = Hears(|_, message: Message, _: &mut Vec<Message>| {
        if on(&message, "Broadcast") && text(&message).contains("UUID") { Vec::new() } else { vec![message] }
    });
    examined(flaw).assert_broken(&[5]);
}

#[test]
fn obeys_what_is_said_to_others() {
    let mut own = None;
    let flaw = Hears(move |_, message: Message, _: &mut Vec<Message>| {
        if on(&message, "Broadcast") {
            return vec![message];
        }
        let own = own.get_or_insert_with(|| message.0.clone());
        vec![(own.clone(), message.1)]
    });
    examined(flaw).assert_broken(&[5]);
}

#[test]
fn takes_words_in_small_letters() {
    examined(hears(|_, command| command.replace("uuid", "UUID"))).assert_broken(&[6]);
}

#[test]
fn obeys_nothing_of_a_payload_with_an_unknown_command() {
    let flaw = Hears(
        |_, message: Message, _: &mut Vec<Message>| {
            if text(&message).contains("JUMP") { Vec::new() } else { vec![message] }
        },
    );
    examined(flaw).assert_broken(&[7]);
}

#[test]
fn never_arrives() {
    let says = |message: Message| {
        if on(&message, "Arrival") && !text(&message).contains(" route=") {
            Vec::new()
        } else {
            vec![message]
        }
    };
    examined(Says(says)).assert_broken(&[18]);
}

#[test]
fn arrives_twice() {
    let says = |message: Message| vec![message.clone(); if on(&message, "Arrival") { 2 } else { 1 }];
    examined(Says(says)).assert_broken(&[18, 36]);
}

#[test]
fn arrives_too_early() {
    struct Early(String);
    impl Flaw for Early {
        fn hear(&mut self, _: Instant, message: Message, says: &mut Vec<Message>) -> Vec<Message> {
            if text(&message).starts_with("|TARGET ") && !text(&message).contains("NaN") {
                says.push(("T/LightBot/Arrival".to_owned(), self.0.clone().into_bytes()));
            }
            vec![message]
        }

        fn say(&mut self, message: Message) -> Vec<Message> {
            let text = text(&message);
            self.0 = text.split(' ').take(3).collect::<Vec<_>>().join(" ");
            let of_a_target = on(&message, "Arrival") && !text.contains(" route=");
            if of_a_target { Vec::new() } else { vec![message] }
        }
    }
    examined(Early(String::new())).assert_broken(&[17]);
}

#[test]
fn finishes_a_target_before_the_next() {
    let mut busy = false;
    let mut waiting: Option<String> = None;
    let mut arrived = false;
    let shared = std::rc::Rc::new(std::cell::Cell::new(false));
    let ends = shared.clone();
    let hear = move |message: Message| {
        arrived |= shared.replace(false);
        busy &= !arrived;
        let mut released = Vec::new();
        if arrived && let Some(command) = waiting.take() {
            released.push((message.0.clone(), format!("|{command}|").into_bytes()));
            busy = true;
        }
        arrived = false;
        let edited = edit(message, |word, command| {
            busy &= word != "STOP";
            let goal = numbers(command);
            if word != "TARGET" || goal.len() != 2 || goal.iter().any(|number| number.is_nan()) {
                return command.to_owned();
            }
            if busy {
                waiting = Some(command.to_owned());
                return String::new();
            }
            busy = true;
            command.to_owned()
        });
        released.push(edited);
        released
    };
    let say = move |message: Message| {
        ends.set(ends.get() || on(&message, "Arrival"));
        vec![message]
    };
    examined(Both(hear, say)).assert_broken(&[16]);
}

#[test]
fn drives_too_fast() {
    let outcome = Bench::new(1, crate::flaws::Right, Options::default()).at_speed(0.55).run();
    outcome.assert_broken(&[20]);
}

#[test]
fn mixes_up_red_and_blue() {
    let flaw = hears(|word, command| match (word, numbers(command).as_slice()) {
        ("COLOR", [n]) if *n < 16_777_216.0 => {
            let n = *n as u32;
            format!("COLOR {}", (n & 0xff) << 16 | n & 0xff00 | n >> 16)
        }
        _ => command.to_owned(),
    });
    examined(flaw).assert_broken(&[21]);
}

#[test]
fn shows_fades_at_once() {
    let flaw = hears(|word, command| match (word, numbers(command).as_slice()) {
        ("FADE", [n, ..]) => format!("COLOR {n}"),
        _ => command.to_owned(),
    });
    examined(flaw).assert_broken(&[22, 23]);
}

#[test]
fn forgets_its_name() {
    let mut messages = 0;
    let shared = std::rc::Rc::new(std::cell::Cell::new(0));
    let count = shared.clone();
    let hear = move |message: Message| {
        messages += 1;
        shared.set(messages);
        let own = !on(&message, "Broadcast") && messages > 60;
        if own { Vec::new() } else { vec![message] }
    };
    let say = move |message: Message| {
        let text = text(&message);
        let renamed = text.split_once(' ').map_or(text.clone(), |(_, rest)| format!("another-name {rest}"));
        vec![(message.0, if count.get() > 60 { renamed } else { text }.into_bytes())]
    };
    examined(Both(hear, say)).assert_broken(&[15]);
}

#[test]
fn its_clock_is_off_by_a_tenth_of_a_second() {
    let flaw = hears(|word, command| {
        match (word, command.split_ascii_whitespace().collect::<Vec<_>>().as_slice()) {
            ("TIME", [_, asked, received, sent]) => {
                let early = |text: &str| text.parse::<u64>().unwrap() - 100_000;
                format!("TIME {asked} {} {}", early(received), early(sent))
            }
            _ => command.to_owned(),
        }
    });
    examined(flaw).assert_broken(&[27]);
}

#[test]
fn asks_for_the_time_in_milliseconds() {
    let says = |message: Message| {
        let text = text(&message);
        let asked = text.split(' ').nth(1).and_then(|text| text.parse::<u64>().ok());
        match asked.filter(|_| on(&message, "Time")) {
            Some(us) => {
                let name = text.split(' ').next().unwrap_or("").to_owned();
                vec![(message.0, format!("{name} {}", us / 1000).into_bytes())]
            }
            None => vec![message],
        }
    };
    examined(Says(says)).assert_broken(&[25]);
}

#[test]
fn drives_at_once_without_start() {
    let flaw = Hears(|now: Instant, message: Message, _: &mut Vec<Message>| {
        let text = text(&message);
        let seq = text.strip_prefix("|PATH ").and_then(|rest| rest.split(' ').next()).map(str::to_owned);
        let topic = message.0.clone();
        let mut heard = vec![message];
        // 1000 s is how far the exam has set the show clock by then, and the route starts 0.1 s later.
        if let Some(seq) = seq {
            heard.push((topic, format!("|START {seq} {}|", now.0 + 1_000_000_000 + 100_000).into_bytes()));
        }
        heard
    });
    examined(flaw).assert_broken(&[32]);
}

#[test]
fn does_not_take_a_later_start() {
    let mut known = String::new();
    let flaw = hears(move |word, command| {
        let seq = command.split_ascii_whitespace().nth(1).unwrap_or("").to_owned();
        if word != "START" {
            return command.to_owned();
        }
        if known == seq {
            return "STATUS".to_owned();
        }
        known = seq;
        command.to_owned()
    });
    examined(flaw).assert_broken(&[33]);
}

#[test]
fn curves_are_straight_to_it() {
    let flaw = hears(|word, command| {
        if word != "PATH" {
            return command.to_owned();
        }
        let fields: Vec<&str> = command.split_ascii_whitespace().collect();
        let mut path: Vec<String> =
            fields[..4.min(fields.len())].iter().map(|field| (*field).to_owned()).collect();
        let mut rest = &fields[4.min(fields.len())..];
        while let Some((kind, after)) = rest.split_first() {
            let count = match *kind {
                "R" => 1,
                "L" => 3,
                _ => 7,
            }
            .min(after.len());
            let (piece, next) = after.split_at(count);
            if *kind == "C" && count == 7 {
                path.extend(["L", piece[0], piece[5], piece[6]].map(str::to_owned));
            } else {
                path.push((*kind).to_owned());
                path.extend(piece.iter().map(|field| (*field).to_owned()));
            }
            rest = next;
        }
        path.join(" ")
    });
    examined(flaw).assert_broken(&[31]);
}

#[test]
fn acknowledges_no_routes() {
    let flaw = hears(|word, command| if word == "PATH" { String::new() } else { command.to_owned() });
    examined(flaw).assert_broken(&[32]);
}

#[test]
fn does_not_hold() {
    examined(deaf_to("HOLD")).assert_broken(&[38, 56]);
}

#[test]
fn does_not_resume() {
    examined(deaf_to("RESUME")).assert_broken(&[38, 56]);
}

#[test]
fn ignores_stop() {
    examined(deaf_to("STOP")).assert_broken(&[23, 40, 58]);
}

#[test]
fn takes_a_stop_for_a_moment_for_a_hold() {
    examined(hears(|word, command| match (word, numbers(command).as_slice()) {
        ("STOP", [_]) => command.replace("STOP", "HOLD"),
        _ => command.to_owned(),
    }))
    .assert_broken(&[40]);
}

/// The last slot that the exam assigns.
const SLOT: &str = "100";

#[test]
fn keeps_no_slot() {
    examined(deaf_to("SLOT")).assert_broken(&[59]);
}

#[test]
fn shows_the_first_colour_of_all_live_messages() {
    let flaw = hears(|word, command| match command.split_ascii_whitespace().collect::<Vec<_>>().as_slice() {
        [_, number, _, colours] if word == "LIVE" => format!("LIVE {number} {SLOT} {colours}"),
        _ => command.to_owned(),
    });
    examined(flaw).assert_broken(&[60]);
}

#[test]
fn shows_old_live_messages() {
    let mut newest = 0;
    let flaw = hears(move |word, command| match numbers(command).first() {
        Some(&number) if word == "LIVE" => {
            newest = newest.max(number as u32);
            command.replacen(&format!("LIVE {number}"), &format!("LIVE {newest}"), 1)
        }
        _ => command.to_owned(),
    });
    examined(flaw).assert_broken(&[60]);
}

#[test]
fn is_not_released() {
    examined(deaf_to("RELEASE")).assert_broken(&[61, 62]);
}

#[test]
fn is_released_after_each_live_message() {
    // The robot takes 0.1 s of silence for the end of live light.
    let flaw = Hears(|_, message: Message, _: &mut Vec<Message>| {
        let is_live = text(&message).starts_with("|LIVE ");
        let release = (message.0.clone(), format!("|RELEASE 4000000000 {SLOT} 1|").into_bytes());
        if is_live { vec![message, release] } else { vec![message] }
    });
    examined(flaw).assert_broken(&[60]);
}

#[test]
fn shows_a_colour_instead_of_live_light() {
    let flaw = hears(|word, command| match command.split_ascii_whitespace().nth(1) {
        Some(number) if word == "COLOR" => format!("COLOR {number}||RELEASE 4000000000 {SLOT} 1"),
        _ => command.to_owned(),
    });
    examined(flaw).assert_broken(&[62]);
}

#[test]
fn drives_on_in_silence() {
    // A robot that receives messages all the time.
    struct Chatty;
    impl Flaw for Chatty {
        fn say(&mut self, message: Message) -> Vec<Message> {
            if text(&message).contains("state=cut") { Vec::new() } else { vec![message] }
        }
    }
    examined(Chatty).assert_broken(&[43]);
}

#[test]
fn reports_seldom() {
    let mut asked = 0;
    let says = move |message: Message| {
        let driving = on(&message, "Status") && text(&message).contains("state=driving");
        asked += u32::from(driving);
        if driving && !asked.is_multiple_of(4) { Vec::new() } else { vec![message] }
    };
    examined(Says(says)).assert_broken(&[41]);
}

#[test]
fn falls_silent_at_bytes_that_are_no_text() {
    let mut dead = false;
    let flaw = Hears(move |_, message: Message, _: &mut Vec<Message>| {
        dead |= std::str::from_utf8(&message.1).is_err();
        if dead { Vec::new() } else { vec![message] }
    });
    examined(flaw).assert_broken(&[48]);
}

#[test]
fn reads_payloads_of_any_length() {
    let flaw = Hears(|_, message: Message, _: &mut Vec<Message>| {
        let text = text(&message);
        vec![(message.0, text.trim_end().as_bytes().to_vec())]
    });
    examined(flaw).assert_broken(&[4]);
}

#[test]
fn counts_its_brakes_downwards() {
    let mut left = 1000;
    let says = move |message: Message| {
        left -= 1;
        let more = format!("{} brakes={left}", text(&message));
        vec![if on(&message, "Time") { message } else { (message.0, more.into_bytes()) }]
    };
    examined(Says(says)).assert_broken(&[53]);
}

#[test]
fn says_how_near_others_came_in_millimetres() {
    let says = |message: Message| {
        let more = format!("{} near=12.5", text(&message));
        vec![if on(&message, "Time") { message } else { (message.0, more.into_bytes()) }]
    };
    examined(Says(says)).assert_broken(&[53]);
}
