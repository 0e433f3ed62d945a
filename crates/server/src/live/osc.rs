//! Open Sound Control 1.0 from and to sound desks: GO and Stop in; drives, frames, cues and controller states out.
//! docs/sound-desk.md has the messages.

use std::collections::BTreeMap;
use std::net::{Ipv4Addr, Ipv6Addr, SocketAddr};
use std::time::{Duration, Instant};

use lightbots_api::Level;
use lightbots_control::{ControllerState, EventKind, Operation};
use rosc::{OscMessage, OscPacket, OscType};
use tokio::net::UdpSocket;
use tokio::sync::broadcast::error::RecvError;

use super::conductor::Handle;
use super::desk_socket::{listen, receive};
use super::orders::News;
use crate::cli::DeskArguments;
use crate::failure::Failure;
use crate::say;
use crate::stop::Stop;
use crate::web::ScreenLog;

/// Longest packet that is read, bytes. Longer ones are cut and then ignored, as they do not decode.
const PACKET_MAX: usize = 1_024;
/// Time after a request during which equal requests are ignored, because pedals bounce and senders repeat packets.
const ONE_PRESS: Duration = Duration::from_millis(250);
/// Pause after a failed reception, so that a broken socket does not keep a processor busy.
const AFTER_ERROR: Duration = Duration::from_millis(100);
/// Beginning of all OSC addresses that are received and sent.
const PREFIX: &str = "/lightbots/";

/// What a message from a desk asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum DeskWish {
    Go,
    Stop,
}

/// The OSC sockets that the command line asks for.
#[derive(Debug)]
pub struct OscLink {
    input: Option<UdpSocket>,
    output: Option<(UdpSocket, SocketAddr)>,
    pressed: BTreeMap<DeskWish, Instant>,
}

impl OscLink {
    /// Binds the sockets that `arguments` ask for; `None` if they ask for none. The failure is one line with a remedy.
    pub async fn open(arguments: &DeskArguments) -> Result<Option<Self>, Failure> {
        let input = listen("OSC", "--osc", arguments.osc, "give GO and Stop").await?;
        let output = match arguments.osc_out {
            Some(to) => Some((sender(to).await?, to)),
            None => None,
        };
        let is_wanted = input.is_some() || output.is_some();
        Ok(is_wanted.then(|| Self { input, output, pressed: BTreeMap::new() }))
    }

    /// Receives and sends until `stop` is wanted or the conductor ends. `name_of` returns the name of a frame of the
    /// open show by its index, from 0.
    pub async fn run(
        mut self,
        handle: Handle,
        log: ScreenLog,
        stop: Stop,
        name_of: impl Fn(usize) -> String,
    ) {
        let mut news = handle.news();
        let mut bytes = [0; PACKET_MAX];
        loop {
            tokio::select! {
                () = stop.wait() => return,
                received = receive(self.input.as_ref(), &mut bytes) => match received {
                    Ok((length, _)) => {
                        for wish in self.wishes(&bytes[..length], Instant::now()) {
                            carry_out(wish, &handle, &log).await;
                        }
                    }
                    Err(error) => {
                        tracing::debug!("an OSC packet was not received: {error}");
                        tokio::time::sleep(AFTER_ERROR).await;
                    }
                },
                heard = news.recv() => match heard {
                    Ok(News::Event(event)) => self.tell(&event.kind, &name_of).await,
                    Ok(_) | Err(RecvError::Lagged(_)) => {}
                    Err(RecvError::Closed) => return,
                },
            }
        }
    }

    /// Returns what a packet asks for. Leaves out a request that was already returned less than `ONE_PRESS` ago.
    fn wishes(&mut self, packet: &[u8], now: Instant) -> Vec<DeskWish> {
        let mut wishes = wishes_of(packet);
        wishes.retain(|wish| {
            let is_same = self.pressed.get(wish).is_some_and(|before| now - *before < ONE_PRESS);
            if !is_same {
                self.pressed.insert(*wish, now);
            }
            !is_same
        });
        wishes
    }

