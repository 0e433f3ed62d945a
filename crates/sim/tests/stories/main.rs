//! Whole systems in virtual time, one file per subject. All files are one test program, because linking a program with
//! everything below it takes longer than most of these tests.

mod breakdowns;
mod campaign;
mod crashes;
mod crossings;
mod crowds;
mod five_frames;
mod fleet;
mod formations;
mod gaps;
mod identities;
mod jumps;
mod light;
mod link_lost;
mod loops;
mod motions;
mod music;
mod noise;
mod originals;
mod outages;
mod pairs;
mod preflight;
mod rapier;
mod recovery;
mod rehearsals;
mod replays;
mod spares;
