//! What is wrong with a show's layers, as issues.

use crate::flashes::{FlashWarning, flashes};
use crate::planned::planned;
use crate::show_light::ShowLight;
use lightbots_base::Rgb;
use lightbots_light::{FloorPicture, LayerFault};
use lightbots_plan::ShowPlan;
use lightbots_show::{AssetHash, Issue, Issues, Show, excerpt};

/// Returns all issues of a show: those of `lightbots_show::validate`, then a warning for each fault of a layer. Pictures
/// are not decoded; a picture counts as good if its file is an asset of the show.
/// [`attach_pictures`](crate::attach_pictures) decodes them.
pub fn validate(show: &Show) -> Issues {
    let mut issues = lightbots_show::validate(show);
    issues.extend(faults(show).iter().map(|fault| Issue::warning("bad-layer", text(show, fault))));
    issues
}

fn faults(show: &Show) -> Vec<LayerFault> {
    let dot = || FloorPicture::new(1, 1, vec![Rgb::BLACK]).ok();
    let is_there = |hash: &str| AssetHash::from_hex(hash).is_some_and(|hash| show.assets.contains_key(&hash));
    ShowLight::with_pictures(show, |hash| is_there(hash).then(dot).flatten()).1
}

/// A fault as text for people, such as `the layer "Sparks": speed_hz is 1000: choose a number from -3 to 3`.
fn text(show: &Show, fault: &LayerFault) -> String {
    let name = fault.layer.and_then(|number| show.layers.get(number)).map_or("", |layer| layer.name.as_str());
    match name {
        "" => fault.to_string(),
        name => {
            format!("the layer \"{}\": {} is {}: {}", excerpt(name), fault.field, fault.value, fault.remedy)
        }
    }
}

/// Returns a warning with the first moment at which the light of a planned show flashes too often. `None` if it never
/// does, or if no layer of the show can be shown.
pub fn flashes_of(show: &Show, plan: &ShowPlan) -> Option<Issue> {
    let (light, _) = ShowLight::new(show);
    if light.is_empty() {
        return None;
    }
    let (width_m, depth_m) = (show.stage.width_m, show.stage.depth_m);
    let found = flashes(&light, &planned(show, plan), (depth_m, width_m * depth_m))?;
    Some(flash_issue(show, &found))
}

/// Turns a result of [`flashes`] into a warning that names the layer, if a single one causes the flashes.
pub fn flash_issue(show: &Show, found: &FlashWarning) -> Issue {
    let layer = found.layer.and_then(|number| Some((number, show.layers.get(number)?)));
    let layer = match layer {
        Some((_, layer)) if !layer.name.is_empty() => format!("the layer \"{}\"", excerpt(&layer.name)),
        Some((number, _)) => format!("layer {}", number + 1),
        None => "the layers".into(),
    };
    let FlashWarning { show_s, flashes, is_red, .. } = found;
    let kind = if *is_red { "red flashes" } else { "flashes" };
    let message = format!(
        "at {show_s:.1} s, {layer}: {flashes} {kind} in a second on more than a quarter of the picture can cause seizures \
         (WCAG 2.3.1 allows 3); slow it down, or make it dimmer or smaller"
    );
    Issue::warning("flashes", message)
}