    /// Sends the OSC message of an event, if there is an output and the event has a message.
    async fn tell(&self, event: &EventKind, name_of: &impl Fn(usize) -> String) {
        let (Some((socket, to)), Some(message)) = (&self.output, message_of(event, name_of)) else { return };
        let sent = match rosc::encoder::encode(&OscPacket::Message(message)) {
            Ok(bytes) => socket.send_to(&bytes, to).await.map(|_| ()).map_err(|error| error.to_string()),
            Err(error) => Err(error.to_string()),
        };
        if let Err(error) = sent {
            tracing::debug!("an OSC message was not sent to {to}: {error}");
        }
    }
}

async fn sender(to: SocketAddr) -> Result<UdpSocket, Failure> {
    let any: SocketAddr =
        if to.is_ipv4() { (Ipv4Addr::UNSPECIFIED, 0).into() } else { (Ipv6Addr::UNSPECIFIED, 0).into() };
    let socket = UdpSocket::bind(any)
        .await
        .map_err(|error| Failure::problem(format!("cannot send OSC to {to}: {error}; check --osc-out")))?;
    say::line(&format!("OSC is sent to {to}"));
    Ok(socket)
}

async fn carry_out(wish: DeskWish, handle: &Handle, log: &ScreenLog) {
    let (name, operation) = match wish {
        DeskWish::Go => ("GO", Operation::Go),
        DeskWish::Stop => ("Stop", Operation::StopAll),
    };
    match handle.operate(operation).await {
        Ok(()) => log.say(Level::Info, format!("{name} came by OSC.")),
        Err(refusal) => log.say(Level::Warn, format!("{name} came by OSC, and was refused: {refusal}.")),
    }
}

/// Returns what a packet asks for, each request once. Other OSC messages, and packets that are not OSC, give no requests.
fn wishes_of(packet: &[u8]) -> Vec<DeskWish> {
    let Ok((rest, packet)) = rosc::decoder::decode_udp(packet) else { return Vec::new() };
    if !rest.is_empty() {
        return Vec::new();
    }
    let (mut left, mut wishes) = (vec![packet], Vec::new());
    while let Some(packet) = left.pop() {
        match packet {
            OscPacket::Message(message) => wishes.extend(wish_of(&message)),
            // Time tags are ignored, because what a person presses is meant now.
            OscPacket::Bundle(bundle) => left.extend(bundle.content),
        }
    }
    wishes.sort_unstable();
    wishes.dedup();
    wishes
}

fn wish_of(message: &OscMessage) -> Option<DeskWish> {
    // Buttons send 1 when they are pressed and 0 when they are let go.
    let is_released = match message.args.first() {
        Some(OscType::Int(value)) => *value == 0,
        Some(OscType::Float(value)) => *value == 0.0,
        Some(OscType::Double(value)) => *value == 0.0,
        Some(OscType::Bool(value)) => !value,
        _ => false,
    };
    match message.addr.strip_prefix(PREFIX)? {
        _ if is_released => None,
        "go" => Some(DeskWish::Go),
        "stop" => Some(DeskWish::Stop),
        _ => None,
    }
}

/// The OSC message about an event; `None` for events that are not sent to desks. Frame numbers in messages count from
/// 1, durations are in seconds.
fn message_of(event: &EventKind, name_of: &impl Fn(usize) -> String) -> Option<OscMessage> {
    let number = |frame: usize| OscType::Int(i32::try_from(frame + 1).unwrap_or(i32::MAX));
    let (address, args) = match event {
        EventKind::TransitionStarted { frame, duration, .. } => (
            "drive",
            vec![number(*frame), OscType::String(name_of(*frame)), OscType::Float(duration.as_secs() as f32)],
        ),
        EventKind::FrameReached { frame, .. } => {
            ("frame", vec![number(*frame), OscType::String(name_of(*frame))])
        }
        EventKind::WaitsForGo { frame, name } => ("cue", vec![number(*frame), OscType::String(name.clone())]),
        EventKind::StateChanged(state) => ("state", vec![OscType::String(state_word(*state).to_owned())]),
        _ => return None,
    };
    Some(OscMessage { addr: format!("{PREFIX}{address}"), args })
}

