//! The layers of a show, and which of them shine in a frame.

use crate::pictures::floor_picture;
use crate::settings::light_layer;
use crate::times::FrameTimes;
use lightbots_light::{FloorPicture, LayerFault, Layers, LightLayer};
use lightbots_show::{AssetHash, FramePhase, LayerSpan, Show};
use std::collections::BTreeMap;

/// When a layer shines. Frames are given by their indices, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Span {
    Show,
    Frames { first: usize, last: usize, phase: FramePhase },
    Seconds { from_s: f64, to_s: f64 },
}

/// The layers of a show, ready to be shown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShowLight {
    layers: Vec<(usize, Span, LightLayer)>,
    pictures: Vec<FloorPicture>,
}

/// The layers that may shine in a frame, with their times.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrameLight {
    /// The layers, lowest first.
    pub layers: Layers,
    /// For each of `layers`, its index among all layers of the show, counted from 0.
    pub numbers: Vec<usize>,
    /// Whether the effect of one of `layers` goes on while show time stands.
    pub runs_freely: bool,
    /// Live light over `layers`. The times of live layers are those of the show clock.
    pub live: Layers,
}

impl FrameLight {
    /// Whether light may change while show time stands.
    pub fn is_free(&self) -> bool {
        self.runs_freely || !self.live.list().is_empty()
    }
}

impl ShowLight {
    /// Reads the layers of a show, with the decoded pictures of its assets. A layer never shines if it is wrong, lacks
    /// its picture, or its span names a missing frame. A setting without meaning is ignored. The returned faults name
    /// wrong layers, missing pictures and settings without meaning; at most
    /// [`FAULTS_MAX`](lightbots_light::FAULTS_MAX).
    pub fn new(show: &Show) -> (Self, Vec<LayerFault>) {
        Self::with_pictures(show, |hash| {
            let asset = show.assets.get(&AssetHash::from_hex(hash)?)?;
            floor_picture(asset.picture.as_ref()?)
        })
    }

    /// Like [`new`](Self::new), but gets pictures from `picture` instead of the show. It returns the picture whose file has
    /// the given hash; `None`: there is none.
    pub fn with_pictures(
        show: &Show,
        mut picture: impl FnMut(&str) -> Option<FloorPicture>,
    ) -> (Self, Vec<LayerFault>) {
        let mut light = Self::default();
        let mut faults = Vec::new();
        let mut numbers = BTreeMap::new();
        for (number, layer) in show.layers.iter().enumerate() {
            let pictures = &mut light.pictures;
            let mut number_of = |hash: &str| {
                if !numbers.contains_key(hash) {
                    let found = picture(hash);
                    numbers.insert(hash.to_owned(), found.is_some().then_some(pictures.len()));
                    pictures.extend(found);
                }
                numbers[hash]
            };
            match (light_layer(layer, number, &mut number_of), span_of(show, &layer.span)) {
                (Ok((layer, unknown)), Some(span)) => {
                    light.layers.push((number, span, layer));
                    faults.extend(unknown);
                }
                // A span that names a missing frame is reported by the validation of the show.
                (Ok((_, unknown)), None) => faults.extend(unknown),
                (Err(found), _) => faults.extend(found),
            }
        }
        faults.truncate(lightbots_light::FAULTS_MAX);
        (light, faults)
    }

    /// Whether there are no layers that can be shown.
    pub fn is_empty(&self) -> bool {
        self.layers.is_empty()
    }

    /// The pictures. Layers refer to them by their index in this list.
    pub fn pictures(&self) -> &[FloorPicture] {
        &self.pictures
    }

    /// Returns the layers that may shine while robots drive to `frame` or show it. `times` returns the times of a frame:
    /// of `frame`, and of each earlier frame that has begun in the present round of the show. If it returns `None` for
    /// `frame`, there are no layers.
    pub fn in_frame(&self, frame: usize, times: impl Fn(usize) -> Option<FrameTimes>) -> FrameLight {
        let Some(own) = times(frame) else { return FrameLight::default() };
        let mut moments = Vec::new();
        let mut layers = Vec::new();
        let mut numbers = Vec::new();
        for (number, span, layer) in &self.layers {
            let moment = match *span {
                Span::Show => Some((f64::NEG_INFINITY, f64::INFINITY, 0.0)),
                Span::Seconds { from_s, to_s } => Some((from_s, to_s, from_s)),
                Span::Frames { first, last, phase } if (first..=last).contains(&frame) => Some(match phase {
                    FramePhase::Whole => {
                        let from_s = times(first).map_or(own.drive_s, |times| times.drive_s);
                        (from_s, if frame == last { own.end_s } else { f64::INFINITY }, from_s)
                    }
                    FramePhase::Transition => (own.drive_s, own.air_s, own.drive_s),
                    FramePhase::Picture => (own.air_s, own.end_s, own.air_s),
                }),
                Span::Frames { .. } => None,
            };
            if let Some(moment) = moment {
                moments.push(moment);
                numbers.push(*number);
                layers.push(layer.clone());
            }
        }
        let runs_freely = layers.iter().any(|layer| layer.runs_freely);
        // Each layer was found valid on its own, and the document bounds their number.
        let layers = Layers::new(layers).unwrap_or_default().at_times(|number| moments[number]);
        FrameLight { layers, numbers, runs_freely, live: Layers::default() }
    }
}

fn span_of(show: &Show, span: &LayerSpan) -> Option<Span> {
    let number = |id: &str| show.frames.iter().position(|frame| frame.id.as_deref() == Some(id));
    Some(match span {
        LayerSpan::Show => Span::Show,
        LayerSpan::Seconds { from_s, to_s } => Span::Seconds { from_s: *from_s, to_s: *to_s },
        LayerSpan::Frames { first, last, phase } => {
            Span::Frames { first: number(first)?, last: number(last)?, phase: *phase }
        }
    })
}
