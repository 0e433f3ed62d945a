//! Plays the open show's music on a sound device of this machine, without a browser. Only with the feature `sound`.
//!
//! The rule is that of the screen's player. Sound that is off by less than 3 ms is left alone. Up to 30 ms, it is
//! played at most 0.5 % faster or slower. Beyond that it jumps to the right place. It pauses while the show stands.

mod playhead;

use std::io::Cursor;
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use rodio::cpal::traits::{DeviceTrait, HostTrait, StreamTrait};
use rodio::cpal::{self, OutputCallbackInfo, Stream, StreamConfig};
use rodio::{Decoder, Source};

use super::handle::Handle;
use crate::failure::Failure;
use crate::stop::Stop;
use playhead::{LoudMusic, Playhead};

/// Time between two readings of the show's position.
const LOOK_EVERY: Duration = Duration::from_millis(100);
/// Longest time for which a reading of the show's position is used. If the program hangs, the music thus stops.
const BELIEVED: Duration = Duration::from_secs(1);
/// Length in seconds after which music is cut. Stereo music of this length at 44.1 kHz takes 400 MB of memory.
const LONGEST_S: usize = 1_200;

/// The music that is to be heard, and its position.
#[derive(Debug, Default)]
struct Wanted {
    music: Option<Arc<LoudMusic>>,
    /// Moment of the last reading, and the music's position then, seconds. `None` while the show stands, or if the reading
    /// took longer than `BELIEVED`.
    position: Option<(Instant, f64)>,
}

/// A sound device, and the music that it is to play.
#[derive(Debug)]
pub struct Loudspeaker {
    /// Ends the thread of the sound stream when dropped. Streams of some systems must stay in the thread that made
    /// them.
    _alive: Sender<()>,
    wanted: Arc<Mutex<Wanted>>,
    /// Time in seconds that is added to the show's position to get the music's position.
    offset_s: f64,
}

impl Loudspeaker {
    /// Opens the default sound device of the machine. A positive `offset_ms` makes the music earlier.
    pub fn open(offset_ms: f64) -> Result<Self, Failure> {
        let wanted = Arc::new(Mutex::new(Wanted::default()));
        let (alive, until) = channel();
        let (opened, answer) = channel();
        let heard = wanted.clone();
        std::thread::spawn(move || {
            let stream = stream(heard);
            let failure = stream.as_ref().err().cloned();
            // `open` waits for this answer. `recv` below returns when the `Loudspeaker` is dropped.
            let _ = opened.send(failure);
            let _ = until.recv();
        });
        match answer.recv() {
            Ok(None) => Ok(Self { _alive: alive, wanted, offset_s: offset_ms / 1e3 }),
            Ok(Some(failure)) => Err(failure),
            Err(_) => Err(no_sound(&"the sound system failed")),
        }
    }

    /// Plays music in step with the run until `stop` is wanted. `music_of` returns the file of the open show's music,
    /// with a key that changes with the file.
    pub async fn run(
        self,
        handle: Handle,
        stop: Stop,
        music_of: impl Fn() -> Option<(String, Arc<[u8]>)> + Send + Sync + 'static,
    ) {
        let mut loaded: Option<String> = None;
        while !stop.is_wanted() {
            tokio::select! {
                () = stop.wait() => return,
                () = tokio::time::sleep(LOOK_EVERY) => {}
            }
            let music = music_of();
            if music.as_ref().map(|(key, _)| key) != loaded.as_ref() {
                loaded = music.as_ref().map(|(key, _)| key.clone());
                let decoded = tokio::task::spawn_blocking(move || music.and_then(|(_, file)| decoded(file)));
                self.change(|wanted, music| wanted.music = music, decoded.await.ok().flatten().map(Arc::new));
            }
            let asked = Instant::now();
            let Some(snapshot) = handle.look().await else { return };
            let position =
                snapshot.run.as_ref().and_then(|run| run.position).filter(|position| position.runs);
            let late_s = (handle.clock().now() - snapshot.at).as_secs().max(0.0);
            let position =
                position.map(|position| (Instant::now(), position.show_s + late_s + self.offset_s));
            let position = position.filter(|_| asked.elapsed() < BELIEVED);
            self.change(|wanted, position| wanted.position = position, position);
        }
    }

    fn change<T>(&self, change: impl FnOnce(&mut Wanted, T), to: T) {
        change(&mut self.wanted.lock().unwrap_or_else(PoisonError::into_inner), to);
    }
}

fn no_sound(what: &dyn std::fmt::Display) -> Failure {
    Failure::problem(format!("--sound: {what}; choose a sound device in the system's settings"))
}

/// Opens a stream on the default sound device that plays what `wanted` holds.
fn stream(wanted: Arc<Mutex<Wanted>>) -> Result<Stream, Failure> {
    let device = cpal::default_host().default_output_device();
    let device = device.ok_or_else(|| no_sound(&"this machine has no sound device"))?;
    let config: StreamConfig = device.default_output_config().map_err(|error| no_sound(&error))?.into();
    let format = (usize::from(config.channels), f64::from(config.sample_rate));
    let mut playhead = Playhead::default();
    let fill = move |samples: &mut [f32], info: &OutputCallbackInfo| {
        let stamp = info.timestamp();
        let ahead = stamp.playback.duration_since(stamp.callback);
        let wanted = wanted.lock().unwrap_or_else(PoisonError::into_inner);
        let target_s = wanted.position_at(Instant::now() + ahead);
        playhead.fill(samples, format, wanted.music.as_deref(), target_s);
    };
    let complain = |error: cpal::Error| tracing::warn!("the sound device: {error}");
    let stream =
        device.build_output_stream(config, fill, complain, None).map_err(|error| no_sound(&error))?;
    stream.play().map_err(|error| no_sound(&error))?;
    Ok(stream)
}

impl Wanted {
    /// Returns the position of the music at a moment, seconds; `None` if nothing is to be heard.
    fn position_at(&self, moment: Instant) -> Option<f64> {
        let (since, at_s) = self.position?;
        let later = moment.saturating_duration_since(since);
        (later < BELIEVED).then(|| at_s + later.as_secs_f64())
    }
}

/// Decodes a music file, up to `LONGEST_S`. `None` if the format is unknown, which is logged.
fn decoded(file: Arc<[u8]>) -> Option<LoudMusic> {
    let decoder = match Decoder::try_from(Cursor::new(file)) {
        Ok(decoder) => decoder,
        Err(error) => {
            tracing::warn!("the music cannot be played: {error}; save it as WAV, MP3, OGG or FLAC");
            return None;
        }
    };
    let channels = usize::from(u16::from(decoder.channels()));
    let rate_hz = f64::from(u32::from(decoder.sample_rate()));
    let most = LONGEST_S * channels * rate_hz as usize;
    let samples: Vec<f32> = decoder.take(most).collect();
    Some(LoudMusic { samples, channels, rate_hz })
}