fn state_word(state: ControllerState) -> &'static str {
    match state {
        ControllerState::Idle => "idle",
        ControllerState::Ready => "ready",
        ControllerState::Preparing => "preparing",
        ControllerState::Playing => "playing",
        ControllerState::Paused => "paused",
        ControllerState::Preview => "preview",
        ControllerState::Aborting => "aborting",
        ControllerState::LinkLost => "link-lost",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::Span;
    use rosc::{OscBundle, OscTime};

    fn message(addr: &str, args: Vec<OscType>) -> OscPacket {
        OscPacket::Message(OscMessage { addr: addr.to_owned(), args })
    }

    fn bytes(packet: &OscPacket) -> Vec<u8> {
        rosc::encoder::encode(packet).unwrap()
    }

    fn asked(packet: &OscPacket) -> Vec<DeskWish> {
        wishes_of(&bytes(packet))
    }

    #[test]
    fn a_press_counts_and_letting_go_does_not() {
        assert_eq!(asked(&message("/lightbots/go", vec![])), [DeskWish::Go]);
        for pressed in
            [OscType::Int(1), OscType::Float(0.7), OscType::Bool(true), OscType::String("x".into())]
        {
            assert_eq!(asked(&message("/lightbots/stop", vec![pressed])), [DeskWish::Stop]);
        }
        for released in [OscType::Int(0), OscType::Float(0.0), OscType::Double(0.0), OscType::Bool(false)] {
            assert_eq!(asked(&message("/lightbots/go", vec![released])), []);
        }
        assert_eq!(asked(&message("/lightbots/goto", vec![])), []);
        assert_eq!(asked(&message("/go", vec![])), []);
    }

    #[test]
    fn a_bundle_asks_for_each_wish_once() {
        let timetag = OscTime { seconds: 0, fractional: 1 };
        let go = message("/lightbots/go", vec![]);
        let inner = OscPacket::Bundle(OscBundle {
            timetag,
            content: vec![go.clone(), message("/lightbots/stop", vec![])],
        });
        let outer = OscPacket::Bundle(OscBundle { timetag, content: vec![go.clone(), inner, go] });
        assert_eq!(asked(&outer), [DeskWish::Go, DeskWish::Stop]);
    }

    #[test]
    fn other_bytes_ask_for_nothing() {
        let go = bytes(&message("/lightbots/go", vec![OscType::Int(1)]));
        for length in 0..go.len() {
            assert_eq!(wishes_of(&go[..length]), [], "cut at {length}");
        }
        let mut noise = 1_u64;
        for _ in 0..20_000 {
            let mut changed = go.clone();
            for _ in 0..3 {
                noise = noise.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                let at = (noise >> 33) as usize % changed.len();
                changed[at] = (noise >> 56) as u8;
            }
            let _ = wishes_of(&changed);
        }
    }

    #[test]
    fn bundles_in_bundles_end() {
        let timetag = OscTime { seconds: 0, fractional: 1 };
        let mut packet = message("/lightbots/go", vec![]);
        while bytes(&packet).len() + 20 < PACKET_MAX {
            packet = OscPacket::Bundle(OscBundle { timetag, content: vec![packet] });
        }
        assert_eq!(asked(&packet), [DeskWish::Go]);
    }

    #[test]
    fn a_bouncing_pedal_is_one_press() {
        let mut link = OscLink { input: None, output: None, pressed: BTreeMap::new() };
        let (go, began) = (bytes(&message("/lightbots/go", vec![])), Instant::now());
        let at = |ms: u64| began + Duration::from_millis(ms);
        assert_eq!(link.wishes(&go, at(0)), [DeskWish::Go]);
        assert_eq!(link.wishes(&go, at(30)), []);
        assert_eq!(link.wishes(&bytes(&message("/lightbots/stop", vec![])), at(40)), [DeskWish::Stop]);
        assert_eq!(link.wishes(&go, at(251)), [DeskWish::Go]);
    }

    #[test]
    fn desks_hear_of_drives_pictures_and_cues() {
        let name_of = |frame: usize| format!("F{frame}");
        let said =
            |event: EventKind| message_of(&event, &name_of).map(|message| (message.addr, message.args));
        let reached = EventKind::FrameReached { frame: 2, spread: Span::ZERO, wait: Span::ZERO };
        let picture = vec![OscType::Int(3), OscType::String("F2".to_owned())];
        assert_eq!(said(reached), Some(("/lightbots/frame".to_owned(), picture)));
        let waits = EventKind::WaitsForGo { frame: 0, name: "Curtain".to_owned() };
        let cue = vec![OscType::Int(1), OscType::String("Curtain".to_owned())];
        assert_eq!(said(waits), Some(("/lightbots/cue".to_owned(), cue)));
        assert_eq!(said(EventKind::Connected), None);
    }
}
