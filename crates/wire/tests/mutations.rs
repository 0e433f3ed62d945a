//! Seeded mutations of good messages for every decoder of the wire. None panics, and a message that was read stays the
//! same when it is written and read again.
//!
//! `LIGHTBOTS_MUTATIONS=1000000 cargo test -p lightbots-wire --release --test mutations` tries more than the usual run.
//! Bytes that break a decoder are written to `corpus`, whose files every run reads.

mod checks;
#[path = "../../exchange/tests/mutator/mod.rs"]
mod mutator;
#[path = "../../exchange/tests/numbers/mod.rs"]
mod numbers;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;

use checks::read;
use mutator::{corpus_files, keep_broken, mutant, rounds};
use numbers::Numbers;

/// Number of mutations of each message in a usual run. With more, the test takes longer.
const USUAL: usize = 2_000;

/// Longest payload after a mutation, bytes. Without a bound, doubled pieces would make it grow without end.
const LONGEST: usize = 4_096;

const GOOD: [&str; 19] = [
    "|TARGET 0.500000 -1.250000||COLOR 16753920|",
    "|UUID|",
    "|PATH 4000000007 -12500 13000 R 350000 C 270000 -12500 13000 -12500 12879 -12500 12636 L 5050370 -12500 -1000 G 12|",
    "|START 7 12345678||HOLD 1||RESUME 9223372036854775807|",
    "|STOP||STATUS||STOP 1540450000|",
    "|TIME 5 900 950|",
    "|FADE 255 77 500000|",
    "|BLINK 2000000|",
    "|SLOT 7||RELEASE 9 0 170|",
    "|LIVE 9 12 AP8HAf4HAv0H|",
    "abfe6805-3c60-4e5a-ba40-2dcf7cb5d8e8 1.3 -0.73",
    "r7 NaN NaN",
    "abfe6805 -0.73 1.0E-4 state=driving h=1.25 off=0.0034 route=12 starts=8000000 clock=450 bat=87 unknown=3",
    "r1 0 0 can=route+fade+blink+room+neighbours fw=lightbots-0.1.0 err=0.0012 blocked=0.0021@-1.5 sim=1",
    "r7 42",
    "T/LightBot/r1",
    "BotControl/a",
    "Broadcast",
    "Position",
];

fn corpus() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/corpus")
}

fn holds(bytes: &[u8]) -> bool {
    catch_unwind(AssertUnwindSafe(|| read(bytes))).unwrap_or_else(|_| {
        let file = keep_broken(&corpus(), bytes);
        panic!("a decoder breaks at {}; keep that file", file.display());
    })
}

#[test]
fn no_mutation_breaks_a_decoder() {
    let mut numbers = Numbers(1);
    let (mut were_read, mut tried) = (0, 0);
    for good in GOOD {
        holds(good.as_bytes());
        for _ in 0..rounds(USUAL) {
            let mut bytes = mutant(good.as_bytes(), 4, &mut numbers);
            bytes.truncate(LONGEST);
            tried += 1;
            were_read += usize::from(holds(&bytes));
        }
    }
    assert!(were_read * 20 > tried && were_read < tried, "{were_read} of {tried} are read");
}

#[test]
fn messages_that_broke_a_decoder_once_do_not_any_more() {
    for bytes in corpus_files(&corpus()) {
        holds(&bytes);
    }
}
